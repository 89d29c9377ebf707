#pragma once
// The nodes of a comparison: from where, in which order, in which precision.

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/point.h"

namespace comparison {

/// Nodes from a file: text as point_sets::read takes it, or NetCDF as files::read does. Throws
/// std::runtime_error with one line that says what was expected where.
std::vector<pstripack::Point> read_nodes(const std::string& file);

/// "given"; "shuffled"; "sorted": by z, that is, latitude, and where that is equal by longitude. That is
/// about the slowest of the orders that models have for a method that inserts node after node.
void put_in_order(std::vector<pstripack::Point>& points, const std::string& order, std::uint64_t seed);

/// Coordinates that REAL*4 programs would have: the nearest ones.
void round_to_single(std::vector<pstripack::Point>& points);

}  // namespace comparison
