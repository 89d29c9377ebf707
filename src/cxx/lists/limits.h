#pragma once

#include <cstdint>
#include <limits>

#include "capi/pstripack.h"

namespace pstripack {

/// The largest n for which LNEW, at most 6n-11, fits Int.
template <class Int>
constexpr Int most_nodes() {
  return (std::numeric_limits<Int>::max() - 1) / 6 + 2;
}

/// The code of TRMESH for n nodes.
constexpr std::int32_t code_of_count(std::int32_t n) {
  if (n < 3) return PSTRIPACK_TOO_FEW_NODES;
  return n > most_nodes<std::int32_t>() ? PSTRIPACK_TOO_MANY_NODES : PSTRIPACK_OK;
}

}  // namespace pstripack
