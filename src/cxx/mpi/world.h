#pragma once
// MPI for a program that is nothing but a rank: the worker of the pool. Not for the libraries, which never
// start MPI.

#include <exception>

#include "mpi/mpi_communicator.h"

namespace pstripack {

/// Initialises MPI, calls body(ranks) for all ranks of the job and finalises MPI. What body() throws ends the
/// job, with a line on stderr. Collective.
template <class Body>
void with_all_ranks(const Body& body) {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  {
    MpiCommunicator ranks(MPI_COMM_WORLD);
    try {
      body(ranks);
    } catch (const std::exception& error) {
      ranks.abort("error", error.what());
    }
  }
  MPI_Finalize();
}

}  // namespace pstripack
