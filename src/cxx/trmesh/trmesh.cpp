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
#include "parallel/options.h"
#include "parallel/triangulate.h"
#include "stripack/original/original_order.h"
#include "stripack/original/original_rules.h"

namespace pstripack {
namespace {

/// The lists by patches on the threads of this process. Returns the pairs of nodes that coincide, or none and
/// has written the lists; nothing if the nodes lie so that patches do not pay.
template <class Int>
std::optional<CoincidentPairs> lists_on_threads(const NodeArrays& nodes, std::size_t n, const Look& look,
                                                Int* list, Int* lptr, Int* lend, Int* lnew,
                                                ParallelCost* cost) {
  SingleProcess process;
  ParallelOptions options = options_from_environment(n);
  options.most_questions = n / 8;
  const Point corners[3] = {nodes[0], nodes[1], nodes[2]};
  const Stars<Int> stars = triangulate<Int>({nodes, n}, look, corners, {1, 2, 3}, process, options, cost);
  if (cost != nullptr) cost->threads = options.threads;
  if (stars.gave_up) return std::nullopt;
  if (stars.coincident.empty()) {
    const PhaseTimer timer(cost, ParallelCost::lists);
    write_piece(stars.of_node, 0, list, lend, options.threads);
    write_lptr(lend, n, 0, lptr, options.threads);
    *lnew = lend[n - 1] + 1;
  }
  return stars.coincident;
}

/// The same by one hull of all nodes p, which lie in `workspace`.
template <class Int>
CoincidentPairs lists_of_one_hull(const Point* p, std::size_t n, Workspace& workspace, Int* list, Int* lptr,
                                  Int* lend, Int* lnew, ParallelCost* cost) {
  const Hull hull = [&] {
    const PhaseTimer timer(cost, ParallelCost::triangulate);
    return delaunay(p, n, workspace);
  }();
  CoincidentPairs pairs;
  for (const auto& [in, out] : hull.coincident) pairs.emplace_back(in + 1, out + 1);
  if (pairs.empty()) {
    const PhaseTimer timer(cost, ParallelCost::lists);
    *lnew = write_lists(hull, list, lptr, lend, workspace);
  }
  return pairs;
}

/// The lists as the original makes them, if they are right or, under PSTRIPACK_ORDER=bitwise, a triangulation
/// at all: a result with the order `made` or `inexact`. Otherwise nothing is written.
template <class Real, class Int>
TrmeshResult lists_in_original_order(Int n, const Real* x, const Real* y, const Real* z, Int* list, Int* lptr,
                                     Int* lend, Int* lnew, ParallelCost* cost) {
  const OriginalRules& rules = original_rules();
  const Seeds<std::int32_t> seeds = kept_seeds();
  InsertedNodes<Int> inserted;
  const auto insert = [&](Hopeless hopeless, StartSearch start_search) {
    const PhaseTimer timer(cost, ParallelCost::triangulate);
    inserted = {};
    inserted = insert_in_order(n, x, y, z, rules, hopeless, start_search);
  };
  /// What became of the insertion; `good` if the lists are.
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
    const NodeArrays arrays(x, y, z);
    BlockArray<Point> nodes(static_cast<std::size_t>(n));
    arrays.points(0, nodes.size(), nodes.data());
    return left(nodes[0], nodes[1], nodes[2]) != 0 &&
           is_valid(nodes.data(), inserted.view(), Lengths::automatic, Ties::either_way);
  });
  if (rules.bitwise && result.order != OriginalOrder::made) {
    // Again, to the end and by the original's bookkeeping alone: nodes are located only where the
    // triangulation is right.
    kept_seeds() = seeds;
    insert(Hopeless::goes_on, StartSearch::simulated);
    result = outcome(OriginalOrder::inexact, OriginalOrder::broken,
                     [&] { return static_cast<bool>(check_topology(inserted.view())); });
  }
  if (result.order != OriginalOrder::made && result.order != OriginalOrder::inexact) return result;
  std::copy_n(inserted.list.data(), inserted.list.size(), list);
  std::copy_n(inserted.lptr.data(), inserted.lptr.size(), lptr);
  std::copy_n(inserted.lend.data(), inserted.lend.size(), lend);
  *lnew = inserted.lnew;
  return result;
}

}  // namespace

template <class Real, class Int>
TrmeshResult trmesh(Int n, const Real* x, const Real* y, const Real* z, Int* list, Int* lptr, Int* lend,
                    Int* lnew, ParallelCost* cost) {
  if (n < 3) return {-1};
  if (n > most_nodes<Int>()) return {-4};

  auto nodes = static_cast<std::size_t>(n);
  const NodeArrays arrays(x, y, z);
  const bool on_threads = threads_for(nodes) > 1, in_original_order = original_rules().follow;
  // One hull has a copy of the nodes. It is made at once, unless they may be triangulated without.
  const bool copied_at_once = !on_threads && !in_original_order;
  std::optional<Workspace> workspace;
  Point* p = nullptr;
  Look look;
  const auto look_at_them = [&] {
    const PhaseTimer timer(cost, ParallelCost::divide);
    look = look_at(arrays, nodes);
  };
  const auto copy_them = [&] {
    const PhaseTimer timer(cost, ParallelCost::divide);
    if (!workspace) workspace.emplace(workspace_bytes(nodes));
    workspace->clear();
    p = workspace->take<Point>(nodes);
    look = arrays.visit([&](const auto& node) {
      return look_at(nodes, threads_for(nodes), [&](std::size_t i) { return p[i] = node(i); });
    });
  };
  const auto take_them = [&] { copied_at_once ? copy_them() : look_at_them(); };
  take_them();
  if (look.first_bad < nodes) return {-5, static_cast<std::int64_t>(look.first_bad) + 1};
  const bool are_collinear = left(arrays[0], arrays[1], arrays[2]) == 0;

  TrmeshResult result{0};
  if (in_original_order && (!are_collinear || original_rules().bitwise)) {
    result = lists_in_original_order(n, x, y, z, list, lptr, lend, lnew, cost);
    if (result.order == OriginalOrder::made || result.order == OriginalOrder::inexact) return result;
  }
  if (are_collinear) return {-2};

  // Writes the lists of the first `nodes` nodes, or returns sets of nodes that coincide.
  const auto triangulate_them = [&] {
    if (on_threads)
      if (const auto pairs = lists_on_threads(arrays, nodes, look, list, lptr, lend, lnew, cost))
        return *pairs;
    if (!copied_at_once) copy_them();
    return lists_of_one_hull(p, nodes, *workspace, list, lptr, lend, lnew, cost);
  };
  const CoincidentPairs pairs = triangulate_them();
  if (pairs.empty()) return result;
  // Nodes 1..M-1 do not coincide, and the first three are not on one great circle: M > 3.
  const Coincidence first = first_coincidence(pairs);
  nodes = static_cast<std::size_t>(first.m) - 1;
  take_them();
  triangulate_them();
  result.ier = static_cast<std::int32_t>(first.l);
  result.node = first.l;
  result.other = first.m;
  return result;
}

template TrmeshResult trmesh(std::int32_t, const double*, const double*, const double*, std::int32_t*,
                             std::int32_t*, std::int32_t*, std::int32_t*, ParallelCost*);
template TrmeshResult trmesh(std::int32_t, const float*, const float*, const float*, std::int32_t*,
                             std::int32_t*, std::int32_t*, std::int32_t*, ParallelCost*);

}  // namespace pstripack
