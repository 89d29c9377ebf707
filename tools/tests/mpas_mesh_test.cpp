// MPAS meshes of odd nodes, and what is none. mpas_mesh.py recomputes all variables.

#include "files/mpas_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "error_of.h"
#include "point_sets.h"

namespace files {
namespace {

MpasMesh mpas_mesh_of(const std::vector<Point>& nodes) {
  std::vector<std::size_t> kept;
  return mpas_mesh(triangulate(nodes), kept);
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
    const std::string error = error_of([&] { mpas_mesh(right.cells, right.vertices, around); });
    EXPECT_EQ(error.rfind(what, 0), 0U) << error;
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
