#pragma once
// Triangles of unit vectors.

#include <cmath>

#include "geometry/point.h"

namespace methods {

using pstripack::Point;

/// The centre of the circumscribed cap of a counterclockwise triangle, from the differences of its corners.
inline Point circumcentre(const Point& a, const Point& b, const Point& c) {
  const Point n = cross(minus(b, a), minus(c, a));
  const double length = std::sqrt(dot(n, n));
  return {n.x / length, n.y / length, n.z / length};
}

/// det(a,b,c), accurate for close vectors.
inline double volume(const Point& a, const Point& b, const Point& c) {
  return dot(a, cross(minus(b, a), minus(c, a)));
}

/// The area on the sphere, negative where the corners are clockwise (van Oosterom and Strackee 1983).
inline double triangle_area(const Point& a, const Point& b, const Point& c) {
  return 2 * std::atan2(volume(a, b, c), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

}  // namespace methods
