#pragma once
// Calls of TRMESH with nodes that have moved, beside the same calls with PSTRIPACK_WARM_START=0.

#include <string>

namespace benchmark {

/// How the nodes of a model move from call to call.
struct MovingModel {
  std::string moves;  ///< the name of one of the rows, empty: none
};

/// What this program is where it is such a model: the report tells of its calls. The exit code.
int be_the_moving_model(const MovingModel& model);

/// A row for each way of moving, written to stdout.
void run_time_of_warm_starts(const std::string& self, int repeats);

}  // namespace benchmark
