#pragma once
// The time of any order or density of nodes relative to random nodes in random order.

namespace benchmark {

/// Writes one row per set of about n nodes to stdout.
void run_time_of_orders(int n, int repeats);

}  // namespace benchmark
