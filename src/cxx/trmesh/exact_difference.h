#pragma once
// How much a triangulation differs from the exact mesh of its nodes, for reports.

#include <cstdint>

#include "geometry/node_arrays.h"
#include "lists/adjacency_lists.h"

namespace pstripack {

struct ExactDifference {
  /// TRMESH's exact IER for these nodes; if it is not 0, there is no exact mesh to compare with.
  std::int32_t ier = 0;
  /// Number of arcs that are not in the exact mesh. Excludes diagonals of four exactly cocircular nodes,
  /// both of which are correct, and arcs of the boundary triangles counted below.
  std::int64_t arcs = 0;
  /// Number of boundary triangles in only one of the two meshes, counted by the nodes on the boundary of only
  /// one. If one mesh covers the sphere: the difference in the number of triangles.
  std::int64_t boundary_triangles = 0;
};

/// Compares a triangulation of the first lists.n nodes with the exact mesh. check_topology must accept the
/// lists, and the nodes must be finite and non-zero. O(n log n). Throws std::bad_alloc.
ExactDifference exact_difference(const NodeArrays& nodes, const ListsView<std::int32_t>& lists);

}  // namespace pstripack
