// stripack-compare: the original STRIPACK and PSTRIPACK on the same nodes, and the reason for every
// difference.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "capi/pstripack.h"
#include "differences.h"
#include "exact.h"
#include "mesh_files.h"
#include "original.h"
#include "our_checks.h"
#include "point_sets.h"

namespace {

using comparison::Cause;
using comparison::Checked;
using comparison::OurRun;
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
  std::string original, abi = "r8";
};

std::vector<Point> nodes_for(const Options& options) {
  if (!options.file.empty()) return point_sets::read(options.file);
  if (options.points.rfind("file:", 0) == 0) return point_sets::read(options.points.substr(5));
  if (options.n < 3) throw std::invalid_argument("--n must be at least 3");
  return point_sets::make(options.points, options.n, options.seed);
}

legacy_stripack::Original find_original(const Options& options, std::string& name) {
  if (!options.original.empty()) {
    name = fmt::format("{} ({})", options.original, options.abi);
    return {options.original, legacy_stripack::abi_named(options.abi)};
  }
  const auto where = legacy_stripack::configured_original();
  if (!where)
    throw std::runtime_error("no original to compare with: this build found none; give --original LIBRARY");
  name = where->name;
  return legacy_stripack::Original(*where);
}

/// The difference between the two error codes; none if they are equal.
struct IerDifference {
  Cause cause;
  std::string text;
};
std::optional<IerDifference> compare_ier(const std::vector<Point>& points, int theirs, const OurRun& ours,
                                         double epsilon) {
  if (theirs == ours.ier) return std::nullopt;
  const std::string both = fmt::format("IER of the original {}, ours {}: ", theirs, ours.ier);
  if (ours.ier == PSTRIPACK_BAD_COORDINATE)
    return IerDifference{Cause::original_wrong, both + "a coordinate is not finite or a vector is zero"};
  if (ours.ier == PSTRIPACK_COLLINEAR || theirs == PSTRIPACK_COLLINEAR) {
    const auto det = comparison::left_test(points[0], points[1], points[2]);
    const std::string text = fmt::format("exact det of nodes 1, 2, 3 is {}, rounding of its LEFT {}",
                                         det.value(), det.bound(epsilon));
    return IerDifference{det.within_rounding(epsilon) ? Cause::rounding : Cause::original_wrong, both + text};
  }
  if (ours.ier > 0)
    return IerDifference{Cause::original_wrong,
                         both + fmt::format("nodes {} and {} coincide, and no earlier two", ours.ier,
                                            comparison::nodes_before_duplicate(points, ours.ier) + 1)};
  return IerDifference{Cause::original_wrong, both + "ours passes every exact check"};
}

/// Everything that is known after both have run.
struct Result {
  std::string points_name, original_name;
  std::size_t n = 0;
  legacy_stripack::Triangulation original;
  Checked original_checked;
  std::vector<OurRun> ours;
  Checked ours_checked;
  std::vector<std::string> broken_promises;
  std::optional<IerDifference> ier;
  bool meshes_compared = false;
  comparison::Differences differences;
  std::vector<pstripack::index_t> original_boundary, our_boundary;

  bool original_returned() const { return original.outcome == legacy_stripack::Outcome::returned; }
  bool against_us() const {
    return !broken_promises.empty() || (ier && ier->cause == Cause::ours_wrong) ||
           differences.of(Cause::ours_wrong).places > 0;
  }
  bool equal() const { return original_returned() && !ier && (!meshes_compared || differences.none()); }
};

// Lengths near 1 are taken as given unless that hides a node, which a valid mesh of the original disproves.
bool used_directions_without_need(const std::vector<Point>& points, const Checked& original,
                                  const Checked& ours) {
  using pstripack::Lengths;
  if (original.nodes == 0 || original.nodes != ours.nodes || !original.verdict || !ours.verdict) return false;
  if (ours.verdict.lengths != Lengths::directions || original.verdict.lengths != Lengths::as_given)
    return false;
  return std::all_of(points.begin(), points.begin() + ours.nodes,
                     [](const Point& p) { return std::fabs(std::hypot(p.x, p.y, p.z) - 1) <= 1e-6; });
}

Result run(const Options& options, std::vector<Point> points, const legacy_stripack::Original& original) {
  Result result;
  result.n = points.size();
  if (original.library().abi() == legacy_stripack::Abi::r4)
    for (Point& p : points) p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};

  result.original = original.triangulate(points, options.timeout, options.repeats);
  for (const int threads : options.threads)
    result.ours.push_back(comparison::run_ours(points, threads, options.repeats));

  const OurRun& first = result.ours.front();
  const auto check = [&](int ier, const auto& lists) {
    return comparison::check(points, ier, lists.list, lists.lptr, lists.lend, lists.lnew);
  };
  result.ours_checked = check(first.ier, first.lists);
  result.broken_promises = comparison::broken_promises(points, first, result.ours_checked);
  for (const OurRun& other : result.ours)
    if (!same_bytes(first, other))
      result.broken_promises.push_back(fmt::format(
          "the result on {} threads is not, byte for byte, that on {}", other.threads, first.threads));

  if (!result.original_returned()) return result;
  result.original_checked = check(result.original.ier, result.original);
  if (used_directions_without_need(points, result.original_checked, result.ours_checked))
    result.broken_promises.push_back(
        "our mesh is that of the directions, although all lengths are within 1e-6 of 1 "
        "and the original's mesh is right for the coordinates as given");
  if (result.broken_promises.empty())
    result.ier = compare_ier(points, result.original.ier, first, original.epsilon());

  result.meshes_compared = result.original.ier == first.ier && result.ours_checked.nodes > 0;
  if (result.meshes_compared) {
    result.original_boundary = comparison::boundary_nodes(result.original_checked.triangles);
    result.our_boundary = comparison::boundary_nodes(result.ours_checked.triangles);
    result.differences = comparison::differences(
        points, {result.original_checked.triangles, result.original_checked.verdict},
        {result.ours_checked.triangles, result.ours_checked.verdict}, original.epsilon(), options.show);
  }
  return result;
}

std::string verdict_of(const Result& result) {
  if (result.against_us()) return "WE ARE WRONG";
  if (!result.original_returned()) return "the original gave no result; ours passes every exact check";
  if (result.equal()) return result.meshes_compared ? "equal" : "equal error codes";
  return "every difference is explained";
}

std::string validity(const Checked& checked) {
  if (checked.nodes == 0) return "no mesh";
  if (checked.verdict) return "valid";
  return fmt::format("NOT VALID ({}): {}", name(checked.verdict.defect), checked.verdict.message);
}

// Differences by tie rule and rounding alone are no reason to call the original's mesh wrong.
std::string validity_of_original(const Result& result) {
  const comparison::Differences& d = result.differences;
  const bool only_small = !d.none() && d.of(Cause::directions).places == 0 &&
                          d.of(Cause::original_wrong).places == 0 && d.of(Cause::ours_wrong).places == 0;
  if (!only_small) return validity(result.original_checked);
  return d.of(Cause::rounding).places > 0 ? "valid but for its rounding" : "valid but for the tie rule";
}

void print(const Result& result, double timeout) {
  fmt::print("nodes      {}\noriginal   {}\npstripack  {}\n\n", result.points_name, result.original_name,
             pstripack_version());
  fmt::print("{:<10} {:>7} {:>8} {:>10} {:>7}  {}\n", "", "threads", "IER", "seconds", "ratio", "result");
  if (result.original_returned())
    fmt::print("{:<10} {:>7} {:>8} {:>10.4g} {:>7}  {}\n", "original", 1, result.original.ier,
               result.original.seconds, "", validity_of_original(result));
  else
    fmt::print("{:<10} {:>7} {:>8} {:>10} {:>7}  {}\n", "original", 1, "-", "-", "",
               describe(result.original, timeout));
  for (const OurRun& ours : result.ours)
    fmt::print(
        "{:<10} {:>7} {:>8} {:>10.4g} {:>7}  {}\n", "pstripack", ours.threads, ours.ier, ours.seconds,
        result.original_returned() ? fmt::format("{:.2f}", result.original.seconds / ours.seconds) : "",
        &ours == &result.ours.front()           ? validity(result.ours_checked)
        : same_bytes(ours, result.ours.front()) ? "same bytes"
                                                : "OTHER BYTES");
  fmt::print("\n");

  if (result.meshes_compared) {
    const comparison::Differences& d = result.differences;
    fmt::print("triangles  {} and {}: {}\n", result.original_checked.triangles.size(),
               result.ours_checked.triangles.size(),
               d.none() ? "equal"
                        : fmt::format("{} only in the original, {} only in ours", d.original_triangles,
                                      d.our_triangles));
    fmt::print("boundary   {} and {} nodes: {}\n", result.original_boundary.size(),
               result.our_boundary.size(),
               result.original_boundary == result.our_boundary ? "equal" : "different");
    if (!d.none()) {
      fmt::print("\n{:<24} {:>8} {:>19} {:>10}\n", "reason of a difference", "places", "arcs: original only",
                 "ours only");
      for (std::size_t c = 0; c < comparison::kCauses; ++c)
        if (d.count[c].places + d.count[c].original_arcs + d.count[c].our_arcs > 0)
          fmt::print("{:<24} {:>8} {:>19} {:>10}\n", name(static_cast<Cause>(c)), d.count[c].places,
                     d.count[c].original_arcs, d.count[c].our_arcs);
    }
  }
  if (result.ier) fmt::print("{}: {}\n", name(result.ier->cause), result.ier->text);
}

void print_decisions(const Result& result, const std::vector<Point>& points) {
  if (!result.differences.decisions.empty()) fmt::print("\n");
  for (const comparison::Decision& d : result.differences.decisions) {
    fmt::print("{}: {}\n", name(d.cause), d.text);
    for (const auto node : d.nodes)
      fmt::print("  node {:<9} {:>24.17g} {:>24.17g} {:>24.17g}\n", node + 1, points[node].x, points[node].y,
                 points[node].z);
  }
  for (const std::string& line : result.broken_promises) fmt::print("WE ARE WRONG: {}\n", line);
  fmt::print("\nverdict    {}\n", verdict_of(result));
}

json to_json(const Checked& checked) {
  json j{{"nodes", checked.nodes}, {"valid", checked.nodes > 0 && checked.verdict}};
  if (checked.nodes > 0) {
    j["defect"] = name(checked.verdict.defect);
    j["message"] = checked.verdict.message;
    j["triangles"] = checked.triangles.size();
  }
  return j;
}

json to_json(const Result& result, const Options& options) {
  json j;
  j["nodes"] = {{"name", result.points_name}, {"n", result.n}, {"seed", options.seed}};
  j["original"] = to_json(result.original_checked);
  j["original"]["name"] = result.original_name;
  j["original"]["outcome"] = describe(result.original, options.timeout);
  if (result.original_returned()) {
    j["original"]["ier"] = result.original.ier;
    j["original"]["seconds"] = result.original.seconds;
  }
  j["pstripack"] = to_json(result.ours_checked);
  j["pstripack"]["version"] = pstripack_version();
  j["pstripack"]["broken_promises"] = result.broken_promises;
  for (const OurRun& ours : result.ours) {
    json run{{"threads", ours.threads},
             {"ier", ours.ier},
             {"seconds", ours.seconds},
             {"same_bytes", same_bytes(ours, result.ours.front())}};
    if (result.original_returned()) run["ratio"] = result.original.seconds / ours.seconds;
    j["pstripack"]["runs"].push_back(run);
  }
  if (result.ier)
    j["ier_difference"] = {{"cause", identifier(result.ier->cause)}, {"text", result.ier->text}};
  if (result.meshes_compared) {
    const comparison::Differences& d = result.differences;
    j["triangles_equal"] = d.none();
    j["boundary_equal"] = result.original_boundary == result.our_boundary;
    j["boundary_nodes"] = {{"original", result.original_boundary.size()},
                           {"pstripack", result.our_boundary.size()}};
    for (std::size_t c = 0; c < comparison::kCauses; ++c)
      j["differences"][identifier(static_cast<Cause>(c))] = {{"places", d.count[c].places},
                                                             {"original_arcs", d.count[c].original_arcs},
                                                             {"our_arcs", d.count[c].our_arcs}};
    j["examples"] = json::array();
    for (const comparison::Decision& decision : d.decisions) {
      json nodes = json::array();
      for (const auto node : decision.nodes) nodes.push_back(node + 1);
      j["examples"].push_back({{"cause", identifier(decision.cause)},
                               {"nodes", nodes},
                               {"text", decision.text},
                               {"determinant", decision.determinant},
                               {"bound", decision.bound}});
    }
  }
  j["verdict"] = verdict_of(result);
  j["exit_code"] = result.against_us() ? kAgainstUs : kExplained;
  return j;
}

int compare_libraries(const Options& options) {
  if (options.points.empty() == options.file.empty())
    throw std::invalid_argument("give either --points FAMILY or --file FILE (--help lists the families)");
  std::string original_name;
  const legacy_stripack::Original original = find_original(options, original_name);
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

  Result result = run(options, points, original);
  result.original_name = original_name;
  result.points_name = !options.file.empty()
                           ? fmt::format("{}, n = {}", options.file, result.n)
                           : fmt::format("{}, n = {}, seed {}", options.points, result.n, options.seed);
  print(result, options.timeout);
  print_decisions(result, points);
  if (json_out.is_open() && !(json_out << to_json(result, options).dump(2) << '\n' << std::flush))
    throw std::runtime_error("cannot write " + options.json_file);
  return result.against_us() ? kAgainstUs : kExplained;
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
  app.add_option("--original", options.original,
                 "shared library of your own STRIPACK instead of the one found");
  app.add_option("--abi", options.abi, "its ABI: r8 (12-argument TRMESH), r4, 8arg")
      ->check(CLI::IsMember({"r8", "r4", "8arg"}))
      ->capture_default_str();

  CLI::App* mesh = app.add_subcommand("mesh", "compare two meshes that scvt_legacy wrote");
  mesh->add_option("A", mesh_options.a, "prefix of A_points.txt and A_triangles.txt")->required();
  mesh->add_option("B", mesh_options.b, "prefix of the other mesh")->required();
  mesh->add_option("--tolerance", mesh_options.tolerance, "largest distance of equal points")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  mesh->add_option("--seconds", mesh_options.seconds, "seconds in trmesh of A and of B, for the table")
      ->expected(2);

  try {
    app.parse(argc, argv);
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
