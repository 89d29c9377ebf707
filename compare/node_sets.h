#pragma once
// The nodes of a comparison: from where, in which order, in which precision.

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/point.h"

namespace comparison {

/// Nodes from a file: text as point_sets::read takes it, or NetCDF. Throws std::runtime_error with one line
/// that says what was expected where.
std::vector<pstripack::Point> read_nodes(const std::string& file);

/// Nodes of a NetCDF file: xCell, yCell, zCell, taken as they are; or lonCell and latCell, lon and lat,
/// longitude and latitude: of one shape, or the two axes of a grid (rows of latitude, one after the other),
/// in the units that the attribute says. Missing units: radians for lonCell and latCell, else an error.
std::vector<pstripack::Point> read_netcdf(const std::string& file);

/// "given"; "shuffled"; "sorted": by z, that is, latitude, and where that is equal by longitude. That is
/// about the slowest of the orders that models have for a method that inserts node after node.
void put_in_order(std::vector<pstripack::Point>& points, const std::string& order, std::uint64_t seed);

/// Coordinates that REAL*4 programs would have: the nearest ones.
void round_to_single(std::vector<pstripack::Point>& points);

}  // namespace comparison
