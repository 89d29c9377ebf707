// pstripack has no MPI: this process works alone.

#include "pstripack/ranks.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "base/environment.h"

namespace program {
namespace {

/// From the environment that launchers set: Open MPI, MPICH and Intel, Slurm.
int ranks_of_job() {
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* const size = pstripack::environment_variable(name)) return std::atoi(size);
  return 1;
}

}  // namespace

void add_serial(CLI::App& app) {
  const CLI::Option* const serial =
      app.add_flag("--serial", "work alone, also where a job has several ranks")->envname("PSTRIPACK_SERIAL");
  app.final_callback([serial] {
    const int ranks = ranks_of_job();
    if (ranks > 1 && (serial->empty() || !serial->as<bool>()))
      throw CLI::ValidationError(
          fmt::format("this job has {} ranks: pstripack-mpi uses them; say --serial, or set "
                      "PSTRIPACK_SERIAL=1, if each process is meant to work alone",
                      ranks));
  });
}

int on_rank_0(int, char**, const std::function<int()>& work) { return work(); }

void on_all_ranks(const std::function<void(Ranks&)>& body) {
  namespace engine = pstripack::scvt;
  pstripack::SingleProcess process;
  Ranks alone{process, [](const engine::Density& d) { return std::make_shared<engine::LocalEvaluator>(d); }};
  body(alone);
}

}  // namespace program
