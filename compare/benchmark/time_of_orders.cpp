#include "time_of_orders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contenders.h"
#include "measuring.h"
#include "orders.h"
#include "pstripack.h"

namespace benchmark {
namespace {

constexpr double kLimit = 1.5;  // times random order

struct Row {
  std::string family, order;
};

const std::vector<Row> kRows{
    // orders
    {"random", "x"},
    {"random", "latitude"},
    {"random", "southward"},
    {"random", "rows"},
    {"random", "columns"},
    {"random", "morton"},
    {"random", "hilbert"},
    {"random", "ends"},
    // grids, as they are numbered
    {"fibonacci", "given"},
    {"latlon", "given"},
    {"reduced-gaussian", "given"},
    {"healpix", "given"},
    {"cubed-sphere", "given"},
    {"icosahedral", "given"},
    {"tripolar", "given"},
    {"ring", "given"},
    // densities
    {"variable:1e4", "given"},
    {"variable:1e6", "given"},
    {"variable:1e6", "latitude"},
    {"clusters:1e-3", "given"},
    {"clusters:1e-7", "given"},
    {"clusters:1e-7", "latitude"},
    {"dense-cap:1e-5", "given"},
    {"dense-cap:1e-7", "given"},
    {"dense-cap:1e-7", "latitude"},
    {"hemisphere", "given"},
    {"hemisphere-rim", "given"},
    {"cap:0.01745", "given"},
    {"cap:1e-4", "given"},
    {"cap:1e-6", "given"},
    {"cap:1e-6", "latitude"},
    {"box:0.00175", "given"},
    {"antipodal:0.1", "given"},
    {"antipodal:1e-6", "given"},
    {"strip:1e-9", "given"},
    {"tee:1e-8", "given"},
    {"pairs:1e-10", "given"},
};

/// Where the first three nodes are collinear, TRMESH returns at once: another node takes the third's place.
Nodes nodes_of(const Row& row, int n) {
  std::vector<pstripack::Point> points = nodes_in_order(row.family, static_cast<std::size_t>(n), row.order);
  for (std::size_t other = points.size(); other > 3; --other) {
    const Nodes nodes(points);
    Lists lists(nodes.n());
    if (pstripack_trmesh(nodes.n(), nodes.x.data(), nodes.y.data(), nodes.z.data(), lists.list.data(),
                         lists.lptr.data(), lists.lend.data(), &lists.lnew) != -2)
      return nodes;
    std::swap(points[2], points[other - 1]);
  }
  throw std::runtime_error("all nodes are collinear");
}

double seconds_a_node(const Nodes& nodes) {
  const double seconds = measured([&] {
    Lists lists(nodes.n());
    const Stripack library = ours();
    return seconds_a_call([&] { library.trmesh(nodes, lists); }, std::max(1, 200000 / nodes.n()));
  });
  return seconds / nodes.n();
}

}  // namespace

void run_time_of_orders(int n, int repeats) {
  fmt::print("\nany order and density beside random nodes in random order, in turn: at most {:g}\n\n",
             kLimit);
  fmt::print("{:<17} {:<10} {:>8} {:>20} {:>7}\n{:<17} {:<10} {:>8} {:>9} {:>10} {:>7}\n", "", "", "",
             "microseconds a node", "", "nodes", "order", "N", "these", "random", "ratio");
  const Nodes random(nodes_in_order("random", static_cast<std::size_t>(n), "given"));
  double largest = 0;
  for (const Row& row : kRows) {
    const Nodes nodes = nodes_of(row, n);
    Samples own, randoms;
    while (!own.enough(repeats) || !randoms.enough(repeats)) {
      own.add(seconds_a_node(nodes));
      randoms.add(seconds_a_node(random));
    }
    const double ratio = own.median() / randoms.median();
    largest = std::max(largest, ratio);
    fmt::print("{:<17} {:<10} {:>8} {:>9.4f} {:>10.4f} {:>7.2f}{}\n", row.family, row.order, nodes.n(),
               1e6 * own.median(), 1e6 * randoms.median(), ratio, ratio > kLimit ? " above" : "");
    std::fflush(stdout);
  }
  fmt::print("largest {:.2f} of {} rows ({:g})\n", largest, kRows.size(), kLimit);
}

}  // namespace benchmark
