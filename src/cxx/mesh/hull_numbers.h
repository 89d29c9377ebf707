#pragma once
// Numbers within one hull. Each means nothing in another hull, and none is a node number of the caller.

#include <cstdint>

namespace pstripack {

// Names, not types of their own: Hull::word reads the vertices and the neighbours of a face as one row of
// words.

/// A node: from 0, < 2^29, in the order of insertion. The caller's node is Hull::order[v].
using HullNode = std::uint32_t;
constexpr std::int64_t kMostHullNodes = (std::int64_t{1} << 29) - 1;

/// A face: from 0, < 2^30.
using HullFace = std::uint32_t;

/// Vertex i of face t, or the edge opposite: the code 4*t + i, i = 0, 1 or 2. See face_of() and edge_of().
using HullCorner = std::uint32_t;

}  // namespace pstripack
