// pstripack-worker: a rank of the pool. pstripack-run starts it through mpirun. All ranks get the model's
// command line; rank 0 starts the model.

#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <thread>

#include "base/environment.h"
#include "pool/steward.h"

namespace {

pstripack::Steward* steward = nullptr;  ///< on rank 0

/// Ends this process if the launcher (mpirun or its daemon) is gone, which may have been killed.
void end_with(pid_t launcher) {
  while (getppid() == launcher) sleep(1);
  kill(getpid(), SIGKILL);
}

void pass_on(int signal) {
  if (steward != nullptr) steward->pass_on(signal);
}

/// The rank, known before MPI is initialised; -1 if this is no rank.
int rank_from_environment() {
  for (const char* const variable : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char* const rank = pstripack::environment_variable(variable)) return std::atoi(rank);
  return -1;
}

}  // namespace

int main(int argc, char** argv) {
  const int rank = rank_from_environment();
  if (argc < 2 || rank < 0) {
    std::fputs("pstripack-worker: only pstripack-run starts this program; see pstripack-run --help\n",
               stderr);
    return 2;
  }
  if (rank == 0) steward = new pstripack::Steward(argv + 1);
  std::thread(end_with, getppid()).detach();
  // mpirun forwards these signals to all processes; they are meant for the model.
  signal(SIGUSR1, pass_on);
  signal(SIGUSR2, pass_on);

  int code = 0;
  {
    const pstripack::World world;
    try {
      pstripack::MpiCommunicator ranks = world.communicator();
      if (rank == 0)
        code = steward->serve(ranks);
      else
        pstripack::serve_as_worker(ranks);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "pstripack: rank %d: %s\n", rank, error.what());
      world.abort();
    }
  }
  return code;
}
