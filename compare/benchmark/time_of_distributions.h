#pragma once
// The time of each distribution of nodes relative to random nodes.

#include <string>
#include <vector>

namespace benchmark {

/// Writes one row per set to stdout: ratios at several N, and how often each stage of the predicates was
/// entered.
/// `only`: point sets; none: all of point_sets::distributions().
void run_time_of_distributions(const std::vector<std::string>& only, int repeats);

/// Writes one row per set: the time on all processors over that on one thread, at several N. Nothing without
/// OpenMP.
void run_distributions_on_threads(const std::vector<std::string>& only, int repeats);

}  // namespace benchmark
