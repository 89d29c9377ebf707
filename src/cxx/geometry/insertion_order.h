#pragma once

#include <cstddef>
#include <cstdint>

#include "base/workspace.h"
#include "geometry/point.h"

namespace pstripack {

/// The nodes in the order of a Hilbert curve over the six faces of a cube around the sphere; where many
/// nodes share one cell, the curve is refined inside it. Neighbours on the curve are neighbours on the
/// sphere, so that a search that starts where the last one ended is short. It concerns speed only: any
/// order gives the same triangulation. Non-zero finite vectors of any length, `stride` bytes apart;
/// n < 2^29; `order` has n entries. Parallel. Takes 16 bytes a node of the workspace.
void insertion_order(const Point* points, std::size_t n, std::uint32_t* order, Workspace& workspace,
                     std::size_t stride = sizeof(Point));

}  // namespace pstripack
