#pragma once
// The pool: ranks that serve the TRMESH calls of a serial model which knows nothing of them.
//
//   pstripack-run
//     mpirun
//       rank 0: steward --- fork, exec ---> the model
//                  ^------- socket, shared memory -- (its libpstripack: pool/client.cpp)
//       rank 1..P-1: workers
//
// Where all ranks are on one machine they read the nodes from the memory that the model shares and write the
// lists there; else rank 0 scatters and gathers.
//
// The model is not an MPI process. So nothing it does can harm MPI or hang the ranks: it may end in any way,
// never call, be a script that starts one model after another, fork, or use MPI for itself.

#include <signal.h>
#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/shared_area.h"
#include "mpi/collective_trmesh.h"
#include "mpi/world.h"
#include "pool/channel.h"
#include "pool/messages.h"

namespace pstripack {

/// Rank 0. Starts the model, gives its calls to all ranks, and passes on how it ended.
class Steward {
 public:
  /// Starts the model. Before MPI_Init, which takes a while: the model need not wait for it.
  explicit Steward(char** command);
  Steward(const Steward&) = delete;
  Steward& operator=(const Steward&) = delete;

  /// Collective, with serve_as_worker() on the other ranks. Returns when the model has ended: with the code
  /// that this process should exit with.
  int serve(MpiCommunicator& ranks);

  /// The model has been told to end together with this process, and this process is in a signal handler:
  /// waits for the end of the model and passes it on.
  void see_the_model_end();

 private:
  struct Client {
    Descriptor socket;
    SharedArea area;
    std::int64_t area_number = 0;
  };

  [[noreturn]] void become_the_model(char** command, Descriptor (&from_launcher)[4],
                                     const sigset_t& signals) const;
  bool model_has_ended();
  /// False: the client is gone.
  bool serve(Client& client, MpiCommunicator& ranks);

  Descriptor launcher_;  ///< pstripack-run; none if it is on another machine
  std::string name_;
  Descriptor listener_, child_signals_;
  std::vector<Client> clients_;
  std::int64_t areas_ = 0;  ///< that there have been
  LastCall last_call_;
  pid_t model_ = -1;
  int status_ = 0;  ///< the model's, as wait() tells it
  bool told_ = false;
};

/// Any other rank: takes part in calls until the pool ends. Collective.
void serve_as_worker(MpiCommunicator& ranks, bool beside_rank_0);

/// Sets this rank's threads: its share of the processors that it may use, unless OMP_NUM_THREADS says it.
void share_processors(const RanksOfMachine& here);

}  // namespace pstripack
