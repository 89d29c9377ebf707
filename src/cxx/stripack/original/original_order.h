#pragma once

#include <cstddef>
#include <cstdint>

#include "base/workspace.h"
#include "lists/adjacency_lists.h"
#include "stripack/original/original_rules.h"
#include "stripack/original/start_nodes.h"

namespace pstripack {

enum class InsertionEnd {
  complete,    ///< all nodes are inserted
  coincident,  ///< `node` coincides with `other`: nodes 1..node-1 are inserted
  collinear,   ///< the original's IER = -2: by its tests `node` is collinear with every visible boundary edge
  endless      ///< the original's search for `node`, or the swaps around it, do not end
};

struct InsertionOutcome {
  InsertionEnd end = InsertionEnd::complete;
  std::int64_t node = 0, other = 0;
};

/// Lists as the original's TRMESH makes them; empty unless the insertion was complete or met a coincident
/// node.
template <class Int>
struct InsertedNodes {
  InsertionOutcome outcome;
  std::size_t nodes = 0;           ///< number of nodes in the lists
  BlockArray<Int> list{}, lptr{};  ///< LNEW-1 slots
  BlockArray<Int> lend{};
  Int lnew = 0;

  ListsView<Int> view() const { return {nodes, list.data(), lptr.data(), lend.data(), lnew}; }
};

/// Renka's TRMESH (ACM TOMS 23 (1997), Algorithm 772): inserts node by node, with its rounded tests, so the
/// result may be wrong. n >= 3. Runs on one thread and uses its seeds_of_thread; O(n) memory. Throws
/// std::bad_alloc.
template <class Real, class Int>
InsertedNodes<Int> insert_in_order(Int n, const Real* x, const Real* y, const Real* z,
                                   const OriginalRules& rules);

}  // namespace pstripack
