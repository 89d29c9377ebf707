#pragma once
// MPI of a program that is a rank and nothing else: the worker of the pool.

#include <cstddef>

#include "mpi/mpi_communicator.h"

namespace pstripack {

/// All ranks of the job, over MPI_COMM_WORLD. One in a process.
class World {
 public:
  /// Initialises MPI. Collective.
  World();
  /// Finalises it. Collective.
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Collective.
  MpiCommunicator communicator() const { return MpiCommunicator(MPI_COMM_WORLD); }
  /// Ends the job.
  [[noreturn]] void abort() const;
};

/// The ranks that can share memory with this one, itself included.
struct RanksOfMachine {
  int count;
  bool have_rank_0;
};
/// Collective.
RanksOfMachine ranks_of_machine(const World& world);

/// On rank 0: sends so many bytes to each of the other ranks, which wait for them. Over MPI_COMM_WORLD, where
/// nobody else sends.
void tell_others(const void* message, std::size_t size);
/// On another rank: waits for what rank 0 tells, without using the processor that others need: naps grow with
/// the time waited so far, so that the answer to one message after another is prompt and an idle hour costs
/// nothing.
void wait_for_rank_0(void* message, std::size_t size);

}  // namespace pstripack
