#pragma once

#include <limits>

namespace pstripack {

/// The largest number of nodes whose lists fit: LNEW <= 6n-11.
template <class Int>
constexpr Int most_nodes() {
  return (std::numeric_limits<Int>::max() - 1) / 6 + 2;
}

}  // namespace pstripack
