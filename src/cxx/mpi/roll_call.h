#pragma once
// Reports a lost rank by one of the ranks that mpirun ends with it. (In pool mode a process beside each rank
// reports it, see pool/watchdog.h; here the ranks are the program's own, and no process is started.)

#include <mpi.h>

#include <cstddef>

#include "base/shared_area.h"

namespace pstripack {

/// The phases of the ranks of a communicator, in memory shared by the ranks on one machine. mpirun ends a
/// job that has lost a rank by SIGTERM. Its handler then prints one line that names the lost rank and its
/// phase, if that rank or this one was in a collective call. There is no handler if the program has its own.
class RollCall {
 public:
  /// Collective. Does nothing if the ranks cannot share memory.
  explicit RollCall(MPI_Comm comm);
  ~RollCall();
  RollCall(const RollCall&) = delete;
  RollCall& operator=(const RollCall&) = delete;

  /// Sets the phase of this rank, at most 47 characters; "": not in a collective call.
  void set_phase(const char* phase);

 private:
  void take_place(int rank);

  SharedArea area_;
  std::size_t me_ = 0;  ///< index of this rank among the ranks of this machine
  int slot_;            ///< index of the page among those of this process
};

}  // namespace pstripack
