#pragma once
// The time of each distribution of nodes relative to random nodes.

#include <string>
#include <vector>

namespace benchmark {

/// Writes one row per set to stdout: ratios at several N.
/// `only`: point sets; none: all of point_sets::distributions(), and random nodes in several orders.
void run_time_of_distributions(const std::vector<std::string>& only, int repeats);

}  // namespace benchmark
