#pragma once
// Calls of TRMESH on moved nodes, with and without PSTRIPACK_WARM_START=0.

#include <string>

namespace benchmark {

/// How the nodes of a model move from call to call.
struct MovingModel {
  std::string moves;  ///< name of a row; empty: this process is not a model
};

/// Runs this program as such a model; the report has the times. Returns the exit code.
int be_the_moving_model(const MovingModel& model);

/// The least time of a call on 10^6 random nodes that moved by a thousandth of their distance.
double seconds_of_warm_call(const std::string& self, int threads);

/// Writes a row for each way of moving to stdout.
void run_time_of_warm_starts(const std::string& self, int repeats);

}  // namespace benchmark
