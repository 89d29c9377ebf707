#pragma once
// The pool: ranks that serve the TRMESH calls of a serial model which knows nothing of them.
//
//   pstripack-run
//     mpirun
//       rank 0: steward --- fork, exec ---> the model
//                  ^------- socket, shared memory -- (its libpstripack: pool/client.cpp)
//       rank 1..P-1: workers
//
// If all ranks are on one machine they read the nodes from memory that the model shares, and write the lists
// there; else rank 0 scatters the nodes and gathers the lists.
//
// The model is not an MPI process. So nothing it does can harm MPI or hang the ranks: it may end in any way,
// never call TRMESH, be a script that starts one model after another, fork, or use MPI for itself.

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

/// Rank 0. Starts the model, carries out its calls with all ranks, and reports how it ended.
class Steward {
 public:
  /// Starts the model with this command line. To be called before MPI_Init, which takes long and for which
  /// the model need not wait.
  explicit Steward(char** command);
  Steward(const Steward&) = delete;
  Steward& operator=(const Steward&) = delete;

  /// Serves calls until the model has ended. Returns the exit code for this process. Collective, with
  /// serve_as_worker() on the other ranks.
  int serve(MpiCommunicator& ranks);

  /// In the handler of a signal that the model got, too: waits until the model has ended, and reports how.
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
  /// Serves one request of a client. False if the client is gone.
  bool serve(Client& client, MpiCommunicator& ranks);

  Descriptor launcher_;  ///< pstripack-run; none if it is on another machine
  std::string name_;
  Descriptor listener_, child_signals_;
  std::vector<Client> clients_;
  std::int64_t areas_ = 0;  ///< number of areas so far
  pid_t model_ = -1;
  int status_ = 0;     ///< of the model, as returned by wait()
  bool told_ = false;  ///< pstripack-run knows that the model has ended
};

/// Every other rank: takes part in calls until the pool ends. beside_rank_0: on the machine of rank 0.
/// Collective.
void serve_as_worker(MpiCommunicator& ranks, bool beside_rank_0);

/// Sets the number of threads of this rank to its share of the processors, unless OMP_NUM_THREADS is set.
void share_processors(const RanksOfMachine& here);

}  // namespace pstripack
