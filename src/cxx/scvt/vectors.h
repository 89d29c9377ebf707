#pragma once

#include <cmath>

#include "geometry/point.h"

namespace pstripack::scvt {

inline Point scaled(double f, const Point& p) { return {f * p.x, f * p.y, f * p.z}; }
inline Point plus(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point normalized(const Point& p) { return scaled(1 / std::sqrt(dot(p, p)), p); }

/// In single precision, for pairs of L-BFGS: they take most of a run's memory, and need no more digits.
struct SinglePoint {
  float x, y, z;
};
inline SinglePoint single(const Point& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}
inline Point point(const SinglePoint& p) { return {p.x, p.y, p.z}; }

}  // namespace pstripack::scvt
