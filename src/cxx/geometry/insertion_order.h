#pragma once

#include <cstddef>
#include <cstdint>

#include "base/workspace.h"
#include "geometry/point.h"

namespace pstripack {

/// The nodes in the order of a Hilbert curve over the six faces of a cube around the sphere; cells with many
/// nodes are refined. Neighbours on the curve are neighbours on the sphere, so a search that starts at the
/// previous node is short. The order affects only speed. Accepts non-zero finite vectors of any length,
/// `stride` bytes apart; n < 2^29; `order` has n entries. Parallel. Takes 16 bytes per node of the workspace.
///
/// Nodes that stand alone come in front, in the same order; returns how many, some 256 at most. One that came
/// late would see most of what was built without it: of a circle and its pole, all triangles.
std::size_t insertion_order(const Point* points, std::size_t n, std::uint32_t* order, Workspace& workspace,
                            std::size_t stride = sizeof(Point));

}  // namespace pstripack
