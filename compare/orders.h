#pragma once
// Orders of nodes. A method that inserts nodes one after another can be sensitive to them.

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/point.h"

namespace comparison {

/// The order:
///   given     as a family makes them (random nodes: without any order; grids: row after row)
///   shuffled  without any order
///   sorted    by latitude, then by longitude: of the orders found in models about the slowest
///   rows      as grids are numbered: zones of latitude from south to north, along the longitude in each
/// Throws std::invalid_argument for any other.
void put_in_order(std::vector<pstripack::Point>& points, const std::string& order, std::uint64_t seed);

/// The nodes of a family, see point_sets::make, in one of these orders.
std::vector<pstripack::Point> nodes_in_order(const std::string& family, std::size_t n,
                                             const std::string& order);

}  // namespace comparison
