#pragma once

#include <limits>

namespace pstripack {

/// The largest n for which LNEW, at most 6n-11, fits Int.
template <class Int>
constexpr Int most_nodes() {
  return (std::numeric_limits<Int>::max() - 1) / 6 + 2;
}

}  // namespace pstripack
