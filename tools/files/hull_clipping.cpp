// Voronoi cells cut at the hull of their nodes.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "files/clipping.h"
#include "files/map_rings.h"
#include "files/measures.h"
#include "files/pieces.h"
#include "geometry/predicates.h"

namespace files {
namespace {

/// Cuts a convex polygon at the great circle from a to b and keeps what lies left of it. True if anything was
/// cut off.
bool cut(std::vector<Point>& ring, const Point& a, const Point& b) {
  constexpr double kNear = 1e-9;
  std::vector<Point> kept;
  bool is_cut = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    // Start at the smaller end, so that the cells on both sides of the arc compute the same bits.
    const auto [p, q] = std::minmax(ring[i], ring[(i + 1) % ring.size()], [](const Point& s, const Point& t) {
      return std::tie(s.x, s.y, s.z) < std::tie(t.x, t.y, t.z);
    });
    const int here = pstripack::left(a, b, ring[i]), at_p = pstripack::left(a, b, p),
              at_q = pstripack::left(a, b, q);
    if (here >= 0) kept.push_back(ring[i]);
    is_cut = is_cut || here < 0;
    if (at_p * at_q >= 0) continue;
    const double to_p = volume(a, b, p), to_q = volume(a, b, q);
    const double t = to_p == to_q ? 0.5 : std::clamp(to_p / (to_p - to_q), 0.0, 1.0);
    const Point x = unit({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z)});
    // The corners of the hull are the nodes.
    kept.push_back(length(minus(x, a)) < kNear ? a : length(minus(x, b)) < kNear ? b : x);
  }
  ring = std::move(kept);
  return is_cut;
}

/// Corners are rounded to 1e-16 rad: in a hull narrower than some 1e-10 rad the parts of cells have no
/// meaning.
void expect_area_of_hull(const Faces& parts, const Mesh& mesh) {
  constexpr double kMost = 1e-6;  // of the hull
  const auto sum = [](const std::vector<double>& areas) {
    return std::accumulate(areas.begin(), areas.end(), 0.0);
  };
  const std::vector<double> of_parts = areas(parts);
  const double hull = sum(triangle_faces(mesh).area);
  if (!(std::fabs(sum(of_parts) - hull) <= kMost * hull) ||
      std::any_of(of_parts.begin(), of_parts.end(), [&](double area) { return !(area >= -kMost * hull); }))
    throw NoMesh(
        "the hull of the nodes is so narrow that rounded corners cannot show the parts of cells in it: "
        "leave out --clip-to-hull");
}

}  // namespace

Faces clipped_to_hull(const Faces& cells, const Mesh& mesh) {
  if (!mesh.has_boundary()) return cells;
  const std::vector<std::int32_t> boundary = hull_of(mesh);
  const auto node_at = [&](std::size_t k) {
    return cells.centres[static_cast<std::size_t>(boundary[k % boundary.size()]) - 1];
  };
  Pieces pieces(cells);
  const LonLat angles(cells.points, true);
  // The cut cells are connected: search them from the boundary nodes by their neighbours.
  const pstripack::ListReader<std::int32_t> reader(mesh.lists());
  std::vector<std::vector<Point>> rings(cells.size());
  std::vector<bool> is_done(cells.size());
  std::vector<std::int32_t> queue = boundary;
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const auto f = static_cast<std::size_t>(queue[k]) - 1;
    if (is_done[f]) continue;
    is_done[f] = true;
    for (std::size_t c = cells.begin[f]; c < cells.begin[f + 1]; ++c) rings[f].push_back(cells.point(c));
    bool is_cut = false;
    for (std::size_t side = 0; side < boundary.size(); ++side)
      is_cut = cut(rings[f], node_at(side), node_at(side + 1)) || is_cut;
    if (is_cut)
      reader.for_each_neighbour(queue[k], [&](std::int32_t neighbour) { queue.push_back(neighbour); });
  }
  for (std::size_t f = 0; f < cells.size(); ++f) {
    MapRing ring;
    for (const Point& p : rings[f]) ring.push_back({p, longitude(p), latitude(p)});
    pieces.add(is_done[f] ? ring : ring_of(cells, f, angles, cells.corner), f);
  }
  Faces parts = pieces.take();
  expect_area_of_hull(parts, mesh);
  return parts;
}

}  // namespace files
