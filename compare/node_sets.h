#pragma once
// The nodes of a comparison: source, order, precision.

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/point.h"

namespace comparison {

/// Nodes from a file: text in the format of point_sets::read, or NetCDF in that of files::read. Throws
/// std::runtime_error with one line that names what was expected where.
std::vector<pstripack::Point> read_nodes(const std::string& file);

/// "given"; "shuffled"; "sorted": by z (latitude), then by longitude. Of the orders in models this is about
/// the slowest for a method that inserts node after node.
void put_in_order(std::vector<pstripack::Point>& points, const std::string& order, std::uint64_t seed);

/// Coordinates rounded to REAL*4.
void round_to_single(std::vector<pstripack::Point>& points);

}  // namespace comparison
