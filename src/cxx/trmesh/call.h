#pragma once

#include <cstdint>

#include "geometry/node_arrays.h"

namespace pstripack {

/// The caller's arrays for STRIPACK's lists. list, lptr: at least 6n-12 entries; lend: n entries.
struct ListArrays {
  std::int32_t *list = nullptr, *lptr = nullptr, *lend = nullptr, *lnew = nullptr;
};

/// One call of TRMESH: n nodes in either precision, and where their lists go.
struct TrmeshCall {
  std::int32_t n = 0;
  NodeArrays nodes;
  ListArrays lists;
  bool by_direction = false;  ///< the mesh of the directions, whatever the lengths
  /// The first three nodes may lie on one great circle. If all do, std::domain_error is thrown; if two
  /// coincide, no lists are written.
  bool starts_anywhere = false;
};

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
  bool is_silent = false;       ///< another rank reports the call, and prints the line of a new code
};

}  // namespace pstripack
