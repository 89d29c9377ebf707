#pragma once
// The time of TRMESH on some nodes beside its time on as many random ones.

#include <vector>

#include "contenders.h"
#include "measuring.h"

namespace benchmark {

/// TRMESH returns at once where the first three nodes are collinear: another node takes the third's place.
/// Throws std::runtime_error where all are collinear with the first two.
Nodes with_a_triangle_first(std::vector<pstripack::Point> points);

struct BesideRandom {
  bool in_time = true;  ///< false: a measurement took longer than the limit, and there is no ratio
  Samples own, random;  ///< seconds a node
  double ratio() const { return own.median() / random.median(); }
};

/// In turn, each in a process of its own that has `time_limit` seconds.
BesideRandom measure_beside_random(const Nodes& nodes, const Nodes& random, int repeats, double time_limit);

}  // namespace benchmark
