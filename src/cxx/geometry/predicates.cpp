#include "geometry/predicates.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/double_double.h"
#include "geometry/exact_signs.h"
#include "geometry/predicate_stages.h"

// Error bounds below: u = 2^-53 is the unit roundoff of rounding to nearest, which every entry of the library
// sets (base/floating_point.h). The "permanent" is a determinant with every term replaced by its absolute
// value; it is computed alongside.

namespace pstripack {

thread_local PredicateCounts stages;

namespace {

constexpr double u = 0x1p-53;
// A product that underflows is wrong by 2^-1075 at most, and is multiplied by one difference, below
// 2 kLargest: nine products together change a determinant by less than kUnderflow. Sums do not underflow.
// The third powers of differences do not overflow.
constexpr double kUnderflow = 1e-250;
constexpr double kLargest = 1e30;

/// det(e,f,g) and its permanent.
struct Determinant {
  double value, permanent;
};

[[gnu::always_inline]] inline Determinant determinant(const Point& e, const Point& f, const Point& g) {
  const double yz = e.y * f.z, zy = e.z * f.y, zx = e.z * f.x, xz = e.x * f.z, xy = e.x * f.y, yx = e.y * f.x;
  return {(yz - zy) * g.x + (zx - xz) * g.y + (xy - yx) * g.z,
          (std::fabs(yz) + std::fabs(zy)) * std::fabs(g.x) +
              (std::fabs(zx) + std::fabs(xz)) * std::fabs(g.y) +
              (std::fabs(xy) + std::fabs(yx)) * std::fabs(g.z)};
}

/// The sign of d.value if its error is certainly below `bound`, else 0. 0 for NaN.
int certain_sign(const Determinant& d, double bound) {
  if (d.value > bound) return 1;
  if (d.value < -bound) return -1;
  return 0;
}

// Filter for vectors whose components are exact or have one rounding.
// e, f, g: differences with one rounding each. A product of three carries 3 roundings of the differences,
// 2 of the products, 1 of the subtraction, at most 2 of the sums: the error is at most (1-u)^-8 - 1 <
// 8u + 40u^2 of the permanent of the computed differences. That permanent and the bound come out smaller by
// 8 roundings at most, and 9u (1-u)^8 > 8u + 40u^2. (Shewchuk 1997, orient3d, stage A: 7u + 56u^2.)
constexpr double kFactor = 9 * u;

int filter_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto v = determinant(minus(b, a), minus(c, a), minus(d, a));
  return certain_sign(v, kFactor * v.permanent + kUnderflow);
}

/// det(a,b,c) = det(b-a, c-a, a), whose terms, and so the error bound, are small if the nodes are close.
[[gnu::always_inline]] inline int filter_left(const Point& a, const Point& b, const Point& c) {
  const auto v = determinant(minus(b, a), minus(c, a), a);
  return certain_sign(v, kFactor * v.permanent + kUnderflow);
}

inline bool moderate(const Point& a) {
  return std::fabs(a.x) < kLargest && std::fabs(a.y) < kLargest && std::fabs(a.z) < kLargest;
}

/// True if the nodes lie on a plane perpendicular to an axis, for example on one parallel: the volume is 0.
template <class... Points>
bool in_parallel_plane(const Point& a, const Points&... p) {
  return ((p.x == a.x) && ...) || ((p.y == a.y) && ...) || ((p.z == a.z) && ...);
}

int exact_left(const Point& a, const Point& b, const Point& c) {
  using namespace exact;
  const int bits = std::max({span_of(a).bits(), span_of(b).bits(), span_of(c).bits()});
  if (bits <= kSmallBits) return exact::left<Integer512>(a, b, c);
  ++stages.big_integers;
  return exact::left<Integer>(a, b, c);
}

int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  using namespace exact;
  Span span = span_of(a);
  span.join(b);
  span.join(c);
  span.join(d);
  if (span.bits() <= kSmallBits) return exact::orientation<Integer512>(a, b, c, d, span.low);
  ++stages.big_integers;
  return exact::orientation<Integer>(a, b, c, d, span.low);
}

// Differences are exact sums of two doubles. In units of u^2: minors 6 + 4, their products 6, two sums 4
// each: 24 of the permanent. 2^-99 is 128 of it, far more than its rounding and higher orders need.
constexpr double kFineFactor = 0x1p-99;

int fine_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  ++stages.double_double;
  struct Difference {
    DoubleDouble x, y, z;
    Difference(const Point& p, const Point& q)
        : x(two_sum(p.x, -q.x)), y(two_sum(p.y, -q.y)), z(two_sum(p.z, -q.z)) {}
  };
  const Difference e(b, a), f(c, a), g(d, a);
  const DoubleDouble value =
      (e.y * f.z - e.z * f.y) * g.x + (e.z * f.x - e.x * f.z) * g.y + (e.x * f.y - e.y * f.x) * g.z;
  const double permanent = determinant({e.x.high, e.y.high, e.z.high}, {f.x.high, f.y.high, f.z.high},
                                       {g.x.high, g.y.high, g.z.high})
                               .permanent;
  return certain_sign({value.high, 0}, kFineFactor * permanent + kUnderflow);
}

}  // namespace

bool symbolic_above(const Point& a, const Point& b, const Point& c, const Point& d) {
  return symbolic_above(a, b, c, d,
                        [](const Point& p, const Point& q, const Point& r) { return left(p, q, r); });
}

int left_of_vectors(const Point& a, const Point& b, const Point& c) {
  using namespace exact;
  if (Grid p, q, r; on_grid(a, p) && on_grid(b, q) && on_grid(c, r)) {
    ++stages.integers;
    return sign_of_det(p, q, r);
  }
  if (const int s = fine_left(a, b, c)) return s;
  ++stages.integers;
  return exact_left(a, b, c);
}

int left(const Point& a, const Point& b, const Point& c) {
  ++stages.left;
  if (in_coordinate_plane(a, b, c)) return 0;
  if (moderate(a) && moderate(b) && moderate(c))
    if (const int s = filter_left(a, b, c)) return s;
  return left_of_vectors(a, b, c);
}

int left_of_sum(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto det = [](const Point& p, const Point& q, const Point& r) { return dot(cross(p, q), r); };
  const auto size = [](const Point& p) { return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z); };
  const double value = det(a, b, c) + det(a, b, d), bound = size(a) * size(b) * (size(c) + size(d));
  const bool all_moderate = is_moderate_square(dot(a, a)) && is_moderate_square(dot(b, b)) &&
                            is_moderate_square(dot(c, c)) && is_moderate_square(dot(d, d));
  // Each of the terms, at most the bound together, has 8 roundings.
  if (all_moderate && std::fabs(value) > 0x1p-48 * bound) return value > 0 ? 1 : -1;
  using exact::Integer;
  exact::Span together = exact::span_of(c);
  together.join(d);
  const auto p = exact::scaled<Integer>(a, exact::span_of(a).low),
             q = exact::scaled<Integer>(b, exact::span_of(b).low);
  return exact::sign(Integer(exact::det(p, q, exact::scaled<Integer>(c, together.low)) +
                             exact::det(p, q, exact::scaled<Integer>(d, together.low))));
}

int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  if (in_parallel_plane(a, b, c, d)) return 0;
  const bool all_moderate = moderate(a) && moderate(b) && moderate(c) && moderate(d);
  if (all_moderate)
    if (const int s = filter_orientation(a, b, c, d)) return s;
  using namespace exact;
  if (Grid p, q, r, s; on_grid(a, p) && on_grid(b, q) && on_grid(c, r) && on_grid(d, s)) {
    ++stages.integers;
    return sign_of_det(minus(q, p), minus(r, p), minus(s, p));
  }
  if (all_moderate)
    if (const int s = fine_orientation(a, b, c, d)) return s;
  ++stages.integers;
  return exact_orientation(a, b, c, d);
}

bool same_direction(const Point& a, const Point& b) {
  if ((a.x < 0) != (b.x < 0) || (a.y < 0) != (b.y < 0) || (a.z < 0) != (b.z < 0)) return false;
  if ((a.x == 0) != (b.x == 0) || (a.y == 0) != (b.y == 0) || (a.z == 0) != (b.z == 0)) return false;
  if (a == b) return true;
  // Equal products are rounded to equal doubles, even if they overflow or underflow.
  if (a.x * b.y != a.y * b.x || a.y * b.z != a.z * b.y || a.z * b.x != a.x * b.z) return false;
  using namespace exact;
  const auto n = cross(scaled<Integer>(a, span_of(a).low), scaled<Integer>(b, span_of(b).low));
  return n.x == 0 && n.y == 0 && n.z == 0;  // equal signs: not opposite
}

PredicateCounts take_predicate_counts() { return std::exchange(stages, {}); }

int Coordinates::left(index_t a, index_t b, index_t c) const { return pstripack::left(p_[a], p_[b], p_[c]); }

int Coordinates::height(index_t ia, index_t ib, index_t ic, index_t id) const {
  ++stages.above;
  return orientation(p_[ia], p_[ib], p_[ic], p_[id]);
}

bool Coordinates::above(index_t ia, index_t ib, index_t ic, index_t id) const {
  if (const int s = height(ia, ib, ic, id)) return s > 0;
  const Point &a = p_[ia], &b = p_[ib], &c = p_[ic], &d = p_[id];
  if (d == a || d == b || d == c || a == b || b == c || c == a) return false;
  return symbolic_above(a, b, c, d);
}

void Coordinates::View::look() {
  is_ready_ = true;
  seen_.forget();
  viewpoint_.on_grid = exact::on_grid(nodes_.p_[v_], viewpoint_.vector);
}

const Coordinates::View::Difference& Coordinates::View::see(index_t i) {
  return seen_(i, [&](Difference& d) {
    d.on_grid = viewpoint_.on_grid && exact::on_grid(nodes_.p_[i], d.vector);
    if (d.on_grid) d.vector = minus(d.vector, viewpoint_.vector);
  });
}

namespace {

/// symbolic_above; false if v coincides with another node. Called millions of times on parallels and
/// lattices. Usually the node with the largest x has the highest rank and decides; it is found without
/// unpredictable branches.
bool above_by_tie(const Point& a, const Point& b, const Point& c, const Point& v) {
  const Point* const node[4] = {&v, &c, &b, &a};
  // For each node: the three others, ordered so that they turn left if pushing it outwards puts v above
  // a,b,c.
  static constexpr std::uint8_t bracket[4][3] = {{3, 2, 1}, {2, 3, 0}, {3, 1, 0}, {1, 2, 0}};
  const int vc = c.x > v.x, ba = 2 + (a.x > b.x);
  const double first = node[vc]->x, second = node[ba]->x;
  if (first != second && v.x != c.x && b.x != a.x) {
    const auto& turn = bracket[second > first ? ba : vc];
    const Point &p = *node[turn[0]], &q = *node[turn[1]], &r = *node[turn[2]];
    if (const int s = moderate(p) && moderate(q) && moderate(r) ? filter_left(r, p, q) : 0) {
      ++stages.symbolic;
      return s > 0;
    }
  }
  return v != a && v != b && v != c && symbolic_above(a, b, c, v);
}

}  // namespace

bool Coordinates::View::above(index_t ia, index_t ib, index_t ic) {
  const Point &a = nodes_.p_[ia], &b = nodes_.p_[ib], &c = nodes_.p_[ic], &v = nodes_.p_[v_];
  if (!in_parallel_plane(a, b, c, v)) {
    if (!is_ready_) look();
    const Difference e = see(ic), f = see(ib), g = see(ia);
    if (!(e.on_grid && f.on_grid && g.on_grid)) return nodes_.above(ia, ib, ic, v_);
    ++stages.integers;
    if (const int s = exact::sign_of_det(e.vector, f.vector, g.vector)) {
      ++stages.above;
      return s > 0;
    }
  }
  ++stages.above;
  return above_by_tie(a, b, c, v);
}

}  // namespace pstripack
