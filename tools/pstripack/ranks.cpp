#include "pstripack/ranks.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "base/environment.h"
#include "base/system.h"

namespace program {
namespace {

/// The number of ranks and the own rank, from the environment that the launcher sets. Under Slurm with PMIx,
/// Slurm's variable has the number.
struct Launched {
  int size = 1, rank = 0;
};

class Alone final : public Ranks {
 public:
  pstripack::Communicator& communicator() override { return process_; }
  std::shared_ptr<pstripack::scvt::Evaluator> evaluator(const pstripack::scvt::Density& density) override {
    return std::make_shared<pstripack::scvt::LocalEvaluator>(density);
  }

 private:
  pstripack::SingleProcess process_;
};

Launched launched() {
  using pstripack::environment_variable;
  constexpr const char* kVariables[][2] = {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                           {"PMI_SIZE", "PMI_RANK"},
                                           {"SLURM_STEP_NUM_TASKS", "PMIX_RANK"}};
  for (const auto& [name_of_size, name_of_rank] : kVariables) {
    const char* const size = environment_variable(name_of_size);
    const char* const rank = environment_variable(name_of_rank);
    if (size != nullptr && rank != nullptr) return {std::atoi(size), std::atoi(rank)};
  }
  return {};
}

}  // namespace

int on_rank_0(int, char** argv, const std::function<int()>& work) {
  const Launched here = launched();
  if (here.size > 1) {
    const std::filesystem::path self = pstripack::path_of_this_program();
    execv((self.parent_path() / "pstripack-mpi").c_str(), argv);  // returns only if it failed
    if (here.rank > 0) return 0;
    fmt::print(stderr, "pstripack: no pstripack-mpi is installed: rank 0 works alone, on its threads\n");
  }
  return work();
}

void on_all_ranks(const std::function<void(Ranks&)>& body) {
  Alone alone;
  body(alone);
}

}  // namespace program
