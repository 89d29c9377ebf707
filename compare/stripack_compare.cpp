// stripack-compare: the original STRIPACK and PSTRIPACK on the same nodes, and the reason for every
// difference.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "capi/pstripack.h"
#include "chosen_original.h"
#include "commands.h"
#include "comparison.h"
#include "mesh_files.h"
#include "original.h"
#include "point_sets.h"
#include "show_result.h"

namespace {

using nlohmann::json;
using pstripack::Point;

enum ExitCode { kExplained = 0, kAgainstUs = 1, kUsage = 2 };

const char* const kDescription =
    "Runs the original STRIPACK and PSTRIPACK on the same nodes, checks both results exactly, and gives the\n"
    "reason for every difference.";

const char* const kFooter = R"(reasons
  exact tie              four nodes in one plane exactly: both diagonals are Delaunay
  within its rounding    the exact determinant is smaller than the rounding of the original's own test
  directions (lengths)   lengths differ from 1: the original took them as given, PSTRIPACK the directions
  the original is wrong  an exact check fails in its result
  WE ARE WRONG           none of these: please report it

exit code
  0  no difference, or every difference is explained
  1  a difference counts against PSTRIPACK (`mesh`: the meshes differ)
  2  usage error or unreadable input

examples
  stripack-compare --points random --n 100000 --seed 1 --threads 1,2
  stripack-compare --file nodes.txt --json result.json
  stripack-compare mesh original_run/scvt pstripack_run/scvt)";

struct Options {
  std::string points, file;
  std::size_t n = 10000;
  std::uint64_t seed = 1;
  std::vector<int> threads{1};
  int repeats = 3;
  double timeout = 120;
  std::size_t show = 5;
  std::string json_file;
  comparison::OriginalChoice original;
};

std::vector<Point> nodes_for(const Options& options) {
  if (!options.file.empty()) return point_sets::read(options.file);
  if (options.points.rfind("file:", 0) == 0) return point_sets::read(options.points.substr(5));
  if (options.n < 3) throw std::invalid_argument("--n must be at least 3");
  return point_sets::make(options.points, options.n, options.seed);
}

int compare_libraries(const Options& options) {
  if (options.points.empty() == options.file.empty())
    throw std::invalid_argument("give either --points FAMILY or --file FILE (--help lists the families)");
  const auto [original, original_name] = comparison::open_original(options.original);
  std::vector<Point> points = nodes_for(options);
  if (points.size() < 3)
    throw std::runtime_error(
        fmt::format("a triangulation needs at least 3 nodes, here are {}", points.size()));
  if (points.size() > 357913943)
    throw std::runtime_error("at most 357913943 nodes: 6N-12 must fit a default INTEGER");
  std::ofstream json_out;
  if (!options.json_file.empty()) {
    json_out.open(options.json_file);
    if (!json_out) throw std::runtime_error("cannot write " + options.json_file);
  }

  if (original.library().abi() == legacy_stripack::Abi::r4)
    for (Point& p : points) p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  legacy_stripack::Triangulation theirs = original.triangulate(points, options.timeout, options.repeats);
  std::vector<comparison::OurRun> ours;
  for (const int threads : options.threads)
    ours.push_back(comparison::run_ours(points, threads, options.repeats));
  comparison::Result result =
      comparison::compare(points, std::move(theirs), original.epsilon(), std::move(ours), options.show);
  result.original_name = original_name;
  result.points_name = !options.file.empty()
                           ? fmt::format("{}, n = {}", options.file, result.n)
                           : fmt::format("{}, n = {}, seed {}", options.points, result.n, options.seed);
  const ExitCode code = result.against_us() ? kAgainstUs : kExplained;
  comparison::print(result, points, options.timeout);
  if (json_out.is_open()) {
    json j = comparison::to_json(result, options.timeout);
    j["nodes"]["seed"] = options.seed;
    j["exit_code"] = code;
    if (!(json_out << j.dump(2) << '\n' << std::flush))
      throw std::runtime_error("cannot write " + options.json_file);
  }
  return code;
}

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
  return points_equal && triangles_equal ? kExplained : kAgainstUs;
}

std::string footer_with_families() {
  std::string text = "families of --points (some take a parameter, as cap:0.01), or file:PATH\n ";
  std::size_t column = 2;
  for (const std::string& family : point_sets::families()) {
    if (column + family.size() > 100) text += "\n ", column = 2;
    text += " " + family;
    column += family.size() + 1;
  }
  return text + "\n\n" + kFooter;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  MeshOptions mesh_options;
  CLI::App app(kDescription, "stripack-compare");
  app.footer(footer_with_families);
  app.set_version_flag("--version", pstripack_version());
  app.add_option("--points", options.points, "family of nodes, see below");
  app.add_option("--file", options.file, "nodes from a text file: lines `lon lat` in degrees, or `x y z`");
  app.add_option("--n", options.n, "number of nodes")->capture_default_str();
  app.add_option("--seed", options.seed, "seed of the family")->capture_default_str();
  app.add_option("--threads", options.threads, "thread counts of PSTRIPACK, as 1,2,4")
      ->delimiter(',')
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--repeats", options.repeats, "times are medians of so many calls (fewer above 10 s)")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--timeout", options.timeout, "seconds after which the original is stopped")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--show", options.show, "print at most so many differences of each kind")
      ->capture_default_str();
  app.add_option("--json", options.json_file, "write the result to this file as well");
  comparison::add_original_options(app, options.original);

  CLI::App* mesh = app.add_subcommand("mesh", "compare two meshes that scvt_legacy wrote");
  mesh->add_option("A", mesh_options.a, "prefix of A_points.txt and A_triangles.txt")->required();
  mesh->add_option("B", mesh_options.b, "prefix of the other mesh")->required();
  mesh->add_option("--tolerance", mesh_options.tolerance, "largest distance of equal points")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  mesh->add_option("--seconds", mesh_options.seconds, "seconds in trmesh of A and of B, for the table")
      ->expected(2);

  comparison::Command chosen;
  comparison::add_lists(app, chosen);
  comparison::add_record(app, chosen);
  comparison::add_replay(app, chosen);

  try {
    app.parse(argc, argv);
    if (chosen) return chosen();
    return mesh->parsed() ? compare_mesh_files(mesh_options) : compare_libraries(options);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    std::fprintf(stderr, "stripack-compare: %s\n", e.what());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "stripack-compare: out of memory\n");
  } catch (const std::exception& e) {
    std::fprintf(stderr, "stripack-compare: %s\n", e.what());
  }
  return kUsage;
}
