#pragma once
// The time of TRMESH on some nodes relative to that on as many random ones.

#include <vector>

#include "contenders.h"
#include "measuring.h"

namespace benchmark {

/// TRMESH returns at once if the first three nodes are collinear: this swaps another node into the third
/// place. Throws std::runtime_error if all are collinear with the first two.
Nodes with_a_triangle_first(std::vector<pstripack::Point> points);

struct BesideRandom {
  bool in_time = true;  ///< false: a measurement exceeded the limit, and there is no ratio
  Samples own, random;  ///< seconds per node
  double ratio() const { return own.median() / random.median(); }
};

/// Alternates, each measurement in its own process with `time_limit` seconds.
BesideRandom measure_beside_random(const Nodes& nodes, const Nodes& random, int repeats, double time_limit);

}  // namespace benchmark
