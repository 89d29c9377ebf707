#include "time_of_distributions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>
#include <utility>

#include "contenders.h"
#include "distributions.h"
#include "geometry/predicates.h"
#include "measuring.h"
#include "orders.h"
#include "point_sets.h"

namespace benchmark {
namespace {

using legacy_stripack::Outcome;

constexpr double kTimeLimit = 60;  // seconds per measurement

struct Size {
  const char* name;
  std::size_t n;
  int most_repeats;
};
constexpr Size kSizes[] = {{"10^4", 10000, 7}, {"10^5", 100000, 5}, {"10^6", 1000000, 3}};

struct Row {
  std::string family, order = "given";
};

/// TRMESH refuses nodes whose first three are collinear: swaps another node into the third place. Throws
/// std::runtime_error if all nodes are collinear with the first two.
Nodes with_a_triangle_first(std::vector<pstripack::Point> points) {
  for (std::size_t other = points.size(); other > 3; --other) {
    if (pstripack::left(points[0], points[1], points[2]) != 0) return Nodes(points);
    std::swap(points[2], points[other - 1]);
  }
  throw std::runtime_error("all nodes are collinear");
}

/// Seconds of a call of TRMESH a node, in a process of its own; none if it exceeded the time limit.
std::optional<double> seconds_a_node(const Nodes& nodes) {
  const Measurement m = measure(
      [&] {
        return seconds_a_call(Routine::trmesh, ours(), nodes, nullptr, std::max(1, 200000 / nodes.n()));
      },
      kTimeLimit);
  if (m.outcome == Outcome::timed_out) return std::nullopt;
  if (m.outcome != Outcome::returned) throw std::runtime_error("a measurement of TRMESH crashed");
  return m.seconds / nodes.n();
}

/// The time of `nodes` over that of `random`, both measured in turn; none if one exceeded the time limit.
std::optional<double> beside_random(const Nodes& nodes, const Nodes& random, int repeats) {
  Samples own, others;
  while (!own.enough(repeats)) {
    const auto first = seconds_a_node(nodes), second = seconds_a_node(random);
    if (!first || !second) return std::nullopt;
    own.add(*first);
    others.add(*second);
  }
  return own.median() / others.median();
}

/// The ratio at each size, until one takes too long or there are too few nodes.
void print_row(const Row& row, const std::vector<Nodes>& randoms, int repeats) {
  fmt::print("{:<19} {:<9}", row.family, row.order);
  for (std::size_t i = 0; i < std::size(kSizes); ++i) {
    std::fflush(stdout);
    const std::vector<pstripack::Point> points =
        comparison::nodes_in_order(row.family, kSizes[i].n, row.order);
    if (points.size() < kSizes[i].n * 9 / 10) {
      fmt::print("{:>8}", "few");
      break;
    }
    const auto ratio =
        beside_random(with_a_triangle_first(points), randoms[i], std::min(repeats, kSizes[i].most_repeats));
    fmt::print("{:>8}", ratio ? fmt::format("{:.2f}", *ratio) : fmt::format("> {:g} s", kTimeLimit));
    if (!ratio) break;
  }
}

}  // namespace

void run_time_of_distributions(const std::vector<std::string>& only, int repeats) {
  std::vector<Row> rows;
  for (const std::string& family : only) {
    point_sets::make(family, 12);  // throws if there is no such family, before others are measured
    rows.push_back({family});
  }
  if (only.empty()) {
    for (const char* order : {"given", "shuffled", "sorted", "rows"}) rows.push_back({"random", order});
    for (const point_sets::Distribution& d : point_sets::distributions()) rows.push_back({d.name});
  }
  std::vector<Nodes> randoms;
  for (const Size& size : kSizes) randoms.emplace_back(comparison::nodes_in_order("random", size.n, "given"));
  fmt::print("\ntime of TRMESH over that of as many random nodes, in turn\n\n{:<19} {:<9}", "nodes", "order");
  for (const Size& size : kSizes) fmt::print("{:>8}", size.name);
  fmt::print("\n");
  for (const Row& row : rows) {
    try {
      print_row(row, randoms, repeats);
      fmt::print("\n");
    } catch (const std::exception& e) {
      fmt::print(" {}\n", e.what());
    }
  }
  fmt::print(
      "> {:g} s: a measurement took longer, larger N are not tried; few: there are fewer nodes than that\n",
      kTimeLimit);
}

}  // namespace benchmark
