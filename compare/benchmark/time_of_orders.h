#pragma once
// The promise about time: any order of the nodes, any density, beside random nodes in random order.

namespace benchmark {

/// A row a set of about n nodes, written to stdout.
void run_time_of_orders(int n, int repeats);

}  // namespace benchmark
