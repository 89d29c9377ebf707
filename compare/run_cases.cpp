#include "run_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "case_files.h"
#include "json_files.h"
#include "lists/limits.h"
#include "orders.h"
#include "original.h"
#include "picture_of_differences.h"
#include "point_sets.h"
#include "show_result.h"

namespace comparison {
namespace {

using pstripack::Point;

constexpr std::size_t kMostNodes = pstripack::most_nodes<std::int32_t>();

/// The nodes of one case: a family, generated when needed, or a file that has been read.
struct Source {
  std::string name;
  std::vector<Point> read;  ///< the nodes of a file; empty: a family

  std::vector<Point> nodes(const RunOptions& options) const {
    return read.empty() ? point_sets::make(name, options.n, options.seed) : read;
  }
};

/// All sets of nodes. Throws for unreadable files and unknown families before the first case runs.
std::vector<Source> sources_of(const RunOptions& options) {
  std::vector<Source> sources;
  const auto add_file = [&](const std::string& file) {
    sources.push_back(
        {std::filesystem::path(file).filename().string(), files::read(file, options.read).points});
    if (const std::size_t n = sources.back().read.size(); n < 3)
      throw std::runtime_error(
          fmt::format("{}: a triangulation needs at least 3 nodes, here are {}", file, n));
    else if (n > kMostNodes)
      throw std::runtime_error(
          fmt::format("{}: at most {} nodes: 6N-12 must fit a default INTEGER", file, kMostNodes));
  };
  for (const std::string& name : options.points) {
    if (name.rfind("file:", 0) == 0) {
      add_file(name.substr(5));
      continue;
    }
    if (options.n < 3 || options.n > kMostNodes)
      throw std::invalid_argument(fmt::format("--n must be 3 to {}", kMostNodes));
    for (const std::string& family :
         name == "all" ? point_sets::families() : std::vector<std::string>{name}) {
      point_sets::make(family, 3);
      sources.push_back({family, {}});
    }
  }
  for (const std::string& file : options.files) add_file(file);
  if (sources.empty())
    throw std::invalid_argument("give --points FAMILY or --file FILE (--help lists the families)");
  return sources;
}

/// The libraries for nodes of this precision: REAL*8 coordinates need a REAL*8 library, REAL*4 coordinates
/// fit all.
std::vector<std::string> abis_for(const std::string& precision, const RunOptions& options) {
  if (options.abis.empty()) return {precision};
  std::vector<std::string> abis = options.abis;
  if (precision == "r8") abis.erase(std::remove(abis.begin(), abis.end(), "r4"), abis.end());
  if (abis.empty())
    throw std::invalid_argument("--abi r4 takes REAL*4 coordinates: give --precision r4, too");
  return abis;
}

std::vector<std::string> precisions_for(const RunOptions& options,
                                        const legacy_stripack::Original& original) {
  const bool single = original.library().abi().real_bytes == 4;
  if (options.precisions.empty()) return {single ? "r4" : "r8"};
  if (single && std::count(options.precisions.begin(), options.precisions.end(), "r8") > 0)
    throw std::invalid_argument("an original in REAL*4 takes REAL*4 coordinates: give --precision r4");
  return options.precisions;
}

std::vector<OurRun> run_all_settings(const std::vector<Point>& points, const std::vector<std::string>& abis,
                                     const RunOptions& options) {
  std::vector<OurRun> runs;
  for (const std::string& abi : abis)
    for (const int threads : options.threads)
      for (const int ranks : options.ranks)
        for (const std::string& partition : options.partitions)
          runs.push_back(run_ours(points, {abi, threads, ranks, partition}, options.repeats));
  return runs;
}

std::string name_of_case(const Case& one, bool is_family, std::size_t n) {
  std::string name = fmt::format("{}, n = {}", one.nodes, n);
  if (is_family || one.order == "shuffled") name += fmt::format(", seed {}", one.seed);
  if (one.order != "given") name += ", " + one.order;
  if (one.precision == "r4") name += ", REAL*4";
  return name;
}

}  // namespace

ExitCode run(const RunOptions& options) {
  using Clock = std::chrono::steady_clock;
  const std::vector<Source> sources = sources_of(options);
  const auto [original, original_name] = open_original(options.original, options.timeout);
  const std::vector<std::string> precisions = precisions_for(options, original);
  for (const std::string& precision : precisions) abis_for(precision, options);

  const auto json = options.json.empty() ? nullptr : std::make_unique<JsonFile>(options.json);
  const auto csv = options.csv.empty() ? nullptr : std::make_unique<CsvFile>(options.csv);
  const auto junit = options.junit.empty() ? nullptr : std::make_unique<JunitFile>(options.junit);
  const auto plot = options.plot.empty() ? nullptr : std::make_unique<Plot>(options.plot);

  const bool one_case = sources.size() * options.orders.size() * precisions.size() == 1;
  const std::size_t show = options.show.value_or(one_case || plot ? 5 : 1);
  Summary summary;
  if (!one_case) print_header_of_cases();

  for (const Source& source : sources)
    for (const std::string& order : options.orders)
      for (const std::string& precision : precisions) {
        const auto start = Clock::now();
        std::vector<Point> points = source.nodes(options);
        put_in_order(points, order, options.seed);
        if (precision == "r4")
          for (Point& p : points) p = point_sets::rounded_to_single(p);

        legacy_stripack::Triangulation theirs =
            original.triangulate(points, options.timeout, options.repeats);
        Case one{source.name, options.seed, order, precision, {}, 0};
        one.result = compare(points, std::move(theirs), original.epsilon(),
                             run_all_settings(points, abis_for(precision, options), options), show);
        one.result.original_name = original_name;
        one.result.points_name = name_of_case(one, source.read.empty(), points.size());
        one.seconds = std::chrono::duration<double>(Clock::now() - start).count();

        summary.add(one.result);
        if (one_case) {
          print(one.result, points, options.timeout);
        } else {
          print_line(one);
          if (options.show || one.result.against_us()) print_decisions(one.result, points);
        }
        std::fflush(stdout);
        if (csv) csv->add(one);
        if (junit) junit->add(one, options.timeout);
        if (plot) plot->add(one.result, points);
        if (json) json->add(one, options.timeout);
      }

  const ExitCode code = summary.against_us > 0 ? kAgainstUs : kExplained;
  if (!one_case)
    fmt::print(
        "\n{} cases: {} equal, {} with every difference explained, {} without a result of the original, "
        "{} against PSTRIPACK\n",
        summary.cases, summary.equal, summary.explained, summary.no_result, summary.against_us);
  if (junit) junit->write();
  if (plot && plot->rows() > 0) plot->write();
  if (plot && plot->rows() == 0)
    fmt::print("plot       no difference to draw: {} not written\n", options.plot);
  if (json) json->write_cases(summary, code);
  return code;
}

}  // namespace comparison
