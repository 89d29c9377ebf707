#include "orders.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "point_sets.h"

namespace benchmark {

using pstripack::Point;

namespace {

void sort_by_rows(std::vector<Point>& nodes) {
  constexpr double kPi = 3.14159265358979323846;
  // A grid of about square cells has twice as many columns as rows.
  const double rows = std::sqrt(static_cast<double>(nodes.size()) / 2);
  struct Placed {
    double row, longitude;
    Point node;
  };
  std::vector<Placed> placed;
  for (const Point& p : nodes)
    placed.push_back({std::floor(std::asin(p.z) / kPi * rows), std::atan2(p.y, p.x), p});
  std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
    return std::tie(a.row, a.longitude) < std::tie(b.row, b.longitude);
  });
  std::transform(placed.begin(), placed.end(), nodes.begin(), [](const Placed& p) { return p.node; });
}

}  // namespace

const std::vector<std::string>& orders() {
  static const std::vector<std::string> names{"given", "shuffled", "latitude", "rows"};
  return names;
}

std::vector<Point> nodes_in_order(const std::string& family, std::size_t n, const std::string& order) {
  std::vector<Point> nodes = point_sets::make(family, n, 1);
  if (order == "shuffled") {
    point_sets::shuffle(nodes, 1);
  } else if (order == "latitude") {
    std::sort(nodes.begin(), nodes.end(), [](const Point& a, const Point& b) { return a.z < b.z; });
  } else if (order == "rows") {
    sort_by_rows(nodes);
  } else if (order != "given") {
    throw std::invalid_argument("there is no order " + order);
  }
  return nodes;
}

}  // namespace benchmark
