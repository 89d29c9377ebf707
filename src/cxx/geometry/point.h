#pragma once

namespace pstripack {

/// A node as the caller gave it: Cartesian coordinates of a vector that points at it from the centre
/// of the sphere. Its length is 1 up to rounding unless the predicates on directions are used.
struct Point {
  double x, y, z;
};

inline bool operator==(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
inline bool operator!=(const Point& a, const Point& b) { return !(a == b); }

}  // namespace pstripack
