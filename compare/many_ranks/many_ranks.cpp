// pstripack-many-ranks: what a distributed mesh costs on more ranks than a machine has processors, with
// constant work a rank.
//
// The ranks are coroutines of one process (mpi.h): the code is that of libpstripack_mpi to the last line, but
// for MPI. A rank runs alone until it waits, so its processor time is that of its own work: packing and
// unpacking of messages and the steps of all collectives included, the transfer as one second per 10^9 bytes;
// what MPI itself does for each message is not. So the messages are counted.

#include <fmt/format.h>
#include <omp.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "lloyd_step.h"
#include "median.h"
#include "move_home.h"
#include "mpi.h"
#include "mpi/distributed_mesh.h"
#include "parallel/agreement.h"
#include "point_sets.h"

namespace {

using namespace pstripack;
using Phase = ParallelCost::Phase;

struct Settings {
  std::vector<int> ranks{16, 64, 256};
  std::size_t points = 10000;  ///< of each rank
  std::string family = "random";
  int repeats = 5;
};

/// The points of one rank.
struct Part {
  std::vector<Point> points;
  std::vector<std::int64_t> numbers;
};

/// A call on one rank.
struct Spent {
  double seconds[Phase::phases];
  double messages, bytes, flips;
};

Spent call(DistributedMesh& mesh, const Part& part) {
  DistributedMesh::Report report;
  const many_ranks::Traffic before = many_ranks::sent();
  if (mesh.triangulate(static_cast<std::int64_t>(part.points.size()), &part.points.data()->x,
                       part.numbers.data(), &report) != 0)
    throw std::runtime_error("these nodes cannot be triangulated");
  const many_ranks::Traffic after = many_ranks::sent();
  Spent spent{{},
              static_cast<double>(after.messages - before.messages),
              static_cast<double>(after.bytes - before.bytes),
              static_cast<double>(report.cost.mine.flips)};
  std::copy(std::begin(report.cost.mine.cpu_seconds), std::end(report.cost.mine.cpu_seconds), spent.seconds);
  return spent;
}

/// The calls of all ranks: of each rank the medians, of these the largest, and the mean over the ranks.
void print(int ranks, const std::string& kind, const std::vector<std::vector<Spent>>& of_rank) {
  double most[Phase::phases] = {}, mean[Phase::phases] = {}, messages = 0, bytes = 0, flips = 0;
  for (const std::vector<Spent>& calls : of_rank) {
    const auto usual = [&](const auto& value) {
      std::vector<double> values;
      for (const Spent& s : calls) values.push_back(value(s));
      return median(values);
    };
    for (int p = 0; p < Phase::phases; ++p) {
      const double seconds = usual([&](const Spent& s) { return s.seconds[p]; });
      most[p] = std::max(most[p], seconds);
      mean[p] += seconds / ranks;
    }
    messages = std::max(messages, usual([](const Spent& s) { return s.messages; }));
    bytes = std::max(bytes, usual([](const Spent& s) { return s.bytes; }));
    flips += usual([](const Spent& s) { return s.flips; });
  }
  const auto path = [](const double(&seconds)[Phase::phases]) {
    return std::accumulate(std::begin(seconds), std::end(seconds), 0.0);
  };
  fmt::print("{:>6} {:>6} |", ranks, kind);
  for (const Phase p : {Phase::divide, Phase::triangulate, Phase::merge, Phase::lists})
    fmt::print(" {:>6.2f} {:>6.2f} |", 1e3 * most[p], 1e3 * mean[p]);
  fmt::print(" {:>6.2f} {:>6.2f} | {:>8.0f} {:>9.0f} {:>8}", 1e3 * path(most), 1e3 * path(mean), messages,
             bytes, flips < 0 ? "" : fmt::format("{:.0f}", flips));
}

/// Calls that begin with the stars of the last one, or those that do not: the library reads once which.
void run(const Settings& s, int ranks, bool is_warm) {
  const std::size_t n = s.points * static_cast<std::size_t>(ranks);
  std::vector<Point> all = point_sets::make(s.family, n, 1);
  setenv("PSTRIPACK_WARM_START", is_warm ? "1" : "0", 1);
  std::vector<std::vector<Spent>> anew(static_cast<std::size_t>(ranks)), again(anew), warm(anew);
  many_ranks::run(ranks, [&] {
    DistributedMesh mesh(MPI_COMM_WORLD);
    MpiCommunicator& world = mesh.ranks();
    const auto me = static_cast<std::size_t>(world.rank());
    Part part;
    for (std::size_t i = me * s.points; i < (me + 1) * s.points; ++i) {
      part.points.push_back(all[i]);
      part.numbers.push_back(static_cast<std::int64_t>(i) + 1);
    }
    std::int64_t ready = 0;
    world.all_min(&ready, 1);
    all = {};
    for (int k = 0; k < 2; ++k) {
      call(mesh, part);
      move_home(world, mesh, part.points, part.numbers, nobody);
    }
    for (int k = 0; k < s.repeats && !is_warm; ++k) {
      DistributedMesh other(MPI_COMM_WORLD);
      anew[me].push_back(call(other, part));
      again[me].push_back(call(mesh, part));
    }
    constexpr int kStepsBefore = 4, kCallsBefore = 3;
    for (int k = 0; k < kStepsBefore + kCallsBefore + s.repeats && is_warm; ++k) {
      lloyd_step(mesh, part.points, k < kStepsBefore ? 1 : 0.06);
      const Spent spent = call(mesh, part);
      if (k >= kStepsBefore + kCallsBefore) warm[me].push_back(spent);
    }
  });
  rusage use;
  getrusage(RUSAGE_SELF, &use);
  const double megabytes = static_cast<double>(use.ru_maxrss) / 1024 / ranks;
  const auto show = [&](const char* kind, const std::vector<std::vector<Spent>>& calls) {
    print(ranks, kind, calls);
    fmt::print(" {:>8.2f}\n", megabytes);
  };
  if (is_warm) {
    show("warm", warm);
  } else {
    show("anew", anew);
    show("again", again);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "What a distributed mesh costs on many ranks, which are coroutines of one process: processor time of "
      "each "
      "phase, messages, bytes, memory."};
  Settings s;
  app.add_option("--ranks", s.ranks, "numbers of ranks")->delimiter(',')->capture_default_str();
  app.add_option("--points", s.points, "points of each rank")->capture_default_str();
  app.add_option("--family", s.family, "point set, as in stripack-compare")->capture_default_str();
  app.add_option("--repeats", s.repeats, "calls of each kind; the median of each rank counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  omp_set_num_threads(1);
  fmt::print(
      "{} points a rank, {}, at home. Milliseconds of processor time: of the slowest rank in each phase, and "
      "of the mean rank.\n"
      "anew: a first call; again: patches are kept; warm: stars are kept, points make small steps of Lloyd's "
      "method. path: sum of the\n"
      "phases. messages, bytes: sent by the rank that sends most. MB: resident memory of the process, a "
      "rank.\n\n"
      "{:>6} {:>6} | {:>13} | {:>13} | {:>13} | {:>13} | {:>13} | {:>8} {:>9} {:>8} {:>8}\n",
      s.points, s.family, "ranks", "call", "divide", "triangulate", "merge", "lists", "path", "messages",
      "bytes", "flips", "MB");
  for (const int ranks : s.ranks)
    for (const bool is_warm : {false, true}) {
      std::fflush(stdout);
      const pid_t child = fork();  // so that memory is counted anew
      if (child == 0) {
        try {
          run(s, ranks, is_warm);
          std::fflush(stdout);
          _exit(0);
        } catch (const std::exception& error) {
          fmt::print(stderr, "pstripack-many-ranks: {}\n", error.what());
          _exit(1);
        }
      }
      int status = 0;
      waitpid(child, &status, 0);
      if (status != 0) return 1;
    }
  return 0;
}
