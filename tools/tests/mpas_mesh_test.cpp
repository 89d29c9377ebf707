// Who touches whom in an MPAS mesh, and what adds up. mpas_mesh.py recomputes all variables.

#include "files/mpas_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "point_sets.h"

namespace files {
namespace {

std::size_t at(MpasMesh::Index i) { return static_cast<std::size_t>(i); }

MpasMesh mpas_mesh_of(const std::vector<Point>& nodes) {
  std::vector<std::size_t> kept;
  return mpas_mesh(triangulate(nodes), kept);
}

/// Kites add up to triangles and cells; weights are antisymmetric but for the lengths in them.
void expect_sums(const MpasMesh& mesh) {
  std::vector<double> of_cells(mesh.cells.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const std::array<double, 3> kites = mesh.kites(v);
    double size = 0;
    for (std::size_t j = 0; j < 3; ++j)
      if (const MpasMesh::Index c = mesh.cells_on_vertex[v][j]; c != MpasMesh::kNone)
        of_cells[at(c)] += kites[j], size = std::max(size, mesh.areas[at(c)]);
    ASSERT_NEAR(kites[0] + kites[1] + kites[2], mesh.triangle_area(v), 4e-13 * size);
  }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    ASSERT_NEAR(of_cells[c], mesh.areas[c], 4e-13 * mesh.areas[c]);
  const auto scaled = [&](std::size_t e, std::size_t other) {
    double sum = 0;
    mesh.for_each_around(e, [&](MpasMesh::Index f, double weight) {
      if (at(f) == other) sum += weight * mesh.distances[e] / mesh.width(other);
    });
    return sum;
  };
  for (std::size_t e = 0; e < std::min<std::size_t>(mesh.distances.size(), 500); ++e)
    mesh.for_each_around(e, [&](MpasMesh::Index f, double) {
      if (mesh.width(e) > 0 && mesh.width(at(f)) > 0) {
        ASSERT_NEAR(scaled(e, at(f)), -scaled(at(f), e), 1e-12);
      }
    });
}

TEST(mpas_mesh, adds_up) {
  for (const char* const family :
       {"random", "hemisphere", "icosahedral", "latlon", "cubed-sphere", "variable"}) {
    SCOPED_TRACE(family);
    const MpasMesh mesh = mpas_mesh_of(point_sets::make(family, 600));
    expect_sums(mesh);
    if (std::string(family) == "hemisphere") continue;
    EXPECT_EQ(mesh.cells.size() + mesh.vertices.size(), mesh.cells_on_edge.size() + 2);
    EXPECT_NEAR(std::accumulate(mesh.areas.begin(), mesh.areas.end(), 0.0), 4 * std::acos(-1), 1e-12);
  }
}

TEST(mpas_mesh, may_have_a_cell_with_very_many_neighbours) {
  constexpr int kAround = 20000;
  std::vector<Point> nodes{{0, 0, 1}, {0, 0, -1}};
  for (int k = 0; k < kAround; ++k) {
    const double lon = 2 * std::acos(-1) * k / kAround;
    nodes.push_back({std::cos(lon), std::sin(lon), 0});
  }
  const MpasMesh mesh = mpas_mesh_of(nodes);
  EXPECT_EQ(mesh.most_sides(), static_cast<std::size_t>(kAround));
}

TEST(mpas_mesh, without_whole_cells_is_refused) {
  EXPECT_THROW(mpas_mesh_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), NoMesh);
}

TEST(mpas_mesh, names_cells_and_vertices_that_are_wrong) {
  const MpasMesh right = mpas_mesh_of(point_sets::make("icosahedral", 12));
  const auto expect = [&](std::size_t vertex, const MpasMesh::Three& cells, const std::string& what) {
    std::vector<MpasMesh::Three> around = right.cells_on_vertex;
    around[vertex] = cells;
    try {
      mpas_mesh(right.cells, right.vertices, around);
      FAIL() << what;
    } catch (const NoMesh& e) {
      EXPECT_EQ(std::string(e.what()).rfind(what, 0), 0U) << e.what();
    }
  };
  constexpr MpasMesh::Index kNone = MpasMesh::kNone;
  const auto [a, b, c] = right.cells_on_vertex[7];
  expect(7, {kNone, kNone, kNone}, "vertex 8: has no cell");
  expect(7, {a, b, a}, "vertex 8: a cell is named twice");
  expect(7, {a, c, b}, "cell ");  // clockwise
  expect(7, {a, b, kNone}, "cell ");
}

}  // namespace
}  // namespace files
