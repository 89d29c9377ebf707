#pragma once
// How far a triangulation is from the exact mesh of its nodes: for reports.

#include <cstdint>

#include "geometry/node_arrays.h"
#include "lists/adjacency_lists.h"

namespace pstripack {

struct ExactDifference {
  /// TRMESH's exact answer for these nodes, where it is not 0: there is nothing to compare with then.
  std::int32_t ier = 0;
  /// Arcs that the exact mesh does not have, nor could have (four nodes exactly in one circle may have either
  /// diagonal), and that do not come with one of the boundary triangles below.
  std::int64_t arcs = 0;
  /// Triangles at the boundary that the exact mesh has and this one has not, or the reverse: the nodes on the
  /// boundary of one of them only. Where one of them covers the sphere, by how many triangles they differ.
  std::int64_t boundary_triangles = 0;
};

/// Of a triangulation of the first nodes that check_topology finds good. The nodes have directions.
/// O(n log n). Throws std::bad_alloc.
template <class Int>
ExactDifference exact_difference(const NodeArrays& nodes, const ListsView<Int>& lists);

}  // namespace pstripack
