#pragma once

#include <cstddef>
#include <cstdint>

#include "base/workspace.h"
#include "geometry/point.h"

namespace pstripack {

/// Writes to order[0..n-1] the nodes in the order of a Hilbert curve over the six faces of a cube around
/// the sphere; cells with many nodes are refined. Neighbours on the curve are neighbours on the sphere, so
/// a search that starts at the previous node is short. The order affects only speed. Accepts non-zero
/// finite vectors of any length, `stride` bytes apart; n < 2^29. Parallel. Takes 16 bytes per node of the
/// workspace.
///
/// Nodes that would see most of the hull built before if they came late come first; returns their number:
///   - isolated nodes, about 256 at most, in the order of the curve: the pole of a circle sees all triangles
///     of that circle;
///   - the node of highest rank (predicates.h, tie rule): all triangles of nodes on one circle have it as a
///     corner. Late, every node on the way to it would have them all for a while.
std::size_t insertion_order(const Point* points, std::size_t n, std::uint32_t* order, Workspace& workspace,
                            std::size_t stride = sizeof(Point));

}  // namespace pstripack
