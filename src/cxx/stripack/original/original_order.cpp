#include "stripack/original/original_order.h"

#include <algorithm>

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

  InsertionOutcome insert_all() {
    const Real d = side(lists_[1], lists_[2], lists_[3]);
    if (d == 0) return {InsertionEnd::collinear, 3};
    lists_.start(d > 0);

    WaitingNodes<Real, Int> waiting(n_, lists_);
    for (Int k = 4; k <= n_; ++k) {
      prefetch(k, waiting);
      if (const InsertionOutcome outcome = insert(k, waiting.near(k)); outcome.end != InsertionEnd::complete)
        return outcome;
      waiting.compare_with(k);
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

  const Int n_;
  const OriginalRules& rules_;
  InsertionLists<Real, Int> lists_;
};

}  // namespace

template <class Real, class Int>
InsertedNodes<Int> insert_in_order(Int n, const Real* x, const Real* y, const Real* z,
                                   const OriginalRules& rules) {
  Insertion<Real, Int> insertion(n, x, y, z, rules);
  InsertedNodes<Int> result;
  result.outcome = insertion.insert_all();
  const InsertionEnd end = result.outcome.end;
  if (end == InsertionEnd::complete || end == InsertionEnd::coincident) insertion.write(result);
  return result;
}

#define PSTRIPACK_ORIGINAL_ORDER(Real, Int)                                               \
  template InsertedNodes<Int> insert_in_order(Int, const Real*, const Real*, const Real*, \
                                              const OriginalRules&);
PSTRIPACK_ORIGINAL_ORDER(float, std::int32_t)
PSTRIPACK_ORIGINAL_ORDER(double, std::int32_t)

}  // namespace pstripack
