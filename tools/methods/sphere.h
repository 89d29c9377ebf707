#pragma once
// Triangles of unit vectors.

#include <cmath>

#include "files/measures.h"

namespace methods {

using files::triangle_area;
using files::unit;
using files::volume;
using pstripack::Point;

/// The centre of the circumscribed cap of a counterclockwise triangle, from the differences of its corners.
inline Point circumcentre(const Point& a, const Point& b, const Point& c) {
  const Point n = cross(minus(b, a), minus(c, a));
  const double length = std::sqrt(dot(n, n));
  return {n.x / length, n.y / length, n.z / length};
}

}  // namespace methods
