#pragma once
// What methods need of a triangulation: of a file's nodes, or of the arrays of a Python program.

#include <cstdint>

#include "geometry/point.h"
#include "lists/adjacency_lists.h"
#include "stripack/expressions.h"

namespace methods {

using pstripack::Point;

/// Canonical lists and their nodes, which are unit vectors and count from 1. Both live elsewhere. Where the
/// nodes were rounded to length 1 after they were triangulated, some triangles may be turned by that
/// rounding.
struct Triangulated {
  pstripack::ListsView<std::int32_t> lists;
  pstripack::Nodes<double> nodes;

  Point at(std::int32_t node) const {
    const auto i = static_cast<std::size_t>(node) - 1;
    return {nodes.x[i], nodes.y[i], nodes.z[i]};
  }
};

}  // namespace methods
