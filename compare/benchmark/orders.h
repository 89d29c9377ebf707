#pragma once
// Orders of the nodes. An incremental construction can be sensitive to them.

#include <string>
#include <vector>

#include "geometry/point.h"

namespace benchmark {

///   given     as the point set makes them (random nodes: without any order; grids: row after row)
///   shuffled  without any order
///   x, latitude, southward  along the axis x, from south to north, from north to south
///   rows      as grids are numbered: zones of latitude from south to north, along the longitude in each
///   columns   zones of longitude, from south to north in each
///   morton, hilbert  along the space-filling curve of that name
///   ends      by latitude, from both ends in turn
const std::vector<std::string>& orders();

/// The nodes of a point set, see point_sets::make, in one of these orders.
std::vector<pstripack::Point> nodes_in_order(const std::string& family, std::size_t n,
                                             const std::string& order);

}  // namespace benchmark
