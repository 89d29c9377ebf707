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
};

}  // namespace pstripack
