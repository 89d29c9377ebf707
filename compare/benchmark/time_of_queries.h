#pragma once
// The time of TRFIND, NEARND and GETNP relative to the original's, call by call.

#include "original.h"

namespace benchmark {

/// GETNP for several L, TRFIND and NEARND from several starts, among n random nodes; written to stdout.
void run_time_of_queries(int n, const legacy_stripack::Original& original, int repeats);

}  // namespace benchmark
