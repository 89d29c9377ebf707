#pragma once

#include <cmath>

#include "point_sets.h"

namespace point_sets {

/// The centroid of node p's Voronoi cell, where a step of Lloyd's method moves p. It is computed from the
/// plane triangles of p and two consecutive corners; it is p if they have no area. neighbour(0), ...,
/// neighbour(count-1): the neighbours of p, counterclockwise.
template <class Count, class Neighbour>
pstripack::Point middle_of_cell(const pstripack::Point& p, Count count, const Neighbour& neighbour) {
  const auto corner = [&](Count i) {
    return normalized(cross(minus(neighbour(i % count), p), minus(neighbour((i + 1) % count), p)));
  };
  pstripack::Point sum{0, 0, 0}, q = corner(0);
  for (Count i = 1; i <= count; ++i) {
    const pstripack::Point r = corner(i), n = cross(minus(q, p), minus(r, p));
    const double area = std::sqrt(dot(n, n));
    sum = {sum.x + area * (p.x + q.x + r.x), sum.y + area * (p.y + q.y + r.y),
           sum.z + area * (p.z + q.z + r.z)};
    q = r;
  }
  return dot(sum, sum) > 0 ? normalized(sum) : p;
}

/// p, moved towards `there` by this fraction of the distance.
inline pstripack::Point part_of_the_way(const pstripack::Point& p, const pstripack::Point& there,
                                        double part) {
  return normalized(
      {p.x + part * (there.x - p.x), p.y + part * (there.y - p.y), p.z + part * (there.z - p.z)});
}

}  // namespace point_sets
