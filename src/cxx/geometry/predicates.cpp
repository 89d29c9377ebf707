#include "geometry/predicates.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/exact.h"
#include "geometry/parallel_for.h"

// Error bounds below: u = 2^-53 is the unit roundoff of rounding to nearest, which every entry of the library
// sets (geometry/floating_point.h). "Permanent" is the expression of a determinant with every term replaced
// by its absolute value; it is computed alongside.

namespace pstripack {
namespace {

constexpr double u = 0x1p-53;
// A product that underflows is wrong by 2^-1075 at most, and is multiplied by one difference, below
// 2 kLargest: nine products together change a determinant by less than kUnderflow. Sums do not underflow.
// The third powers of differences do not overflow.
constexpr double kUnderflow = 1e-250;
constexpr double kLargest = 1e30;

thread_local PredicateCounts counts;

double largest(const Point& a) { return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}); }

/// det(e,f,g) and its permanent.
struct Determinant {
  double value, permanent;
};

Determinant determinant(const Point& e, const Point& f, const Point& g) {
  const double yz = e.y * f.z, zy = e.z * f.y, zx = e.z * f.x, xz = e.x * f.z, xy = e.x * f.y, yx = e.y * f.x;
  return {(yz - zy) * g.x + (zx - xz) * g.y + (xy - yx) * g.z,
          (std::fabs(yz) + std::fabs(zy)) * std::fabs(g.x) +
              (std::fabs(zx) + std::fabs(xz)) * std::fabs(g.y) +
              (std::fabs(xy) + std::fabs(yx)) * std::fabs(g.z)};
}

/// The sign of d.value if it is certain with this bound, else 0. False for NaN and infinities.
int certain_sign(const Determinant& d, double bound) {
  if (d.value > bound) return 1;
  if (d.value < -bound) return -1;
  return 0;
}

// Filter for vectors that are exact or known to one rounding a component.
// e, f, g: differences with one rounding each. A product of three carries 3 roundings of the differences,
// 2 of the products, 1 of the subtraction, at most 2 of the sums: the error is at most (1-u)^-8 - 1 <
// 8u + 40u^2 of the permanent of the computed differences. That permanent and the bound come out smaller by
// 8 roundings at most, and 9u (1-u)^8 > 8u + 40u^2. (Shewchuk 1997, orient3d, stage A: 7u + 56u^2.)
constexpr double kFactor = 9 * u;

int filter_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto v = determinant(minus(b, a), minus(c, a), minus(d, a));
  return certain_sign(v, kFactor * v.permanent + kUnderflow);
}

/// det(a,b,c) = det(b-a, c-a, a): small where the nodes are close, so the bound is small as well.
int filter_left(const Point& a, const Point& b, const Point& c) {
  const auto v = determinant(minus(b, a), minus(c, a), a);
  return certain_sign(v, kFactor * v.permanent + kUnderflow);
}

bool moderate(const Point& a) { return largest(a) < kLargest; }

// Zeros that need no arithmetic are common: nodes on the equator, on one parallel.

template <class... Points>
bool in_coordinate_plane(const Points&... p) {
  return ((p.x == 0) && ...) || ((p.y == 0) && ...) || ((p.z == 0) && ...);
}

int exact_zero() {
  ++counts.exact;
  return 0;
}

template <class... Points>
bool in_parallel_plane(const Point& a, const Points&... p) {
  return ((p.x == a.x) && ...) || ((p.y == a.y) && ...) || ((p.z == a.z) && ...);
}

int exact_left(const Point& a, const Point& b, const Point& c) {
  using namespace exact;
  if (Grid p, q, r; on_grid(a, p) && on_grid(b, q) && on_grid(c, r)) return sign_of_det(p, q, r);
  const int bits = std::max({span_of(a).bits(), span_of(b).bits(), span_of(c).bits()});
  return bits <= kSmallBits ? exact::left<Integer512>(a, b, c) : exact::left<Integer>(a, b, c);
}

int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  using namespace exact;
  if (Grid p, q, r, s; on_grid(a, p) && on_grid(b, q) && on_grid(c, r) && on_grid(d, s))
    return sign_of_det(q - p, r - p, s - p);
  Span span = span_of(a);
  span.join(b);
  span.join(c);
  span.join(d);
  return span.bits() <= kSmallBits ? exact::orientation<Integer512>(a, b, c, d, span.low)
                                   : exact::orientation<Integer>(a, b, c, d, span.low);
}

/// The volume of the directions times |a||b||c||d|:  |a| [bcd] - |b| [acd] + |c| [abd] - |d| [abc].
int exact_orientation_of_directions(const Point& a, const Point& b, const Point& c, const Point& d) {
  using namespace exact;
  const auto A = scaled<Integer>(a, span_of(a).low), B = scaled<Integer>(b, span_of(b).low),
             C = scaled<Integer>(c, span_of(c).low), D = scaled<Integer>(d, span_of(d).low);
  return sign_of_sum({det(B, C, D), -det(A, C, D), det(A, B, D), -det(A, B, C)},
                     {dot(A, A), dot(B, B), dot(C, C), dot(D, D)});
}

bool lower_rank(const Point& a, const Point& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

/// The tie rule of predicates.h for four nodes whose volume is zero. No two may coincide.
bool symbolic_above(const Point& a, const Point& b, const Point& c, const Point& d) {
  ++counts.symbolic;
  struct Term {
    const Point *node, *p, *q, *r;  // pushing `node` outwards gives the sign of sign * [pqr]
    int sign;
  };
  Term terms[4] = {{&d, &a, &b, &c, 1}, {&c, &a, &b, &d, -1}, {&b, &a, &c, &d, 1}, {&a, &b, &c, &d, -1}};
  for (int remaining = 4; remaining > 0; --remaining) {
    Term& highest = *std::max_element(
        terms, terms + remaining, [](const Term& s, const Term& t) { return lower_rank(*s.node, *t.node); });
    if (const int bracket = left(*highest.p, *highest.q, *highest.r)) return highest.sign * bracket > 0;
    highest = terms[remaining - 1];
  }
  return false;  // all four on one great circle
}

// Double-double arithmetic, just enough for p/|p|. Dekker's product: no FMA is assumed.
struct Pair {
  double high, low;
};

Pair sum_of_ordered(double a, double b) {  // |a| >= |b|
  const double s = a + b;
  return {s, b - (s - a)};
}

Pair sum(double a, double b) {
  const double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

Pair product(double a, double b) {
  const auto split = [](double v) {
    const double c = 134217729.0 * v, high = c - (c - v);
    return Pair{high, v - high};
  };
  const Pair s = split(a), t = split(b);
  const double p = a * b;
  return {p, ((s.high * t.high - p) + s.high * t.low + s.low * t.high) + s.low * t.low};
}

}  // namespace

int left(const Point& a, const Point& b, const Point& c) {
  if (in_coordinate_plane(a, b, c)) return exact_zero();
  if (moderate(a) && moderate(b) && moderate(c))
    if (const int s = filter_left(a, b, c)) return s;
  ++counts.exact;
  return exact_left(a, b, c);
}

int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  if (in_parallel_plane(a, b, c, d)) return exact_zero();
  if (moderate(a) && moderate(b) && moderate(c) && moderate(d))
    if (const int s = filter_orientation(a, b, c, d)) return s;
  ++counts.exact;
  return exact_orientation(a, b, c, d);
}

int orientation_of_directions(const Point& a, const Point& b, const Point& c, const Point& d) {
  if (in_coordinate_plane(a, b, c, d)) return exact_zero();
  ++counts.exact;
  return exact_orientation_of_directions(a, b, c, d);
}

bool same_direction(const Point& a, const Point& b) {
  if ((a.x < 0) != (b.x < 0) || (a.y < 0) != (b.y < 0) || (a.z < 0) != (b.z < 0)) return false;
  if ((a.x == 0) != (b.x == 0) || (a.y == 0) != (b.y == 0) || (a.z == 0) != (b.z == 0)) return false;
  if (a == b) return true;
  // Products that are equal are rounded to equal doubles, also where they overflow or underflow.
  if (a.x * b.y != a.y * b.x || a.y * b.z != a.z * b.y || a.z * b.x != a.x * b.z) return false;
  using namespace exact;
  const auto n = exact::cross(scaled<Integer>(a, span_of(a).low), scaled<Integer>(b, span_of(b).low));
  return n.x == 0 && n.y == 0 && n.z == 0;  // equal signs: not opposite
}

PredicateCounts take_predicate_counts() { return std::exchange(counts, {}); }

int Coordinates::left(index_t a, index_t b, index_t c) const { return pstripack::left(p_[a], p_[b], p_[c]); }

int Coordinates::height(index_t ia, index_t ib, index_t ic, index_t id) const {
  ++counts.above;
  return orientation(p_[ia], p_[ib], p_[ic], p_[id]);
}

bool Coordinates::above(index_t ia, index_t ib, index_t ic, index_t id) const {
  if (const int s = height(ia, ib, ic, id)) return s > 0;
  const Point &a = p_[ia], &b = p_[ib], &c = p_[ic], &d = p_[id];
  if (d == a || d == b || d == c || a == b || b == c || c == a) return false;
  return symbolic_above(a, b, c, d);
}

Directions::Directions(const Point* points, std::size_t n) : p_(points), n_(n), unit_(n) {
  parallel_pieces(n, threads_for(n), [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i) unit_[i] = unit(p_[i]);
  });
}

void Directions::extend(const Point* points, std::size_t n) {
  if (n > unit_.size()) {
    BlockArray<Unit> larger(n + n / 2);
    std::copy(unit_.begin(), unit_.begin() + n_, larger.begin());
    unit_ = std::move(larger);
  }
  p_ = points;
  for (std::size_t i = n_; i < n; ++i) unit_[i] = unit(p_[i]);
  n_ = n;
}

Directions::Unit Directions::unit(const Point& p) {
  // Where squares could leave the range, scaled to [1/2,1) by a power of two: exact, up to bits below 2^-1074
  // of the largest component. What underflows below is as small, in a vector of moderate length 2^-400 of it.
  // Then `product` (Dekker 1971) and `sum` (Knuth) are exact, and high + low is p/|p| with relative errors
  // of, in units of u^2,
  //   3    half the error of s: two sums of three small terms, 3 each;
  //   9.4  what one Newton step for 1/sqrt(s) leaves: 3/8 h^2 with h = 1 - s r0^2 below 5u, by the rounding
  //        of the root, of the quotient, and s.low;
  //   8.5  half the error of `residual`: 16 for its five roundings, 1 for s.low * rr.low, which is left out;
  //   8.5  the roundings of r1, of c * r1 and of its sum with q.low, 2.5 + 2.5 + 3.5:
  // together less than 2^-101.
  double c[3] = {p.x, p.y, p.z};
  if (const double most = largest(p); !(most > 0x1p-300 && most < 0x1p300)) {
    int e;
    std::frexp(most, &e);
    for (double& v : c) v = std::ldexp(v, -e);
  }
  Pair s = product(c[0], c[0]);
  for (int k = 1; k < 3; ++k) {
    const Pair q = product(c[k], c[k]);
    const Pair t = sum(s.high, q.high);
    s = sum_of_ordered(t.high, t.low + (s.low + q.low));
  }
  const double r0 = 1 / std::sqrt(s.high);
  const Pair rr = product(r0, r0);
  const Pair one = product(s.high, rr.high);
  const double residual = ((1 - one.high) - one.low) - (s.high * rr.low + s.low * rr.high);
  const double r1 = r0 * residual * 0.5;
  double high[3], low[3];
  for (int k = 0; k < 3; ++k) {
    const Pair q = product(c[k], r0);
    const Pair v = sum_of_ordered(q.high, q.low + c[k] * r1);
    high[k] = v.high;
    low[k] = v.low;
  }
  return {{high[0], high[1], high[2]}, {low[0], low[1], low[2]}};
}

// Filters on directions. A component of `difference` is known to 2u of itself and tau = 2^-99: the high parts
// subtract exactly where they are within a factor of 2 of each other (Sterbenz), else with an error u of
// themselves, which is u (1 + 4u) of the result; the last sum adds u; the low parts, 2^-54 each at most,
// subtract with an error below 2^-106; and two directions add 2^-101 each. A product of three differences
// then carries 3*2u + 5u = 11u of the permanent, 12u with higher orders and the rounding of the bound. The
// tau terms are at most 6 products * 3 factors * tau m^2, m the largest component: 2^-94 m^2. A sign is
// certain only where 6 m^3 > 2^-91 m^2, so where tau < m/32, and then terms of tau^2 and tau^3 are less than
// an eighth of that. In `left` the third vector is a position, known to u of itself and not small: 10u, and
// 2^-95 m. For such m nothing underflows that counts.
namespace {
constexpr double kDirectionFactor = 12 * u;
constexpr double kDirectionAbsolute = 0x1p-91;
}  // namespace

int Directions::left(index_t a, index_t b, index_t c) const {
  if (in_coordinate_plane(p_[a], p_[b], p_[c])) return exact_zero();
  const Point e = difference(b, a), f = difference(c, a);
  const auto v = determinant(e, f, position(a));
  const double m = std::max(largest(e), largest(f));
  if (const int s = certain_sign(v, kDirectionFactor * v.permanent + kDirectionAbsolute * m)) return s;
  return pstripack::left(p_[a], p_[b], p_[c]);
}

int Directions::height(index_t ia, index_t ib, index_t ic, index_t id) const {
  ++counts.above;
  if (in_coordinate_plane(p_[ia], p_[ib], p_[ic], p_[id])) return exact_zero();
  // From each of the four, by even permutations: of a needle only the differences from a near node are small.
  const index_t seen_from[4][4] = {{ia, ib, ic, id}, {ib, ia, id, ic}, {ic, id, ia, ib}, {id, ic, ib, ia}};
  for (const auto& [a, b, c, d] : seen_from) {
    const Point e = difference(b, a), f = difference(c, a), g = difference(d, a);
    const auto v = determinant(e, f, g);
    const double m = std::max({largest(e), largest(f), largest(g)});
    if (const int s = certain_sign(v, kDirectionFactor * v.permanent + kDirectionAbsolute * m * m)) return s;
  }
  ++counts.exact;
  return exact_orientation_of_directions(p_[ia], p_[ib], p_[ic], p_[id]);
}

bool Directions::above(index_t ia, index_t ib, index_t ic, index_t id) const {
  if (const int s = height(ia, ib, ic, id)) return s > 0;
  const Point &a = p_[ia], &b = p_[ib], &c = p_[ic], &d = p_[id];
  if (same_direction(a, b) || same_direction(b, c) || same_direction(c, a) || same_direction(a, d) ||
      same_direction(b, d) || same_direction(c, d))
    return false;
  return symbolic_above(a, b, c, d);
}

}  // namespace pstripack
