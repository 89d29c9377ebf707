#pragma once
// The model's parent, a process beside rank 0 of the pool.
//
// A model that is told to end takes its time, to save its state. mpirun, which a batch system may tell to end
// as well, gives its ranks one second. So the model is no child of rank 0, and may outlive it.

#include <string>

#include "base/descriptor.h"
#include "pool/messages.h"

namespace pstripack {

/// What the keeper has to do with pstripack-run.
struct Launcher {
  Descriptor socket;    ///< none if it is on another machine
  Descriptor files[4];  ///< the model's stdin, stdout, stderr, and its environment; none: those of rank 0
  Greeting greeting;
};

/// Starts the keeper, which starts the model with this command line and with PSTRIPACK_POOL=pool in its
/// environment. The two have a process group of their own. The keeper
///   passes on the signals that pstripack-run gets, to the whole group, unless a batch system has sent them
///   to this group, too: each arrives once;
///   ends the model by SIGTERM, and SIGKILL 2 s later, if pstripack-run is gone, or if rank 0 is gone and
///   nobody has told the model to end;
///   sends a ModelEnd to pstripack-run and to rank 0.
/// Returns the socket to it, where a ModelEnd arrives unless the keeper is killed. None on failure, with
/// errno set. To be called before MPI_Init. The keeper closes its copy of `listener`.
Descriptor start_keeper(char** command, const std::string& pool, Launcher launcher, Descriptor& listener);

}  // namespace pstripack
