#pragma once

#include <cmath>

#include "geometry/point.h"

namespace pstripack::scvt {

inline Point normalized(const Point& p) { return scaled(1 / std::sqrt(dot(p, p)), p); }

/// The direction of the point (u,v) of a face 0..5 of the cube around the unit sphere.
inline Point on_face(int face, double u, double v) {
  const double side = face % 2 == 0 ? 1 : -1;
  return normalized(face < 2 ? Point{side, u, v} : face < 4 ? Point{u, side, v} : Point{u, v, side});
}

/// In single precision, for pairs of L-BFGS: they take most of a run's memory, and need no more digits.
struct SinglePoint {
  float x, y, z;
};
inline SinglePoint single(const Point& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}
inline Point point(const SinglePoint& p) { return {p.x, p.y, p.z}; }

}  // namespace pstripack::scvt
