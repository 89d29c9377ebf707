// TRMESH of nodes that coincide, or nearly: L of the smallest M, and the lists of the nodes before.

#include <gtest/gtest.h>

#include <cmath>

#include "point_sets.h"
#include "support/expect.h"

namespace {

using point_sets::make;
using pstripack::Point;

/// Expects L of the smallest M, and bit for bit the lists of a call with the nodes 1..M-1.
void expect_duplicate(const Nodes& nodes, int l, std::size_t m) {
  ASSERT_EQ(expected_ier(nodes), l);
  ::testing::internal::CaptureStderr();
  const Mesh mesh = trmesh(nodes);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  ASSERT_EQ(mesh.ier, l);
  const Nodes front(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(m - 1));
  const Mesh alone = trmesh(front);
  ASSERT_TRUE(is_correct(front, alone));
  EXPECT_EQ(mesh.lnew, alone.lnew);
  for (std::size_t i = 0; i < mesh.list.size(); ++i) {
    const bool used = i + 1 < static_cast<std::size_t>(alone.lnew);
    ASSERT_EQ(mesh.list[i], used ? alone.list[i] : untouched) << "slot " << i + 1;
    ASSERT_EQ(mesh.lptr[i], used ? alone.lptr[i] : untouched) << "slot " << i + 1;
  }
  for (std::size_t k = 0; k + 1 < m; ++k) ASSERT_EQ(mesh.lend[k], alone.lend[k]);
}

Nodes with(Nodes nodes, std::size_t l, std::size_t m) {
  nodes[m - 1] = nodes[l - 1];
  return nodes;
}

TEST(Duplicate, IsReported) {
  for (const auto& [l, m] : {std::pair{2, 5}, {1, 4}, {3, 4}, {50, 99}})
    expect_duplicate(with(make("random", 120), static_cast<std::size_t>(l), static_cast<std::size_t>(m)), l,
                     static_cast<std::size_t>(m));
}

TEST(Duplicate, OfABoundaryNodeIsReported) {
  const Nodes nodes = make("hemisphere", 60);
  const Mesh m = trmesh(nodes);
  ASSERT_EQ(m.ier, 0);
  for (std::size_t k = 1; k <= 40; ++k)
    if (m.list[static_cast<std::size_t>(m.lend[k - 1]) - 1] < 0)
      expect_duplicate(with(nodes, k, 50), static_cast<int>(k), 50);
}

TEST(Duplicate, AtTheEndIsReported) {
  for (const std::size_t n : {4, 5, 10, 1000, 30000}) {
    expect_duplicate(with(make("random", n), 1, n), 1, n);
    expect_duplicate(with(make("random", n), n - 1, n), static_cast<int>(n) - 1, n);
  }
}

TEST(Duplicate, TheSmallestOfManyIsReported) {
  Nodes nodes = make("random", 1000);
  for (std::size_t k = 400; k < 1000; k += 3) nodes[k] = nodes[(7 * k) % 399];
  expect_duplicate(nodes, (7 * 400) % 399 + 1, 401);
  nodes = make("random", 1000);
  for (std::size_t k = 500; k < 1000; ++k) nodes[k] = nodes[k - 500];  // the whole set twice
  expect_duplicate(nodes, 1, 501);
  nodes = make("random", 1000);
  for (std::size_t k = 10; k < 1000; ++k) nodes[k] = nodes[9];
  expect_duplicate(nodes, 10, 11);
  nodes = with(make("random", 100), 3, 90);
  nodes[69] = nodes[59];  // 60 == 70 comes before 3 == 90
  expect_duplicate(nodes, 60, 70);
}

TEST(Duplicate, TheSameDirectionWithAnotherLengthIsReported) {
  for (const double scale : {2.0, 0.5, 0x1p-500, 0x1p900}) {
    Nodes nodes = make("random", 50);
    const Point p = nodes[10];
    nodes[30] = scaled(scale, p);
    expect_duplicate(nodes, 11, 31);
  }
  // Lengths that differ by less than 1e-6: without the check for copies one node would only hide the other.
  for (const double scale : {1 + 0x1p-52, 1 - 0x1p-53, 1 + 0x1p-30}) {
    Nodes nodes = make("random", 50);
    nodes[10] = {0, 1, 0};
    nodes[30] = {0, scale, 0};
    expect_duplicate(nodes, 11, 31);
    std::swap(nodes[10], nodes[30]);
    expect_duplicate(nodes, 11, 31);
  }
}

TEST(Duplicate, IsReportedTheSameWithAnyThreads) {
  Nodes nodes = make("random", 50000);
  nodes[40000] = nodes[20000], nodes[45000] = nodes[3], nodes[40001] = nodes[5];
  expect_duplicate(nodes, 20001, 40001);
}

// ---- Near duplicates ----

constexpr double radians = 0.017453292519943295;

/// Rows and columns as simple programs compute them; at the poles cos(90 degrees) = 6e-17.
Nodes naive_grid(int rows, int columns, bool poles, bool seam_twice) {
  Nodes nodes;
  for (int j = poles ? 0 : 1; j <= (poles ? rows : rows - 1); ++j)
    for (int i = 0; i < columns + (seam_twice ? 1 : 0); ++i) {
      const double latitude = (-90 + 180.0 * j / rows) * radians, longitude = 360.0 * i / columns * radians;
      nodes.push_back({std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                       std::sin(latitude)});
    }
  return nodes;
}

TEST(NearDuplicates, PolesAndLongitudesRepeatedAreCorrect) {
  for (const auto& [rows, columns] :
       {std::pair{18, 36}, {3, 3}, {2, 4}, {36, 5}, {11, 9}, {2, 1000}, {180, 360}})
    for (const bool poles : {false, true})
      for (const bool seam_twice : {false, true})
        expect_as_promised_in_any_order(naive_grid(rows, columns, poles, seam_twice),
                                        std::to_string(rows) + " x " + std::to_string(columns), 1);
}

TEST(NearDuplicates, AllNeighboursWithinTwoUlpsAreCorrect) {  // 125 nodes in a cube of five ulps
  for (const Point& centre : {Point{0.6, 0, 0.8}, make("random", 1, 9)[0]}) {
    Nodes nodes;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j)
        for (int k = -2; k <= 2; ++k)
          nodes.push_back({centre.x + i * 0x1p-53, centre.y + j * 0x1p-53, centre.z + k * 0x1p-53});
    point_sets::shuffle(nodes, 3);
    EXPECT_TRUE(is_as_promised(nodes));
    for (const Point& p : make("random", 50)) nodes.push_back(p);
    EXPECT_TRUE(is_as_promised(nodes));
  }
}

TEST(NearDuplicates, PairsAreCorrectAlsoWhereTheSecondOnesAreBehindAllOthers) {
  for (const char* apart : {"1e-5", "1e-7", "1e-8", "1e-9", "1e-10", "1e-11", "1e-13", "1e-15"}) {
    const Nodes nodes = make(std::string("pairs:") + apart, 2000);
    EXPECT_TRUE(is_as_promised(nodes)) << apart;
    Nodes first, second;
    for (std::size_t k = 0; k < nodes.size(); ++k) (k % 2 == 0 ? first : second).push_back(nodes[k]);
    first.insert(first.end(), second.begin(), second.end());
    EXPECT_TRUE(is_as_promised(first)) << apart;
  }
}

}  // namespace
