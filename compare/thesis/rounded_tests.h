#pragma once
// The two tests of the thesis, in floating point as printed, without protection against rounding.

#include <algorithm>
#include <cmath>

#include "geometry/point.h"

namespace thesis {

using pstripack::Point;

/// det(p, p1, p2): not negative where p lies left of the great circle directed from p1 to p2, or on it.
inline double leftness(const Point& p, const Point& p1, const Point& p2) { return dot(p, cross(p1, p2)); }

inline double arc_length(const Point& a, const Point& b) {
  return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
}

struct Circle {
  Point centre;
  double radius;
};

/// The circle through three points, around the left-hand side of pi -> pj -> pk.
/// If points coincide it is not-a-number, and no point lies inside.
inline Circle circumcircle(const Point& pi, const Point& pj, const Point& pk) {
  const Point c = cross(minus(pj, pi), minus(pk, pi));
  const double length = std::sqrt(dot(c, c));
  const Point centre{c.x / length, c.y / length, c.z / length};
  return {centre, arc_length(pi, centre)};
}

inline bool is_inside(const Point& p, const Circle& circle) {
  return arc_length(p, circle.centre) < circle.radius;
}

}  // namespace thesis
