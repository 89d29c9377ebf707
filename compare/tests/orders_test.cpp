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
