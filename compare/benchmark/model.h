#pragma once
// Runs this program again as a model to measure threads and pools of ranks: a forked child has only one
// thread.

#include <string>

#include "library.h"

namespace benchmark {

/// What a call of the model does: triangulates; the same as the first call of a process, for lists that the
/// system gives their memory while they are written, as after ALLOCATE; reads a mesh; makes a centroidal one,
/// of one width or of 60 to 30 km.
enum class Work { trmesh, first, trlist, crlist, scvt, widths };

struct Model {
  std::string points = "random", order = "given";
  int n = 1000000, calls = 0;
  Work work = Work::trmesh;
  int pause_ms = -1;  ///< between calls with other nodes each, whose median is taken; -1: all have the same
};

struct ModelFigures {
  double seconds = 0, peak = 0;  ///< seconds per call; peak memory of the first call in bytes per node,
                                 ///< beside the arrays of the call; Work::first: with them
};

/// A call that must be the first of this process: of ours, or of the original if it is given.
ModelFigures first_call(const Model& model, const legacy_stripack::Library* original);

/// Runs this program as the model. Returns the exit code.
int be_the_model(const Model& model);

/// Runs the model by the command `launcher`, which may begin with NAME=VALUE. If that starts several, the
/// figures of the slowest.
ModelFigures as_model(const std::string& self, const std::string& launcher, const Model& model);

}  // namespace benchmark
