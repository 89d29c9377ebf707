#pragma once

namespace benchmark {

/// Prints the peak memory of TRLIST and CRLIST for canonical lists and others on one thread, and of TRLIST on
/// all processors. This process must have called no routine of the library.
void print_memory_of_lists();

}  // namespace benchmark
