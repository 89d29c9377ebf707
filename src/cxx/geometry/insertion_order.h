#pragma once

#include <cstddef>
#include <cstdint>

#include "geometry/point.h"
#include "geometry/workspace.h"

namespace pstripack {

/// The nodes in the order of a Hilbert curve over the six faces of a cube around the sphere; where many
/// nodes share one cell, the curve is refined inside it. Neighbours on the curve are neighbours on the
/// sphere, so that a search that starts where the last one ended is short. It concerns speed only: any
/// order gives the same triangulation. Non-zero finite vectors of any length; n < 2^29. Parallel.
/// Keeps 4 bytes a node of the workspace, the result, and takes 16.
std::uint32_t* insertion_order(const Point* points, std::size_t n, Workspace& workspace);

}  // namespace pstripack
