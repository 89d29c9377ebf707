#pragma once
// Orders of the nodes. An incremental construction can be sensitive to them.

#include <string>
#include <vector>

#include "geometry/point.h"

namespace benchmark {

///   given     as the point set makes them (random nodes: without any order; grids: row after row)
///   shuffled  without any order
///   latitude  from south to north
///   rows      as grids are numbered: zones of latitude from south to north, along the longitude in each
const std::vector<std::string>& orders();

/// The nodes of a point set, see point_sets::make, in one of these orders.
std::vector<pstripack::Point> nodes_in_order(const std::string& family, std::size_t n,
                                             const std::string& order);

}  // namespace benchmark
