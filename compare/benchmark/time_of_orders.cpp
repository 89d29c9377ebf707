#include "time_of_orders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "beside_random.h"
#include "orders.h"

namespace benchmark {
namespace {

constexpr double kLimit = 1.5;       // times random order
constexpr double kTimeLimit = 1800;  // seconds

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

}  // namespace

void run_time_of_orders(int n, int repeats) {
  fmt::print("\nany order and density beside random nodes in random order, in turn: at most {:g}\n\n",
             kLimit);
  fmt::print("{:<17} {:<10} {:>8} {:>20} {:>7}\n{:<17} {:<10} {:>8} {:>9} {:>10} {:>7}\n", "", "", "",
             "microseconds a node", "", "nodes", "order", "N", "these", "random", "ratio");
  const Nodes random(nodes_in_order("random", static_cast<std::size_t>(n), "given"));
  double largest = 0;
  for (const Row& row : kRows) {
    const Nodes nodes =
        with_a_triangle_first(nodes_in_order(row.family, static_cast<std::size_t>(n), row.order));
    const BesideRandom b = measure_beside_random(nodes, random, repeats, kTimeLimit);
    if (!b.in_time) throw std::runtime_error("a measurement crashed or exceeded its time limit");
    const double ratio = b.ratio();
    largest = std::max(largest, ratio);
    fmt::print("{:<17} {:<10} {:>8} {:>9.4f} {:>10.4f} {:>7.2f}{}\n", row.family, row.order, nodes.n(),
               1e6 * b.own.median(), 1e6 * b.random.median(), ratio, ratio > kLimit ? " above" : "");
    std::fflush(stdout);
  }
  fmt::print("largest {:.2f} of {} rows ({:g})\n", largest, kRows.size(), kLimit);
}

}  // namespace benchmark
