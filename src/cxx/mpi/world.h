#pragma once
// MPI for a program that is nothing but a rank: the worker of the pool.

#include <cstddef>

#include "mpi/mpi_communicator.h"

namespace pstripack {

/// All ranks of the job, over MPI_COMM_WORLD. At most one object per process.
class World {
 public:
  /// Initialises MPI. Collective.
  World();
  /// Finalises MPI. Collective.
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Collective.
  MpiCommunicator communicator() const { return MpiCommunicator(MPI_COMM_WORLD); }
  /// Ends the job.
  [[noreturn]] void abort() const;
};

/// On rank 0: sends `size` bytes to each of the other ranks, over MPI_COMM_WORLD, where nothing else is sent.
void tell_others(const void* message, std::size_t size);
/// On the other ranks: waits for that message. Sleeps grow with the time waited so far, so that frequent
/// messages are received promptly and a long wait takes hardly any processor time.
void wait_for_rank_0(void* message, std::size_t size);

}  // namespace pstripack
