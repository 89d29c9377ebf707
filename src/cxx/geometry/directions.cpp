// The predicates on directions p/|p|, at every scale.
//
// Seen from one of four nodes, the apex a, the other three are p = b, c, d. With
//
//     N_p = a x p,    D_pq = (N_p x N_q).x = a.x [apq],    G_p = |a||p| - a.p,    [pqr] = det(p,q,r),
//
// where x stands for the axis on which a has its largest component, the volume of the directions,
//
//     V |a||b||c||d| = |a|[bcd] - |b|[acd] + |c|[abd] - |d|[abc],
//
// loses its first term when a times the identity  [bcd] a - [acd] b + [abd] c - [abc] d = 0  is subtracted:
//
//     a.x |a| V |a||b||c||d| = -D_cd G_b + D_bd G_c - D_bc G_d                                        (*)
//
// No norms cancel any more. N_p and G_p = |N_p|^2 / (|a||p| + a.p) are as small as p is close to a, and each
// is known to a small relative error, so (*) decides nodes that are 1e-150 apart as well as others:
//
//                    d                 N_p: p projected to the tangent plane at a, turned by 90 degrees
//        c        .                    D_pq: twice the area of the triangle a,p,q there
//           \  .                       G_p: how far p lies below that plane, times lengths
//            a ---- b
//
// Stages: (*) in doubles; in double-double; integers. References: Shewchuk (1997), Adaptive precision
// floating-point arithmetic and fast robust geometric predicates; Devillers & Pion (2003), Efficient exact
// geometric predicates for Delaunay triangulations.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/parallel_for.h"
#include "geometry/double_double.h"
#include "geometry/exact_signs.h"
#include "geometry/predicate_stages.h"
#include "geometry/predicates.h"

namespace pstripack {
namespace {

double largest(const Point& a) { return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}); }

/// Rotates the axes so that the largest component becomes x. A cyclic permutation: all signs stay.
struct Axes {
  explicit Axes(const Point& a) {
    const double u = std::fabs(a.x), v = std::fabs(a.y), w = std::fabs(a.z);
    first = u >= v ? (u >= w ? 0 : 2) : (v >= w ? 1 : 2);
    negative = (*this)(a).x < 0;
  }
  Point operator()(const Point& p) const {
    if (first == 0) return p;
    return first == 1 ? Point{p.y, p.z, p.x} : Point{p.z, p.x, p.y};
  }
  int first;
  bool negative;  ///< a.x < 0: D has the sign of -[apq]
};

/// The biased exponent of a number that is not negative.
int exponent_of(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return static_cast<int>(bits >> 52);
}

/// A power of two, `by`, and its inverse, such that value * by is in [1,2). 2^-1020 <= value <= 2^1020.
struct Scale {
  double by, inverse;
  explicit Scale(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    const std::uint64_t exponent = bits & 0x7ff0000000000000u, up = 0x7fe0000000000000u - exponent;
    std::memcpy(&by, &up, sizeof by);
    std::memcpy(&inverse, &exponent, sizeof inverse);
  }
};

// ---- in doubles ---------------------------------------------------------------------------------------
//
// u = 2^-53. From the differences e = p - a of the directions, N_p = a x e. Errors, relative to sums of
// absolute values, which are computed alongside (py of N.y, and so on):
//   e        a component k is known to 2.1u of itself and t_k = 2^-99 m_k + 2^-1068, m_k the larger of |a_k|
//            and |p_k|: high - high adds u unless it is exact (Sterbenz), then the last sum another u; the
//            directions are known to 2^-101 m_k each, and the difference of the low parts, each below 2^-51
//            m_k, rounds by 2^-103 m_k
//   N        2.1u, the rounding of a, of the product, of the difference: 5.2u py, and |a_z| t_x + |a_x| t_z,
//            which is less than 5.2u 2^-47 (m_z + 2^-963): that is added to py. For N.x: 2^-47 m_y m_z. Or a
//            is not rounded, but longer by at most 4u: that multiplies all N alike
//   D        twice 5.2u, product, difference: 13u of r = py qz + pz qy
//   G        near a (|e|^2 < 1): |N|^2 / (2 - |e|^2 / 2) with q = px^2 + py^2 + pz^2: |N|^2 15u q, the
//            denominator, above 1.5, and the division 7u, so 15u q, and G <= 0.67 q
//            elsewhere |e|^2 / 2: less than 8u q with q = |e|^2, and G = q/2. It does not grow with the
//            length of a, as |N|^2 does: another 4u q
//   D G      13u 0.67 + 15u + u < 25u of r q; the two sums of (*) 2u more; the bound itself is rounded
//            some 20 times: 28u.
// Where nothing underflows: kNegligible is added for products of numbers that were not scaled.
constexpr double u = 0x1p-53;
constexpr double kFactor = 28 * u;
constexpr double kNegligible = 0x1p-900;
constexpr double kLost = 0x1p-963;  ///< 2^47 of what a component of N loses by underflow

/// A node seen from the apex, in the arithmetic T: double or DoubleDouble. Each factor N is stored multiplied
/// by `by`, so G and q are multiplied by by^2.
template <class T>
struct Seen {
  T y, z;                     ///< components of N
  double py, pz;              ///< bounds of the sums of the absolute values of their terms
  T g;                        ///< G
  double q;                   ///< the quantity that the error of G is relative to
  double weight = 1, by = 1;  ///< powers of two, inverse to each other
};

[[gnu::always_inline]] inline Seen<double> seen_from(const Point& a, const Point& p, const Point& e) {
  const double ae_yz = a.y * e.z, ae_zy = a.z * e.y, ae_zx = a.z * e.x, ae_xz = a.x * e.z, ae_xy = a.x * e.y,
               ae_yx = a.y * e.x;
  const double my = std::fabs(a.y) + std::fabs(p.y), mz = std::fabs(a.z) + std::fabs(p.z);
  Seen<double> s;
  const double x = ae_yz - ae_zy;
  s.y = ae_zx - ae_xz;
  s.z = ae_xy - ae_yx;
  const double px = std::fabs(ae_yz) + std::fabs(ae_zy) + 0x1p-47 * (my * mz + kLost);
  s.py = std::fabs(ae_zx) + std::fabs(ae_xz) + 0x1p-47 * (mz + kLost);
  s.pz = std::fabs(ae_xy) + std::fabs(ae_yx) + 0x1p-47 * (my + kLost);
  const double square = dot(e, e);
  if (!(square < 1)) {
    s.g = 0.5 * square;
    s.q = square;
    return s;
  }
  // Squares and products of four small numbers would underflow.
  if (const double most = std::max(s.py, s.pz); most < 0x1p-120) {
    const Scale scale(most);
    s.by = scale.by, s.weight = scale.inverse;
    s.y *= s.by, s.z *= s.by, s.py *= s.by, s.pz *= s.by;
  }
  const double sx = x * s.by, spx = px * s.by;
  s.g = (sx * sx + s.y * s.y + s.z * s.z) / (2 - 0.5 * square);
  s.q = spx * spx + s.py * s.py + s.pz * s.pz;
  return s;
}

template <class T>
struct Estimate {
  T value;
  double magnitude;
};

/// D, and the sum of the absolute values of its terms.
template <class T>
[[gnu::always_inline]] inline Estimate<T> area(const Seen<T>& p, const Seen<T>& q) {
  return {p.y * q.z - p.z * q.y, p.py * q.pz + p.pz * q.py};
}

int certain_sign(double value, double bound) { return (value > bound) - (value < -bound); }
int certain_sign(const DoubleDouble& value, double bound) { return certain_sign(value.high, bound); }
double scaled_by(double x, double scale) { return x * scale; }

/// The sign of (*), for the apex on its positive side; 0 if it is not certain. factor: the bound of the error
/// relative to the sum of the magnitudes.
template <class T>
[[gnu::always_inline]] inline int height(const Seen<T>& b, const Seen<T>& c, const Seen<T>& d,
                                         double factor) {
  const Estimate<T> cd = area(c, d), bd = area(b, d), bc = area(b, c);
  T tb = cd.value * b.g, tc = bd.value * c.g, td = bc.value * d.g;
  double mb = cd.magnitude * b.q, mc = bd.magnitude * c.q, md = bc.magnitude * d.q;
  if (b.weight != 1 || c.weight != 1 || d.weight != 1) {
    const double most = std::min({b.by, c.by, d.by});
    const double wb = b.weight * most, wc = c.weight * most, wd = d.weight * most;
    tb = scaled_by(tb, wb), tc = scaled_by(tc, wc), td = scaled_by(td, wd);
    mb *= wb, mc *= wc, md *= wd;
  }
  return certain_sign((tc - tb) - td, factor * ((mb + mc) + md) + kNegligible);
}

int filter_left(const Seen<double>& b, const Seen<double>& c) {
  const Estimate<double> d = area(b, c);
  return certain_sign(d.value, kFactor * d.magnitude + kNegligible);
}

/// For two nodes c and d close to each other: the step from c to d. With N_d = N_c + N and G_d = G_c + G
/// the sum (*) becomes
///
///     -D(N_c, N) G_b + D(N_b, N) G_c - D_bc G,
///
/// (*) for b, c and the step, in which every term is as small as the step. N = a x f and G = -a.f with f = d
/// - c are known as well as for e above; the error of G is less than 6u of q = |a.x f.x| + ... + 2^-46, and G
/// grows with the length of a, not with its square: another 4u. G is not scaled, so `weight` must be 1.
Seen<double> step(const Point& a, const Point& p, const Point& f) {
  Seen<double> s = seen_from(a, p, f);
  s.g = -dot(a, f);
  s.q = std::fabs(a.x * f.x) + std::fabs(a.y * f.y) + std::fabs(a.z * f.z) + 0x1p-46;
  return s;
}

/// For vectors p that are (1 + s_p) times a direction, |s_p| < 2^-51, and whose volume v as given is known,
/// the volume of the directions is, up to terms of second order in s,
///
///     a.x V = (1 - s_b - s_c - s_d) a.x v - D_cd (s_b - s_a) + D_bd (s_c - s_a) - D_bc (s_d - s_a):
///
/// each bracket of V grows with the lengths of its three vectors, and [bcd] = v + [acd] - [abd] + [abc].
/// Errors: 2^-49 of the first term by its factor and 2^-51 by its rounding; of each other term, in units of
/// the magnitude of its D, 2^-98 by 13u of D times |s_p - s_a| < 2^-50, 2^-100 by the lengths, and 3 * 2^-102
/// by the terms of second order: the bound has 2^-96. `volume` is a.x v, wrong by at most 2^-51 of itself and
/// 2^-171.
int height_by_lengths(double volume, const Seen<double>& b, const Seen<double>& c, const Seen<double>& d,
                      double s_b, double s_c, double s_d) {
  if (b.weight != 1 || c.weight != 1 || d.weight != 1) return 0;
  const Estimate<double> cd = area(c, d), bd = area(b, d), bc = area(b, c);
  return certain_sign(
      volume + ((bd.value * s_c - cd.value * s_b) - bc.value * s_d),
      0x1p-48 * std::fabs(volume) + (0x1p-96 * ((bd.magnitude + cd.magnitude) + bc.magnitude) + 0x1p-168));
}

// ---- in double-double -----------------------------------------------------------------------------------
//
// A node far from the apex, |e| >= 2^-17: from the directions, high + low, each component known to 2^-101 of
// itself. A component of e is known to 2^-98 m_k, so N to 2^-80 (py + 2^-17 m_z), and G = |e|^2 / 2 to
// |e| 2^-97 <= 2^-80 |e|^2. The arithmetic adds less than 2^-98.
// A node near the apex: from the vectors as given, since a x p does not depend on how much longer than a p
// is, and the difference of its products is exact but for 3u^2 of itself and 8u^3 of the products: 3u^2 m
// with m = |N| + 4u (...), and 2^-850 where a component of up to 2^-1074 is lost, times at most 2^100. G =
// |N|^2 / S with S = |a||p| + a.p: with X = a.p, S - 2X = C / (2X + (S - 2X)) for C = |N|^2 < 2^-33 X^2 is
// known to 2^-53 of itself: G to 2^-85. Each of the three nodes appears once in each term of (*), as N or as
// G, so its length does not matter. All together less than 2^-80 (2 + 1 + ...) < 2^-78 of the sum of the
// magnitudes of (*), rounded as well.
constexpr double kFineFactor = 0x1p-76;
constexpr double kNear = 0x1p-34;  ///< |e|^2 below which a node is near

/// A vector as given, scaled by a power of two, its axes permuted.
struct FinePoint {
  Halves x, y, z;
  FinePoint() = default;
  FinePoint(const Point& p, const Axes& axes) {
    Point v = axes(p);
    if (const double most = largest(v); !(most > 0x1p-100 && most < 0x1p100)) {
      int e;
      std::frexp(most, &e);
      v = {std::ldexp(v.x, -e), std::ldexp(v.y, -e), std::ldexp(v.z, -e)};
    }
    x = Halves(v.x), y = Halves(v.y), z = Halves(v.z);
  }
};

struct FineComponent {
  DoubleDouble value;
  double magnitude;
};

[[gnu::always_inline]] inline FineComponent component(const Halves& a, const Halves& b, const Halves& c,
                                                      const Halves& d) {
  const DoubleDouble v = difference_of_products(a, b, c, d);
  return {v, std::fabs(v.high) +
                 (4 * u * (std::fabs(a.value * b.value) + std::fabs(c.value * d.value)) + 0x1p-850)};
}

/// N of the vectors as given, scaled as in Seen.
struct FineCross {
  FineComponent x, y, z;
  double weight = 1, by = 1;

  FineCross(const FinePoint& a, const FinePoint& p)
      : x(component(a.y, p.z, a.z, p.y)), y(component(a.z, p.x, a.x, p.z)), z(component(a.x, p.y, a.y, p.x)) {
    const double most = std::max(y.magnitude, z.magnitude);
    if (most > 0x1p-100) return;
    const Scale scale(most);  // most >= 2^-850
    weight = scale.inverse, by = scale.by;
    for (FineComponent* c : {&x, &y, &z}) c->value = scaled_by(c->value, by), c->magnitude *= by;
  }
};

/// The apex, axes permuted.
struct FineApex {
  FineApex(const Axes& axes, const UnitVector& unit, const Point& given)
      : high(axes(unit.high)), low(axes(unit.low)), given(given, axes) {}
  Point high, low;  ///< of the direction
  FinePoint given;
};

Seen<DoubleDouble> seen_finely_from(const FineApex& a, const UnitVector& unit, const Axes& axes,
                                    const Point& p) {
  const Point high = axes(unit.high), low = axes(unit.low);
  const DoubleDouble ax{a.high.x, a.low.x}, ay{a.high.y, a.low.y}, az{a.high.z, a.low.z};
  const DoubleDouble x = DoubleDouble{high.x, low.x} - ax, y = DoubleDouble{high.y, low.y} - ay,
                     z = DoubleDouble{high.z, low.z} - az;
  const Point e{x.high, y.high, z.high};
  if (const double square = dot(e, e); square >= kNear) {
    const double py = std::fabs(az.high * x.high) + std::fabs(ax.high * z.high) +
                      (0x1p-17 * (std::fabs(az.high) + std::fabs(high.z)) + 0x1p-700);
    const double pz = std::fabs(ax.high * y.high) + std::fabs(ay.high * x.high) +
                      (0x1p-17 * (std::fabs(ay.high) + std::fabs(high.y)) + 0x1p-700);
    return {az * x - ax * z, ax * y - ay * x, py, pz, scaled_by(x * x + y * y + z * z, 0.5), square};
  }
  const FinePoint given(p, axes);
  const FineCross n(a.given, given);
  const DoubleDouble square = n.x.value * n.x.value + n.y.value * n.y.value + n.z.value * n.z.value;
  const DoubleDouble two_x = scaled_by(
      two_product(a.given.x, given.x) + two_product(a.given.y, given.y) + two_product(a.given.z, given.z), 2);
  const double inverse = 1 / two_x.high, rest = square.high * n.weight * n.weight * inverse;
  return {n.y.value,
          n.z.value,
          n.y.magnitude,
          n.z.magnitude,
          square / (two_x + DoubleDouble{rest - rest * rest * inverse, 0}),
          (n.x.magnitude * n.x.magnitude + n.y.magnitude * n.y.magnitude + n.z.magnitude * n.z.magnitude) *
              inverse,
          n.weight,
          n.by};
}

// ---- in integers --------------------------------------------------------------------------------------

/// The sign of the volume times |a||b||c||d|:  |a| [bcd] - |b| [acd] + |c| [abd] - |d| [abc].
template <class Int>
int exact_height(const Point& a, const Point& b, const Point& c, const Point& d) {
  using namespace exact;
  const auto A = scaled<Int>(a, span_of(a).low), B = scaled<Int>(b, span_of(b).low),
             C = scaled<Int>(c, span_of(c).low), D = scaled<Int>(d, span_of(d).low);
  return sign_of_sum<Int>({det(B, C, D), -det(A, C, D), det(A, B, D), -det(A, B, C)},
                          {dot(A, A), dot(B, B), dot(C, C), dot(D, D)});
}

/// True if all brackets are zero. Three of them suffice: if a, b, c were linearly independent, d would be a
/// combination of them with coefficients 0.
bool on_great_circle(const Point& a, const Point& b, const Point& c, const Point& d) {
  return in_coordinate_plane(a, b, c, d) ||
         (left_of_vectors(a, b, d) == 0 && left_of_vectors(b, c, d) == 0 && left_of_vectors(c, a, d) == 0);
}

int exact_height_of_directions(const Point& a, const Point& b, const Point& c, const Point& d) {
  using namespace exact;
  const int bits = std::max({span_of(a).bits(), span_of(b).bits(), span_of(c).bits(), span_of(d).bits()});
  ++stages.integers;
  if (bits <= kRootBits) return exact_height<RootInteger>(a, b, c, d);
  ++stages.big_integers;
  return exact_height<Integer>(a, b, c, d);
}

}  // namespace

int fine_left(const Point& pa, const Point& pb, const Point& pc) {
  // Two factors N, the product, the difference: 3 + 3 + 6 + 4 units of u^2, less than 2^-101 of the
  // magnitude.
  constexpr double kFactor = 0x1p-100;
  ++stages.double_double;
  const Axes axes(pa);
  const FinePoint a(pa, axes);
  const FineCross b(a, FinePoint(pb, axes)), c(a, FinePoint(pc, axes));
  const DoubleDouble value = b.y.value * c.z.value - b.z.value * c.y.value;
  const int sign = certain_sign(
      value.high, kFactor * (b.y.magnitude * c.z.magnitude + b.z.magnitude * c.y.magnitude) + kNegligible);
  return axes.negative ? -sign : sign;
}

int orientation_of_directions(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point four[4] = {a, b, c, d};
  return Directions(four, 4).orientation(0, 1, 2, 3);
}

bool is_nearer(const Point& p, const Point& a, const Point& b) {
  // With A = a.p and B = b.p, compare A |A| b.b with B |B| a.a. In doubles each has the three roundings of
  // three dot products and two of their product, 11u of |p|^2 a.a b.b: 22u together, and `size` has 11u of
  // itself.
  const double dot_a = dot(a, p), dot_b = dot(b, p), aa = dot(a, a), bb = dot(b, b);
  const double difference = dot_a * std::fabs(dot_a) * bb - dot_b * std::fabs(dot_b) * aa;
  const double pp = dot(p, p), size = pp * aa * bb;
  const bool all_moderate = is_moderate_square(pp) && is_moderate_square(aa) && is_moderate_square(bb);
  if (all_moderate && std::fabs(difference) > 32 * u * size) return difference > 0;
  const auto exactly = [&](auto zero) {
    using Int = decltype(zero);
    const auto vector = [](const Point& v) { return exact::scaled<Int>(v, exact::span_of(v).low); };
    const auto c = vector(p), d = vector(a), e = vector(b);
    return exact::sign_of_sum(Int(dot(d, c)), Int(dot(e, e)), Int(-dot(e, c)), Int(dot(d, d))) > 0;
  };
  const int bits = std::max({exact::span_of(p).bits(), exact::span_of(a).bits(), exact::span_of(b).bits()});
  return bits <= 4 * exact::kRootBits ? exactly(exact::RootInteger()) : exactly(exact::Integer());
}

bool above_of_directions(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point four[4] = {a, b, c, d};
  return Directions(four, 4).above(0, 1, 2, 3);
}

namespace {

/// Finds `shrink` with p/|p| = p - shrink p for a vector whose length is 1 up to rounding; no root is needed.
/// |p|^2 = 1 + x with |x| < 2^-50, and 1/sqrt(1+x) = 1 - x/2 + 3/8 x^2 - ..., the next term below 2^-150.
/// Errors in units of u^2: 4, half of those of four sums of at most five terms below u/2 each; by the
/// rounding of x, of both factors of `shrink`, of `shrink` and of its product with a component, each half an
/// ulp of a number below 2^-50 or half of that: 4 + 4 + 8 + 8.
bool find_shrink(const Point& p, double& shrink) {
  if (!(std::fabs(dot(p, p) - 1) <= 0x1p-51)) return false;
  const DoubleDouble xx = two_product(p.x, p.x), yy = two_product(p.y, p.y), zz = two_product(p.z, p.z);
  const DoubleDouble xy = two_sum(xx.high, yy.high), all = two_sum(xy.high, zz.high);
  const double x = (all.high - 1) + ((all.low + xy.low) + (xx.low + yy.low + zz.low));
  shrink = x * (0.5 - 0.375 * x);
  return true;
}

}  // namespace

bool Directions::store(index_t i) {
  Stored& s = unit_[i];
  s.high = p_[i];
  if (find_shrink(p_[i], s.shrink)) return true;
  s.shrink = std::numeric_limits<double>::quiet_NaN();
  return false;
}

void Directions::store_other(index_t i) {
  const UnitVector v = unit_vector(p_[i]);
  unit_[i].high = v.high;
  low_[i] = v.low;
}

Directions::Directions(const Point* points, std::size_t n, std::size_t capacity)
    : p_(points), n_(n), unit_(std::max(n, capacity)) {
  std::atomic<bool> are_units = true;
  parallel_pieces(n, threads_for(n), [&](std::size_t first, std::size_t last, int) {
    bool are = true;
    for (std::size_t i = first; i < last; ++i) are &= store(static_cast<index_t>(i));
    if (!are) are_units = false;
  });
  if (are_units) return;
  low_ = BlockArray<Point>(unit_.size());
  parallel_for(n, n, [&](std::size_t i) {
    if (std::isnan(unit_[i].shrink)) store_other(static_cast<index_t>(i));
  });
}

void Directions::extend(const Point* points, std::size_t n) {
  const auto grow = [&](auto& array) {
    std::decay_t<decltype(array)> larger(n + n / 2);
    std::copy(array.begin(), array.begin() + n_, larger.begin());
    array = std::move(larger);
  };
  if (n > unit_.size()) {
    if (low_.size() > 0) grow(low_);
    grow(unit_);
  }
  p_ = points;
  for (std::size_t k = n_; k < n; ++k) {
    const auto i = static_cast<index_t>(k);
    if (store(i)) continue;
    if (low_.size() == 0) low_ = BlockArray<Point>(unit_.size());
    store_other(i);
  }
  n_ = n;
}

UnitVector unit_vector(const Point& p) {
  if (double shrink; find_shrink(p, shrink))
    return rounded({p, {-shrink * p.x, -shrink * p.y, -shrink * p.z}});
  // A vector whose squares could overflow or underflow is scaled by a power of two, its largest component
  // to [1/2,1). That is exact except for bits below 2^-1074 of the largest component. What underflows later
  // is as small; in a vector that is not scaled it is below 2^-400 of the length. Then `two_product` and
  // `two_sum` are exact, and high + low is p/|p| with these relative errors, in units of u^2:
  //   3    half the error of s: two sums of three small terms, 3 each;
  //   9.4  what one Newton step for 1/sqrt(s) leaves: 3/8 h^2 with h = 1 - s r0^2 below 5u, by the rounding
  //        of the root, of the quotient, and s.low;
  //   8.5  half the error of `residual`: 16 for its five roundings, 1 for s.low * rr.low, which is left out;
  //   8.5  the roundings of r1, of c * r1 and of its sum with q.low, 2.5 + 2.5 + 3.5:
  // together less than 2^-101. Where products underflow a component is wrong by 2^-1071 more.
  double c[3] = {p.x, p.y, p.z};
  if (const double most = largest(p); !(most > 0x1p-300 && most < 0x1p300)) {
    int e;
    std::frexp(most, &e);
    for (double& v : c) v = std::ldexp(v, -e);
  }
  // A tiny square is far below the error of s. It is skipped because underflow slows the processor down.
  const auto square = [](double v) {
    const double not_tiny = std::fabs(v) < 0x1p-440 ? 0 : v;
    return two_product(not_tiny, not_tiny);
  };
  DoubleDouble s = square(c[0]);
  for (int k = 1; k < 3; ++k) {
    const DoubleDouble q = square(c[k]);
    const DoubleDouble t = two_sum(s.high, q.high);
    s = two_sum_of_ordered(t.high, t.low + (s.low + q.low));
  }
  const double r0 = 1 / std::sqrt(s.high);
  const DoubleDouble rr = two_product(r0, r0);
  const DoubleDouble one = two_product(s.high, rr.high);
  const double residual = ((1 - one.high) - one.low) - (s.high * rr.low + s.low * rr.high);
  const double r1 = r0 * residual * 0.5;
  double high[3], low[3];
  for (int k = 0; k < 3; ++k) {
    const DoubleDouble q = two_product(c[k], r0);
    const DoubleDouble v = two_sum_of_ordered(q.high, q.low + c[k] * r1);
    high[k] = v.high;
    // Below the error. Set to 0, because its square would underflow, which slows the processor down.
    low[k] = std::fabs(v.low) < 0x1p-110 * std::fabs(v.high) ? 0 : v.low;
  }
  return {{high[0], high[1], high[2]}, {low[0], low[1], low[2]}};
}

int Directions::left(index_t ia, index_t ib, index_t ic) const {
  ++stages.left;
  const Point &a = p_[ia], &b = p_[ib], &c = p_[ic];
  if (in_coordinate_plane(a, b, c)) return 0;
  const Axes axes(position(ia));
  const Point apex = axes(position(ia));
  const auto seen = [&](index_t i) { return seen_from(apex, axes(position(i)), axes(difference(i, ia))); };
  if (const int s = filter_left(seen(ib), seen(ic))) return axes.negative ? -s : s;
  return left_of_vectors(a, b, c);
}

int Directions::orientation(index_t a, index_t b, index_t c, index_t d) const {
  if (const int s = filter_seen_from_first({a, b, c, d})) return s;
  return uncertain_orientation({a, b, c, d});
}

int Directions::filter_seen_from_first(const Four& f) const {
  const Axes axes(position(f[0]));
  const Point apex = axes(position(f[0]));
  const auto seen = [&](index_t i) { return seen_from(apex, axes(position(i)), axes(difference(i, f[0]))); };
  const int s = height(seen(f[1]), seen(f[2]), seen(f[3]), kFactor);
  return axes.negative ? -s : s;
}

int Directions::uncertain_orientation(const Four& f) const {
  bool first_will_do;
  const Four best = best_first(f, first_will_do);
  if (!first_will_do)
    if (const int s = filter_seen_from_first(best)) return s;
  const Point &a = p_[best[0]], &b = p_[best[1]], &c = p_[best[2]], &d = p_[best[3]];
  ++stages.double_double;
  const Axes axes(position(best[0]));
  const FineApex apex(axes, unit(best[0]), a);
  const auto seen = [&](index_t i) { return seen_finely_from(apex, unit(i), axes, p_[i]); };
  if (const int s = height(seen(best[1]), seen(best[2]), seen(best[3]), kFineFactor))
    return axes.negative ? -s : s;
  if (on_great_circle(a, b, c, d)) return 0;
  return exact_height_of_directions(a, b, c, d);
}

Directions::Four Directions::best_first(const Four& f, bool& first_will_do) const {
  // The error grows with the product of the distances from the apex. In a needle the best apex is one of
  // the two close nodes. Sums of exponents replace the product, which could underflow.
  const auto distance = [&](std::size_t i, std::size_t j) {
    return exponent_of(largest(difference(f[i], f[j])));
  };
  const int ab = distance(0, 1), ac = distance(0, 2), ad = distance(0, 3), bc = distance(1, 2),
            bd = distance(1, 3), cd = distance(2, 3);
  const int product[4] = {ab + ac + ad, ab + bc + bd, ac + bc + cd, ad + bd + cd};
  const Four even[4] = {f, {f[1], f[0], f[3], f[2]}, {f[2], f[3], f[0], f[1]}, {f[3], f[2], f[1], f[0]}};
  const auto least = std::min_element(product, product + 4) - product;
  first_will_do = product[0] <= product[least] + 3;
  return even[least];
}

bool Directions::above(index_t a, index_t b, index_t c, index_t d) const {
  ++stages.above;
  const int s = orientation(a, b, c, d);
  return s > 0 || (s == 0 && above_by_tie_rule({a, b, c, d}));
}

bool Directions::above_by_tie_rule(const Four& f) const {
  const Point &a = p_[f[0]], &b = p_[f[1]], &c = p_[f[2]], &d = p_[f[3]];
  return !same_direction(a, b) && !same_direction(b, c) && !same_direction(c, a) && !same_direction(a, d) &&
         !same_direction(b, d) && !same_direction(c, d) && symbolic_above(a, b, c, d);
}

// ---- the view from one node -----------------------------------------------------------------------------

struct Directions::View::Memory {
  explicit Memory(const Directions& directions) : nodes(directions) {}

  const Seen<double>& see(index_t i) {
    return seen(i, [&](Seen<double>& s) {
      s = seen_from(apex, axes(nodes.position(i)), axes(nodes.difference(i, v)));
    });
  }
  /// For unit vectors up to rounding whose coordinates are multiples of 2^-61, as those of most nodes on
  /// parallels are. 0: not certain.
  int height_on_grid(const index_t (&node)[3], const Seen<double> (&of)[3]) const {
    exact::Grid at_v, at[3];
    double s[3];
    if (!exact::on_grid(nodes.position(v), at_v)) return 0;
    for (int k = 0; k < 3; ++k) {
      if (!exact::on_grid(nodes.position(node[k]), at[k])) return 0;
      s[k] = nodes.unit_[node[k]].shrink - nodes.unit_[v].shrink;  // NaN, and not certain, for other lengths
    }
    const double volume =
        0x1p-183 * exact::det(minus(at[0], at_v), minus(at[1], at_v), minus(at[2], at_v)).value();
    return height_by_lengths(apex.x * volume, of[0], of[1], of[2], s[0], s[1], s[2]);
  }
  /// For two of the nodes that are close to each other and far from v. 0: not certain, or there are none.
  int height_of_pair(const index_t (&node)[3], const Seen<double> (&of)[3]) const {
    std::size_t pair = 0;
    double least = 4;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point f = nodes.difference(node[(k + 1) % 3], node[k]);
      if (const double square = dot(f, f); square < least) pair = k, least = square;
    }
    if (!(least < 0x1p-10 * of[pair].q)) return 0;
    const index_t from = node[pair], to = node[(pair + 1) % 3];
    const Seen<double> s = step(apex, axes(nodes.position(from)), axes(nodes.difference(to, from)));
    return s.weight == 1 ? height(of[(pair + 2) % 3], of[pair], s, kFactor) : 0;
  }

  const Directions& nodes;
  index_t v = 0;
  Axes axes{{1, 0, 0}};
  Point apex{};
  Remembered<Seen<double>> seen;
};

Directions::View::View(const Directions& nodes) : nodes_(nodes), memory_(std::make_unique<Memory>(nodes)) {}
Directions::View::~View() = default;

Directions::View::Memory& Directions::View::memory() {
  Memory& m = *memory_;
  if (is_ready_) return m;
  is_ready_ = true;
  m.v = v_;
  m.axes = Axes(nodes_.position(v_));
  m.apex = m.axes(nodes_.position(v_));
  m.seen.forget();
  return m;
}

bool Directions::View::above(index_t a, index_t b, index_t c) {
  Memory& m = memory();
  tied_ = false;
  ++stages.above;
  // c, b, a seen from v: an even permutation of a, b, c, v.
  const index_t node[3] = {c, b, a};
  const Seen<double> seen[3] = {m.see(c), m.see(b), m.see(a)};
  int s = height(seen[0], seen[1], seen[2], kFactor);
  if (s == 0) s = m.height_on_grid(node, seen);
  if (s == 0) s = m.height_of_pair(node, seen);
  if (s != 0) return (s > 0) != m.axes.negative;
  s = nodes_.uncertain_orientation({m.v, c, b, a});
  tied_ = s == 0;
  return s > 0 || (s == 0 && nodes_.above_by_tie_rule({a, b, c, m.v}));
}

}  // namespace pstripack
