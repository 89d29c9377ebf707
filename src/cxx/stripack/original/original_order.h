#pragma once

#include <cstddef>
#include <cstdint>

#include "base/workspace.h"
#include "lists/adjacency_lists.h"
#include "stripack/original/original_rules.h"
#include "stripack/original/start_nodes.h"

namespace pstripack {

/// How the insertion of the nodes ended.
enum class InsertionEnd {
  complete,    ///< all are in
  coincident,  ///< `node` coincides with `other`: nodes 1..node-1 are in
  collinear,   ///< the original's IER = -2: node 3 or a later one lies in line with all that it sees
  endless,     ///< the original's search for `node`, or the swaps round it, do not end
  hopeless     ///< with nodes 1..`node` in there is an arc that is not Delaunay, and that will stay
};

struct InsertionOutcome {
  InsertionEnd end = InsertionEnd::complete;
  std::int64_t node = 0, other = 0;
};

/// Lists as the original's TRMESH makes them; empty where the insertion neither was complete nor met a node
/// that coincides.
template <class Int>
struct InsertedNodes {
  InsertionOutcome outcome;
  std::size_t nodes = 0;           ///< that are in the lists
  BlockArray<Int> list{}, lptr{};  ///< LNEW-1 slots
  BlockArray<Int> lend{};
  Int lnew = 0;

  ListsView<Int> view() const { return {nodes, list.data(), lptr.data(), lend.data(), lnew}; }
};

/// Whether to go on with a triangulation that cannot become right.
enum class Hopeless { goes_on, ends };

/// Renka's TRMESH (Algorithm 772): inserts node by node, with the tests as he rounds them. n >= 3. Nothing is
/// said about whether the result is right. One thread, with its kept_seeds; O(n) memory. Throws
/// std::bad_alloc.
template <class Real, class Int>
InsertedNodes<Int> insert_in_order(Int n, const Real* x, const Real* y, const Real* z,
                                   const OriginalRules& rules, Hopeless hopeless = Hopeless::goes_on,
                                   StartSearch start_search = StartSearch::adaptive);

}  // namespace pstripack
