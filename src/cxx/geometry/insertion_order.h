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
/// Isolated nodes, about 256 at most, come first, in the order of the curve; returns their number. If an
/// isolated node came late it would see most of the hull built before: the pole of a circle would see all
/// its triangles.
std::size_t insertion_order(const Point* points, std::size_t n, std::uint32_t* order, Workspace& workspace,
                            std::size_t stride = sizeof(Point));

}  // namespace pstripack
