#pragma once
// The exact stage: signs of determinants of doubles through integers, header-only, internal to the layer.
//
// A finite double is m * 2^e with a 53-bit integer m. Vectors are brought to one exponent (each vector
// to its own where only its direction counts) and the determinant is evaluated in integers. Three sizes:
//   grid      coordinates that are multiples of 2^-61: a few machine words. Nearly all nodes on the unit
//             sphere are of this kind, in meshes with many ties (lattices, icosahedra), too;
//   512 bits  on the stack, for exponents that are not too far apart;
//   any size  on the heap. The last two share one template.

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

#include "geometry/point.h"

namespace pstripack::exact {

namespace mp = boost::multiprecision;
using Integer512 =
    mp::number<mp::cpp_int_backend<512, 512, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;
/// For directions: removing their square roots takes 32 times the bits of a coordinate, and 64 more.
using RootInteger =
    mp::number<mp::cpp_int_backend<2688, 2688, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;
using Integer = mp::number<mp::cpp_int_backend<>, mp::et_off>;

/// Bits of a coordinate up to which det3 of differences (3*(bits+1)+3 bits) fits Integer512.
constexpr int kSmallBits = 168;

/// Bits of a coordinate up to which sign_of_sum of four brackets fits RootInteger: a bracket has 3 bits + 3,
/// its square times a squared length 8 bits + 8, and squared twice more 32 bits + 44.
constexpr int kRootBits = 82;

template <class Int>
int sign(const Int& v) {
  return v.sign();
}

/// The exponents that the components of a vector span, as values m * 2^e with 53-bit m.
struct Span {
  int low = 1 << 20, high = -(1 << 20);
  int bits() const { return high - low + 53; }  // negative if all components are 0
  void join(double v) {
    if (v == 0) return;
    int e;
    std::frexp(v, &e);
    low = std::min(low, e - 53);
    high = std::max(high, e - 53);
  }
  void join(const Point& p) {
    join(p.x);
    join(p.y);
    join(p.z);
  }
};

inline Span span_of(const Point& p) {
  Span s;
  s.join(p);
  return s;
}

/// v * 2^-low. `low` must not exceed the exponent e of v = m * 2^e, so that this is an integer.
template <class Int>
Int scaled(double v, int low) {
  if (v == 0) return Int(0);
  int e;
  const auto m = static_cast<std::int64_t>(std::ldexp(std::frexp(v, &e), 53));
  return Int(m) << (e - 53 - low);
}

template <class Int>
Vector3<Int> scaled(const Point& p, int low) {
  return {scaled<Int>(p.x, low), scaled<Int>(p.y, low), scaled<Int>(p.z, low)};
}

template <class Int>
Int det(const Vector3<Int>& a, const Vector3<Int>& b, const Vector3<Int>& c) {
  return dot(cross(a, b), c);
}

// ---- the grid of multiples of 2^-61 --------------------------------------------------------------

using Grid = Vector3<std::int64_t>;

/// g = p * 2^61 if that is a vector of integers below 2^61 (1 + 2^-10) in magnitude.
inline bool on_grid(const Point& p, Grid& g) {
  const auto component = [](double v, std::int64_t& out) {
    const double scaled = v * 0x1p61;
    if (!(std::fabs(scaled) <= 0x1.004p61)) return false;
    out = static_cast<std::int64_t>(scaled);
    return static_cast<double>(out) == scaled;
  };
  return component(p.x, g.x) && component(p.y, g.y) && component(p.z, g.z);
}

/// high * 2^64 + low
struct WideInteger {
  __int128 high;
  std::uint64_t low;
  int sign() const { return high < 0 ? -1 : high > 0 || low != 0; }
  /// Rounded: wrong by at most 2^-52 of itself and 2^12.
  double value() const { return 0x1p64 * static_cast<double>(high) + static_cast<double>(low); }
};

/// det(e,f,g), components below 2^62 (1 + 2^-10). A 2x2 minor is below 2^126 and is split into a high word
/// below 2^62 and a low word below 2^64; the products with g are summed in base 2^64, high part below 3 *
/// 2^125, so nothing overflows.
inline WideInteger det(const Grid& e, const Grid& f, const Grid& g) {
  using Wide = __int128;
  Wide high = 0;
  unsigned __int128 low = 0;
  const auto add = [&](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d, std::int64_t factor) {
    const Wide minor = Wide{a} * b - Wide{c} * d;
    const Wide product = static_cast<Wide>(static_cast<std::uint64_t>(minor)) * factor;
    high += (minor >> 64) * factor + (product >> 64);
    low += static_cast<std::uint64_t>(product);
  };
  add(e.y, f.z, e.z, f.y, g.x);
  add(e.z, f.x, e.x, f.z, g.y);
  add(e.x, f.y, e.y, f.x, g.z);
  return {high + static_cast<Wide>(low >> 64), static_cast<std::uint64_t>(low)};
}
inline int sign_of_det(const Grid& e, const Grid& f, const Grid& g) { return det(e, f, g).sign(); }

// ---- any exponents ---------------------------------------------------------------------------------

template <class Int>
int left(const Point& a, const Point& b, const Point& c) {
  return sign(
      det(scaled<Int>(a, span_of(a).low), scaled<Int>(b, span_of(b).low), scaled<Int>(c, span_of(c).low)));
}

template <class Int>
int orientation(const Point& a, const Point& b, const Point& c, const Point& d, int low) {
  const auto base = scaled<Int>(a, low);
  return sign(det(minus(scaled<Int>(b, low), base), minus(scaled<Int>(c, low), base),
                  minus(scaled<Int>(d, low), base)));
}

// Signs of sums of square roots, in integers alone. A sum is split into two halves. If their signs are
// equal, that is the sign of the sum. If they are opposite, the sign of the sum is the sign of the first
// half times the sign of the difference of the squares, which contains fewer roots: four roots become two
// halves of two roots, then an integer and two roots, then an integer and one root, then an integer. So
// three steps suffice, and nothing is rounded. All radicands are positive.

/// sign of A sqrt(a) + B sqrt(b)
template <class Integer>
int sign_of_sum(const Integer& A, const Integer& a, const Integer& B, const Integer& b) {
  const int s = sign(A), t = sign(B);
  if (s == 0 || s == t) return t;
  if (t == 0) return s;
  return s * sign(Integer(A * A * a - B * B * b));
}

/// sign of E + F sqrt(f) + G sqrt(g)
template <class Integer>
int sign_of_sum(const Integer& E, const Integer& F, const Integer& f, const Integer& G, const Integer& g) {
  const int s = sign(E), t = sign_of_sum(F, f, G, g);
  if (s == 0 || s == t) return t;
  if (t == 0) return s;
  // opposite signs: compare E^2 with (F sqrt f + G sqrt g)^2
  const Integer rest = E * E - F * F * f - G * G * g;
  return s * sign_of_sum(rest, Integer(1), Integer(-2 * F * G), Integer(f * g));
}

/// sign of A sqrt(a) + B sqrt(b) + C sqrt(c) + D sqrt(d)
template <class Integer>
int sign_of_sum(std::array<Integer, 4> factor, const std::array<Integer, 4>& root) {
  // Vectors of equal length, such as mirror images, share a root: their factors are added, which saves
  // squares. A factor may become two bits longer, but then the last squares have a zero factor.
  for (std::size_t i = 1; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (root[i] == root[j]) {
        factor[j] += factor[i];
        factor[i] = 0;
        break;
      }
  const auto& [A, B, C, D] = factor;
  const auto& [a, b, c, d] = root;
  const int s = sign_of_sum(A, a, B, b), t = sign_of_sum(C, c, D, d);
  if (s == 0 || s == t) return t;
  if (t == 0) return s;
  // opposite signs: compare the squares of the two halves
  return s * sign_of_sum(Integer(A * A * a + B * B * b - C * C * c - D * D * d), Integer(2 * A * B),
                         Integer(a * b), Integer(-2 * C * D), Integer(c * d));
}

}  // namespace pstripack::exact
