#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "geometry/parallel_for.h"
#include "geometry/point.h"

namespace pstripack {

/// Copies the coordinates of n nodes; returns the first (from 0) that has no direction, n if all have one.
/// Parallel. Throws std::bad_alloc.
template <class Real>
std::size_t copy_nodes(std::size_t n, const Real* x, const Real* y, const Real* z, Point* p) {
  std::vector<std::size_t> bad(static_cast<std::size_t>(threads_for(n)), n);
  parallel_pieces(n, static_cast<int>(bad.size()), [&](std::size_t first, std::size_t last, int piece) {
    for (std::size_t i = last; i-- > first;) {
      p[i] = {static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
      if (!has_direction(p[i])) bad[static_cast<std::size_t>(piece)] = i;
    }
  });
  return *std::min_element(bad.begin(), bad.end());
}

}  // namespace pstripack
