#pragma once
// TRANS, SCOORD, LEFT, AREAS, TRIAREAS: conversions and measures on the unit sphere, for Real = float,
// double.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/measures.h"
#include "geometry/predicates.h"
#include "stripack/expressions.h"
#include "stripack/original/original_rules.h"

namespace pstripack {

template <class Real>
struct SphericalCoordinates {
  Real latitude, longitude, norm;  ///< in radians, -pi/2..pi/2; in radians, -pi..pi; length of the vector
};

/// LEFT: true if p lies in the closed hemisphere left of the great circle from a to b, by rounded arithmetic;
/// false for NaN. The exact sign is `left` of geometry/predicates.h.
template <class Real>
bool closed_left(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& p) {
  return side(a, b, p) >= Real(0);
}

template <class Real>
Vector<double> widen(const Vector<Real>& a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

/// The area by the angles: that at a corner is the angle between the normals of its two sides. With u =
/// 2^-53, a normal is wrong by 1.2u over the sine of its side, and 4u; an angle by as much as both its
/// normals are, by 16u over its sine for its cosine, and 4u; the sum by 8u. Together less than 8u over the
/// least sine of a side, and 100u over that of an angle. `certain`: both are below 2^-21 of the area.
inline double area_by_angles(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c,
                             bool& certain) {
  const Vector<double> ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
  const double square_ab = dot(ab, ab), square_bc = dot(bc, bc), square_ca = dot(ca, ca);
  certain = false;
  if (square_ab == 0 || square_bc == 0 || square_ca == 0) return 0;
  const auto unit = [](const Vector<double>& v, double square) {
    const double length = std::sqrt(square);
    return Vector<double>{v.x / length, v.y / length, v.z / length};
  };
  const Vector<double> n_ab = unit(ab, square_ab), n_bc = unit(bc, square_bc), n_ca = unit(ca, square_ca);
  const double at_a = -dot(n_ab, n_ca), at_b = -dot(n_bc, n_ab), at_c = -dot(n_ca, n_bc);
  const double angles = clamped_acos(at_a) + clamped_acos(at_b) + clamped_acos(at_c);
  const double area = angles - std::acos(-1.0);
  // Squares of the least sines; that of a side times those of all lengths.
  const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c),
               side = std::min(std::min(square_ab * cc, square_bc * aa), square_ca * bb),
               angle = 1 - std::max(std::max(at_a * at_a, at_b * at_b), at_c * at_c);
  certain = area > 0 && area * area * side >= 0x1p-58 * (aa * bb * cc) && area * area * angle >= 0x1p-50;
  return area < 0 ? 0 : area;
}

/// The same by differences, for an area that is about `area` and not certain.
inline double area_by_differences(const Point& a, const Point& b, const Point& c, double area) {
  if (!has_direction(a) || !has_direction(b) || !has_direction(c)) return area;
  if (left(a, b, c) == 0) return area < 3 ? 0 : area;  // a null triangle, or a hemisphere
  return std::fabs(triangle_area({unit_vector(a), a}, {unit_vector(b), b}, {unit_vector(c), c}));
}

/// TRANS: Cartesian coordinates of n points given by latitude and longitude in radians. x and y may be the
/// same arrays as rlat and rlon, in either order.
template <class Real>
void trans(std::ptrdiff_t n, const Real* rlat, const Real* rlon, Real* x, Real* y, Real* z) {
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const Real latitude = rlat[i], longitude = rlon[i];  // both read before x, y may overwrite them
    const Real cosine = std::cos(latitude);
    x[i] = cosine * std::cos(longitude);
    y[i] = cosine * std::sin(longitude);
    z[i] = std::sin(latitude);
  }
}

/// SCOORD. The zero vector has latitude and longitude 0.
template <class Real>
SphericalCoordinates<Real> scoord(const Vector<Real>& p) {
  SphericalCoordinates<Real> result{};
  result.norm = std::sqrt(dot(p, p));
  if (p.x != 0 || p.y != 0) result.longitude = std::atan2(p.y, p.x);
  if (result.norm != 0) result.latitude = std::asin(p.z / result.norm);
  return result;
}

/// AREAS: area of the spherical triangle whose corners lie in the directions of a, b, c, in steradians,
/// 0..2 pi, for either orientation. Computed in double; 0 for null triangles, NaN for NaN. By the original's
/// formula where its error is below 2^-20 of the area, and under original_rules(); else right up to 64u.
template <class Real>
Real areas(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c) {
  bool certain;
  const double area = area_by_angles(widen(a), widen(b), widen(c), certain);
  if (certain || original_rules().follow) return static_cast<Real>(area);
  return static_cast<Real>(area_by_differences(as_point(a), as_point(b), as_point(c), area));
}

/// TRIAREAS: area[nt] of the triangles[3*nt], in steradians, as AREAS. Corners are nodes 1..n; NaN for a
/// triangle with a corner outside 1..n.
template <class Real, class Int>
void triangle_areas(Int n, const Nodes<Real>& nodes, std::ptrdiff_t nt, const Int* triangles, Real* area) {
  const auto is_node = [n](Int node) { return node >= 1 && node <= n; };
  for (std::ptrdiff_t t = 0; t < nt; ++t) {
    const Int a = triangles[3 * t], b = triangles[3 * t + 1], c = triangles[3 * t + 2];
    area[t] = is_node(a) && is_node(b) && is_node(c) ? areas(nodes[a], nodes[b], nodes[c])
                                                     : std::numeric_limits<Real>::quiet_NaN();
  }
}

}  // namespace pstripack
