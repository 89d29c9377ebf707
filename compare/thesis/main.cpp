// stripe-baseline: the published parallel algorithm, for comparison.
//
//   V. G. Vergara Larrea, Construction of Delaunay Triangulations on the Sphere: A Parallel Approach,
//   thesis, Florida State University.
//
//   1  pick         every process has all nodes, picks those of its stripe of longitude     stripe.h
//   2  triangulate  Lawson's insertion into two huge triangles, location by the history     delaunay_tree.h
//   3  stitch       to the right side of the left neighbour's stripe, Algorithm 5.3         stitch.h, ring.h
//   4  gather       all triangles at the root                                               ring.h
//
// Processes wait twice: for the left neighbour before 3, and the root for all processes in 4.
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
// The check and the repair (defects.h) are not part of the method.

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "median.h"
#include "parallel/cost.h"
#include "point_sets.h"
#include "standard_streams.h"
#include "thesis/defects.h"
#include "thesis/ring.h"
#include "thesis/stripe.h"

namespace {

using namespace thesis;
using pstripack::clock_seconds;

struct Options {
  std::string family = "latlon", csv, triangles, owners;
  std::size_t n = 100000;
  std::uint64_t seed = 1;
  int threads = 1, repeats = 1;
  bool shuffle = false, check = false, repair = false;
};

enum Phase { kPick, kTriangulate, kStitch, kGather, kPhases };
constexpr const char* kPhaseNames[] = {"pick", "triangulate", "stitch", "gather"};

/// The times of one call in seconds. `cpu`: processor time of this rank, or of its slowest thread; the
/// others: clock time since all ranks started together.
struct Call {
  double cpu[kPhases] = {}, triangulated = 0, total = 0;
};

/// The mesh gathered at the root; empty on other ranks. `owner`: the rank that made the triangle; -1:
/// stitched.
struct Gathered {
  Triangles triangles;
  std::vector<int> owner;
  TreeCounts counts;
  std::string status;
};

double seconds() { return clock_seconds(CLOCK_MONOTONIC); }
double cpu_seconds() { return clock_seconds(CLOCK_THREAD_CPUTIME_ID); }

std::string status_of(const Stripe& stripe, std::size_t nodes) {
  if (!stripe.failure.empty()) return "failed: " + stripe.failure;
  if (nodes == 0) return "open: no nodes in this stripe";
  if (stripe.left.empty()) return "open: the nodes surround the huge vertices, so the stripe has no sides";
  return "";
}

/// The method, on every rank. The status says what failed in a stripe; a rank without memory ends the job.
Gathered run(const Ring& ring, const Options& options, const std::vector<Point>& points,
             Call& call) noexcept {
  ring.barrier();
  const double start = seconds();
  const auto timed = [&](Phase phase, const auto& work) {
    const double spent = cpu_seconds();
    work();
    call.cpu[phase] += cpu_seconds() - spent;
  };
  const int count = ring.size() * options.threads, first = ring.rank() * options.threads;

  std::vector<Nodes> nodes;
  timed(kPick, [&] {
    nodes = pick(points, first, options.threads, count);
    if (options.shuffle)
      for (Nodes& stripe : nodes) point_sets::shuffle(stripe, options.seed);
  });

  StripeSeconds spent;
  Stripe stripe = triangulate(points, nodes, first, count, spent);
  call.cpu[kTriangulate] = spent.triangulate;
  call.cpu[kStitch] = spent.stitch;
  call.triangulated = seconds() - start;

  const Chain left = ring.from_left(stripe.right);
  timed(kStitch, [&] {
    const Triangles between = stitch(points, left, stripe.left);
    stripe.stitched.insert(stripe.stitched.end(), between.begin(), between.end());
  });

  ring.barrier();  // keeps waiting out of the processor time of gathering
  Gathered all;
  std::vector<std::size_t> patches, stitches;
  timed(kGather, [&] {
    all.triangles = ring.gather(stripe.triangles, patches);
    const Triangles between = ring.gather(stripe.stitched, stitches);
    all.triangles.insert(all.triangles.end(), between.begin(), between.end());
  });
  call.total = seconds() - start;

  std::size_t picked = 0;
  for (const Nodes& n : nodes) picked += n.size();
  const std::string mine = status_of(stripe, picked);
  std::vector<std::size_t> begin;
  const std::vector<char> status = ring.gather(std::vector<char>(mine.begin(), mine.end()), begin);
  for (std::size_t r = 0; r + 1 < begin.size() && all.status.empty(); ++r)
    if (begin[r] < begin[r + 1])
      all.status =
          fmt::format("{} (process {})", std::string(&status[begin[r]], &status[0] + begin[r + 1]), r);
  for (const TreeCounts& c : ring.gather(std::vector<TreeCounts>{stripe.counts}, begin)) all.counts += c;
  for (std::size_t r = 0; r + 1 < patches.size(); ++r)
    all.owner.insert(all.owner.end(), patches[r + 1] - patches[r], static_cast<int>(r));
  all.owner.resize(all.triangles.size(), -1);
  return all;
}

/// For every phase the time of the slowest rank, each rank's time being the median over the calls, as in
/// pstripack-scaling. Collective; counts at the root.
Call slowest(const Ring& ring, const std::vector<Call>& mine) {
  std::vector<std::size_t> begin;
  const std::vector<Call> all = ring.gather(mine, begin);
  Call result;
  for (std::size_t r = 0; r + 1 < begin.size(); ++r) {
    const auto usual = [&](const auto& value) {
      std::vector<double> values;
      for (std::size_t k = begin[r]; k < begin[r + 1]; ++k) values.push_back(value(all[k]));
      return median(values);
    };
    for (int phase = 0; phase < kPhases; ++phase)
      result.cpu[phase] = std::max(result.cpu[phase], usual([&](const Call& c) { return c.cpu[phase]; }));
    result.triangulated = std::max(result.triangulated, usual([](const Call& c) { return c.triangulated; }));
    result.total = std::max(result.total, usual([](const Call& c) { return c.total; }));
  }
  return result;
}

struct Report {
  std::size_t nodes, triangles;
  int ranks;
  Call call;
  std::optional<Expected> expected;
  std::optional<Defects> defects, after;
  std::optional<Repair> repair;
  TreeCounts counts;
  std::string status;
};

void print(const Options& options, const Report& r) {
  const auto row = [](const char* name, const auto& value, const std::string& remark = "") {
    fmt::print("  {:<26} {:>12}   {}\n", name, value, remark);
  };
  const auto ms = [](double s) { return fmt::format("{:.2f}", 1e3 * s); };
  const auto finding = [](const Defects& d) {
    return d.verdict.empty() ? "this is the Delaunay triangulation" : d.verdict;
  };
  fmt::print("stripes of longitude: {}, {} nodes, {} processes x {} threads, {} order\n", options.family,
             r.nodes, r.ranks, options.threads, options.shuffle ? "random" : "given");
  fmt::print("milliseconds: processor time of the slowest process\n");
  double path = 0;
  for (int phase = 0; phase < kPhases; ++phase)
    row(kPhaseNames[phase], ms(r.call.cpu[phase])), path += r.call.cpu[phase];
  row("path", ms(path), "their sum: the time if every thread had a processor of its own");
  row("clock, triangulated", ms(r.call.triangulated), "since the start, of the slowest process");
  row("clock, total", ms(r.call.total));
  const auto per_node = [&](std::size_t count) {
    return fmt::format("{:.1f} a node", static_cast<double>(count) / static_cast<double>(r.nodes));
  };
  row("steps in the history", r.counts.steps, per_node(r.counts.steps));
  row("  rounding left no child", r.counts.rescued, "went on in the one that the point is least outside of");
  row("flips", r.counts.flips, per_node(r.counts.flips));
  row("triangles", r.triangles, r.expected ? fmt::format("of {}", r.expected->triangles) : "");
  if (r.defects) {
    const Defects& d = *r.defects;
    row("non-Delaunay arcs", d.non_delaunay_arcs,
        fmt::format("{} of them ties (less than 1e-14 above the plane of the other three)", d.ties));
    row("inverted triangles", d.inverted);
    row("missing nodes", d.missing_nodes);
    row("arcs with over 2 triangles", d.non_manifold_arcs);
    row("boundary arcs", d.boundary_arcs);
    row("uncovered area", fmt::format("{:.3e}", d.uncovered_area), "steradians");
    row("validator", "", finding(d));
  }
  if (r.repair) {
    row("repair: flips", r.repair->flips, ms(r.repair->cpu_seconds) + " ms at the root");
    row("repair: arcs left", r.repair->stuck, "not Delaunay, and a flip would invert a triangle");
    if (r.after) {
      row("repair: inverted", r.after->inverted, "triangles that are still so");
      row("validator after repair", "", finding(*r.after));
    }
  }
  row("status", "", r.status.empty() ? "ok" : r.status);
}

/// An output file; reports if it cannot be written.
class File {
 public:
  File(const std::string& name, std::ios::openmode mode) : name_(name), out_(name, mode) { check(); }
  std::ofstream& stream() { return out_; }
  void close() { out_.close(), check(); }

 private:
  void check() const {
    if (!out_) throw std::runtime_error("cannot write " + name_);
  }
  std::string name_;
  std::ofstream out_;
};

void append_csv(const Options& options, const Report& r) {
  File file(options.csv, std::ios::app);
  if (file.stream().tellp() == 0)
    fmt::print(
        file.stream(),
        "method,points,n,ranks,threads,triangulate_wall,total_wall,triangulate_cpu_path,stitch_cpu_path,"
        "gather_cpu_path,repair_cpu_path,triangles,expected_triangles,non_delaunay_arcs,uncovered_area,"
        "flips_to_repair,status,ties,inverted,boundary_arcs,missing_nodes,history_steps\n");
  const auto optional = [](bool known, const auto& value) { return known ? fmt::format("{}", value()) : ""; };
  const bool checked = r.defects.has_value(), repaired = r.repair.has_value();
  fmt::print(file.stream(), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},\"{}\",{},{},{},{},{}\n",
             options.shuffle ? "stripes-shuffled" : "stripes", options.family, r.nodes, r.ranks,
             options.threads, r.call.triangulated, r.call.total, r.call.cpu[kPick] + r.call.cpu[kTriangulate],
             r.call.cpu[kStitch], r.call.cpu[kGather],
             optional(repaired, [&] { return r.repair->cpu_seconds; }), r.triangles,
             optional(checked, [&] { return r.expected->triangles; }),
             optional(checked, [&] { return r.defects->non_delaunay_arcs; }),
             optional(checked, [&] { return r.defects->uncovered_area; }),
             optional(repaired, [&] { return r.repair->flips; }), r.status.empty() ? "ok" : r.status,
             optional(checked, [&] { return r.defects->ties; }),
             optional(checked, [&] { return r.defects->inverted; }),
             optional(checked, [&] { return r.defects->boundary_arcs; }),
             optional(checked, [&] { return r.defects->missing_nodes; }), r.counts.steps);
  file.close();
}

void write_triangles(const std::string& name, const Triangles& triangles) {
  File file(name, std::ios::trunc);
  for (const auto& [a, b, c] : triangles) fmt::print(file.stream(), "{} {} {}\n", a + 1, b + 1, c + 1);
  file.close();
}

void write_owners(const std::string& name, const std::vector<Point>& points, const Gathered& all) {
  File file(name, std::ios::trunc);
  fmt::print(file.stream(), "x1,y1,z1,x2,y2,z2,x3,y3,z3,owner\n");
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    for (const index_t v : all.triangles[t]) {
      const Point& p = points[static_cast<std::size_t>(v)];
      fmt::print(file.stream(), "{},{},{},", p.x, p.y, p.z);
    }
    fmt::print(file.stream(), "{}\n", all.owner[t]);
  }
  file.close();
}

void at_the_root(const Options& options, const std::vector<Point>& points, const Ring& ring, const Call& call,
                 Gathered& all) {
  Report r{points.size(), all.triangles.size(), ring.size(), call, {}, {}, {}, {}, all.counts, all.status};
  if (!options.owners.empty()) write_owners(options.owners, points, all);
  if (options.check) {
    r.expected = expected(points);
    r.defects = find_defects(points, all.triangles, r.expected->area);
  }
  if (options.repair) r.repair = repair(points, all.triangles);
  if (options.repair && options.check) r.after = find_defects(points, all.triangles, r.expected->area);
  if (!options.triangles.empty()) write_triangles(options.triangles, all.triangles);
  print(options, r);
  if (!options.csv.empty()) append_csv(options, r);
}

constexpr const char* kDescription =
    "The published stripe method (Vergara Larrea, Florida State University), for comparison with PSTRIPACK.\n"
    "Run it under mpirun: one stripe of longitude a process.";

void add_options(CLI::App& app, Options& options) {
  app.add_option("--points", options.family, "family of nodes, as in stripack-compare")
      ->capture_default_str();
  app.add_option("--n", options.n, "number of nodes")->capture_default_str();
  app.add_option("--seed", options.seed, "seed of the family, and of --shuffle")->capture_default_str();
  app.add_option("--threads", options.threads, "stripes per process, each on its own thread")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--repeats", options.repeats, "number of calls; their median time is shown")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("--shuffle", options.shuffle,
               "insert the nodes of a stripe in random order instead of the given one");
  app.add_flag("--check", options.check, "count the defects of the mesh exactly");
  app.add_flag("--repair", options.repair, "then flip arcs until all are locally Delaunay; holes remain");
  app.add_option("--csv", options.csv, "append one line to this file; a new one gets a header");
  app.add_option("--triangles", options.triangles, "write three node numbers per triangle, after the repair");
  app.add_option(
      "--owners", options.owners,
      "write corners of each triangle and the process that made it, -1: stitched; before the repair");
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int kUsage = 2;
  const Ring ring;
  Options options;
  CLI::App app(kDescription, "stripe-baseline");
  add_options(app, options);
  try {
    app.parse(argc, argv);
    const std::vector<Point> points = point_sets::make(options.family, options.n, options.seed);
    Gathered all;
    std::vector<Call> calls(static_cast<std::size_t>(options.repeats));
    for (Call& call : calls) all = run(ring, options, points, call);
    const Call call = slowest(ring, calls);
    if (ring.is_root()) at_the_root(options, points, ring, call, all);
    expect_printed();
    return 0;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return ring.is_root() ? app.exit(e) : 0;  // --help
    if (ring.is_root()) fmt::print(stderr, "stripe-baseline: {}\n", e.what());
  } catch (const std::exception& e) {
    if (ring.is_root()) fmt::print(stderr, "stripe-baseline: {}\n", e.what());
  }
  return kUsage;
}
