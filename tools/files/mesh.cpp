#include "files/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/parallel_for.h"
#include "files/near_nodes.h"
#include "geometry/measures.h"
#include "lists/limits.h"
#include "mesh/delaunay.h"
#include "stripack/triangle_list.h"
#include "stripack/voronoi.h"

namespace files {
namespace {

using pstripack::Triangle;
using pstripack::Triangles;

Trmesh& the_trmesh() {
  static Trmesh trmesh = [](const pstripack::TrmeshCall& call) { return pstripack::trmesh(call); };
  return trmesh;
}

Mesh empty_mesh(std::vector<Point> points) {
  Mesh mesh;
  const std::size_t n = points.size();
  mesh.points = std::move(points);
  mesh.list.resize(6 * n - 12);
  mesh.lptr.resize(6 * n - 12);
  mesh.lend.resize(n);
  return mesh;
}

void check_count(std::size_t n) {
  if (n < 3) throw NoMesh(fmt::format("a triangulation needs at least 3 nodes, here are {}", n));
  if (n > static_cast<std::size_t>(pstripack::most_nodes<std::int32_t>()))
    throw NoMesh(
        fmt::format("at most {} nodes: 6N-12 must fit 32 bits", pstripack::most_nodes<std::int32_t>()));
}

/// work(); if all nodes lie on one great circle, which the kernel finds, NoMesh.
template <class Work>
auto off_one_great_circle(const Work& work) {
  try {
    return work();
  } catch (const std::domain_error&) {
    throw NoMesh("all nodes lie on one great circle: they have no triangulation");
  }
}

/// The arc opposite a node in one of its triangles, from one neighbour to the next.
struct Step {
  std::int32_t node, from, to;
  bool operator<(const Step& other) const { return std::tie(node, from) < std::tie(other.node, other.from); }
};

/// The neighbours of a node in the order of its list. [begin, end): its steps, sorted.
std::vector<std::int32_t> ring_of(std::int32_t node, const Step* begin, const Step* end) {
  const auto fail = [&](const std::string& what) { throw NoMesh(fmt::format("node {}: {}", node, what)); };
  if (begin == end) fail("is the corner of no triangle");
  std::vector<std::int32_t> reached;
  for (const Step* s = begin; s != end; ++s) reached.push_back(s->to);
  std::sort(reached.begin(), reached.end());
  const Step* step = begin;
  std::size_t fans = 0, length = reached.size();
  for (const Step* s = begin; s != end; ++s) {
    if (s + 1 != end && s->from == s[1].from)
      fail(fmt::format("two triangles on one side of the arc to node {}", s->from));
    if (!std::binary_search(reached.begin(), reached.end(), s->from)) step = s, ++fans, ++length;
  }
  if (fans > 1) fail("its triangles are not one fan");
  std::vector<std::int32_t> ring{step->from};
  while (step != end && step->from == ring.back() && step->to != ring[0] && ring.size() <= length) {
    ring.push_back(step->to);
    step = std::lower_bound(begin, end, Step{node, step->to, 0});
  }
  if (ring.size() != length) fail("its triangles are not one cycle");
  if (fans > 0) ring.back() = -ring.back();
  return ring;
}

}  // namespace

void set_trmesh(Trmesh trmesh) { the_trmesh() = std::move(trmesh); }

Mesh triangulate(std::vector<Point> points) {
  const std::size_t n = points.size();
  check_count(n);
  // Ranks, unlike this process, need the first three nodes off one great circle.
  const bool starts_anywhere = pstripack::left(points[0], points[1], points[2]) == 0;
  std::vector<double> x, y, z;
  for (const Point& p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  Mesh mesh = empty_mesh(std::move(points));
  const pstripack::TrmeshCall call{static_cast<std::int32_t>(n),
                                   {x.data(), y.data(), z.data()},
                                   {mesh.list.data(), mesh.lptr.data(), mesh.lend.data(), &mesh.lnew},
                                   true,
                                   starts_anywhere};
  const pstripack::TrmeshResult result =
      off_one_great_circle([&] { return starts_anywhere ? pstripack::trmesh(call) : the_trmesh()(call); });
  if (result.ier > 0)
    throw CoincidentNodes(static_cast<std::size_t>(result.node) - 1,
                          static_cast<std::size_t>(result.other) - 1);
  if (result.ier < 0) throw NoMesh(fmt::format("the triangulation failed with code {}", result.ier));
  return mesh;
}

std::vector<Duplicate> duplicates(const std::vector<Point>& points) {
  check_count(points.size());
  pstripack::Workspace workspace(pstripack::workspace_bytes(points.size()));
  const pstripack::Hull hull =
      off_one_great_circle([&] { return pstripack::delaunay(points.data(), points.size(), workspace); });
  return coincident_nodes(hull);
}

Mesh mesh_of(std::vector<Point> points, const Triangles& triangles) {
  const std::size_t n = points.size();
  check_count(n);
  std::vector<Step> steps;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) steps.push_back({t[k] + 1, t[(k + 1) % 3] + 1, t[(k + 2) % 3] + 1});
  std::sort(steps.begin(), steps.end());

  Mesh mesh = empty_mesh(std::move(points));
  std::size_t slot = 0;
  const Step *begin = steps.data(), *const last = begin + steps.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto node = static_cast<std::int32_t>(i + 1);
    const Step* const end = std::find_if(begin, last, [&](const Step& step) { return step.node != node; });
    const std::vector<std::int32_t> ring = ring_of(node, begin, end);
    if (slot + ring.size() > mesh.list.size()) throw NoMesh("more arcs than a triangulation can have");
    const std::size_t first_slot = slot;
    for (const std::int32_t neighbour : ring) {
      mesh.list[slot] = neighbour;
      mesh.lptr[slot] = static_cast<std::int32_t>(slot + 2);
      ++slot;
    }
    mesh.lptr[slot - 1] = static_cast<std::int32_t>(first_slot + 1);
    mesh.lend[i] = static_cast<std::int32_t>(slot);
    begin = end;
  }
  mesh.lnew = static_cast<std::int32_t>(slot + 1);
  return mesh;
}

std::size_t Mesh::triangles() const {
  const std::size_t arcs = (static_cast<std::size_t>(lnew) - 1) / 2;
  return arcs + (has_boundary() ? 1 : 2) - points.size();  // Euler's formula
}

bool Mesh::has_boundary() const {
  return pstripack::ListReader<std::int32_t>(lists()).first_boundary_node() > 0;
}

std::vector<std::int32_t> triangles_of(const Mesh& mesh) {
  std::vector<std::int32_t> triangles(6 * mesh.points.size() - 12);
  std::int32_t count = 0;
  if (triangle_list(mesh.lists(), 3, count, triangles.data()) != pstripack::TriangleListStatus::done)
    throw NoMesh("the lists are broken");
  triangles.resize(3 * static_cast<std::size_t>(count));
  return triangles;
}

std::vector<std::int32_t> triangles_to_write(const Mesh& mesh) {
  const std::vector<std::int32_t> all = triangles_of(mesh);
  if (mesh.longest == 0) return all;
  const auto is_short = [&](std::int32_t a, std::int32_t b) {
    return is_near(mesh.points[static_cast<std::size_t>(a) - 1], mesh.points[static_cast<std::size_t>(b) - 1],
                   mesh.longest);
  };
  std::vector<std::int32_t> kept;
  for (std::size_t t = 0; t < all.size(); t += 3) {
    const std::int32_t a = all[t], b = all[t + 1], c = all[t + 2];
    if (is_short(a, b) && is_short(b, c) && is_short(c, a)) kept.insert(kept.end(), {a, b, c});
  }
  return kept;
}

std::vector<Point> unit(const std::vector<Point>& points) {
  std::vector<Point> result(points.size());
  pstripack::parallel_for(points.size(), points.size(), [&](std::size_t i) {
    result[i] = pstripack::length_is_one(points[i]) ? points[i] : unit(points[i]);
  });
  return result;
}

namespace {

/// measure(nodes, a, b, c) of all triangles, on threads.
template <class Measure>
auto measures_of(const std::vector<Point>& points, const std::vector<std::int32_t>& triangles,
                 const Measure& measure) {
  const pstripack::Directions nodes(points.data(), points.size());
  std::vector<decltype(measure(nodes, 0, 0, 0))> all(triangles.size() / 3);
  pstripack::parallel_for(all.size(), 4 * all.size(), [&](std::size_t t) {
    all[t] = measure(nodes, triangles[3 * t] - 1, triangles[3 * t + 1] - 1, triangles[3 * t + 2] - 1);
  });
  return all;
}

/// The faces are these triangles. Without points they have no areas.
Faces faces_of(const std::vector<Point>& points, const std::vector<std::int32_t>& triangles) {
  Faces faces;
  faces.points = unit(points);
  faces.corner = triangles;
  faces.begin.resize(triangles.size() / 3 + 1);
  for (std::size_t f = 0; f < faces.begin.size(); ++f) faces.begin[f] = 3 * f;
  if (!points.empty())
    faces.area = measures_of(points, triangles, [](const auto&... nodes) { return triangle_area(nodes...); });
  return faces;
}

}  // namespace

std::vector<Point> circumcentres(const std::vector<Point>& points,
                                 const std::vector<std::int32_t>& triangles) {
  return measures_of(points, triangles, [](const auto&... nodes) { return circumcentre(nodes...); });
}

std::size_t Faces::most_corners() const {
  std::size_t most = 0;
  for (std::size_t f = 0; f < size(); ++f) most = std::max(most, corners(f));
  return most;
}

Faces triangle_faces(const Mesh& mesh) {
  Faces faces = faces_of(mesh.points, triangles_to_write(mesh));
  faces.variant = mesh.variant;
  return faces;
}

std::vector<std::int32_t> hull_of(const Mesh& mesh) {
  std::vector<std::int32_t> corners(mesh.points.size());
  corners.resize(
      static_cast<std::size_t>(pstripack::boundary_nodes(mesh.lists(), corners.data()).boundary_nodes));
  return corners;
}

namespace {

/// Each area is right to 128 * 2^-53 of itself, and so is their sum but for the rounding of n - 1 additions.
void expect_whole_sphere(const std::vector<double>& areas) {
  constexpr double kSphere = 12.566370614359172, u = 0x1p-53;
  for (std::size_t k = 0; k < areas.size(); ++k)
    if (!(areas[k] >= 0)) throw NoMesh(fmt::format("the area of the cell of node {} is {}", k + 1, areas[k]));
  const double sum = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (!(std::fabs(sum - kSphere) <= (130 + static_cast<double>(areas.size())) * u * kSphere))
    throw NoMesh(
        fmt::format("the areas of the cells add up to {:.15g} steradians instead of 4 pi: please "
                    "report these nodes",
                    sum));
}

}  // namespace

Faces voronoi_faces(const Mesh& mesh, bool with_corners) {
  const pstripack::Directions directions(mesh.points.data(), mesh.points.size());
  Faces cells;
  if (with_corners) cells = voronoi_cells(mesh.lists(), directions, true);
  cells.begin.resize(mesh.points.size() + 1);
  cells.centres = unit(mesh.points);
  cells.area.resize(mesh.points.size());
  if (!pstripack::cell_areas(mesh.lists(), directions, cells.area.data()))
    throw NoMesh("the lists are broken");
  expect_whole_sphere(cells.area);
  return cells;
}

std::vector<double> areas(const Faces& faces) {
  std::vector<double> all(faces.size());
  const auto point = [&](std::size_t k) { return faces.point(k); };
  pstripack::parallel_for(all.size(), 8 * all.size(), [&](std::size_t f) {
    if (!faces.area.empty() && !std::isnan(faces.area[f])) {
      all[f] = faces.area[f];
      return;
    }
    const std::size_t begin = faces.begin[f], end = faces.begin[f + 1];
    // Parts of a cell may be far from its node, and small.
    const auto is_small = [&] {
      for (std::size_t k = begin; k < end; ++k)
        if (dot(point(begin), point(k)) < 0.5) return false;
      return true;
    };
    if (faces.centres.empty() || (!faces.nodes.empty() && is_small())) {
      for (std::size_t k = begin + 1; k + 1 < end; ++k)
        all[f] += triangle_area(point(begin), point(k), point(k + 1));
    } else {
      for (std::size_t k = begin; k < end; ++k)
        all[f] += triangle_area(faces.centres[f], point(k), point(faces.after(f, k)));
    }
  });
  return all;
}

namespace {

/// The columns of faces that we compute. `nodes`: of triangles, as given.
Columns measures_of(const Faces& faces, const std::vector<Point>& nodes) {
  Columns columns{{"area", "area of the face on the unit sphere", "sr", areas(faces)},
                  {"area_km2", "area of the face on a sphere of radius 6371 km", "km2"}};
  for (const double a : columns[0].numbers) columns[1].numbers.push_back(a * kEarthRadius * kEarthRadius);
  if (faces.centres.empty()) {
    const auto radius = [](const pstripack::Directions& at, auto a, auto b, auto c) {
      return kEarthRadius *
             circumcircle(direction_of(at, a), direction_of(at, b), direction_of(at, c)).radius;
    };
    columns.push_back({"circumradius_km", "circumradius of the triangle on a sphere of radius 6371 km", "km",
                       measures_of(nodes, faces.corner, radius)});
    return columns;
  }
  LonLat angles(centroids(faces), true);
  columns.push_back(
      {"centroid_lon", "longitude of the centroid of the face", "degrees", std::move(angles.lon)});
  columns.push_back(
      {"centroid_lat", "latitude of the centroid of the face", "degrees", std::move(angles.lat)});
  return columns;
}

}  // namespace

void add_columns(Faces& faces, const Mesh& mesh) {
  const bool are_cells = !faces.centres.empty();
  (are_cells ? faces.given_centres : faces.given_points) = mesh.given;
  std::vector<double> degrees(mesh.points.size());
  for (std::size_t i = 0; i < degrees.size(); ++i)
    degrees[i] = pstripack::nbcnt(mesh.lend[i], mesh.lptr.data());
  Columns measures = faces.columns_of_parts;
  for (Column& column : measures_of(faces, mesh.points)) measures.push_back(std::move(column));
  Columns& of_nodes = are_cells ? faces.columns_of_faces : faces.columns_of_points;
  of_nodes = mesh.columns;
  Column degree = whole_numbers("degree", "number of neighbours of the node", std::move(degrees));
  std::vector<std::string> names{degree.name};
  for (const Column& c : measures) names.push_back(c.name);
  const auto is_ours = [&](const Column& c) {
    const Column* const ours = c.name == degree.name ? &degree : find(measures, c.name);
    return ours != nullptr && ours->long_name == c.long_name;
  };
  of_nodes.erase(std::remove_if(of_nodes.begin(), of_nodes.end(), is_ours), of_nodes.end());
  make_names_differ(of_nodes, names);
  of_nodes.push_back(std::move(degree));
  if (are_cells && !faces.nodes.empty()) {
    of_nodes = at_nodes(of_nodes, faces.nodes);
    faces.given_centres = at_nodes(faces.given_centres, faces.nodes);
  }
  for (Column& column : measures) faces.columns_of_faces.push_back(std::move(column));
}

}  // namespace files
