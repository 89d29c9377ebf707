#include "orders.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "geometry/hilbert_curve.h"
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

double latitude(const Point& p) { return p.z; }
double longitude(const Point& p) { return std::atan2(p.y, p.x); }

/// The zone of a value, from 0 to `zones` - 1; `zones` at the upper end.
double zone(double value, double low, double high, double zones) {
  return std::floor((value - low) / (high - low) * zones);
}

/// The cell of a point on the cylinder (longitude, z), which has 2^30 x 2^30 cells of equal area.
std::pair<std::uint32_t, std::uint32_t> cell(const Point& p) {
  constexpr double kSide = 0x1p30;
  const auto within = [](double c) { return static_cast<std::uint32_t>(std::clamp(c, 0.0, kSide - 1)); };
  return {within(zone(longitude(p), -kPi, kPi, kSide)), within(zone(p.z, -1, 1, kSide))};
}

std::uint64_t along_morton(const Point& p) {
  const auto [i, j] = cell(p);
  std::uint64_t key = 0;
  for (int bit = 29; bit >= 0; --bit) key = key << 2 | (i >> bit & 1) << 1 | (j >> bit & 1);
  return key;
}

std::uint64_t along_hilbert(const Point& p) {
  const auto [i, j] = cell(p);
  return pstripack::hilbert::along_curve(i, j, 6);
}

/// First, last, second, last but one ...
void from_both_ends(std::vector<Point>& nodes) {
  std::vector<Point> alternating;
  for (std::size_t first = 0, last = nodes.size(); first < last;) {
    alternating.push_back(nodes[first++]);
    if (first < last) alternating.push_back(nodes[--last]);
  }
  nodes.swap(alternating);
}

}  // namespace

const std::vector<std::string>& orders() {
  static const std::vector<std::string> names{"given", "shuffled", "x",      "latitude", "southward",
                                              "rows",  "columns",  "morton", "hilbert",  "ends"};
  return names;
}

std::vector<Point> nodes_in_order(const std::string& family, std::size_t n, const std::string& order) {
  std::vector<Point> nodes = point_sets::make(family, n, 1);
  // A grid of about square cells has twice as many columns as rows.
  const double rows = std::sqrt(static_cast<double>(nodes.size()) / 2);
  if (order == "shuffled") {
    point_sets::shuffle(nodes, 1);
  } else if (order == "x") {
    sort_by(nodes, [](const Point& p) { return p.x; });
  } else if (order == "latitude") {
    sort_by(nodes, latitude);
  } else if (order == "southward") {
    sort_by(nodes, [](const Point& p) { return -latitude(p); });
  } else if (order == "rows") {
    sort_by(nodes, [rows](const Point& p) {
      return std::make_pair(zone(std::asin(p.z), -kPi / 2, kPi / 2, rows), longitude(p));
    });
  } else if (order == "columns") {
    sort_by(nodes, [rows](const Point& p) {
      return std::make_pair(zone(longitude(p), -kPi, kPi, 2 * rows), latitude(p));
    });
  } else if (order == "morton") {
    sort_by(nodes, along_morton);
  } else if (order == "hilbert") {
    sort_by(nodes, along_hilbert);
  } else if (order == "ends") {
    sort_by(nodes, latitude);
    from_both_ends(nodes);
  } else if (order != "given") {
    throw std::invalid_argument("unknown order " + order);
  }
  return nodes;
}

}  // namespace benchmark
