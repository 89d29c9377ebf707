#include "trmesh/trmesh.h"

#include <algorithm>
#include <optional>

#include "base/parallel_for.h"
#include "capi/pstripack.h"
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

/// Before the lists are written: where their pages are new, half of the call's time goes into page faults.
void prepare_pages_of_lists(const TrmeshCall& call) {
  const std::size_t n = static_cast<std::size_t>(call.n), bytes = sizeof(std::int32_t);
  ask_for_huge_pages(call.lists.list, (6 * n - 12) * bytes);
  ask_for_huge_pages(call.lists.lptr, (6 * n - 12) * bytes);
  ask_for_huge_pages(call.lists.lend, n * bytes);
}

/// A call carried out by one hull. `copy_` are the nodes that it takes.
class ByOneHull {
 public:
  ByOneHull(const TrmeshCall& call, ParallelCost* cost) : call_(call), cost_(cost) {}

  /// Checks the first n nodes. Returns the first (from 0) that is zero or not finite; n if there is none.
  std::size_t check(std::size_t n) {
    const PhaseTimer timer(cost_, ParallelCost::divide);
    n_ = n;
    workspace_.clear();
    copy_ = workspace_.for_phase<Point>(n);
    return call_.nodes
        .visit([&](const auto& node) {
          return check_nodes(n, threads_for(n), [&](std::size_t i) { return copy_[i] = node(i); });
        })
        .first_bad;
  }

  std::optional<Coincidence> triangulate(std::size_t n) {
    if (n != n_) check(n);
    const PhaseTimer timer(cost_, ParallelCost::triangulate);
    hull_ = delaunay(copy_, n, workspace_, call_.by_direction ? Lengths::directions : Lengths::automatic);
    CoincidentPairs pairs;
    for (const auto& [in, out] : hull_.coincident)
      pairs.emplace_back(GlobalNumber{in + 1}, GlobalNumber{out + 1});
    if (pairs.empty()) return std::nullopt;
    return first_coincidence(pairs);
  }

  void write() {
    const PhaseTimer timer(cost_, ParallelCost::lists);
    prepare_pages_of_lists(call_);
    const auto& [list, lptr, lend, lnew] = call_.lists;
    *lnew = write_lists(hull_, list, lptr, lend, workspace_);
  }

 private:
  const TrmeshCall& call_;
  ParallelCost* const cost_;
  Workspace workspace_{workspace_bytes(static_cast<std::size_t>(call_.n))};
  std::size_t n_ = 0;  ///< number of nodes checked
  Point* copy_ = nullptr;
  Hull hull_;
};

/// A call carried out by patches on the threads of this process.
class ByPatches {
 public:
  ByPatches(const TrmeshCall& call, ParallelCost* cost) : call_(call), cost_(cost) {}

  std::size_t check(std::size_t n) {
    const PhaseTimer timer(cost_, ParallelCost::divide);
    n_ = n;
    check_ = check_nodes(call_.nodes, n);
    check_.by_direction.value = call_.by_direction;
    return check_.first_bad;
  }

  std::optional<Coincidence> triangulate(std::size_t n) {
    if (n != n_) check(n);
    SingleProcess process;
    options_ = options_from_environment(n);
    options_.most_questions = n / 8;
    if (cost_ != nullptr) cost_->set_threads({options_.threads, options_.thread_limit});
    const NodeArrays& nodes = call_.nodes;
    stars_ = {};
    stars_ = pstripack::triangulate<std::int32_t>({nodes, n}, check_, {nodes[0], nodes[1], nodes[2]},
                                                  {1, 2, 3}, process, options_, cost_);
    if (stars_.coincident.empty()) return std::nullopt;
    return first_coincidence(stars_.coincident);
  }

  void write() {
    const PhaseTimer timer(cost_, ParallelCost::lists);
    prepare_pages_of_lists(call_);
    const auto& [list, lptr, lend, lnew] = call_.lists;
    write_piece(stars_.of_node, 0, list, lend, options_.threads);
    write_lptr(lend, n_, 0, lptr, options_.threads);
    *lnew = lend[n_ - 1] + 1;
  }

 private:
  const TrmeshCall& call_;
  ParallelCost* const cost_;
  std::size_t n_ = 0;  ///< number of nodes checked
  NodeCheck check_;
  ParallelOptions options_;
  Stars<std::int32_t> stars_;
};

template <class Way>
TrmeshResult cold_by(const TrmeshCall& call, ParallelCost* cost) {
  Way way(call, cost);
  const auto n = static_cast<std::size_t>(call.n), first_bad = way.check(n);
  if (first_bad < n) return {PSTRIPACK_BAD_COORDINATE, static_cast<std::int64_t>(first_bad) + 1};
  if (call.starts_anywhere) {
    if (const auto first = way.triangulate(n))
      return {static_cast<std::int32_t>(first->l), first->l, first->m};
    way.write();
    return {0};
  }
  if (left(call.nodes[0], call.nodes[1], call.nodes[2]) == 0) return {PSTRIPACK_COLLINEAR};
  return triangulate_and_write(call.n, way);
}

TrmeshResult cold(const TrmeshCall& call, CallWay* way, ParallelCost* cost, Engine* pool) {
  try {
    if (pool != nullptr && pool->takes(call)) return pool->carry_out(call, way);
  } catch (const PoolIsGone&) {
    // This process can carry out every call.
  }
  const ParallelOptions options = options_from_environment(static_cast<std::size_t>(call.n));
  if (options.patches > 1 && !call.starts_anywhere) return cold_by<ByPatches>(call, cost);
  if (cost != nullptr) cost->set_threads({1, options.thread_limit});
  const ChosenThreads one(
      1);  // the insertion uses one: it would fetch what another has sorted from its cache
  return cold_by<ByOneHull>(call, cost);
}

/// How good the lists are that the insertion has made.
OriginalOrder order_of(const NodeArrays& given, const InsertedNodes<std::int32_t>& inserted, bool bitwise) {
  BlockArray<Point> nodes(inserted.nodes);
  given.copy(0, nodes.size(), nodes.data());
  if (left(nodes[0], nodes[1], nodes[2]) != 0 &&
      is_valid(nodes.data(), inserted.view(), Lengths::automatic, Ties::either_way))
    return OriginalOrder::made;
  if (!bitwise) return OriginalOrder::wrong;
  return check_topology(inserted.view()) ? OriginalOrder::inexact : OriginalOrder::broken;
}

/// Writes the lists as the original makes them, if they are the exact mesh (result.order `made`) or, under
/// PSTRIPACK_ORDER=bitwise, at least a triangulation (`inexact`). Otherwise nothing is written.
TrmeshResult lists_in_original_order(const TrmeshCall& call, ParallelCost* cost) {
  const OriginalRules& rules = original_rules();
  {
    const PhaseTimer timer(cost, ParallelCost::divide);
    const auto n = static_cast<std::size_t>(call.n), first_bad = check_nodes(call.nodes, n).first_bad;
    if (first_bad < n) return {PSTRIPACK_BAD_COORDINATE, static_cast<std::int64_t>(first_bad) + 1};
  }
  if (!rules.bitwise && left(call.nodes[0], call.nodes[1], call.nodes[2]) == 0) return {PSTRIPACK_COLLINEAR};
  InsertedNodes<std::int32_t> inserted;
  {
    const PhaseTimer timer(cost, ParallelCost::triangulate);
    inserted = call.nodes.visit_arrays(
        [&](const auto* x, const auto* y, const auto* z) { return insert_in_order(call.n, x, y, z, rules); });
  }
  const auto [end, node, other] = inserted.outcome;
  if (end == InsertionEnd::collinear) return {0, 0, 0, OriginalOrder::collinear, node};
  if (end == InsertionEnd::endless) return {0, 0, 0, OriginalOrder::endless, node};
  TrmeshResult result{0};
  if (end == InsertionEnd::coincident) result = {static_cast<std::int32_t>(other), other, node};
  {
    const PhaseTimer timer(cost, ParallelCost::lists);
    result.order = order_of(call.nodes, inserted, rules.bitwise);
  }
  if (result.order != OriginalOrder::made && result.order != OriginalOrder::inexact) return result;
  std::copy_n(inserted.list.data(), inserted.list.size(), call.lists.list);
  std::copy_n(inserted.lptr.data(), inserted.lptr.size(), call.lists.lptr);
  std::copy_n(inserted.lend.data(), inserted.lend.size(), call.lists.lend);
  *call.lists.lnew = inserted.lnew;
  return result;
}

/// The way of a call is chosen here, in this order: the ranks of a communicator, the original's order
/// (`follow`: then this process alone), the mesh of an earlier call, the pool, threads, one hull. But for the
/// second, all write the same lists.
TrmeshResult by_best_way(const TrmeshCall& call, bool follow, CallWay* way, Engine* communicator,
                         Engine* pool) {
  if (communicator != nullptr && communicator->takes(call)) return communicator->carry_out(call, way);
  if (const std::int32_t code = code_of_count(call.n); code != PSTRIPACK_OK) return {code};

  ParallelCost* const cost = way != nullptr ? &way->cost.maximum : nullptr;
  TrmeshResult original{0};
  if (follow) {
    original = lists_in_original_order(call, cost);
    if (original.ier < 0 || original.order == OriginalOrder::made || original.order == OriginalOrder::inexact)
      return original;
  }
  WarmStart warm_start(call.nodes, static_cast<std::size_t>(call.n),
                       call.by_direction ? Confirm::directions : Confirm::nothing);
  if (warm_start.write_lists(call.lists, cost)) return {0, 0, 0, original.order, original.order_node};
  TrmeshResult result = cold(call, way, cost, pool);
  if (result.ier == 0) warm_start.remember(call.lists);
  if (result.ier >= 0) result.order = original.order, result.order_node = original.order_node;
  return result;
}

}  // namespace

TrmeshResult trmesh(const TrmeshCall& call, CallWay* way, Engine* communicator, Engine* pool) {
  const AtWork here(1);
  const bool follow = original_rules().follow && !call.by_direction;
  return by_best_way(call, follow, way, follow ? nullptr : communicator, follow ? nullptr : pool);
}

TrmeshResult canonical_trmesh(const TrmeshCall& call, CallWay* way) {
  return by_best_way(call, false, way, nullptr, nullptr);
}

}  // namespace pstripack
