#include "orders.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "point_sets.h"

namespace benchmark {

using pstripack::Point;

namespace {

constexpr double kPi = 3.14159265358979323846;

template <class Key>
void sort_by(std::vector<Point>& nodes, Key key) {
  std::vector<std::pair<decltype(key(nodes[0])), Point>> keyed;
  for (const Point& p : nodes) keyed.push_back({key(p), p});
  std::stable_sort(keyed.begin(), keyed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::transform(keyed.begin(), keyed.end(), nodes.begin(), [](const auto& k) { return k.second; });
}

}  // namespace

const std::vector<std::string>& orders() {
  static const std::vector<std::string> names{"given", "shuffled", "latitude", "rows"};
  return names;
}

std::vector<Point> nodes_in_order(const std::string& family, std::size_t n, const std::string& order) {
  std::vector<Point> nodes = point_sets::make(family, n, 1);
  // A grid of about square cells has twice as many columns as rows.
  const double rows = std::sqrt(static_cast<double>(nodes.size()) / 2);
  if (order == "shuffled") {
    point_sets::shuffle(nodes, 1);
  } else if (order == "latitude") {
    sort_by(nodes, [](const Point& p) { return p.z; });
  } else if (order == "rows") {
    sort_by(nodes, [rows](const Point& p) {
      return std::make_pair(std::floor(rows * std::asin(p.z) / kPi), std::atan2(p.y, p.x));
    });
  } else if (order != "given") {
    throw std::invalid_argument("unknown order " + order);
  }
  return nodes;
}

}  // namespace benchmark
