#pragma once
// Directions, circumcentres and areas with 400 digits, by textbook formulas: what measures are compared with.

#include <boost/multiprecision/mpfr.hpp>
#include <cstddef>
#include <vector>

#include "geometry/point.h"

namespace many_digits {

using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<400>,
                                           boost::multiprecision::et_off>;

struct Vector {
  Real x, y, z;
};
inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Real dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real length(const Vector& a) { return sqrt(dot(a, a)); }
inline Vector unit(const Vector& a) {
  const Real l = length(a);
  return {a.x / l, a.y / l, a.z / l};
}
inline Vector vector(const pstripack::Point& p) { return {Real(p.x), Real(p.y), Real(p.z)}; }
inline Vector direction(const pstripack::Point& p) { return unit(vector(p)); }

inline Real arc(const Vector& a, const Vector& b) { return 2 * atan2(length(a - b), length(a + b)); }
inline Vector circumcentre(const Vector& a, const Vector& b, const Vector& c) {
  return unit(cross(b - a, c - a));
}
/// Van Oosterom & Strackee (1983).
inline Real area(const Vector& a, const Vector& b, const Vector& c) {
  return 2 * atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}
/// The Voronoi cell of v; the ring of its neighbours in the hull, counterclockwise. A side of a half turn is
/// divided where its circle meets the arc to the neighbour, or opposite, if the third of three nodes is
/// nearer.
inline Real cell(const Vector& v, const std::vector<Vector>& ring) {
  const auto corner = [&](std::size_t k) { return circumcentre(v, ring[k], ring[(k + 1) % ring.size()]); };
  Real sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vector from = corner(k), to = corner((k + 1) % ring.size());
    Vector middle = unit(v + ring[(k + 1) % ring.size()]);
    if (dot(v, cross(from, middle)) < 0) middle = Vector{0, 0, 0} - middle;
    sum += length(from + to) > Real(1e-3) ? area(v, from, to) : area(v, from, middle) + area(v, middle, to);
  }
  return sum;
}

/// |value - exact| in units of 2^-53 |scale|.
inline double error(const Real& value, const Real& exact, const Real& scale) {
  return static_cast<double>(Real(ldexp(Real(abs(Real(value - exact)) / abs(scale)), 53)));
}

}  // namespace many_digits
