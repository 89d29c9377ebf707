#pragma once
// Who executes a command. pstripack (ranks.cpp): this process alone. pstripack-mpi (ranks_mpi.cpp): rank 0,
// while the others help to triangulate, or all ranks together.

#include <functional>
#include <memory>

#include "parallel/communicator.h"
#include "scvt/evaluator.h"

namespace CLI {
class App;
}

namespace program {

/// pstripack: adds --serial. In a job of several ranks parsing fails without it: the processes would all do
/// the same. pstripack-mpi: nothing.
void add_serial(CLI::App& app);

/// Runs work() on rank 0; returns its exit code on every rank. Collective.
int on_rank_0(int argc, char** argv, const std::function<int()>& work);

/// All ranks, or this process alone if there is no MPI.
struct Ranks {
  pstripack::Communicator& communicator;
  /// Collective.
  std::function<std::shared_ptr<pstripack::scvt::Evaluator>(const pstripack::scvt::Density& density)>
      evaluator;
};

/// To be called within work(): all ranks run work() up to this call, then body(ranks). body() may throw only
/// what the ranks have agreed on: scvt::NoTessellation or AgreedFailure.
void on_all_ranks(const std::function<void(Ranks&)>& body);

}  // namespace program
