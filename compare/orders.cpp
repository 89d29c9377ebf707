#include "orders.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "point_sets.h"

namespace comparison {
namespace {

using pstripack::Point;

constexpr double kPi = 3.14159265358979323846;

/// Sorts by zone(p), then by longitude.
template <class Zone>
void sort_by(std::vector<Point>& points, const Zone& zone) {
  std::vector<std::pair<std::pair<double, double>, Point>> keyed;
  for (const Point& p : points) keyed.push_back({{zone(p), std::atan2(p.y, p.x)}, p});
  std::stable_sort(keyed.begin(), keyed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::transform(keyed.begin(), keyed.end(), points.begin(), [](const auto& k) { return k.second; });
}

}  // namespace

void put_in_order(std::vector<Point>& points, const std::string& order, std::uint64_t seed) {
  // A grid of about square cells has twice as many columns as rows.
  const double rows = std::sqrt(static_cast<double>(points.size()) / 2);
  if (order == "shuffled")
    point_sets::shuffle(points, seed);
  else if (order == "sorted")
    sort_by(points, [](const Point& p) { return p.z; });
  else if (order == "rows")
    sort_by(points, [rows](const Point& p) { return std::floor(rows * std::asin(p.z) / kPi); });
  else if (order != "given")
    throw std::invalid_argument("unknown order " + order);
}

std::vector<Point> nodes_in_order(const std::string& family, std::size_t n, const std::string& order) {
  std::vector<Point> nodes = point_sets::make(family, n, 1);
  put_in_order(nodes, order, 1);
  return nodes;
}

}  // namespace comparison
