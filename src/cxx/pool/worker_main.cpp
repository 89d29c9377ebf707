// pstripack-worker: a rank of the pool. pstripack-run starts it through mpirun. All ranks get the model's
// command line; rank 0 starts the model.

#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "base/environment.h"
#include "pool/steward.h"
#include "pool/watchdog.h"

namespace {

pstripack::Watchdog* watchdog = nullptr;
pstripack::Steward* steward = nullptr;  ///< on rank 0

/// Handles SIGTERM from mpirun, which ends a job in this way; it is not a loss to be reported.
void end_on_request(int signal, siginfo_t* sender, void*) {
  if (sender->si_pid != watchdog->launcher()) {
    ::signal(signal, SIG_DFL);
    raise(signal);
    return;
  }
  watchdog->dismiss();
  _exit(128 + signal);
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
  static pstripack::Watchdog the_watchdog(rank);
  watchdog = &the_watchdog;
  static pstripack::Steward* const the_steward =
      rank == 0 ? new pstripack::Steward(argv + 1, the_watchdog) : nullptr;
  steward = the_steward;
  struct sigaction action {};
  action.sa_sigaction = end_on_request;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGTERM, &action, nullptr);
  // mpirun forwards these signals to all processes; they are meant for the model.
  signal(SIGUSR1, pass_on);
  signal(SIGUSR2, pass_on);

  int code = 0;
  {
    const pstripack::World world;
    try {
      pstripack::MpiCommunicator ranks = world.communicator();
      ranks.show_phase_in(watchdog->phase());
      if (rank == 0)
        code = steward->serve(ranks);
      else
        pstripack::serve_as_worker(ranks);
      ranks.set_phase("the end of MPI");
    } catch (const std::exception& error) {
      std::fprintf(stderr, "pstripack: rank %d: %s\n", rank, error.what());
      watchdog->dismiss();
      world.abort();
    }
  }
  watchdog->dismiss();
  return code;
}
