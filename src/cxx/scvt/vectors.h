#pragma once

#include <cmath>

#include "geometry/point.h"

namespace pstripack::scvt {

inline Point scaled(double f, const Point& p) { return {f * p.x, f * p.y, f * p.z}; }
inline Point plus(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point normalized(const Point& p) { return scaled(1 / std::sqrt(dot(p, p)), p); }

}  // namespace pstripack::scvt
