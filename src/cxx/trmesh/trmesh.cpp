#include "trmesh/trmesh.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel_for.h"
#include "lists/adjacency_lists.h"
#include "lists/limits.h"
#include "lists/list_pieces.h"
#include "mesh/delaunay.h"
#include "parallel/coincidence.h"
#include "parallel/environment_options.h"
#include "parallel/triangulate.h"
#include "stripack/original/original_order.h"
#include "stripack/original/original_rules.h"
#include "trmesh/warm_start.h"

namespace pstripack {
namespace {

/// A call carried out by patches on the threads of this process, or by one hull.
class OnThreads {
 public:
  OnThreads(const TrmeshCall& call, bool in_original_order, ParallelCost* cost)
      : call_(call),
        cost_(cost),
        on_threads_(threads_for(static_cast<std::size_t>(call.n)) > 1),
        copied_at_once_(!on_threads_ && !in_original_order) {}

  /// Checks the first n nodes. Returns the first (from 0) that is zero or not finite; n if there is none.
  std::size_t check(std::size_t n) {
    n_ = n;
    if (copied_at_once_) {
      copy();
    } else {
      const PhaseTimer timer(cost_, ParallelCost::divide);
      check_ = check_nodes(call_.nodes, n);
    }
    check_.by_direction.value = call_.by_direction;
    return check_.first_bad;
  }

  std::optional<Coincidence> triangulate(std::size_t n) {
    if (n != n_) check(n);
    const CoincidentPairs pairs = on_threads_ ? by_patches() : by_one_hull();
    if (pairs.empty()) return std::nullopt;
    return first_coincidence(pairs);
  }

  void deliver() {
    const PhaseTimer timer(cost_, ParallelCost::lists);
    const auto& [list, lptr, lend, lnew] = call_.lists;
    if (stars_) {
      const int threads = options_.threads;
      write_piece(stars_->of_node, 0, list, lend, threads);
      write_lptr(lend, n_, 0, lptr, threads);
      *lnew = lend[n_ - 1] + 1;
    } else {
      *lnew = write_lists(hull_, list, lptr, lend, *workspace_);
    }
  }

 private:
  /// Copies the nodes, for one hull. Patches need no copy, so with threads this is done only if they fail.
  void copy() {
    const PhaseTimer timer(cost_, ParallelCost::divide);
    if (!workspace_) workspace_.emplace(workspace_bytes(n_));
    workspace_->clear();
    copy_ = workspace_->for_phase<Point>(n_);
    check_ = call_.nodes.visit([&](const auto& node) {
      return check_nodes(n_, threads_for(n_), [&](std::size_t i) { return copy_[i] = node(i); });
    });
  }

  CoincidentPairs by_patches() {
    SingleProcess process;
    options_ = options_from_environment(n_);
    options_.most_questions = n_ / 8;
    const NodeArrays& nodes = call_.nodes;
    const Point corners[3] = {nodes[0], nodes[1], nodes[2]};
    if (cost_ != nullptr) cost_->threads = options_.threads;
    stars_.reset();
    try {
      stars_ = pstripack::triangulate<std::int32_t>({nodes, n_}, check_, corners, {1, 2, 3}, process,
                                                    options_, cost_);
      return stars_->coincident;
    } catch (const PatchesDoNotPay&) {
      return by_one_hull();
    }
  }

  CoincidentPairs by_one_hull() {
    if (!copied_at_once_) copy();
    const PhaseTimer timer(cost_, ParallelCost::triangulate);
    hull_ = delaunay(copy_, n_, *workspace_, call_.by_direction ? Lengths::directions : Lengths::automatic);
    CoincidentPairs pairs;
    for (const auto& [in, out] : hull_.coincident)
      pairs.emplace_back(GlobalNumber{in + 1}, GlobalNumber{out + 1});
    return pairs;
  }

  const TrmeshCall& call_;
  ParallelCost* const cost_;
  const bool on_threads_, copied_at_once_;
  std::size_t n_ = 0;  ///< number of nodes checked by check()
  NodeCheck check_;
  ParallelOptions options_;
  std::optional<Stars<std::int32_t>> stars_;  ///< if triangulated by patches
  std::optional<Workspace> workspace_;        ///< for one hull
  Point* copy_ = nullptr;
  Hull hull_;
};

/// Writes the lists as the original makes them, if they are the exact mesh (result.order `made`) or, under
/// PSTRIPACK_ORDER=bitwise, at least a triangulation (`inexact`). Otherwise nothing is written.
TrmeshResult lists_in_original_order(const TrmeshCall& call, ParallelCost* cost) {
  const OriginalRules& rules = original_rules();
  const Seeds<std::int32_t> seeds = seeds_of_thread();
  InsertedNodes<std::int32_t> inserted;
  const auto insert = [&](Hopeless hopeless, StartSearch start_search) {
    const PhaseTimer timer(cost, ParallelCost::triangulate);
    inserted = {};
    inserted = call.nodes.visit_arrays([&](const auto* x, const auto* y, const auto* z) {
      return insert_in_order(call.n, x, y, z, rules, hopeless, start_search);
    });
  };
  /// The result of the insertion: its order is `good` if are_good(), else `bad`, collinear or endless.
  const auto outcome = [&](OriginalOrder good, OriginalOrder bad, const auto& are_good) -> TrmeshResult {
    const auto [end, node, other] = inserted.outcome;
    if (end == InsertionEnd::collinear) return {0, 0, 0, OriginalOrder::collinear, node};
    if (end == InsertionEnd::endless) return {0, 0, 0, OriginalOrder::endless, node};
    const PhaseTimer timer(cost, ParallelCost::lists);
    if (end == InsertionEnd::hopeless || !are_good()) return {0, 0, 0, bad};
    if (end == InsertionEnd::coincident) return {static_cast<std::int32_t>(other), other, node, good};
    return {0, 0, 0, good};
  };

  insert(Hopeless::ends, StartSearch::adaptive);
  TrmeshResult result = outcome(OriginalOrder::made, OriginalOrder::wrong, [&] {
    BlockArray<Point> nodes(static_cast<std::size_t>(call.n));
    call.nodes.copy(0, nodes.size(), nodes.data());
    return left(nodes[0], nodes[1], nodes[2]) != 0 &&
           is_valid(nodes.data(), inserted.view(), Lengths::automatic, Ties::either_way);
  });
  if (rules.bitwise && result.order != OriginalOrder::made) {
    // Repeat to the end, by the original's bookkeeping alone: locating nodes is valid only while the
    // triangulation is correct.
    seeds_of_thread() = seeds;
    insert(Hopeless::goes_on, StartSearch::simulated);
    result = outcome(OriginalOrder::inexact, OriginalOrder::broken,
                     [&] { return static_cast<bool>(check_topology(inserted.view())); });
  }
  if (result.order != OriginalOrder::made && result.order != OriginalOrder::inexact) return result;
  std::copy_n(inserted.list.data(), inserted.list.size(), call.lists.list);
  std::copy_n(inserted.lptr.data(), inserted.lptr.size(), call.lists.lptr);
  std::copy_n(inserted.lend.data(), inserted.lend.size(), call.lists.lend);
  *call.lists.lnew = inserted.lnew;
  return result;
}

/// follow: first try the original's order of insertion, as original_rules() say.
TrmeshResult carry_out(const TrmeshCall& call, bool follow, ParallelCost* cost) {
  if (call.n < 3) return {-1};
  if (call.n > most_nodes<std::int32_t>()) return {-4};

  const auto n = static_cast<std::size_t>(call.n);
  std::optional<WarmStart> warm_start;
  if (!follow) {
    warm_start.emplace(call.nodes, n, call.by_direction ? Confirm::directions : Confirm::nothing);
    if (warm_start->write_lists(call.lists, cost)) return {0};
  }
  OnThreads way(call, follow, cost);
  const std::size_t first_bad = way.check(n);
  if (first_bad < n) return {-5, static_cast<std::int64_t>(first_bad) + 1};
  const bool are_collinear = left(call.nodes[0], call.nodes[1], call.nodes[2]) == 0;

  TrmeshResult original{0};
  if (follow && !call.by_direction && (!are_collinear || original_rules().bitwise)) {
    original = lists_in_original_order(call, cost);
    if (original.order == OriginalOrder::made || original.order == OriginalOrder::inexact) return original;
  }
  if (are_collinear) return {-2};
  TrmeshResult result = triangulate_and_deliver(call.n, way);
  if (warm_start && result.ier == 0) warm_start->remember(call.lists);
  result.order = original.order;
  result.order_node = original.order_node;
  return result;
}

}  // namespace

TrmeshResult trmesh(const TrmeshCall& call, ParallelCost* cost) {
  return carry_out(call, original_rules().follow, cost);
}

TrmeshResult canonical_trmesh(const TrmeshCall& call, ParallelCost* cost) {
  return carry_out(call, false, cost);
}

}  // namespace pstripack
