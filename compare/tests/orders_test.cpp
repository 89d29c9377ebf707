#include "benchmark/orders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace {

using pstripack::Point;

std::vector<Point> sorted(std::vector<Point> nodes) {
  std::sort(nodes.begin(), nodes.end(),
            [](const Point& a, const Point& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  return nodes;
}

TEST(Orders, AreOrdersOfTheSameNodes) {
  const auto given = benchmark::nodes_in_order("random", 1000, "given");
  for (const std::string& order : benchmark::orders()) {
    const auto nodes = benchmark::nodes_in_order("random", 1000, order);
    EXPECT_EQ(sorted(nodes), sorted(given)) << order;
    EXPECT_EQ(nodes == given, order == "given") << order;
  }
}

TEST(Orders, LatitudeGoesFromSouthToNorth) {
  const auto nodes = benchmark::nodes_in_order("random", 1000, "latitude");
  EXPECT_TRUE(
      std::is_sorted(nodes.begin(), nodes.end(), [](const Point& a, const Point& b) { return a.z < b.z; }));
}

TEST(Orders, SouthwardIsLatitudeBackwards) {
  auto nodes = benchmark::nodes_in_order("random", 1000, "southward");
  std::reverse(nodes.begin(), nodes.end());
  EXPECT_EQ(nodes, benchmark::nodes_in_order("random", 1000, "latitude"));
}

TEST(Orders, EndsAlternate) {
  const auto nodes = benchmark::nodes_in_order("random", 1000, "ends");
  for (std::size_t i = 2; i < nodes.size(); ++i)
    EXPECT_EQ(nodes[i].z > nodes[i - 2].z, i % 2 == 0) << i;  // from the south, from the north
}

// On the cylinder (longitude, z), scaled to a unit square: Hilbert's curve goes from cell to cell, Morton's
// jumps.
TEST(Orders, CurvesGoFromNeighbourToNeighbour) {
  constexpr double kPi = 3.14159265358979323846;
  const auto longest_step = [](const std::string& order) {
    const auto nodes = benchmark::nodes_in_order("random", 4000, order);
    double longest = 0;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const auto longitude = [&](std::size_t k) { return std::atan2(nodes[k].y, nodes[k].x) / (2 * kPi); };
      longest =
          std::max(longest, std::hypot(longitude(i) - longitude(i - 1), (nodes[i].z - nodes[i - 1].z) / 2));
    }
    return longest;
  };
  EXPECT_LT(longest_step("hilbert"), 0.15);
  EXPECT_GT(longest_step("morton"), 0.5);
  EXPECT_LT(longest_step("morton"), 1);
}

// 1000 nodes are some 22 rows: the longitude restarts some 21 times, and the latitude of the rows increases.
TEST(Orders, RowsRunAlongTheLongitude) {
  const auto nodes = benchmark::nodes_in_order("random", 1000, "rows");
  int rows = 1;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if (std::atan2(nodes[i].y, nodes[i].x) < std::atan2(nodes[i - 1].y, nodes[i - 1].x)) {
      ++rows;
      EXPECT_GT(nodes[i].z, nodes[i - 1].z);
    }
  EXPECT_NEAR(rows, 22, 3);
}

TEST(Orders, UnknownOnesAreRefused) {
  EXPECT_THROW(benchmark::nodes_in_order("random", 10, "alphabetic"), std::invalid_argument);
}

}  // namespace
