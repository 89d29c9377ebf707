#pragma once
// The pool: ranks that serve the TRMESH calls of a serial model which knows nothing of them.
//
//   pstripack-run
//     mpirun
//       rank 0: steward --- fork ---> keeper (pool/keeper.h) --- fork, exec ---> the model
//                  ^------- socket, shared memory -- (its libpstripack: pool/client.cpp) ---'
//       rank 1..P-1: workers
//
// If all ranks are on one machine they read the nodes from memory that the model shares, and write the lists
// there; else rank 0 scatters the nodes and gathers the lists.
//
// The model is not an MPI process. So nothing it does can harm MPI or hang the ranks: it may end in any way,
// never call TRMESH, be a script that starts one model after another, fork, or use MPI for itself.

#include <cstdint>
#include <vector>

#include "base/shared_area.h"
#include "mpi/collective_trmesh.h"
#include "mpi/world.h"
#include "pool/channel.h"

namespace pstripack {

/// Rank 0. Has the model started, and carries out its calls with all ranks.
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

  /// In a signal handler: passes on a signal from mpirun to a model that pstripack-run does not reach.
  void pass_on(int number);

 private:
  struct Client {
    Descriptor socket;
    SharedArea area;
    std::int64_t area_number = 0;
  };

  /// Serves one request of a client. False if the client is gone.
  bool serve(Client& client, MpiCommunicator& ranks);
  void send_to_workers(const Descriptor& file);

  bool has_launcher_;  ///< pstripack-run is on this machine; the keeper tells it how the model ended
  Descriptor listener_, keeper_;
  std::vector<Descriptor> sockets_;  ///< to the other ranks, see connect_ranks()
  std::vector<Client> clients_;
  std::int64_t areas_ = 0;  ///< number of areas so far
};

/// Every other rank: takes part in calls until the pool ends. Collective.
void serve_as_worker(MpiCommunicator& ranks);

}  // namespace pstripack
