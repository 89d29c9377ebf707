#include "stripack/coordinates_and_areas.h"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>

namespace pstripack {
namespace {

template <class Real>
Vector<double> widen(const Vector<Real>& a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

}  // namespace

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

template <class Real>
SphericalCoordinates<Real> scoord(const Vector<Real>& p) {
  SphericalCoordinates<Real> result{};
  result.norm = std::sqrt(dot(p, p));
  if (p.x != 0 || p.y != 0) result.longitude = std::atan2(p.y, p.x);
  if (result.norm != 0) result.latitude = std::asin(p.z / result.norm);
  return result;
}

template <class Real>
Real areas(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c) {
  // The angle at a corner is that between the normals of its two sides.
  Vector<double> ab = cross(widen(a), widen(b));
  Vector<double> bc = cross(widen(b), widen(c));
  Vector<double> ca = cross(widen(c), widen(a));
  for (Vector<double>* normal : {&ab, &bc, &ca}) {
    const double square = dot(*normal, *normal);
    if (square == 0) return 0;
    const double length = std::sqrt(square);
    *normal = {normal->x / length, normal->y / length, normal->z / length};
  }
  const double angles = clamped_acos(-dot(ab, ca)) + clamped_acos(-dot(bc, ab)) + clamped_acos(-dot(ca, bc));
  const double area = angles - std::acos(-1.0);
  return area < 0 ? Real(0) : static_cast<Real>(area);
}

template <class Real, class Int>
void triangle_areas(Int n, const Nodes<Real>& nodes, std::ptrdiff_t nt, const Int* triangles, Real* area) {
  const auto is_node = [n](Int node) { return node >= 1 && node <= n; };
  for (std::ptrdiff_t t = 0; t < nt; ++t) {
    const Int a = triangles[3 * t], b = triangles[3 * t + 1], c = triangles[3 * t + 2];
    area[t] = is_node(a) && is_node(b) && is_node(c) ? areas(nodes[a], nodes[b], nodes[c])
                                                     : std::numeric_limits<Real>::quiet_NaN();
  }
}

template void trans(std::ptrdiff_t, const float*, const float*, float*, float*, float*);
template void trans(std::ptrdiff_t, const double*, const double*, double*, double*, double*);
template SphericalCoordinates<float> scoord(const Vector<float>&);
template SphericalCoordinates<double> scoord(const Vector<double>&);
template float areas(const Vector<float>&, const Vector<float>&, const Vector<float>&);
template double areas(const Vector<double>&, const Vector<double>&, const Vector<double>&);
#define PSTRIPACK_AREAS(Real, Int) \
  template void triangle_areas(Int, const Nodes<Real>&, std::ptrdiff_t, const Int*, Real*);
PSTRIPACK_AREAS(float, std::int32_t)
PSTRIPACK_AREAS(double, std::int32_t)
PSTRIPACK_AREAS(double, std::int64_t)

}  // namespace pstripack
