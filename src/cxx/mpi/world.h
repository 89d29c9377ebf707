#pragma once
// MPI for a program that is nothing but a rank: the worker of the pool. Not for the libraries, which never
// start MPI.

#include <cstdlib>

#include "mpi/mpi_communicator.h"

namespace pstripack {

/// All ranks of the job, over MPI_COMM_WORLD. At most one object per process.
class World {
 public:
  /// Initialises MPI. Collective.
  World() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  }
  /// Finalises MPI. Collective.
  ~World() { MPI_Finalize(); }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Collective.
  MpiCommunicator communicator() const { return MpiCommunicator(MPI_COMM_WORLD); }
  /// Ends the job.
  [[noreturn]] void abort() const {
    MPI_Abort(MPI_COMM_WORLD, 1);
    std::abort();  // does not return either, but MPI's declaration does not say so
  }
};

}  // namespace pstripack
