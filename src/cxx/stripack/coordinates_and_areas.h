#pragma once
// TRANS, SCOORD, LEFT, AREAS, TRIAREAS: conversions and measures on the unit sphere, for Real = float,
// double.

#include <cstddef>

#include "stripack/expressions.h"

namespace pstripack {

/// TRANS: Cartesian coordinates of n points given by latitude and longitude in radians. x and y may be the
/// same arrays as rlat and rlon, in either order.
template <class Real>
void trans(std::ptrdiff_t n, const Real* rlat, const Real* rlon, Real* x, Real* y, Real* z);

template <class Real>
struct SphericalCoordinates {
  Real latitude, longitude, norm;  ///< in radians, -pi/2..pi/2; in radians, -pi..pi; length of the vector
};

/// SCOORD. The zero vector has latitude and longitude 0.
template <class Real>
SphericalCoordinates<Real> scoord(const Vector<Real>& p);

/// LEFT: true if p lies in the closed hemisphere left of the great circle from a to b, by rounded arithmetic;
/// false for NaN. The exact sign is `left` of geometry/predicates.h.
template <class Real>
bool closed_left(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& p) {
  return side(a, b, p) >= Real(0);
}

/// AREAS: area of the spherical triangle whose corners lie in the directions of a, b, c, in steradians,
/// 0..2 pi, for either orientation. Computed in double; 0 for null triangles, NaN for NaN. By the original's
/// formula where its error is below 2^-20 of the area, and under original_rules(); else right up to 64u.
template <class Real>
Real areas(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c);

/// TRIAREAS: area[nt] of the triangles[3*nt], in steradians, as AREAS. Corners are nodes 1..n; NaN for a
/// triangle with a corner outside 1..n.
template <class Real, class Int>
void triangle_areas(Int n, const Nodes<Real>& nodes, std::ptrdiff_t nt, const Int* triangles, Real* area);

}  // namespace pstripack
