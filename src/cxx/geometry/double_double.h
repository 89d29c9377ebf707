#pragma once
// Double-double arithmetic: an unevaluated sum high + low, |low| <= u |high|, u = 2^-53. Internal to the
// layer. No FMA is assumed. Relative errors, if nothing overflows or underflows, in units of u^2 (Joldes,
// Muller & Popescu 2017, Tight and rigorous error bounds for basic building blocks of double-word arithmetic;
// Lefevre, Louvet, Muller, Picot & Rideau 2023 for the square root; rounded up):
//   x + y   4; relative to |x| + |y| if the signs differ
//   x * y   6
//   x / y, sqrt(x)   16

#include <cmath>

namespace pstripack {

struct DoubleDouble {
  double high, low;
};

/// a + b, exactly (Knuth).
inline DoubleDouble two_sum(double a, double b) {
  const double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

/// a + b, exactly, for |a| >= |b| or a = 0 (Dekker 1971).
inline DoubleDouble two_sum_of_ordered(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// A double as the sum of two doubles of 26 bits each, whose products are exact. |value| < 2^996.
struct Halves {
  double value, high, low;
  Halves() = default;
  explicit Halves(double v) : value(v) {
    const double c = 134217729.0 * v;
    high = c - (c - v);
    low = v - high;
  }
};

/// a * b, exactly (Dekker 1971), if |a * b| >= 2^-969 or a * b = 0.
inline DoubleDouble two_product(const Halves& a, const Halves& b) {
  const double p = a.value * b.value;
  return {p, ((a.high * b.high - p) + a.high * b.low + a.low * b.high) + a.low * b.low};
}
inline DoubleDouble two_product(double a, double b) { return two_product(Halves(a), Halves(b)); }

inline DoubleDouble operator-(const DoubleDouble& x) { return {-x.high, -x.low}; }

inline DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble s = two_sum(x.high, y.high), t = two_sum(x.low, y.low);
  const DoubleDouble v = two_sum_of_ordered(s.high, s.low + t.high);
  return two_sum_of_ordered(v.high, t.low + v.low);
}
inline DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) { return x + -y; }

inline DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble p = two_product(x.high, y.high);
  return two_sum_of_ordered(p.high, p.low + (x.high * y.low + x.low * y.high));
}

/// x / y and sqrt(x), x > 0: one Newton step from that of the high parts.
inline DoubleDouble operator/(const DoubleDouble& x, const DoubleDouble& y) {
  const double q = x.high / y.high;
  const DoubleDouble rest = x - y * DoubleDouble{q, 0};
  return two_sum_of_ordered(q, rest.high / y.high);
}
inline DoubleDouble sqrt(const DoubleDouble& x) {
  if (!(x.high > 0)) return {0, 0};
  const double r = std::sqrt(x.high);
  const DoubleDouble rest = x - two_product(r, r);
  return two_sum_of_ordered(r, rest.high / (2 * r));
}

/// x * scale, exactly: `scale` is a power of two.
inline DoubleDouble scaled_by(const DoubleDouble& x, double scale) { return {x.high * scale, x.low * scale}; }

/// a * b - c * d. The error is at most 3u^2 of the result plus 8u^3 (|a * b| + |c * d|), so it is small even
/// if the products nearly cancel.
inline DoubleDouble difference_of_products(const Halves& a, const Halves& b, const Halves& c,
                                           const Halves& d) {
  const DoubleDouble p = two_product(a, b), q = two_product(c, d);
  const DoubleDouble s = two_sum(p.high, -q.high), t = two_sum(p.low, -q.low);  // s + t is exact
  const DoubleDouble v = two_sum(s.high, t.high);
  return two_sum(v.high, v.low + (s.low + t.low));
}

}  // namespace pstripack
