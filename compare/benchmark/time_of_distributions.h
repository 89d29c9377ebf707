#pragma once
// The promise about time, distribution by distribution.

#include <string>
#include <vector>

namespace benchmark {

/// A row a set, written to stdout: beside random nodes at several N, and what the predicates had to do.
/// `only`: point sets; none: all of point_sets::distributions().
void run_time_of_distributions(const std::vector<std::string>& only, int repeats);

}  // namespace benchmark
