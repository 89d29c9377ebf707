#pragma once
// What some nodes from everywhere tell of all, by their hull.

#include <vector>

#include "parallel/places.h"
#include "parallel/record.h"

namespace pstripack {

/// How many times as far from the centre as a triangle of a hull a place in its direction can be, for all
/// hulls of these nodes and any others: they lie around the hull of these. Infinite if these do not surround
/// the centre. Throws std::bad_alloc.
double most_stretch(const std::vector<Record>& nodes, const Places& places);

/// Throws HiddenNode if lengths hide one of some nodes, and so in every set that has them. Looks closely only
/// if neighbours in their order, which should follow a curve, are close. Not all on one great circle. Throws
/// std::bad_alloc.
void look_for_hidden_nodes(const std::vector<Record>& nodes, const Places& places);

}  // namespace pstripack
