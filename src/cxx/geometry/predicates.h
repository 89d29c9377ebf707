#pragma once
// The predicates of the triangulation, exact for every finite double.
//
//   left(a,b,c)     the sign of det(a,b,c): c lies left of (+1), on (0) or right of (-1) the great
//                   circle directed from a to b, seen from outside the sphere.
//   above(a,b,c,d)  d lies strictly above the plane of the counterclockwise triangle a,b,c, that is,
//                   strictly inside its circumscribed cap.
//
// Identities (tested in tests/cxx/predicates_test.cpp), for pairwise different directions:
//   (1) left(a,b,c) == left(b,c,a) == -left(b,a,c)
//   (2) above(a,b,c,d) == above(b,c,a,d)
//   (3) above(a,b,c,d) != above(b,a,c,d), except where all four lie on one great circle: both false
//   (4) the sign behind `above` is antisymmetric under every permutation of its four arguments
//   (5) the result does not depend on the numbering of the nodes, on FMA or on threads; nor on the rounding
//       mode of the program, which every entry of the library replaces (base/floating_point.h)
//
// Two sets of predicates share this interface; the kernel takes the set as a parameter:
//   Coordinates  the vectors exactly as given;
//   Directions   the vectors p/|p|, exactly (square roots included).
//
// Each decision passes three stages: filter (floating point with a proven bound), exact (integers),
// symbolic (the tie rule). The tie rule: a zero of `above` is decided as if every node were pushed
// outwards along its own direction by an amount that grows with its rank in the lexicographic order
// of the given (x,y,z); each push is infinitely larger than all of lower rank. With t = 1/length the
// volume is linear in each t,
//     volume ~  t_a [bcd] - t_b [acd] + t_c [abd] - t_d [abc],      [pqr] = det(p,q,r),
// and pushing outwards lowers t; so the highest-ranked node whose bracket is not zero decides:
//     d: +[abc]    c: -[abd]    b: +[acd]    a: -[bcd].
// A radial push changes no `left`. Four nodes on one great circle have four zero brackets, so no rank
// decides: they count as "not above".

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "base/workspace.h"
#include "geometry/double_double.h"
#include "geometry/point.h"

namespace pstripack {

using index_t = std::int32_t;

/// The exact sign of det(a,b,c): +1, 0, -1. The same for the vectors and for their directions.
int left(const Point& a, const Point& b, const Point& c);

/// The exact sign of det(a, b, c + d).
int left_of_sum(const Point& a, const Point& b, const Point& c, const Point& d);

/// The exact sign of det(b-a, c-a, d-a), without tie rule: +1 where d is above the plane of a,b,c.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

/// The same for the directions a/|a|, b/|b|, c/|c|, d/|d|.
int orientation_of_directions(const Point& a, const Point& b, const Point& c, const Point& d);
/// Directions::above for these four.
bool above_of_directions(const Point& a, const Point& b, const Point& c, const Point& d);

bool same_direction(const Point& a, const Point& b);

/// True if the direction of a is nearer to that of p than the direction of b is: exact, a.p/|a| > b.p/|b|.
bool is_nearer(const Point& p, const Point& a, const Point& b);

/// Which of the two sets decides.
enum class Lengths {
  automatic,  ///< as given; directions where a length differs from 1 by more than 1e-6, or where the
              ///< lengths as given would hide a node inside the hull of the others
  as_given,
  directions
};

/// What a mesh that was repaired by Lengths::as_given has to show. `directions`: it is the mesh of the
/// directions, too. All nodes must then have length_is_one_up_to_rounding.
enum class Confirm { nothing, directions };

/// True if |p| is within 1e-6 of 1, so that Coordinates may be used. False if p is not finite. Exact except
/// for the rounding of the square, since (1 +- 1e-6)^2 = 1 + 1e-12 +- 2e-6.
inline bool length_is_one(const Point& p) {
  return std::fabs(p.x * p.x + p.y * p.y + p.z * p.z - (1 + 1e-12)) <= 2e-6;
}

/// True if |p| is within 2^-50 of 1: a unit vector up to the rounding of its coordinates. The rounding of the
/// square is at most 3 * 2^-53, so its error is below 2^-50 + 2^-51.
inline bool length_is_one_up_to_rounding(const Point& p) {
  return std::fabs(p.x * p.x + p.y * p.y + p.z * p.z - 1) <= 0x1p-50;
}

/// Number of times each stage was entered, over all predicates; for tests and for measuring the filters.
struct PredicateCounts {
  std::uint64_t above = 0, left = 0;  ///< calls that the kernel passed to the predicates
  std::uint64_t double_double = 0;    ///< not decided by doubles
  std::uint64_t integers = 0;         ///< decided by integers, of machine words or larger
  std::uint64_t big_integers = 0;     ///< those of `integers` that were too large for a fixed size
  std::uint64_t symbolic = 0;         ///< zeros of `above` that the tie rule decided
};

/// Predicates on the nodes p[0..n-1] as given.
/// Holds a pointer only: the points must outlive it.
class Coordinates {
 public:
  Coordinates(const Point* points, std::size_t n) : p_(points), n_(n) {}

  std::size_t size() const { return n_; }
  /// Sets the address and the number of the nodes. Nodes that were there before must be unchanged.
  void extend(const Point* points, std::size_t n) { p_ = points, n_ = n; }
  const Point& given(index_t i) const { return p_[i]; }
  const Point& position(index_t i) const { return p_[i]; }
  /// p[i] - p[j]; every component has one rounding.
  Point difference(index_t i, index_t j) const {
    return {p_[i].x - p_[j].x, p_[i].y - p_[j].y, p_[i].z - p_[j].z};
  }
  int left(index_t a, index_t b, index_t c) const;
  bool above(index_t a, index_t b, index_t c, index_t d) const;
  /// Without the tie rule: false for a zero.
  bool strictly_above(index_t a, index_t b, index_t c, index_t d) const { return height(a, b, c, d) > 0; }
  bool coincide(index_t a, index_t b) const { return p_[a] == p_[b]; }
  class View;

 private:
  int height(index_t a, index_t b, index_t c, index_t d) const;  ///< the exact sign behind `above`
  const Point* p_;
  std::size_t n_;
};

/// A direction: high + low = p/|p| with a relative error of 2^-101 in every component; high is the rounded
/// sum.
struct UnitVector {
  Point high, low;
};
UnitVector unit_vector(const Point& p);
/// The same for two doubles of each component whose sum is the direction.
inline UnitVector rounded(const UnitVector& v) {
  const DoubleDouble x = two_sum_of_ordered(v.high.x, v.low.x), y = two_sum_of_ordered(v.high.y, v.low.y),
                     z = two_sum_of_ordered(v.high.z, v.low.z);
  return {{x.high, y.high, z.high}, {x.low, y.low, z.low}};
}
/// a - b; every component has 2 roundings and an absolute error of 2^-99.
inline Point difference(const UnitVector& a, const UnitVector& b) {
  return {(a.high.x - b.high.x) + (a.low.x - b.low.x), (a.high.y - b.high.y) + (a.low.y - b.low.y),
          (a.high.z - b.high.z) + (a.low.z - b.low.z)};
}

/// Predicates on the directions p[i]/|p[i]| of any finite non-zero vectors.
/// Keeps 32 bytes per node beside the points, which must outlive it, and another 24 if any node is no unit
/// vector.
class Directions {
 public:
  /// `capacity`: extend() takes memory anew only for more nodes. Throws std::bad_alloc.
  Directions(const Point* points, std::size_t n, std::size_t capacity = 0);

  std::size_t size() const { return n_; }
  /// Sets the address and the number of the nodes. Nodes that were there before must be unchanged. Throws
  /// std::bad_alloc.
  void extend(const Point* points, std::size_t n);
  const Point& given(index_t i) const { return std::isnan(unit_[i].shrink) ? p_[i] : unit_[i].high; }
  /// p[i]/|p[i]|, where 4u = 2^-51 is the largest error of its length, u of its direction.
  const Point& position(index_t i) const { return unit_[i].high; }
  /// That of unit_vector(p[i]).
  UnitVector unit(index_t i) const { return rounded({unit_[i].high, low(i)}); }
  /// For loops whose next nodes may lie anywhere in memory. Always inline: g++ otherwise considers functions
  /// that only prefetch free of side effects and drops the calls.
  [[gnu::always_inline]] void prefetch(index_t i) const { __builtin_prefetch(&unit_[i]); }
  /// p[i]/|p[i]| - p[j]/|p[j]|; every component has 2 roundings and an absolute error of 2^-99.
  Point difference(index_t i, index_t j) const {
    return pstripack::difference({unit_[i].high, low(i)}, {unit_[j].high, low(j)});
  }
  int left(index_t a, index_t b, index_t c) const;
  bool above(index_t a, index_t b, index_t c, index_t d) const;
  /// Without the tie rule: false for a zero.
  bool strictly_above(index_t a, index_t b, index_t c, index_t d) const {
    return orientation(a, b, c, d) > 0;
  }
  /// The exact sign behind `above`.
  int orientation(index_t a, index_t b, index_t c, index_t d) const;
  bool coincide(index_t a, index_t b) const { return same_direction(p_[a], p_[b]); }
  class View;

 private:
  using Four = std::array<index_t, 4>;
  /// `orientation` with f[0] as the apex, in doubles; 0: not certain.
  int filter_seen_from_first(const Four& f) const;
  /// `orientation` where that is 0: by the best apex, then by the later stages.
  int uncertain_orientation(const Four& f) const;
  /// `above` where `orientation` is 0.
  bool above_by_tie_rule(const Four& f) const;
  /// An even permutation of f that starts with the apex of smallest error bound. `first_will_do`: f[0] is
  /// about as good.
  Four best_first(const Four& f, bool& first_will_do) const;

  /// Of a node that is a unit vector up to rounding, `high` is the vector itself, and the direction is high -
  /// shrink high. Where `shrink` is NaN, it is high + low_[i].
  struct Stored {
    Point high;
    double shrink;
  };
  Point low(index_t i) const {
    const Stored& s = unit_[i];
    if (__builtin_expect(std::isnan(s.shrink), false)) return low_[i];
    return {-s.shrink * s.high.x, -s.shrink * s.high.y, -s.shrink * s.high.z};
  }
  /// Stores node i. False if it is no unit vector: then store_other() is needed, too.
  bool store(index_t i);
  void store_other(index_t i);

  const Point* p_;
  std::size_t n_;
  BlockArray<Stored> unit_;
  BlockArray<Point> low_;  ///< empty if all are unit vectors
};

/// Cache of one value per node for a view of the predicates. It has 32 slots; nodes whose numbers are equal
/// modulo 32 share one. Entries are valid until the next call of `forget`.
template <class Item>
class Remembered {
 public:
  void forget() { ++time_; }
  /// The entry of node i; `make` computes it if it is not in the cache.
  template <class Make>
  Item& operator()(index_t i, const Make& make) {
    const std::size_t k = slot(i);
    const std::uint64_t key = time_ << 32 | static_cast<std::uint32_t>(i);
    if (key_[k] != key) {
      make(item_[k]);
      key_[k] = key;
    }
    return item_[k];
  }

 private:
  static constexpr std::size_t kSlots = 32;
  static std::size_t slot(index_t i) { return static_cast<std::size_t>(i) % kSlots; }
  std::uint64_t time_ = 1;  // fits 32 bits: forget() is called once per inserted node
  std::uint64_t key_[kSlots] = {};
  Item item_[kSlots];
};

/// The predicates with one node v fixed, for cases that the kernel's floating-point filter leaves open. An
/// inserted node meets each of its future neighbours in about three faces; this class computes the difference
/// to the neighbour once.
class Coordinates::View {
 public:
  explicit View(const Coordinates& nodes) : nodes_(nodes) {}
  void from(index_t v) { v_ = v, is_ready_ = false; }
  /// Coordinates::above(a, b, c, v); no two of a, b, c coincide.
  bool above(index_t a, index_t b, index_t c);
  int left(index_t a, index_t b) { return nodes_.left(a, b, v_); }

 private:
  /// Difference from v to the node; in multiples of 2^-61 if both are such multiples.
  struct Difference {
    Vector3<std::int64_t> vector;
    bool on_grid;
  };
  void look();  ///< prepares v, when first needed: few insertions do
  const Difference& see(index_t i);
  const Coordinates& nodes_;
  index_t v_ = 0;
  bool is_ready_ = false;
  Difference viewpoint_{};
  Remembered<Difference> seen_;
};

class Directions::View {
 public:
  explicit View(const Directions& nodes);
  ~View();
  void from(index_t v) { v_ = v, is_ready_ = false; }
  bool above(index_t a, index_t b, index_t c);  ///< Directions::above(a, b, c, v); no two of a, b, c coincide
  int left(index_t a, index_t b) { return nodes_.left(a, b, v_); }
  /// True if v lay in the plane in the last call of `above`, which the tie rule decided.
  bool tied() const { return tied_; }

 private:
  struct Memory;
  Memory& memory();  ///< cache of differences to v
  index_t v_ = 0;
  bool is_ready_ = false, tied_ = false;
  const Directions& nodes_;
  std::unique_ptr<Memory> memory_;
};

/// Counts in this thread since the last call. For tests and measurements.
PredicateCounts take_predicate_counts();

}  // namespace pstripack
