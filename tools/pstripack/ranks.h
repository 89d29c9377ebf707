#pragma once
// pstripack under mpirun: rank 0 executes the command and the others help to triangulate, or all ranks
// execute it together.

#include <functional>
#include <memory>

#include "parallel/communicator.h"
#include "scvt/evaluator.h"

namespace program {

/// Runs work() on rank 0; returns its exit code on every rank. In `pstripack` (ranks.cpp), which has no MPI:
/// replaces the program by pstripack-mpi if there are several ranks, else this process is rank 0. In
/// `pstripack-mpi` (ranks_mpi.cpp): collective.
int on_rank_0(int argc, char** argv, const std::function<int()>& work);

/// All ranks, or this process alone if there is no MPI.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual pstripack::Communicator& communicator() = 0;
  /// Collective.
  virtual std::shared_ptr<pstripack::scvt::Evaluator> evaluator(const pstripack::scvt::Density& density) = 0;
};

/// To be called within work(): all ranks run work() up to this call, then body(ranks). body() may throw only
/// what the ranks have agreed on: scvt::NoTessellation or AgreedFailure.
void on_all_ranks(const std::function<void(Ranks&)>& body);

}  // namespace program
