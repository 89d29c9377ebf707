#pragma once

#include <cstddef>

#include "parallel/local_nodes.h"

namespace pstripack {

/// Copies the coordinates of n nodes, and looks at them.
template <class Real>
Look copy_nodes(std::size_t n, const Real* x, const Real* y, const Real* z, Point* p) {
  return look_at(n, threads_for(n), [=](std::size_t i) {
    return p[i] = {static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
  });
}

}  // namespace pstripack
