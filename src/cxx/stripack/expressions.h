#pragma once
// The expressions that decide STRIPACK's results. Their order of evaluation, with one rounding per operation
// in the working kind, is part of the behaviour: compile with -ffp-contract=off and change nothing.

#include <cmath>
#include <cstddef>

#include "geometry/point.h"

namespace pstripack {

template <class Real>
using Vector = Vector3<Real>;

/// Coordinates in the caller's three arrays; nodes count from 1.
template <class Real>
struct Nodes {
  const Real* x;
  const Real* y;
  const Real* z;

  template <class Int>
  Vector<Real> operator[](Int node) const {
    const auto i = static_cast<std::size_t>(node - 1);
    return {x[i], y[i], z[i]};
  }
  template <class Int>
  [[gnu::always_inline]] void prefetch(Int node) const {
    const auto i = static_cast<std::size_t>(node - 1);
    __builtin_prefetch(x + i);
    __builtin_prefetch(y + i);
    __builtin_prefetch(z + i);
  }
};

/// <c, a x b> in rounded arithmetic: > 0 if c is left of the great circle directed from a to b.
/// side(b,a,c) == -side(a,b,c) exactly; side(b,c,a) differs from side(a,b,c) by rounding.
template <class Real>
Real side(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c) {
  return c.x * (a.y * b.z - b.y * a.z) - c.y * (a.x * b.z - b.x * a.z) + c.z * (a.x * b.y - b.x * a.y);
}

/// The determinant of SWPTST in rounded arithmetic: > 0 if d is above the plane of the counterclockwise
/// triangle a, b, c.
template <class Real>
Real height(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c, const Vector<Real>& d) {
  const Vector<Real> p{a.x - d.x, a.y - d.y, a.z - d.z};
  const Vector<Real> q{b.x - d.x, b.y - d.y, b.z - d.z};
  const Vector<Real> r{c.x - d.x, c.y - d.y, c.z - d.z};
  return r.x * (q.y * p.z - p.y * q.z) - r.y * (q.x * p.z - p.x * q.z) + r.z * (q.x * p.y - p.x * q.y);
}

/// The coordinates as doubles, without rounding, for exact tests.
template <class Real>
Point as_point(const Vector<Real>& a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

template <class Real>
bool coincide(const Vector<Real>& a, const Vector<Real>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

template <class Real>
bool is_finite(const Vector<Real>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// arccos with its argument clamped to [-1,1]; a NaN stays one.
template <class Real>
Real clamped_acos(Real cosine) {
  if (cosine < Real(-1)) cosine = Real(-1);
  if (cosine > Real(1)) cosine = Real(1);
  return std::acos(cosine);
}

}  // namespace pstripack
