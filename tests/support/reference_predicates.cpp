#include "reference_predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace exact {
namespace {

struct Vector {
  Integer x, y, z;
};

/// value == mantissa * 2^exponent.
struct Parts {
  std::int64_t mantissa;
  int exponent;
};

Parts parts(double value) {
  int exponent;
  const double fraction = std::frexp(value, &exponent);
  return {static_cast<std::int64_t>(std::ldexp(fraction, 53)), exponent - 53};
}

int least_exponent(const Point& p) {
  int least = std::numeric_limits<int>::max();
  for (const double v : {p.x, p.y, p.z})
    if (v != 0) least = std::min(least, parts(v).exponent);
  return least;
}

Integer scaled(double value, int exponent) {
  if (value == 0) return 0;
  const Parts p = parts(value);
  return Integer(p.mantissa) << (p.exponent - exponent);
}

/// p * 2^-exponent, which is whole.
Vector scaled(const Point& p, int exponent) {
  return {scaled(p.x, exponent), scaled(p.y, exponent), scaled(p.z, exponent)};
}

Integer determinant(const Vector& a, const Vector& b, const Vector& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

Integer dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vector minus(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

/// The sign of a sqrt(p) + b sqrt(q).
int sign(const Integer& a, const Integer& p, const Integer& b, const Integer& q) {
  const int sa = p == 0 ? 0 : a.sign(), sb = q == 0 ? 0 : b.sign();
  if (sa == sb || sb == 0) return sa;
  if (sa == 0) return sb;
  return sa * Integer(a * a * p - b * b * q).sign();
}

/// The sign of k + a sqrt(p) + b sqrt(q).
int sign(const Integer& k, const Integer& a, const Integer& p, const Integer& b, const Integer& q) {
  const int s = sign(k, 1, a, p), t = q == 0 ? 0 : b.sign();
  if (s == t || t == 0) return s;
  if (s == 0) return t;
  return s * sign(k * k + a * a * p - b * b * q, 1, 2 * k * a, p);
}

}  // namespace

int sign_of_root_sum(const Integer (&c)[4], const Integer (&q)[4]) {
  const int s = sign(c[0], q[0], c[1], q[1]), t = sign(c[2], q[2], c[3], q[3]);
  if (s == t || t == 0) return s;
  if (s == 0) return t;
  return s * sign(c[0] * c[0] * q[0] + c[1] * c[1] * q[1] - c[2] * c[2] * q[2] - c[3] * c[3] * q[3],
                  2 * c[0] * c[1], q[0] * q[1], -2 * c[2] * c[3], q[2] * q[3]);
}

int left(const Point& a, const Point& b, const Point& c) {
  return determinant(scaled(a, least_exponent(a)), scaled(b, least_exponent(b)), scaled(c, least_exponent(c)))
      .sign();
}

int orientation(On on, const Point& a, const Point& b, const Point& c, const Point& d) {
  if (on == On::coordinates) {
    const int e = std::min({least_exponent(a), least_exponent(b), least_exponent(c), least_exponent(d)});
    const Vector origin = scaled(a, e);
    return determinant(minus(scaled(b, e), origin), minus(scaled(c, e), origin), minus(scaled(d, e), origin))
        .sign();
  }
  // [bcd] |a| - [acd] |b| + [abd] |c| - [abc] |d|: the volume times all four lengths.
  const Vector v[4] = {scaled(a, least_exponent(a)), scaled(b, least_exponent(b)),
                       scaled(c, least_exponent(c)), scaled(d, least_exponent(d))};
  const Integer squared[4] = {dot(v[0], v[0]), dot(v[1], v[1]), dot(v[2], v[2]), dot(v[3], v[3])};
  const Integer coefficient[4] = {determinant(v[1], v[2], v[3]), -determinant(v[0], v[2], v[3]),
                                  determinant(v[0], v[1], v[3]), -determinant(v[0], v[1], v[2])};
  return sign_of_root_sum(coefficient, squared);
}

bool lower_rank(const Point& a, const Point& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

// Pushing one corner outwards moves the volume by the bracket of the other three, with the sign of the place.
int above(On on, const Point& a, const Point& b, const Point& c, const Point& d) {
  const int sign = orientation(on, a, b, c, d);
  if (sign != 0) return sign;
  std::array<std::pair<Point, int>, 4> push = {
      {{a, -left(b, c, d)}, {b, left(a, c, d)}, {c, -left(a, b, d)}, {d, left(a, b, c)}}};
  std::sort(push.begin(), push.end(), [](auto& p, auto& q) { return lower_rank(q.first, p.first); });
  for (const auto& p : push)
    if (p.second != 0) return p.second;
  return 0;
}

bool same_direction(const Point& a, const Point& b) {
  const Vector u = scaled(a, least_exponent(a)), v = scaled(b, least_exponent(b));
  return u.y * v.z == u.z * v.y && u.z * v.x == u.x * v.z && u.x * v.y == u.y * v.x && dot(u, v) > 0;
}

}  // namespace exact
