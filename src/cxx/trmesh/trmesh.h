#pragma once

#include <cstdint>

#include "parallel/cost.h"

namespace pstripack {

/// What became of PSTRIPACK_ORDER. The lists are canonical but for `made` and `inexact`.
enum class OriginalOrder {
  not_asked,
  made,       ///< the original's lists, of the exact mesh
  inexact,    ///< PSTRIPACK_ORDER=bitwise: the original's lists, not or perhaps not of the exact mesh
  collinear,  ///< to the original's rounded tests a node lies in line with all others that it can see
  endless,    ///< the original's search for a node does not end
  wrong,      ///< the original's triangulation is not Delaunay, by exact signs
  broken      ///< PSTRIPACK_ORDER=bitwise: the original's lists are no triangulation
};

/// TRMESH's answer. `node` and `other` are the nodes (from 1) a code is about, 0 where it is about none.
struct TrmeshResult {
  std::int32_t ier;
  std::int64_t node = 0, other = 0;
  OriginalOrder order = OriginalOrder::not_asked;
  std::int64_t order_node = 0;  ///< the node that is in line, or searched for
};

/// STRIPACK's TRMESH (stripack-interface 3.6) with the promises of the interface contract, section 4:
/// canonical lists, exact decisions, IER 0, -1, -2, L > 0, -4, -5. On a negative code nothing is written.
/// Under PSTRIPACK_ORDER=original (original_rules.h) the lists are the original's, by inserting node by node
/// on the calling thread, wherever they are a correct triangulation; four nodes in one circle may then have
/// either diagonal. Under PSTRIPACK_ORDER=bitwise lists and IER are the original's wherever its IER is not
/// negative and its lists are a triangulation, right or not. x, y, z: n components each; list, lptr: at least
/// 6n-12 entries; lend: n. Throws std::bad_alloc, having written nothing. Real is float or double, Int
/// std::int32_t. `cost`, if given, is added to.
template <class Real, class Int>
TrmeshResult trmesh(Int n, const Real* x, const Real* y, const Real* z, Int* list, Int* lptr, Int* lend,
                    Int* lnew, ParallelCost* cost = nullptr);

}  // namespace pstripack
