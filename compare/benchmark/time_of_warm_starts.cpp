#include "time_of_warm_starts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "contenders.h"
#include "point_sets.h"
#include "voronoi_cell.h"

namespace benchmark {
namespace {

using pstripack::Point;

enum class Moves { lloyd, random, other, none };

struct Row {
  std::string name;
  int n, threads;
  Moves moves;
  double part;        ///< of a step of Lloyd's method; random: of the mean distance of nodes
  int before, calls;  ///< number of Lloyd steps before; number of measured calls
};

const std::vector<Row> kRows{
    {"lloyd-1e5", 100000, 1, Moves::lloyd, 0.06, 12, 20},
    {"lloyd-1e6", 1000000, 1, Moves::lloyd, 0.06, 12, 6},
    {"lloyd-1e6-threads", 1000000, 2, Moves::lloyd, 0.06, 12, 6},
    {"flips-1e5", 100000, 1, Moves::lloyd, 0.4, 5, 5},
    {"random-1e-3", 100000, 1, Moves::random, 1e-3, 0, 5},
    {"random-1e-2", 100000, 1, Moves::random, 1e-2, 0, 5},
    {"random-1e6", 1000000, 1, Moves::random, 1e-3, 0, 5},
    {"other-1e5", 100000, 1, Moves::other, 0, 0, 12},
    {"first-1e5", 100000, 1, Moves::none, 0, 0, 1},
};

const Row& row(const std::string& name) {
  const auto found = std::find_if(kRows.begin(), kRows.end(), [&](const Row& r) { return r.name == name; });
  if (found == kRows.end()) throw std::invalid_argument(name + ": unknown way of moving nodes");
  return *found;
}

/// A step of Lloyd's method: moves each node by `part` of the way to the centroid of its Voronoi cell.
std::vector<Point> lloyd_step(const Nodes& nodes, const Lists& lists, double part) {
  std::vector<Point> moved = nodes.all;
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const int begin = k == 0 ? 0 : lists.lend[k - 1], count = lists.lend[k] - begin;
    const Point p = nodes.all[k];
    const auto neighbour = [&](int i) {
      const auto slot = static_cast<std::size_t>(begin + i);
      return nodes.all[static_cast<std::size_t>(lists.list[slot]) - 1];
    };
    moved[k] = point_sets::part_of_the_way(p, point_sets::middle_of_cell(p, count, neighbour), part);
  }
  return moved;
}

/// Moves each node by so much in a random direction.
std::vector<Point> random_step(const std::vector<Point>& points, double by, std::uint64_t seed) {
  const std::vector<Point> towards = point_sets::make("random", points.size(), seed);
  std::vector<Point> moved;
  for (std::size_t k = 0; k < points.size(); ++k)
    moved.push_back(point_sets::part_of_the_way(points[k], towards[k], by));
  return moved;
}

struct Times {
  std::vector<double> cold, warm;
  double flips = 0;  ///< mean number of flips of warm calls
  int warm_calls = 0;
};

/// Runs the row's model once and adds its times, the last lines of its report.
void run_model(const std::string& self, const Row& row, int threads, bool warm, Times& times) {
  const std::string command = fmt::format(
      "OMP_NUM_THREADS={} PSTRIPACK_WARM_START={} PSTRIPACK_REPORT=/dev/stdout '{}' --be-the-moving-model {}",
      threads, warm ? 1 : 0, self, row.name);
  FILE* const out = popen(command.c_str(), "r");
  if (out == nullptr) throw std::runtime_error("cannot start " + command);
  struct Call {
    double seconds;
    long flips;
  };
  std::vector<Call> calls;
  char line[4096];
  while (std::fgets(line, sizeof line, out) != nullptr) {
    const std::string text = line;
    const auto value = [&](const std::string& key) {
      const std::size_t at = text.find(" " + key + "=");
      return at == std::string::npos ? -1 : std::stod(text.substr(at + key.size() + 2));
    };
    if (value("seconds") >= 0) calls.push_back({value("seconds"), std::lround(value("flips"))});
  }
  if (pclose(out) != 0 || calls.size() < static_cast<std::size_t>(row.calls))
    throw std::runtime_error("the model failed or wrote no report: " + command);
  for (auto c = calls.end() - row.calls; c != calls.end(); ++c) {
    (warm ? times.warm : times.cold).push_back(c->seconds);
    if (c->flips >= 0) ++times.warm_calls, times.flips += static_cast<double>(c->flips);
  }
}

}  // namespace

int be_the_moving_model(const MovingModel& model) {
  const Row& r = row(model.moves);
  const Stripack library = ours();
  const auto n = static_cast<std::size_t>(r.n);
  std::vector<Point> points = point_sets::make("random", n, 1);
  Lists lists(r.n);
  const auto call = [&] {
    const Nodes nodes(points);
    library.trmesh(nodes, lists);
    return nodes;
  };
  for (int step = 0; step < r.before; ++step) points = lloyd_step(call(), lists, 1);
  // Two more calls: a mesh is kept only after a call whose nodes fitted.
  for (int step = r.moves == Moves::none ? 2 : 0; step < r.calls + 2; ++step) {
    const Nodes nodes = call();
    if (r.moves == Moves::lloyd) points = lloyd_step(nodes, lists, r.part);
    if (r.moves == Moves::random)
      points = random_step(points, r.part * std::sqrt(4 * M_PI / r.n), static_cast<std::uint64_t>(step) + 2);
    if (r.moves == Moves::other) points = point_sets::make("random", n, static_cast<std::uint64_t>(step) + 2);
  }
  return 0;
}

double seconds_of_warm_call(const std::string& self, int threads) {
  Times times;
  run_model(self, row("random-1e6"), threads, true, times);
  return *std::min_element(times.warm.begin(), times.warm.end());
}

void run_time_of_warm_starts(const std::string& self, int repeats) {
  fmt::print(
      "\nTRMESH on random nodes that have moved since the last call: a call that may begin with the last mesh"
      "\nbeside the same call with PSTRIPACK_WARM_START=0, in turn; the least time of all calls\n\n"
      "{:<18} {:>8} {:>7} {:>9} {:>9} {:>11} {:>9} {:>12}\n",
      "nodes moved by", "N", "threads", "cold us/N", "warm us/N", "cold / warm", "flips/N", "warm calls");
  for (const Row& r : kRows) {
    Times times;
    // A row with a single measured call needs more runs.
    const int runs = std::max(1, r.calls == 1     ? 6 * repeats
                                 : r.n >= 1000000 ? std::min(repeats, 3)
                                                  : repeats);
    for (int run = 0; run < runs; ++run)
      for (const bool warm : {false, true}) run_model(self, r, r.threads, warm, times);
    const double cold = *std::min_element(times.cold.begin(), times.cold.end()),
                 warm = *std::min_element(times.warm.begin(), times.warm.end());
    fmt::print("{:<18} {:>8} {:>7} {:>9.4f} {:>9.4f} {:>11.2f} {:>9.5f} {:>12}\n", r.name, r.n, r.threads,
               1e6 * cold / r.n, 1e6 * warm / r.n, cold / warm,
               times.warm_calls > 0 ? times.flips / times.warm_calls / r.n : 0.0,
               fmt::format("{}/{}", times.warm_calls, times.warm.size()));
    std::fflush(stdout);
  }
}

}  // namespace benchmark
