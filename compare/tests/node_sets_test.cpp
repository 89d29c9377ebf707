#include "node_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <tuple>

#include "families.h"

namespace comparison {
namespace {

using pstripack::Point;
using Points = std::vector<Point>;

Points in_any_order(Points points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  return points;
}

TEST(order, changes_the_order_and_nothing_else) {
  const Points given = point_sets::make("random", 500);
  for (const char* const order : {"given", "shuffled", "sorted"}) {
    Points points = given;
    put_in_order(points, order, 7);
    EXPECT_EQ(points == given, order == std::string("given")) << order;
    EXPECT_EQ(in_any_order(points), in_any_order(given)) << order;
  }
}

TEST(order, sorted_is_by_latitude_and_then_by_longitude) {
  Points points{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  put_in_order(points, "sorted", 1);
  EXPECT_EQ(points, (Points{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}));
}

TEST(rounding_to_single, gives_the_nearest_numbers) {
  Points points{{0.1, -0.25, 1 + 0x1p-24}};
  round_to_single(points);
  EXPECT_EQ(points[0], (Point{0.1f, -0.25, 1}));
}

std::string error_of(const std::string& file) {
  try {
    read_nodes(file);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "no error";
}

TEST(files, are_read_as_pstripack_reads_them) {
  const std::string file = testing::TempDir() + "node_sets_test_text.nc";
  std::ofstream(file) << "1 0 0\n0 1 0\n0 0 1\n";
  EXPECT_EQ(read_nodes(file), (Points{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  std::ofstream(file) << "name;lat;lon\na;0;0\nb;0;90\nc;90;0\n";
  EXPECT_EQ(read_nodes(file), (Points{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  std::ofstream(file) << R"({"type": "MultiPoint", "coordinates": [[0, 0], [90, 0], [0, 90]]})";
  EXPECT_EQ(read_nodes(file), (Points{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  std::ofstream(file) << "0 0\n1 0\n0 1\n";
  EXPECT_NE(error_of(file).find("say --units degrees or --units radians"), std::string::npos);
  files::ReadOptions degrees;
  degrees.units = files::Units::degrees;
  EXPECT_NEAR(read_nodes(file, degrees)[1].y, 0.01745240643728351, 1e-17);
  std::ofstream(file) << "CDF, it says";
  EXPECT_NE(error_of(file).find("NetCDF"), std::string::npos) << error_of(file);
}

}  // namespace
}  // namespace comparison
