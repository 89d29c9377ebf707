// The ranks of pstripack-mpi. Ranks above 0 wait for a message of rank 0: to triangulate with it, to run the
// command with it, or to end with its exit code.

#include <fmt/format.h>

#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>

#include "files/mesh.h"
#include "mpi/collective_trmesh.h"
#include "mpi/distributed_evaluator.h"
#include "mpi/mpi_communicator.h"
#include "pstripack/options.h"
#include "pstripack/ranks.h"
#include "scvt/errors.h"
#include "stripack/original/original_rules.h"

namespace program {
namespace {

namespace engine = pstripack::scvt;
using pstripack::MpiCommunicator;

/// The message of rank 0: one of these, or an exit code.
constexpr std::int32_t kTriangulate = -1, kTogether = -2;

std::int32_t word_of_rank_0(MpiCommunicator& ranks, std::int32_t word = 0) {
  ranks.broadcast(&word, sizeof word, 0);
  return word;
}

std::shared_ptr<engine::Evaluator> evaluator_on(const MpiCommunicator& ranks,
                                                const engine::Density& density) {
  if (ranks.size() == 1) return std::make_shared<engine::LocalEvaluator>(density);
  struct WithMesh {
    WithMesh(MPI_Comm comm, const engine::Density& density) : mesh(comm), evaluator(mesh, density) {}
    pstripack::DistributedMesh mesh;
    engine::DistributedEvaluator evaluator;
  };
  const auto both = std::make_shared<WithMesh>(ranks.handle(), density);
  return {both, &both->evaluator};
}

/// The communicator of on_rank_0; null outside of it.
MpiCommunicator*& ranks_of_program() {
  static MpiCommunicator* ranks = nullptr;
  return ranks;
}

int lead(MpiCommunicator& ranks, const std::function<int()>& work) {
  // Ranks cannot help: the original's order inserts one node after another.
  if (!pstripack::original_rules().follow)
    files::set_trmesh([&](const pstripack::TrmeshCall& call) {
      global().ranks = ranks.size();
      word_of_rank_0(ranks, kTriangulate);
      try {
        return collective_trmesh(ranks, pstripack::Arrays::on_one_rank, call);
      } catch (const pstripack::AgreedFailure&) {
        throw std::bad_alloc();  // some rank is out of memory
      }
    });
  return word_of_rank_0(ranks, work());
}

int follow(MpiCommunicator& ranks, const std::function<int()>& work) {
  global().is_led = true;
  for (;;) {
    const std::int32_t word = word_of_rank_0(ranks);
    if (word >= 0) return word;
    if (word == kTogether) {
      work();
      continue;
    }
    try {
      pstripack::collective_trmesh(ranks, pstripack::Arrays::on_one_rank, {});
    } catch (const pstripack::AgreedFailure&) {  // rank 0 reports the error
    }
  }
}

/// True on all ranks or on none. The ranks execute rank 0's arguments, so those of a rank that differ would
/// be ignored.
bool have_one_command_line(MpiCommunicator& ranks, int argc, char** argv) {
  std::string all;
  for (int i = 1; i < argc; ++i) all += std::string(argv[i]) + '\0';
  const auto hash = static_cast<std::int64_t>(std::hash<std::string>{}(all) >> 1);
  std::int64_t values[] = {hash, ~hash};
  ranks.all_min(values, 2);
  return values[0] == ~values[1];
}

}  // namespace

void add_serial(CLI::App&) {}

int on_rank_0(int argc, char** argv, const std::function<int()>& work) {
  int provided = 0, code = kFailed;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  try {
    MpiCommunicator ranks(MPI_COMM_WORLD);
    ranks_of_program() = &ranks;
    if (have_one_command_line(ranks, argc, argv)) {
      code = ranks.rank() == 0 ? lead(ranks, work) : follow(ranks, work);
    } else {
      code = kUsage;
      if (ranks.rank() == 0)
        fmt::print(stderr,
                   "pstripack: the ranks have different command lines: start each command by its own "
                   "mpirun\n");
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "pstripack: {}\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, kFailed);
  }
  MPI_Finalize();
  return code;
}

void on_all_ranks(const std::function<void(Ranks&)>& body) {
  MpiCommunicator& ranks = *ranks_of_program();
  // From now on all ranks run the same code: each triangulates by itself unless body() makes them cooperate.
  files::set_trmesh([](const pstripack::TrmeshCall& call) { return pstripack::trmesh(call); });
  if (ranks.rank() == 0) word_of_rank_0(ranks, kTogether);
  global().ranks = ranks.size();
  Ranks all{ranks, [&](const engine::Density& density) { return evaluator_on(ranks, density); }};
  try {
    body(all);
  } catch (const std::exception& e) {
    const bool is_agreed = dynamic_cast<const engine::NoTessellation*>(&e) != nullptr ||
                           dynamic_cast<const pstripack::AgreedFailure*>(&e) != nullptr;
    if (ranks.size() > 1 && !is_agreed) ranks.abort("error", e.what());
    throw;
  }
}

}  // namespace program
