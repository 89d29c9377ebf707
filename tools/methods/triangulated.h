#pragma once
// The triangulation that interpolation works on: of a file's nodes, or of arrays of a Python program.

#include <cstdint>

#include "geometry/measures.h"
#include "lists/adjacency_lists.h"
#include "stripack/expressions.h"

namespace methods {

using pstripack::Point;

/// Canonical lists of the mesh of the nodes' directions, and the nodes, with numbers from 1; not owned.
struct Triangulated {
  pstripack::ListsView<std::int32_t> lists;
  pstripack::Nodes<double> given;  ///< vectors of any length
  pstripack::Nodes<double>
      unit;  ///< unit vectors in their directions, up to rounding: for searches and filters

  Point at(std::int32_t node) const { return of(given, node); }
  Point unit_at(std::int32_t node) const { return of(unit, node); }
  pstripack::Direction direction(std::int32_t node) const { return pstripack::direction_of(at(node)); }

 private:
  static Point of(const pstripack::Nodes<double>& nodes, std::int32_t node) {
    const auto i = static_cast<std::size_t>(node) - 1;
    return {nodes.x[i], nodes.y[i], nodes.z[i]};
  }
};

}  // namespace methods
