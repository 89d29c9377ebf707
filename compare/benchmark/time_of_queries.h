#pragma once
// The time per call of TRFIND, NEARND and GETNP relative to the original's.

#include "original.h"

namespace benchmark {

/// Measures GETNP for several L, and TRFIND and NEARND from several starts, among n random nodes. Writes to
/// stdout.
void run_time_of_queries(int n, const legacy_stripack::Original& original, int repeats);

}  // namespace benchmark
