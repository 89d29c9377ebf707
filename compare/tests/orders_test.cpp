#include "orders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "point_sets.h"

namespace comparison {
namespace {

using pstripack::Point;
using Points = std::vector<Point>;

Points in_any_order(Points points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  return points;
}

TEST(orders, change_the_order_and_nothing_else) {
  const Points given = point_sets::make("random", 500);
  for (const char* const order : {"given", "shuffled", "sorted", "rows"}) {
    Points points = given;
    put_in_order(points, order, 7);
    EXPECT_EQ(points == given, order == std::string("given")) << order;
    EXPECT_EQ(in_any_order(points), in_any_order(given)) << order;
  }
  EXPECT_THROW(nodes_in_order("random", 10, "alphabetic"), std::invalid_argument);
}

TEST(orders, sorted_is_by_latitude_and_then_by_longitude) {
  Points points{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  put_in_order(points, "sorted", 1);
  EXPECT_EQ(points, (Points{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}));
}

// 1000 nodes are some 22 rows: the longitude restarts some 21 times, and the latitude of the rows increases.
TEST(orders, rows_run_along_the_longitude) {
  const Points nodes = nodes_in_order("random", 1000, "rows");
  int rows = 1;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if (std::atan2(nodes[i].y, nodes[i].x) < std::atan2(nodes[i - 1].y, nodes[i - 1].x)) {
      ++rows;
      EXPECT_GT(nodes[i].z, nodes[i - 1].z);
    }
  EXPECT_NEAR(rows, 22, 3);
}

}  // namespace
}  // namespace comparison
