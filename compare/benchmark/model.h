#pragma once
// This program started as a model, for measuring threads and pools of ranks: a forked child has one thread.

#include <string>

#include "contenders.h"

namespace benchmark {

struct Model {
  std::string points = "random", order = "given";
  int n = 1000000, calls = 0;
};

struct ModelFigures {
  double seconds = 0, peak = 0;  ///< per call; bytes per node during the first
};

/// Runs this program as the model. Returns the exit code.
int be_the_model(const Model& model);

/// Starts the model by `launcher`, which may begin with NAME=VALUE.
ModelFigures as_model(const std::string& self, const std::string& launcher, const Model& model);

/// Bytes per node: the peak memory during TRMESH, the first call of this process, minus that held before with
/// all arrays written.
double peak_of_first_call(const Nodes& nodes, Lists& lists);

}  // namespace benchmark
