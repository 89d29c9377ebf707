#pragma once
// This program as a model of its own, which threads and pools of ranks need: a forked child has one thread.

#include <string>

#include "contenders.h"

namespace benchmark {

struct Model {
  std::string points = "random", order = "given";
  int n = 1000000, calls = 0;
};

struct ModelFigures {
  double seconds = 0, peak = 0;  ///< a call; bytes a node during the first
};

/// What this program is where it is the model. The exit code.
int be_the_model(const Model& model);

/// Started by `launcher`, which may begin with NAME=VALUE.
ModelFigures as_model(const std::string& self, const std::string& launcher, const Model& model);

/// The largest memory during our TRMESH, the first of this process, beyond what it held before with all its
/// arrays written. Bytes a node.
double peak_of_first_call(const Nodes& nodes, Lists& lists);

}  // namespace benchmark
