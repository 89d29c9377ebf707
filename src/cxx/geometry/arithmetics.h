#pragma once
// Arithmetics of more and more bits for measures of directions: double, double-double, and floating-point
// numbers of 256, 1280 and 9216 bits. Internal to the layer. Each formula is a template of the arithmetic T;
// it finds its result and a bound of its error, and if that is too large, the next arithmetic tries.

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <type_traits>

#include "geometry/double_double.h"
#include "geometry/measures.h"

namespace pstripack::arithmetics {

namespace mp = boost::multiprecision;
template <unsigned bits>
using Real = mp::number<mp::cpp_bin_float<bits, mp::digit_base_2, void, std::int32_t>, mp::et_off>;

constexpr double u = 0x1p-53;

/// What they differ in:
///   kUnit          bound of the relative error of an operation
///   kSide, kApart  a side has an error of kSide of its length and 2^kApart
///   Corner         what of a direction enters the sides; side(to, from) is the difference, sum() as accurate
///   position       the direction as one vector
template <class T>
struct Arithmetic;

template <>
struct Arithmetic<double> {
  static constexpr double kUnit = u, kSide = 2 * u;
  static constexpr int kApart = -98;
  using Corner = const Direction&;
  static Corner corner(const Direction& d) { return d; }
  static Point side(Corner to, Corner from) { return difference(to, from); }
  static Point sum(Corner a, Corner b) {
    return {(a.high.x + b.high.x) + (a.low.x + b.low.x), (a.high.y + b.high.y) + (a.low.y + b.low.y),
            (a.high.z + b.high.z) + (a.low.z + b.low.z)};
  }
  static Point position(Corner d) { return d.high; }
  static double value(double v, int exponent = 0) { return exponent == 0 ? v : std::ldexp(v, exponent); }
  static double square_root(double v) { return std::sqrt(v); }
};

template <>
struct Arithmetic<DoubleDouble> {
  static constexpr double kUnit = 0x1p-101, kSide = 0x1p-102;
  static constexpr int kApart = -98;
  using Corner = Vector3<DoubleDouble>;
  static Corner corner(const Direction& d) {
    return {{d.high.x, d.low.x}, {d.high.y, d.low.y}, {d.high.z, d.low.z}};
  }
  static Corner side(const Corner& to, const Corner& from) { return minus(to, from); }
  static Corner sum(const Corner& a, const Corner& b) { return plus(a, b); }
  static const Corner& position(const Corner& d) { return d; }
  static double value(const DoubleDouble& v, int exponent = 0) { return std::ldexp(v.high, exponent); }
  static DoubleDouble square_root(const DoubleDouble& v) { return sqrt(v); }
};

template <unsigned bits>
struct Arithmetic<Real<bits>> {
  using T = Real<bits>;
  static constexpr double kUnit = bits < 1000 ? 0x1p-100 * 0x1p-100 * 0x1p-50 : 0x1p-1000;
  static constexpr double kSide = kUnit;
  static constexpr int kApart = 4 - static_cast<int>(bits);
  using Corner = Vector3<T>;
  static Corner corner(const Direction& d) {
    const Corner p{T(d.given.x), T(d.given.y), T(d.given.z)};
    const T length = sqrt(dot(p, p));
    return {p.x / length, p.y / length, p.z / length};
  }
  static Corner side(const Corner& to, const Corner& from) { return minus(to, from); }
  static Corner sum(const Corner& a, const Corner& b) { return plus(a, b); }
  static const Corner& position(const Corner& d) { return d; }
  static double value(const T& v, int exponent = 0) { return static_cast<double>(T(ldexp(v, exponent))); }
  static T square_root(const T& v) { return sqrt(v); }
};

/// A number of the arithmetic T.
template <class T>
T number(double v) {
  if constexpr (std::is_same_v<T, DoubleDouble>)
    return {v, 0};
  else
    return T(v);
}

/// The binary exponent of a vector's largest component; very small for 0.
template <class T>
int exponent_of(const Vector3<T>& v) {
  int most = -100000;
  for (const T& component : {v.x, v.y, v.z})
    if constexpr (std::is_same_v<T, double>) {
      if (component != 0) most = std::max(most, std::ilogb(component));
    } else if constexpr (std::is_same_v<T, DoubleDouble>) {
      if (component.high != 0) most = std::max(most, std::ilogb(component.high));
    } else {
      if (component != 0) most = std::max(most, static_cast<int>(ilogb(component)));
    }
  return most;
}

template <class T>
Point as_point(const Vector3<T>& v, int exponent) {
  using A = Arithmetic<T>;
  return {A::value(v.x, exponent), A::value(v.y, exponent), A::value(v.z, exponent)};
}

/// Calls attempt(T()) with the arithmetics from doubles on until it returns true.
template <class Attempt>
[[gnu::noinline]] bool with_more_bits(const Attempt& attempt) {
  return attempt(DoubleDouble{}) || attempt(Real<256>{}) || attempt(Real<1280>{}) || attempt(Real<9216>{});
}
template <class Attempt>
bool with_enough_bits(const Attempt& attempt) {
  return attempt(0.0) || with_more_bits(attempt);
}

}  // namespace pstripack::arithmetics
