#pragma once
// Under mpirun: rank 0 does what the command line says, the others help it triangulate; or all ranks do it
// together.

#include <functional>
#include <memory>

#include "parallel/communicator.h"
#include "scvt/evaluator.h"

namespace program {

/// The exit code of work(), which runs on rank 0, on every rank. Of `pstripack` (ranks.cpp), which has no
/// MPI: replaces the program by pstripack-mpi if there is more than one rank, and else is rank 0. Of
/// `pstripack-mpi` (ranks_mpi.cpp): collective.
int on_rank_0(int argc, char** argv, const std::function<int()>& work);

/// All ranks, or this process alone.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual pstripack::Communicator& communicator() = 0;
  /// Collective.
  virtual std::shared_ptr<pstripack::scvt::Evaluator> evaluator(const pstripack::scvt::Density& density) = 0;
};

/// Within work(): runs body(ranks) on all ranks, which go through work() as far as here. What body() throws
/// the ranks must have agreed on: scvt::NoTessellation or AgreedFailure.
void on_all_ranks(const std::function<void(Ranks&)>& body);

}  // namespace program
