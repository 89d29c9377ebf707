#pragma once

#include <cstdint>

#include "parallel/cost.h"
#include "trmesh/call.h"

namespace pstripack {

/// Outcome of PSTRIPACK_ORDER. The lists are canonical except for `made` and `inexact`.
enum class OriginalOrder {
  not_asked,
  made,       ///< the original's lists, of the exact mesh
  inexact,    ///< PSTRIPACK_ORDER=bitwise: the original's lists, possibly not of the exact mesh
  collinear,  ///< by the original's rounded tests a node is collinear with every visible boundary edge
  endless,    ///< the original's search for a node does not end
  wrong,      ///< the original's triangulation is not Delaunay, by exact signs
  broken      ///< PSTRIPACK_ORDER=bitwise: the original's lists are no triangulation
};

/// TRMESH's result. `node` and `other`: the nodes (from 1) that the code is about; 0 if none. Of -7: N of the
/// first rank that differs from rank 0, and that rank.
struct TrmeshResult {
  std::int32_t ier;
  std::int64_t node = 0, other = 0;
  OriginalOrder order = OriginalOrder::not_asked;
  std::int64_t order_node = 0;  ///< the node of `collinear` or `endless`
};

/// STRIPACK's TRMESH with canonical lists and exact decisions (docs/differences.md). IER is 0, -1, -2, L > 0,
/// -4 or -5 (docs/ier.md). On a negative code nothing is written. Under PSTRIPACK_ORDER=original
/// (original_rules.h) nodes are inserted one by one on the calling thread, and the lists are the original's
/// if these are a correct triangulation; four nodes on one circle may then have either diagonal. Under
/// PSTRIPACK_ORDER=bitwise lists and IER are the original's if its IER is not negative and its lists are a
/// triangulation, correct or not. Parallel. Throws std::bad_alloc, having written nothing. What the call
/// cost is added to `cost`, if given.
TrmeshResult trmesh(const TrmeshCall& call, ParallelCost* cost = nullptr);
/// The same, always with canonical lists, whatever PSTRIPACK_ORDER is.
TrmeshResult canonical_trmesh(const TrmeshCall& call, ParallelCost* cost = nullptr);

/// The common path of every way to carry out a call: by one hull, on threads, by ranks. A Way has
///   std::optional<Coincidence> triangulate(std::size_t n)  of the first n nodes; the first coincidence
///   void deliver()                                         writes the lists of the last triangulation
/// If nodes L and M > L coincide, M the smallest such, the lists are those of nodes 1..M-1.
template <class Way>
TrmeshResult triangulate_and_deliver(std::int32_t n, Way& way) {
  TrmeshResult result{0};
  if (const auto first = way.triangulate(static_cast<std::size_t>(n))) {
    result = {static_cast<std::int32_t>(first->l), first->l, first->m};
    // Nodes 1..M-1 do not coincide, and the first three are not on one great circle: M > 3.
    way.triangulate(static_cast<std::size_t>(first->m) - 1);
  }
  way.deliver();
  return result;
}

}  // namespace pstripack
