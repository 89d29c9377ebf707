#pragma once
// Somebody must be left to say that a rank was lost: the ranks that are ended with it. (In pool mode a
// process beside each rank does it, watchdog.h; here the ranks are the program's own, and no process is
// started.)

#include <mpi.h>

#include <cstddef>

#include "base/shared_area.h"

namespace pstripack {

/// Which rank of a communicator does what, in memory that the ranks on one machine share. SIGTERM, by which
/// mpirun ends a job that has lost a rank, is answered with one line that names the lost rank and its phase,
/// if that or the one who says so was in a collective call, and then as ever. Only where the program has no
/// answer of its own.
class RollCall {
 public:
  /// Collective. Without shared memory it does nothing.
  explicit RollCall(MPI_Comm comm);
  ~RollCall();
  RollCall(const RollCall&) = delete;
  RollCall& operator=(const RollCall&) = delete;

  /// What this rank does from now on; "": nothing that is collective.
  void set_phase(const char* phase);

 private:
  void take_place(int rank);

  SharedArea area_;
  std::size_t me_ = 0;  ///< among the ranks of this machine
  int slot_;            ///< among the pages of this process
};

}  // namespace pstripack
