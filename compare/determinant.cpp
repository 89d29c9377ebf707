#include "determinant.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <initializer_list>

namespace comparison {
namespace {

using Integer = Determinant::Integer;
using Vector = std::array<Integer, 3>;

constexpr int kDigits = 53;

// The exponent e for which value = integer * 2^e, with e that of the last bit of the significand.
int last_bit(double value) { return value == 0 ? 1024 : std::max(std::ilogb(value), -1022) - (kDigits - 1); }

int common_exponent(std::initializer_list<Point> points) {
  int e = 1024;
  for (const Point& p : points) e = std::min({e, last_bit(p.x), last_bit(p.y), last_bit(p.z)});
  return e;
}

Integer scaled(double value, int exponent) {
  if (value == 0) return 0;
  const int e = last_bit(value);
  return Integer(static_cast<long long>(std::ldexp(value, -e))) << (e - exponent);
}

Vector scaled(const Point& p, int exponent) {
  return {scaled(p.x, exponent), scaled(p.y, exponent), scaled(p.z, exponent)};
}

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Integer determinant(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Integer permanent_of_absolutes(Vector a, Vector b, Vector c) {
  for (Vector* v : {&a, &b, &c})
    for (Integer& component : *v) component = abs(component);
  return a[0] * (b[1] * c[2] + b[2] * c[1]) + a[1] * (b[0] * c[2] + b[2] * c[0]) +
         a[2] * (b[0] * c[1] + b[1] * c[0]);
}

std::string decimal(const Integer& numerator, const Integer& denominator, int exponent) {
  using Float = boost::multiprecision::cpp_bin_float_50;
  const Float value = ldexp(Float(numerator) / Float(denominator), exponent);
  return value.str(4, std::ios_base::scientific);
}

// g = r u / (1 - r u) as a fraction: r / (1/u - r).
Integer one_over_u(double epsilon) { return Integer(static_cast<long long>(2 / epsilon)); }

}  // namespace

bool Determinant::within_rounding(double epsilon) const {
  return abs(value_) * (one_over_u(epsilon) - roundings_) <= permanent_ * roundings_;
}

std::string Determinant::value() const { return decimal(value_, 1, exponent_); }

std::string Determinant::bound(double epsilon) const {
  return decimal(permanent_ * roundings_, one_over_u(epsilon) - roundings_, exponent_);
}

Determinant left_test(const Point& a, const Point& b, const Point& c) {
  const int e = common_exponent({a, b, c});
  const Vector va = scaled(a, e), vb = scaled(b, e), vc = scaled(c, e);
  Determinant d;
  d.value_ = determinant(va, vb, vc);
  d.permanent_ = permanent_of_absolutes(va, vb, vc);
  d.exponent_ = 3 * e;
  d.roundings_ = 5;
  return d;
}

Determinant swap_test(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int e = common_exponent({a, b, c, d});
  const std::array<Vector, 4> v{scaled(a, e), scaled(b, e), scaled(c, e), scaled(d, e)};
  Determinant result;
  result.value_ = determinant(v[1] - v[0], v[2] - v[0], v[3] - v[0]);
  for (int p4 = 0; p4 < 4; ++p4) {
    const Vector &p1 = v[(p4 + 1) % 4], &p2 = v[(p4 + 2) % 4], &p3 = v[(p4 + 3) % 4];
    result.permanent_ =
        std::max(result.permanent_, permanent_of_absolutes(p1 - v[p4], p2 - v[p4], p3 - v[p4]));
  }
  result.exponent_ = 3 * e;
  result.roundings_ = 8;
  return result;
}

}  // namespace comparison
