#pragma once
// What the hull of some nodes from everywhere tells of all nodes.

#include <vector>

#include "parallel/places.h"
#include "parallel/record.h"

namespace pstripack {

/// Throws HiddenNode if the lengths hide one of these nodes: it is hidden in every larger set, too. Builds
/// the hull only if two successive nodes are close; so the nodes should follow a curve. They must not all be
/// on one great circle. Throws std::bad_alloc.
void look_for_hidden_nodes(const std::vector<Record>& nodes, const Places& places);

}  // namespace pstripack
