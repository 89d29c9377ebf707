#include "thesis/defects.h"

#include <cmath>
#include <map>
#include <utility>

#include "geometry/predicates.h"

namespace thesis {
namespace {

using pstripack::index_t;
using pstripack::Point;

/// Rounding of coordinates can move a node this far off the plane of cocircular nodes.
constexpr double kTie = 1e-14;

/// The height of d above the plane of a, b, c.
double height(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point normal = cross(minus(b, a), minus(c, a));
  return dot(normal, minus(d, a)) / std::sqrt(dot(normal, normal));
}

}  // namespace

Defects find_defects(const std::vector<Point>& points, const pstripack::Triangles& triangles) {
  const pstripack::Coordinates predicates(points.data(), points.size());
  const auto point = [&](index_t v) { return points[static_cast<std::size_t>(v)]; };
  std::map<std::pair<index_t, index_t>, index_t> opposite;  // of each arc, the node on its left
  Defects found;
  for (const auto& t : triangles) {
    if (predicates.left(t[0], t[1], t[2]) <= 0) ++found.inverted;
    for (std::size_t i = 0; i < 3; ++i) opposite[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
  }
  for (const auto& [arc, c] : opposite) {
    const auto [a, b] = arc;
    const auto beyond = opposite.find({b, a});
    if (beyond == opposite.end()) {
      ++found.boundary;
    } else if (a < b && predicates.above(a, b, c, beyond->second)) {
      const bool is_tie = height(point(a), point(b), point(c), point(beyond->second)) < kTie;
      ++(is_tie ? found.ties : found.not_delaunay);
    }
  }
  return found;
}

}  // namespace thesis
