#pragma once
// The nodes of a comparison: where they come from, their order, their precision.

#include <cstdint>
#include <string>
#include <vector>

#include "files/nodes.h"
#include "geometry/point.h"

namespace comparison {

/// Reads nodes as pstripack does (files::read). Throws std::runtime_error with one line that says what was
/// expected where.
std::vector<pstripack::Point> read_nodes(const std::string& file, const files::ReadOptions& options = {});

/// Orders: "given"; "shuffled"; "sorted" by z (latitude), then by longitude. Of the orders found in models
/// the last one is about the slowest for a method that inserts nodes one after another.
void put_in_order(std::vector<pstripack::Point>& points, const std::string& order, std::uint64_t seed);

/// Rounds the coordinates to REAL*4.
void round_to_single(std::vector<pstripack::Point>& points);

}  // namespace comparison
