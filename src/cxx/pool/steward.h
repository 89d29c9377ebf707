#pragma once
// The pool: ranks that serve the TRMESH calls of a serial model which knows nothing of them.
//
//   pstripack-run (run_main.cpp), which becomes the model (its libpstripack: pool/client.cpp)
//     supervisor                                                       ^
//       mpirun                                                         | socket, shared memory
//         rank 0: steward <--------------------------------------------'
//         rank 1..P-1: workers
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
#include "pool/channel.h"

namespace pstripack {

/// Rank 0. Carries out the model's calls with all ranks.
class Steward {
 public:
  /// Gets the socket of the pool from pstripack-run, which then starts the model. To be called before
  /// MPI_Init, which takes long and for which the model need not wait. False if pstripack-run is on another
  /// machine.
  bool connect(const char* pool);

  /// Serves calls until the model has ended. Collective, with serve_as_worker() on the other ranks.
  void serve(MpiCommunicator& ranks);

 private:
  struct Client {
    Descriptor socket;
    SharedArea area;
    std::int64_t area_number = 0;
  };

  /// Serves one request of a client. False if the client is gone.
  bool serve(Client& client, MpiCommunicator& ranks);
  void send_to_workers(const Descriptor& file);

  Descriptor listener_, supervisor_;  ///< the supervisor closes the second when the model has ended
  std::vector<Descriptor> sockets_;   ///< to the other ranks, see connect_ranks()
  std::vector<Client> clients_;
  std::int64_t areas_ = 0;  ///< number of areas so far
};

/// Every other rank: takes part in calls until the pool ends. Collective.
void serve_as_worker(MpiCommunicator& ranks);

}  // namespace pstripack
