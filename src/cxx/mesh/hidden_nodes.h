#pragma once
// A quick search for hidden nodes (HiddenNode) before a hull is built. If the lengths as given hide any node,
// they usually hide one of the closest pairs or of the nodes around them, and a small hull shows it.

#include <cstddef>
#include <vector>

#include "geometry/point.h"
#include "mesh/hull_numbers.h"

namespace pstripack {

/// The nodes, at most 16, that are so close to two neighbours that lengths may hide them, the closest first.
/// nodes first..n-1 follow a curve. Throws std::bad_alloc.
std::vector<std::size_t> closest_nodes(const Point* nodes, std::size_t n, std::size_t first);

/// Triangulates, for each of these nodes, the nodes around it along the curve. The four corners of the whole
/// are added, because the nodes around may lie on one great circle. Throws HiddenNode if a set has one,
/// std::bad_alloc.
void triangulate_around(const std::vector<std::size_t>& closest, const Point* nodes, std::size_t n,
                        std::size_t first, const HullNode (&corners)[4]);

}  // namespace pstripack
