#include "files/clipping.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "files/map_rings.h"
#include "files/measures.h"
#include "files/pieces.h"
#include "geometry/predicates.h"
#include "point_sets.h"

namespace files {
namespace {

/// A side of the hull, counterclockwise.
struct Side {
  MapCorner from, to;
};

constexpr std::size_t kInside = static_cast<std::size_t>(-1);
/// A part of a cell, and the side of the hull that leads to each next corner; kInside: none.
struct Part {
  MapRing ring;
  std::vector<std::size_t> along;

  void add(const MapCorner& c, std::size_t side) {
    ring.push_back(c);
    along.push_back(side);
  }
};

/// True if the node is on the arc, up to rounding of the great circle of ends that may be nearly opposite.
bool is_on(const MapCorner& node, const MapCorner& p, const MapCorner& q, double tolerance) {
  return distance_to_arc(node.p, p.p, q.p) < tolerance;
}

/// Cuts a convex polygon at the great circle of side k and keeps what lies left of it. True if anything was
/// cut off.
bool cut(Part& part, const std::vector<Side>& sides, std::size_t k) {
  const MapRing& ring = part.ring;
  const Side& side = sides[k];
  const Point &a = side.from.p, &b = side.to.p;
  std::vector<int> at(ring.size());
  bool all = true;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    at[i] = pstripack::left(a, b, ring[i].p);
    all = all && at[i] >= 0;
  }
  if (all) return false;
  Part kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::size_t next = (i + 1) % ring.size();
    if (at[i] >= 0) kept.add(ring[i], at[i] == 0 && at[next] < 0 ? k : part.along[i]);
    if (at[i] * at[next] >= 0) continue;
    const std::size_t along = at[i] > 0 ? k : part.along[i];
    // Neighbouring sides of the hull meet in their node, or opposite it. Take the node itself: if they are
    // nearly one arc, their rounded intersection is far from it.
    const bool meets_last = part.along[i] == (k + sides.size() - 1) % sides.size(),
               meets_next = part.along[i] == (k + 1) % sides.size();
    if (const MapCorner& node = meets_last ? side.from : side.to;
        (meets_last || meets_next) && is_on(node, ring[i], ring[next], 1e-6)) {
      kept.add(node, along);
      continue;
    }
    // Start at the smaller end, so that the cells on both sides of the arc compute the same bits.
    const bool swap = std::tie(ring[next].p.x, ring[next].p.y, ring[next].p.z) <
                      std::tie(ring[i].p.x, ring[i].p.y, ring[i].p.z);
    const Point &p = ring[swap ? next : i].p, &q = ring[swap ? i : next].p;
    const double at_p = volume(a, b, p), at_q = volume(a, b, q);
    const double t = at_p == at_q ? 0.5 : std::clamp(at_p / (at_p - at_q), 0.0, 1.0);
    const Point x = unit({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z)});
    const LonLat angles({x}, true);
    kept.add({x, angles.lon[0], angles.lat[0]}, along);
  }
  part = std::move(kept);
  return true;
}

/// A region narrower than this, in degrees, has no parts: its corners would be one.
constexpr double kLeastRegion = 1e-10;

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
  const LonLat of_nodes = angles_of(cells.centres, mesh.given, true), of_points(cells.points, true);
  const auto corner_of = [&](std::int32_t node) -> MapCorner {
    const auto i = static_cast<std::size_t>(node) - 1;
    return {cells.centres[i], of_nodes.lon[i], of_nodes.lat[i]};
  };
  std::vector<Side> sides;
  for (std::size_t k = 0; k < boundary.size(); ++k)
    sides.push_back({corner_of(boundary[k]), corner_of(boundary[(k + 1) % boundary.size()])});

  // The cut cells are connected: search them from the boundary nodes by their neighbours.
  const pstripack::ListReader<std::int32_t> reader(mesh.lists());
  std::vector<MapRing> rings(cells.size());
  std::vector<bool> is_done(cells.size());
  std::vector<std::int32_t> queue = boundary;
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const auto f = static_cast<std::size_t>(queue[k]) - 1;
    if (is_done[f]) continue;
    is_done[f] = true;
    Part part{ring_of(cells, f, of_points, cells.corner), {}};
    part.along.assign(part.ring.size(), kInside);
    bool is_cut = false;
    for (std::size_t side = 0; side < sides.size(); ++side) is_cut = cut(part, sides, side) || is_cut;
    // Where two sides of the hull are one arc, nothing was cut at the node between them.
    for (std::size_t i = 0; k < sides.size() && i < part.ring.size(); ++i) {
      const MapCorner &p = part.ring[i], &q = part.ring[(i + 1) % part.ring.size()], &node = sides[k].from;
      if (p.p == node.p || q.p == node.p) break;
      if (part.along[i] == kInside || !is_on(node, p, q, 1e-9)) continue;
      part.ring.insert(part.ring.begin() + static_cast<std::ptrdiff_t>(i) + 1, node);
      break;
    }
    rings[f] = std::move(part.ring);
    if (!is_cut) continue;
    reader.for_each_neighbour(queue[k], [&](std::int32_t neighbour) { queue.push_back(neighbour); });
  }
  Pieces pieces(cells);
  for (std::size_t f = 0; f < cells.size(); ++f)
    pieces.add(is_done[f] ? rings[f] : ring_of(cells, f, of_points, cells.corner), f);
  Faces parts = pieces.take();
  expect_area_of_hull(parts, mesh);
  return parts;
}

Faces clipped_to_region(const Faces& cells, const Region& region) {
  const double width = region.east - region.west;
  const LonLat angles = angles_of(cells.points, cells.given_points, true);
  const std::vector<std::int32_t> corner = merged_corners(cells);
  Pieces pieces(cells);
  if (width < kLeastRegion || region.north - region.south < kLeastRegion) return pieces.take();
  for (std::size_t f = 0; f < cells.size(); ++f) {
    MapRing polygon = ring_of(cells, f, angles, corner);
    expect_no_half_turn(polygon, cells, f);
    move_to_poles(polygon);
    MapRing ring = unrolled(polygon, region.west);
    const bool around_pole = std::any_of(ring.begin(), ring.end(), [](const MapCorner& c) { return c.seam; });
    const bool hole = around_pole && (ring.back().lat > 0 ? region.north < 90 : region.south > -90);
    // A region of 360 degrees has no western or eastern edge. Cells around a pole are opened at one of their
    // corners, which adds no corner. If the region leaves out the pole, the cell has a hole and is cut into
    // two parts, at this corner and at another one opposite.
    const double opened_at = polygon[0].lon;
    if (width == 360 && around_pole) ring = unrolled(polygon, opened_at);
    std::vector<MapRing> parts;
    if (width < 360)
      parts = between_meridians(ring, region.west, width);
    else if (!hole)
      parts = {ring};
    else {
      double opposite = 0;
      double and_at = 0;
      for (const MapCorner& c : polygon) {
        const double from_first = c.lon - opened_at - 360 * std::floor((c.lon - opened_at) / 360);
        if (std::fabs(from_first - 180) < std::fabs(opposite - 180)) opposite = from_first, and_at = c.lon;
      }
      parts = between_meridians(ring, opened_at, opposite);
      for (MapRing& part : between_meridians(ring, opened_at + opposite, 360 - opposite))
        parts.push_back(std::move(part));
      for (MapRing& part : parts)
        for (const double lon : {opened_at, and_at}) move_to_meridian(part, lon);
    }
    for (const MapRing& part : parts)
      for (const MapRing& piece : between_parallels(part, region.south, region.north)) {
        MapRing arcs = with_arcs(piece);
        if (width == 360 && !hole)
          arcs.erase(std::remove_if(arcs.begin(), arcs.end(), [](const MapCorner& c) { return c.seam; }),
                     arcs.end());
        pieces.add(arcs, f);
      }
  }
  return pieces.take();
}

}  // namespace files
