// pstripack-worker: a rank of the pool. pstripack-run starts it through mpirun.

#include <signal.h>
#include <sys/prctl.h>

#include <cstdio>
#include <cstdlib>

#include "base/environment.h"
#include "mpi/world.h"
#include "pool/steward.h"

namespace {

/// The rank, known before MPI is initialised; -1 if this is no rank.
int rank_from_environment() {
  for (const char* const variable : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char* const rank = pstripack::environment_variable(variable)) return std::atoi(rank);
  return -1;
}

}  // namespace

int main() {
  const int rank = rank_from_environment();
  const char* const pool = pstripack::environment_variable("PSTRIPACK_POOL");
  if (pool == nullptr || rank < 0) {
    std::fputs("pstripack-worker: only pstripack-run starts this program; see pstripack-run --help\n",
               stderr);
    return 2;
  }
  pstripack::Steward steward;
  if (rank == 0 && !steward.connect(pool)) {
    std::fputs(
        "pstripack-worker: rank 0 is not on the machine of pstripack-run: start pstripack-run where rank 0 "
        "is\n",
        stderr);
    return 1;
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // where mpirun or its daemon was killed
  // mpirun forwards these signals to all processes; they are meant for the program.
  signal(SIGUSR1, SIG_IGN);
  signal(SIGUSR2, SIG_IGN);

  pstripack::with_all_ranks([&](pstripack::MpiCommunicator& ranks) {
    if (rank == 0)
      steward.serve(ranks);
    else
      pstripack::serve_as_worker(ranks);
  });
  return 0;
}
