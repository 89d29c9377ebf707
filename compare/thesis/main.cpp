// stripe-baseline: the published parallel algorithm, for comparison.
//
//   V. G. Vergara Larrea, Construction of Delaunay Triangulations on the Sphere: A Parallel Approach,
//   thesis, Florida State University.
//
//   1  pick         every process has all nodes, picks those of its stripe of longitude     stripe.h
//   2  triangulate  Lawson's insertion into two huge triangles, location by the history     delaunay_tree.h
//   3  stitch       to the right side of the left neighbour's stripe, Algorithm 5.3         stitch.h
//   4  gather       all triangles at the root
//
// Known weaknesses of the method:
//   - Stitching keeps every triangle of both stripes, even if a node of the other stripe lies in its circle:
//     triangles along borders are not Delaunay.
//   - Stitching tests circles only: where sides are ragged, triangles are inverted.
//   - Sides run from a stripe's southernmost to its northernmost node. The areas around the poles, between
//   these
//     nodes of all stripes, are not covered.
//   - Tests are floating point. Nodes on common great circles, as on a grid, can end up in a wrong triangle.
//   - Removing the huge vertices also removes the flattest triangles along the sides.
//   - Stripes must be narrower than a hemisphere: three or more (the thesis asks for four). From one or two,
//     the nodes surround the huge vertices, and what remains has holes instead of sides.
//   - The depth of the history depends on the order of the nodes; row after row of a grid is a bad order.
//   - Near the poles stripes are narrower than the distance between nodes.
//
// The check (defects.h) is not part of the method.

#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "mpi/mpi_communicator.h"
#include "parallel/cost.h"
#include "parallel/parcels.h"
#include "point_sets.h"
#include "standard_streams.h"
#include "thesis/defects.h"
#include "thesis/stripe.h"
#include "usual_cost.h"

namespace {

using namespace thesis;
using pstripack::MpiCommunicator;
using pstripack::ParallelCost;
using pstripack::PhaseTimer;

struct Options {
  std::string family = "latlon";
  std::size_t n = 100000;
  std::uint64_t seed = 1;
  int repeats = 1;
  bool shuffle = false, check = false;
};

/// Sends `mine` to rank `to`; returns what all ranks have sent to this one, in their order. Collective.
template <class Item>
std::vector<Item> sent_to(int to, MpiCommunicator& ranks, const std::vector<Item>& mine) {
  std::vector<std::vector<Item>> items(static_cast<std::size_t>(ranks.size()));
  items[static_cast<std::size_t>(to)] = mine;
  const pstripack::Parcels here = ranks.exchange(pstripack::packed(items));
  const pstripack::Items<Item> all(here);
  return {all.begin(), all.end()};
}

std::string status_of(const Stripe& stripe, std::size_t nodes) {
  if (!stripe.failure.empty()) return "failed: " + stripe.failure;
  if (nodes == 0) return "open: no nodes in this stripe";
  if (stripe.left.empty()) return "open: the nodes surround the huge vertices, so the stripe has no sides";
  return "";
}

/// The mesh gathered at the root; empty on other ranks. The status says what failed in the first stripe with
/// a failure.
struct Gathered {
  Triangles triangles;
  std::string status;
};

/// The method, on every rank. A rank without memory ends the job.
Gathered run(MpiCommunicator& ranks, const Options& options, const std::vector<Point>& points,
             ParallelCost& cost) noexcept {
  const int rank = ranks.rank(), count = ranks.size();
  Nodes nodes;
  Stripe stripe;
  Gathered all;
  {
    const PhaseTimer timer(&cost, ParallelCost::divide, &ranks);
    nodes = pick(points, rank, count);
    if (options.shuffle) point_sets::shuffle(nodes, options.seed);
  }
  {
    const PhaseTimer timer(&cost, ParallelCost::triangulate, &ranks);
    stripe = triangulate(points, nodes, middle(rank, count));
  }
  {
    const PhaseTimer timer(&cost, ParallelCost::merge, &ranks);
    const Triangles between = stitch(points, sent_to((rank + 1) % count, ranks, stripe.right), stripe.left);
    stripe.triangles.insert(stripe.triangles.end(), between.begin(), between.end());
  }
  {
    const PhaseTimer timer(&cost, ParallelCost::gather, &ranks);
    all.triangles = sent_to(0, ranks, stripe.triangles);
  }
  std::string mine = status_of(stripe, nodes.size());
  if (!mine.empty()) mine += fmt::format(" (process {})\n", rank);
  const std::vector<char> lines = sent_to(0, ranks, std::vector<char>(mine.begin(), mine.end()));
  all.status.assign(lines.begin(), std::find(lines.begin(), lines.end(), '\n'));
  return all;
}

void print(const Options& options, const std::vector<Point>& points, int ranks, const ParallelCost& cost,
           const Gathered& all) {
  const auto row = [](const char* name, const auto& value, const std::string& remark = "") {
    fmt::print("  {:<20} {:>12}   {}\n", name, value, remark);
  };
  fmt::print("stripes of longitude: {}, {} nodes, {} processes, {} order\n", options.family, points.size(),
             ranks, options.shuffle ? "random" : "given");
  fmt::print("milliseconds: processor time of the slowest process\n");
  double path = 0;
  for (const auto& [phase, name] :
       {std::pair(ParallelCost::divide, "pick"), std::pair(ParallelCost::triangulate, "triangulate"),
        std::pair(ParallelCost::merge, "stitch"), std::pair(ParallelCost::gather, "gather")}) {
    row(name, fmt::format("{:.2f}", 1e3 * cost.cpu_seconds[phase]));
    path += cost.cpu_seconds[phase];
  }
  row("path", fmt::format("{:.2f}", 1e3 * path),
      "their sum: the time if every process had its own processor");
  row("triangles", all.triangles.size(),
      fmt::format("of {}, if nodes surround the centre", 2 * points.size() - 4));
  if (options.check) {
    const Defects found = find_defects(points, all.triangles);
    row("inverted triangles", found.inverted);
    row("boundary arcs", found.boundary);
    row("not Delaunay", found.not_delaunay, "arcs, without ties");
    row("ties", found.ties, "arcs; the node is less than 1e-14 above the plane of the other three");
  }
  row("status", "", all.status.empty() ? "ok" : all.status);
}

constexpr const char* kDescription =
    "The published stripe method (Vergara Larrea, Florida State University), for comparison with PSTRIPACK.\n"
    "Run it under mpirun: one stripe of longitude a process.";

void add_options(CLI::App& app, Options& options) {
  app.add_option("--points", options.family, "family of nodes, as in stripack-compare")
      ->capture_default_str();
  app.add_option("--n", options.n, "number of nodes")->capture_default_str();
  app.add_option("--seed", options.seed, "seed of the family, and of --shuffle")->capture_default_str();
  app.add_option("--repeats", options.repeats, "number of calls; their median time is shown")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("--shuffle", options.shuffle,
               "insert the nodes of a stripe in random order instead of the given one");
  app.add_flag("--check", options.check, "count the defects of the mesh exactly");
}

/// The exit code on this rank.
int run_program(int argc, char** argv) {
  constexpr int kUsage = 2;
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const bool is_root = ranks.rank() == 0;
  Options options;
  CLI::App app(kDescription, "stripe-baseline");
  add_options(app, options);
  try {
    app.parse(argc, argv);
    const std::vector<Point> points = point_sets::make(options.family, options.n, options.seed);
    Gathered all;
    std::vector<ParallelCost> calls(static_cast<std::size_t>(options.repeats));
    for (ParallelCost& call : calls) all = run(ranks, options, points, call);
    const ParallelCost cost = usual_cost(ranks, calls).maximum;
    if (is_root) print(options, points, ranks.size(), cost, all);
    expect_printed();
    return 0;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return is_root ? app.exit(e) : 0;  // --help
    if (is_root) fmt::print(stderr, "stripe-baseline: {}\n", e.what());
  } catch (const std::exception& e) {
    if (is_root) fmt::print(stderr, "stripe-baseline: {}\n", e.what());
  }
  return kUsage;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(nullptr, nullptr);
  const int code = run_program(argc, argv);
  MPI_Finalize();
  return code;
}
