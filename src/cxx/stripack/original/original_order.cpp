#include "stripack/original/original_order.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/predicates.h"
#include "stripack/original/insertion_lists.h"
#include "stripack/random.h"
#include "stripack/trfind_walk.h"

namespace pstripack {
namespace {

/// Inserts node after node into the lists, until all are in or one cannot be inserted.
template <class Real, class Int>
class Insertion {
 public:
  Insertion(Int n, const Real* x, const Real* y, const Real* z, const OriginalRules& rules)
      : n_(n), rules_(rules), lists_(n) {
    const Nodes<Real> nodes{x, y, z};
    for (Int k = 1; k <= n; ++k) lists_.place(k, nodes[k]);
  }

  InsertionOutcome insert_all(Hopeless hopeless) {
    const Real d = side(lists_[1], lists_[2], lists_[3]);
    if (d == 0) return {InsertionEnd::collinear, 3};
    lists_.start(d > 0);

    WaitingNodes<Real, Int> waiting(n_, lists_);
    std::int64_t next_look = hopeless == Hopeless::ends ? 1000 : n_;
    for (Int k = 4; k <= n_; ++k) {
      prefetch(k, waiting);
      if (const InsertionOutcome outcome = insert(k, waiting.near(k)); outcome.end != InsertionEnd::complete)
        return outcome;
      waiting.compare_with(k);
      if (k == next_look && k < n_) {
        if (is_hopeless()) return {InsertionEnd::hopeless, k};
        next_look *= 8;
      }
    }
    return {};
  }

  void write(InsertedNodes<Int>& to) const {
    to.nodes = static_cast<std::size_t>(lists_.size());
    to.list = BlockArray<Int>(lists_.slots());
    to.lptr = BlockArray<Int>(lists_.slots());
    to.lend = BlockArray<Int>(to.nodes);
    lists_.write(to.list.data(), to.lptr.data(), to.lend.data());
    to.lnew = static_cast<Int>(lists_.slots()) + 1;
  }

 private:
  /// In random order all data for the insertion of a node are far apart in memory. Always inlined: GCC 12
  /// otherwise considers these functions free of side effects and drops the calls.
  [[gnu::always_inline]] void prefetch(Int k, const WaitingNodes<Real, Int>& waiting) const {
    constexpr Int kNode = 12, kList = 6, kWaiting = 3;
    if (k + kNode > n_) return;
    lists_.prefetch(waiting.near(k + kNode));
    lists_.prefetch_list(waiting.near(k + kList));
    waiting.prefetch(k + kWaiting);
  }

  /// ADDNOD.
  InsertionOutcome insert(Int k, Int start) {
    const Vector<Real> p = lists_[k];
    Seeds<std::int32_t>& seeds = seeds_of_thread();
    const auto draw = [&](Int size) { return std::min(size, rules_.random<Real>(size, seeds)); };
    Real b1, b2, b3;
    TrfindWalk<Real, Int, InsertionLists<Real, Int>, decltype(draw)> walk(
        p, lists_, rules_.tolerance<Real>(), SearchLimits::to_follow(lists_.size()), {b1, b2, b3}, draw);
    Location<Int> found;
    if (!walk.find(start, found)) return {InsertionEnd::endless, k};
    const auto [a, b, c] = found;
    if (a == 0) return {InsertionEnd::collinear, k};
    if (c != 0) {
      for (const Int node : {a, b, c})
        if (coincide(lists_[node], p)) return {InsertionEnd::coincident, k, node};
      lists_.insert_inside(lists_.twin(walk.slot_found()));
    } else if (a != b) {
      lists_.insert_outside(a, b);
    } else {
      lists_.cover(a);
    }
    return lists_.restore_delaunay() ? InsertionOutcome{} : InsertionOutcome{InsertionEnd::endless, k};
  }

  // ---- is the triangulation already wrong for good? (usual for grids) ----

  Point point(Int node) const { return as_point(lists_[node]); }

  /// True if a wrong arc is found that will stay. The four nodes of a grid cell are cocircular up to
  /// rounding, so rounded tests choose the wrong diagonal in some cells.
  bool is_hopeless() const {
    int tries = 20;
    for (Int a = 1; a <= lists_.size(); ++a) {
      const Int last = lists_.last_slot(a);
      Int slot = last;
      do {
        const Int before = lists_.neighbour(slot);
        slot = lists_.next(slot);
        const Int b = lists_.neighbour(slot), c = lists_.neighbour(lists_.next(slot));
        const bool has_two_sides = lists_.entry(last) > 0 || (slot != last && slot != lists_.next(last));
        if (a > b || !has_two_sides || orientation(point(a), point(b), point(c), point(before)) <= 0)
          continue;
        if (is_lasting_fault(a, b, c, before)) return true;
        if (--tries == 0) return false;
      } while (slot != last);
    }
    return false;
  }

  /// True if the arc a-b of the triangles (a,b,c) and (b,a,d) is wrong by exact signs, and will stay. It
  /// stays if all other nodes are so far outside the circumscribed caps of both triangles that rounded tests
  /// agree: then no search ends in these triangles, and no swap begins there.
  bool is_lasting_fault(Int a, Int b, Int c, Int d) const {
    return orientation_of_directions(point(a), point(b), point(c), point(d)) > 0 && stays(a, b, c, d) &&
           stays(b, a, d, c);
  }
  bool stays(Int a, Int b, Int c, Int d) const {
    const Point p = point(a), e = minus(point(b), p), f = minus(point(c), p), normal = cross(e, f);
    // Each test is a determinant of three differences from a corner of the triangle. Two of them are no
    // longer than its sides, so the permanent is at most 6 side^2 reach, and the error 9u of it
    // (predicates.cpp). Four times that leaves room for our own rounding.
    constexpr double u = std::numeric_limits<Real>::epsilon() / 2;
    const double side_2 = 2 * (dot(e, e) + dot(f, f)), side = std::sqrt(side_2);
    for (Int i = 1; i <= n_; ++i) {
      if (i == a || i == b || i == c || i == d) continue;
      const Point g = minus(point(i), p);
      const double reach = std::sqrt(dot(g, g)) + side;
      if (!(dot(normal, g) < -4 * 9 * u * 6 * side_2 * reach)) return false;
    }
    return true;
  }

  const Int n_;
  const OriginalRules& rules_;
  InsertionLists<Real, Int> lists_;
};

}  // namespace

template <class Real, class Int>
InsertedNodes<Int> insert_in_order(Int n, const Real* x, const Real* y, const Real* z,
                                   const OriginalRules& rules, Hopeless hopeless) {
  Insertion<Real, Int> insertion(n, x, y, z, rules);
  InsertedNodes<Int> result;
  result.outcome = insertion.insert_all(hopeless);
  const InsertionEnd end = result.outcome.end;
  if (end == InsertionEnd::complete || end == InsertionEnd::coincident) insertion.write(result);
  return result;
}

#define PSTRIPACK_ORIGINAL_ORDER(Real, Int)                                               \
  template InsertedNodes<Int> insert_in_order(Int, const Real*, const Real*, const Real*, \
                                              const OriginalRules&, Hopeless);
PSTRIPACK_ORIGINAL_ORDER(float, std::int32_t)
PSTRIPACK_ORIGINAL_ORDER(double, std::int32_t)

}  // namespace pstripack
