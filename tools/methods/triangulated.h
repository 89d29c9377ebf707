#pragma once
// The triangulation that interpolation works on: of a file's nodes, or of arrays of a Python program.

#include <cstdint>

#include "geometry/point.h"
#include "lists/adjacency_lists.h"
#include "stripack/expressions.h"

namespace methods {

using pstripack::Point;

/// Canonical lists and their nodes, which are unit vectors with numbers from 1; not owned. If the nodes were
/// scaled to length 1 after triangulation, rounding may have inverted some triangles.
struct Triangulated {
  pstripack::ListsView<std::int32_t> lists;
  pstripack::Nodes<double> nodes;

  Point at(std::int32_t node) const {
    const auto i = static_cast<std::size_t>(node) - 1;
    return {nodes.x[i], nodes.y[i], nodes.z[i]};
  }
};

}  // namespace methods
