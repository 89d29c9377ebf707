// stripack-compare: the original STRIPACK and PSTRIPACK on the same nodes, and the reason for every
// difference.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "capi/pstripack.h"
#include "chosen_original.h"
#include "commands.h"
#include "families.h"
#include "mesh_files.h"
#include "number_in.h"
#include "our_calls.h"
#include "pstripack/reading.h"
#include "run_cases.h"
#include "standard_streams.h"

namespace {

using comparison::RunOptions;

/// The command to run; returns the exit code.
using Command = std::function<int()>;

const char* const kDescription =
    R"(Runs the original STRIPACK and PSTRIPACK on the same nodes, checks both results exactly, and explains every
difference.

  stripack-compare run --file nodes.txt                    your nodes
  stripack-compare run --points latlon --n 100000 --plot difference.svg
  stripack-compare run --points all --order shuffled,sorted --precision r8,r4 --timeout 20 --csv all.csv
  stripack-compare run --file nodes.nc --original ./libmystripack.so --junit report.xml
  stripack-compare run --points random --n 1000000 --threads 1,2 --ranks 1,4 --partition bisection,stripes
  stripack-compare record -o calls.rec -- ./model          records the calls of a model
  stripack-compare replay calls.rec                        repeats each of them with the original

`run` is optional. A case is one set of nodes in one order and precision; each runs the original once and
PSTRIPACK in every combination of ABI, threads, ranks and partition. Lists in options have commas: 1,2,4.)";

const char* const kFooter = R"(
Reasons of differences
  exact tie              four nodes exactly in one plane: both diagonals are Delaunay
  within its rounding    the exact determinant is below the rounding error of the original's test
  directions (lengths)   lengths differ from 1: the original used the vectors as given, PSTRIPACK their directions
  the original is wrong  its result fails an exact check
  WE ARE WRONG           none of these: please report it
Verdicts: equal; explained; no result (the original crashed, stopped or exceeded --timeout); WE ARE WRONG.

Exit code: 0 no difference, or each is explained; 1 a difference counts against PSTRIPACK (mesh: the meshes
differ); 2 usage, unreadable input, or a library or MPI that cannot be started.)";

struct MeshOptions {
  std::string a, b;
  double tolerance = 1e-12;
  std::vector<double> seconds;
};

int compare_mesh_files(const MeshOptions& options) {
  const comparison::MeshFiles a = comparison::read_mesh(options.a), b = comparison::read_mesh(options.b);
  const comparison::MeshComparison c = comparison::compare_meshes(a, b);
  const bool points_equal = c.largest_distance <= options.tolerance;
  const bool triangles_equal = c.only_in_a == 0 && c.only_in_b == 0;
  const auto verdict = [](bool equal) { return equal ? "equal" : "DIFFERENT"; };
  const auto name = [](const std::string& prefix) {
    return std::filesystem::path(prefix).filename().string();
  };
  fmt::print("{:<22} {:>14} {:>14}\n", "", name(options.a), name(options.b));
  fmt::print("{:<22} {:>14} {:>14}   {}: largest distance {:.1e}, tolerance {:.0e}\n", "points",
             a.points.size(), b.points.size(), verdict(points_equal), c.largest_distance, options.tolerance);
  fmt::print("{:<22} {:>14} {:>14}   {}: {} only in the first, {} only in the second\n", "triangles",
             a.triangles.size(), b.triangles.size(), verdict(triangles_equal), c.only_in_a, c.only_in_b);
  if (options.seconds.size() == 2)
    fmt::print("{:<22} {:>14.4f} {:>14.4f}   ratio {:.1f}\n", "seconds in trmesh", options.seconds[0],
               options.seconds[1], options.seconds[0] / options.seconds[1]);
  return points_equal && triangles_equal ? comparison::kExplained : comparison::kAgainstUs;
}

std::string footer() {
  std::string text =
      "Families of --points with their default parameter, if any (cap:0.01 gives another; lengths in "
      "radians)\n";
  for (const point_sets::Family& f : point_sets::registry())
    text += fmt::format("  {:<17} {:<12} {}\n", f.name + (f.parameter.empty() ? "" : ":" + f.parameter),
                        f.nodes, f.what);
  return text + kFooter;
}

void add_original_options(CLI::App& app, comparison::OriginalChoice& choice) {
  app.add_option("--original", choice.file, "shared library of your own STRIPACK instead of the one found");
  app.add_option("--original-abi", choice.abi,
                 "its ABI, if it cannot be detected: r8, r4, i8, 8arg, or several as in r4-8arg");
}

void add_run_options(CLI::App& app, RunOptions& options) {
  const auto list = [&](const char* name, auto& values, const char* text) {
    return app.add_option(name, values, text)->delimiter(',')->allow_extra_args(false);
  };
  const auto choice = [&](const char* name, auto& values, const char* text,
                          std::vector<std::string> choices) {
    return list(name, values, text)->check(CLI::IsMember(std::move(choices)).description(""));
  };
  list("--points", options.points, "families, see below; `all`: random to hemisphere-rim; file:PATH");
  list("--file", options.files,
       "all that pstripack reads: text (lines of `lon lat` or `x y z`, tables; - is stdin), NetCDF, GeoJSON, "
       "OFF");
  program::add_reading(app, options.read);
  options.read.lengths_decide = false;
  app.add_option("--n", options.n, "number of nodes of a family [10000]");
  app.add_option("--seed", options.seed, "seed of families and of shuffling [1]");
  choice("--order", options.orders, "given, shuffled, sorted (by z) [given]",
         {"given", "shuffled", "sorted"});
  choice("--precision", options.precisions, "precision of the coordinates: r8, r4 [the original's]",
         {"r8", "r4"});
  choice("--abi", options.abis, "our library: r8, r4, 8arg, i8 [as --precision]", {"r8", "r4", "8arg", "i8"});
  list("--threads", options.threads, "thread counts [1]; fewer than 20000 nodes use one")
      ->check(CLI::Range(1, 4096).description(""));
  list("--ranks", options.ranks, "MPI ranks [1], started by pstripack-run")
      ->check(CLI::Range(1, 4096).description(""));
  choice("--partition", options.partitions, "bisection, stripes [bisection]", {"bisection", "stripes"});
  add_original_options(app, options.original);
  app.add_option("--timeout", options.timeout, "processor seconds after which the original is stopped [120]")
      ->check(number_in(1e-6, 1e9));
  app.add_option("--repeats", options.repeats,
                 "number of calls (fewer above 10 s); their median time is shown [3]")
      ->check(CLI::Range(1, 1000).description(""));
  app.add_option("--show", options.show, "number of differences described per reason [5; several cases: 0]");
  app.add_option("--plot", options.plot, "draw the described differences to FILE.svg");
  app.add_option("--json", options.json, "write everything to this file");
  app.add_option("--csv", options.csv, "write one row per call of ours");
  app.add_option("--junit", options.junit,
                 "write JUnit XML: one test per case, which fails if it counts against us");
}

void add_mesh(CLI::App& app, MeshOptions& options, Command& chosen) {
  CLI::App* const mesh = app.add_subcommand("mesh", "compare two meshes that scvt_legacy wrote");
  mesh->add_option("A", options.a, "prefix of A_points.txt and A_triangles.txt")->required();
  mesh->add_option("B", options.b, "prefix of the other mesh")->required();
  mesh->add_option("--tolerance", options.tolerance, "largest distance of equal points")
      ->check(number_in(0, 1e300))
      ->capture_default_str();
  mesh->add_option("--seconds", options.seconds, "seconds in trmesh of A and of B, for the table")
      ->expected(2);
  mesh->callback([&] { chosen = [&] { return compare_mesh_files(options); }; });
}

void add_lists(CLI::App& app, comparison::ListsOptions& options, Command& chosen) {
  CLI::App* const lists = app.add_subcommand("lists", "compare the LIST, LPTR, LEND of two files");
  lists->footer(R"(a file
  a recording of PSTRIPACK_CHECK=FILE, or text, for each call: N and LNEW, then LIST(1..LNEW-1),
  LPTR(1..LNEW-1) and LEND(1..N), as WRITE(10,*) N,LNEW ... makes it. Calls are compared in their order.

exit code
  0  every call has the same triangles in both files (--bytes: the same bytes)
  1  they differ
  2  usage error or unreadable input)");
  lists->add_option("A", options.a, "file")->required();
  lists->add_option("B", options.b, "file")->required();
  lists->add_flag("--bytes", options.bytes, "the lists must be the same bytes, not only the same triangles");
  lists->callback([&] { chosen = [&] { return comparison::compare_lists(options); }; });
}

void add_record(CLI::App& app, comparison::RecordOptions& options, Command& chosen) {
  CLI::App* const record = app.add_subcommand("record", "run a model and record its calls of TRMESH");
  record->footer(
      "The model runs with PSTRIPACK_CHECK=FILE, and its exit code is that of this program.\n"
      "  stripack-compare record -o calls.rec -- ./model arguments\n"
      "  stripack-compare replay calls.rec");
  record->add_option("-o,--output", options.file, "the recording; replaces an older one")
      ->capture_default_str();
  record->add_option("command", options.command, "-- program and its arguments")->required();
  record->callback([&] { chosen = [&] { return comparison::record(options); }; });
}

void add_replay(CLI::App& app, comparison::ReplayOptions& options, Command& chosen) {
  CLI::App* const replay = app.add_subcommand("replay", "run recorded calls again, explain every difference");
  replay->footer(R"(A recording is made by PSTRIPACK_CHECK=FILE ./model or by stripack-compare record. With
PSTRIPACK_CHECK=lib:ORIGINAL[,abi=ABI][,timeout=SECONDS][,show=K][,log=FILE] this runs while the model runs.

exit code
  0  no difference, or every difference is explained
  1  a difference counts against PSTRIPACK (--library: other bytes than recorded)
  2  usage error or unreadable input)");
  replay->add_option("FILE", options.file, "the recording, - for stdin")->required();
  add_original_options(*replay, options.original);
  replay
      ->add_option("--library", options.library,
                   "instead of an original, a libstripack of PSTRIPACK: it must give the recorded bytes")
      ->excludes("--original");
  replay
      ->add_option("--timeout", options.timeout,
                   "processor seconds of each call after which the original is stopped")
      ->check(number_in(1e-6, 1e9))
      ->capture_default_str();
  replay->add_option("--show", options.show, "largest number of differences of each kind printed per call")
      ->capture_default_str();
  replay->add_option("--json", options.json_file, "write the results to this file as well");
  replay->callback([&] { chosen = [&] { return comparison::replay(options); }; });
}

}  // namespace

int main(int argc, char** argv) {
  fill_standard_streams();
  RunOptions options;
  MeshOptions mesh_options;
  comparison::ListsOptions lists_options;
  comparison::RecordOptions record_options;
  comparison::ReplayOptions replay_options;
  CLI::App app(kDescription, "stripack-compare");
  app.footer(footer);
  app.set_version_flag("--version", std::string("stripack-compare ") + pstripack_version());
  add_run_options(app, options);
  CLI::App* const run = app.add_subcommand("run", "compare the libraries");
  add_run_options(*run, options);
  const Command run_all = [&] { return comparison::run(options); };
  Command chosen = run_all;  // `run` is the default command
  run->callback([&] { chosen = run_all; });
  add_mesh(app, mesh_options, chosen);
  add_lists(app, lists_options, chosen);
  add_record(app, record_options, chosen);
  add_replay(app, replay_options, chosen);

  try {
    if (argc == 3 && argv[1] == std::string(comparison::kCallCommand))
      return comparison::call_trmesh(argv[2]);
    app.parse(argc, argv);
    const int code = chosen();
    expect_printed();
    return code;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return after_help("stripack-compare", app.exit(e));  // --help, --version
    std::fprintf(stderr, "stripack-compare: %s\n", e.what());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "stripack-compare: out of memory\n");
  } catch (const std::exception& e) {
    std::fprintf(stderr, "stripack-compare: %s\n", e.what());
  }
  return comparison::kUsage;
}
