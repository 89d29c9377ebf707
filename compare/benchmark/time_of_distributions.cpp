#include "time_of_distributions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "beside_random.h"
#include "distributions.h"
#include "point_sets.h"
#include "stage_counts.h"

namespace benchmark {
namespace {

using point_sets::Distribution;

constexpr double kTimeLimit = 60;  // seconds per measurement

struct Size {
  const char* name;
  std::size_t n;
  int most_repeats;
};
constexpr Size kSizes[] = {{"10^4", 10000, 7}, {"10^5", 100000, 5}, {"10^6", 1000000, 3}};

/// Counts in a process of its own; empty if it exceeds the limit.
std::optional<StageCounts> counts_of(const Nodes& nodes) {
  const legacy_stripack::Shared<StageCounts> counts;
  const auto ended = legacy_stripack::run_in_child([&] { counts[0] = stage_counts(nodes.all); }, kTimeLimit);
  if (ended.outcome != legacy_stripack::Outcome::returned) return std::nullopt;
  return counts[0];
}

std::string share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "-" : fmt::format("{:.3f}", static_cast<double>(part) / static_cast<double>(whole));
}

struct Row {
  std::string ratios, times, counts;
  int n = 0;
  double largest = 0;  ///< ratio
  bool above = false;
};

Row measure_row(const Distribution& d, const std::vector<Nodes>& randoms, int repeats) {
  Row row;
  bool goes_on = true;
  for (std::size_t i = 0; i < std::size(kSizes); ++i) {
    const Size& size = kSizes[i];
    std::string ratio = "";
    if (goes_on) {
      const std::vector<pstripack::Point> points = point_sets::make(d.name, size.n);
      if (i == 0) row.n = static_cast<int>(points.size());
      if (points.size() < size.n * 9 / 10) {
        goes_on = false;
        ratio = "few";
      } else {
        const Nodes nodes = with_a_triangle_first(points);
        const BesideRandom b =
            measure_beside_random(nodes, randoms[i], std::min(repeats, size.most_repeats), kTimeLimit);
        row.n = nodes.n();
        if (b.in_time) {
          ratio = fmt::format("{:.2f}", b.ratio());
          row.largest = std::max(row.largest, b.ratio());
          row.times = fmt::format("{:>9.4f} {:>9.4f}", 1e6 * b.own.median(), 1e6 * b.random.median());
          if (const auto c = counts_of(nodes))
            row.counts = fmt::format("{:>9.3f} {:>7} {:>7} {:>7} {:>7}", double(c->asked) / nodes.n(),
                                     share(c->double_double, c->asked), share(c->integers, c->asked),
                                     share(c->big_integers, c->asked), share(c->tie_rule, c->asked));
        } else {
          goes_on = false;
          ratio = fmt::format("> {:g} s", kTimeLimit);
          row.above = true;
        }
      }
    }
    row.ratios += fmt::format("{:>8}", ratio);
  }
  row.above = row.above || row.largest > d.limit;
  return row;
}

std::vector<Distribution> chosen(const std::vector<std::string>& only) {
  const auto& all = point_sets::distributions();
  if (only.empty()) return all;
  std::vector<Distribution> some;
  for (const std::string& name : only) {
    const auto known =
        std::find_if(all.begin(), all.end(), [&](const Distribution& d) { return d.name == name; });
    some.push_back(known != all.end() ? *known : Distribution{name, 4});
  }
  return some;
}

#ifdef _OPENMP
/// The time on `threads` threads over that on one, measured in turn in this process, since a forked child has
/// only one thread.
double threads_over_one(const Nodes& nodes, int threads, int repeats) {
  Lists lists(nodes.n());
  const Stripack library = ours();
  const auto seconds_on = [&](int wanted) {
    omp_set_num_threads(wanted);
    return seconds_a_call([&] { library.trmesh(nodes, lists); }, std::max(1, 50000 / nodes.n()));
  };
  Samples one, all;
  while (!all.enough(repeats)) {
    one.add(seconds_on(1));
    all.add(seconds_on(threads));
  }
  return all.median() / one.median();
}
#endif

}  // namespace

void run_distributions_on_threads([[maybe_unused]] const std::vector<std::string>& only,
                                  [[maybe_unused]] int repeats) {
#ifdef _OPENMP
  constexpr double kNoise = 1.05;
  const int threads = omp_get_num_procs();
  fmt::print(
      "\ndistributions: time on {} threads over that on one, in turn; at most 1, marked above {:g}\n\n{:<19}",
      threads, kNoise, "nodes");
  for (const Size& size : kSizes) fmt::print("{:>8}", size.name);
  fmt::print("\n");
  int above = 0;
  for (const Distribution& d : chosen(only)) {
    double largest = 0;
    fmt::print("{:<19}", d.name);
    for (const Size& size : kSizes) {
      const std::vector<pstripack::Point> points = point_sets::make(d.name, size.n);
      if (points.size() < size.n * 9 / 10) break;
      const double ratio =
          threads_over_one(with_a_triangle_first(points), threads, std::min(repeats, size.most_repeats));
      largest = std::max(largest, ratio);
      fmt::print("{:>8.2f}", ratio);
      std::fflush(stdout);
    }
    above += largest > kNoise;
    fmt::print("{}\n", largest > kNoise ? " above" : "");
  }
  fmt::print("{} rows marked\n", above);
#endif
}

void run_time_of_distributions(const std::vector<std::string>& only, int repeats) {
  std::vector<Nodes> randoms;
  for (const Size& size : kSizes) randoms.emplace_back(point_sets::make("random", size.n));
  fmt::print("\ndistributions beside random nodes of the same N, in turn\n\n");
  fmt::print("{:<19}{:^24}{:>7} {:>6}{:>9} {:>19}  {:^41}\n", "", "times random nodes", "", "", "",
             "microseconds a node", "the predicates, at N");
  fmt::print("{:<19}", "nodes");
  for (const Size& size : kSizes) fmt::print("{:>8}", size.name);
  fmt::print("{:>7} {:>6}{:>9} {:>9} {:>9}  {:>9} {:>7} {:>7} {:>7} {:>7}\n", "limit", "", "N", "these",
             "random", "asked/N", "dd", "int", "big", "tie");
  int above = 0;
  double largest = 0;
  const std::vector<Distribution> rows = chosen(only);
  for (const Distribution& d : rows) {
    try {
      const Row row = measure_row(d, randoms, repeats);
      above += row.above;
      largest = std::max(largest, row.largest);
      fmt::print("{:<19}{}{:>7g} {:>6}{:>9} {:>19}  {}\n", d.name, row.ratios, d.limit,
                 row.above ? "above" : "", row.n, row.times, row.counts);
    } catch (const std::exception& e) {
      ++above;
      fmt::print("{:<19} {}\n", d.name, e.what());
    }
    std::fflush(stdout);
  }
  fmt::print(
      "largest {:.2f}; {} of {} rows above their limit\n"
      "> {:g} s: a measurement took longer, larger N are not tried; few: there are fewer nodes than that\n"
      "the predicates: questions a node that floating point in the kernel left open; of these the shares\n"
      "that went on to double-double arithmetic, to integers of fixed size, to big integers, to the tie "
      "rule\n",
      largest, above, rows.size(), kTimeLimit);
}

}  // namespace benchmark
