#pragma once
// The time of TRMESH on some nodes relative to the same number of random nodes.

#include <vector>

#include "contenders.h"
#include "measuring.h"

namespace benchmark {

/// TRMESH refuses nodes whose first three are collinear: swaps another node into the third place. Throws
/// std::runtime_error if all nodes are collinear with the first two.
Nodes with_a_triangle_first(std::vector<pstripack::Point> points);

struct BesideRandom {
  bool in_time = true;  ///< false: a measurement exceeded the limit; there is no ratio
  Samples own, random;  ///< seconds per node
  double ratio() const { return own.median() / random.median(); }
};

/// Measures both sets in turn, each time in a process of its own with a limit of `time_limit` seconds.
BesideRandom measure_beside_random(const Nodes& nodes, const Nodes& random, int repeats, double time_limit);

}  // namespace benchmark
