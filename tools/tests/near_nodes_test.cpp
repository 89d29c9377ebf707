// Nodes near each other, against all pairs.

#include "files/near_nodes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "point_sets.h"

namespace files {

bool operator==(const Duplicate& a, const Duplicate& b) { return a.node == b.node && a.first == b.first; }

namespace {

using Points = std::vector<Point>;

/// Each node in the place of the earliest kept node within `within`, from all pairs.
std::vector<Duplicate> by_all_pairs(const Points& points, double within) {
  std::vector<std::size_t> kept;
  std::vector<Duplicate> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto first = std::find_if(kept.begin(), kept.end(),
                                    [&](std::size_t k) { return is_near(points[k], points[i], within); });
    if (first == kept.end())
      kept.push_back(i);
    else
      found.push_back({i, *first});
  }
  return found;
}

/// Random nodes, of which the others are within some `size` of eight of them.
Points clusters(double size) {
  point_sets::Random random(3);
  Points points;
  for (int i = 0; i < 400; ++i) points.push_back(random.direction());
  for (std::size_t i = 8; i < 200; ++i) {
    const Point shift = random.direction();
    for (const auto axis : {&Point::x, &Point::y, &Point::z})
      points[i].*axis = points[i % 8].*axis + size * (shift.*axis);
  }
  point_sets::shuffle(points, 4);
  return points;
}

TEST(near_nodes, are_those_of_all_pairs) {
  for (const double size : {1e-14, 1e-9, 1e-4, 0.1, 1.0})
    for (const double within : {0.01 * size, 0.3 * size, size, 3 * size, 1.5}) {
      const Points points = clusters(size);
      if (within >= 1.57) continue;
      EXPECT_EQ(near_duplicates(triangulate(points), within), by_all_pairs(points, within))
          << size << ' ' << within;
    }
  for (const char* const family : {"latlon", "strip", "hemisphere", "comb", "spiral"}) {
    const Points points = point_sets::make(family, 500);
    std::vector<Duplicate> copies = duplicates(points);
    ASSERT_TRUE(copies.empty()) << family;
    for (const double within : {1e-3, 0.05, 0.3, 1.5})
      EXPECT_EQ(near_duplicates(triangulate(points), within), by_all_pairs(points, within))
          << family << ' ' << within;
  }
}

TEST(near_nodes, form_chains_of_which_the_first_and_those_beyond_it_are_kept) {
  Points points;
  for (int i = 0; i < 6; ++i) points.push_back(point_sets::from_degrees(i, 0));
  points.push_back({0, 0, 1});
  EXPECT_EQ(near_duplicates(triangulate(points), 1.5 * std::acos(-1) / 180),
            (std::vector<Duplicate>{{1, 0}, {3, 2}, {5, 4}}));
}

TEST(near_nodes, are_told_apart_at_every_distance) {
  for (const double d : {1e-150, 1e-100, 1e-30, 1e-17, 1e-15, 1e-13, 1e-9, 1e-3, 0.5}) {
    const double angle = std::atan(d);
    for (const double length : {1.0, 3e-200, 7e200}) {
      const Point a{length, 0, 0}, b{length, length * d, 0};
      if (length * d == 0) continue;  // 3e-200 * 1e-150
      EXPECT_TRUE(is_near(a, b, angle * (1 + 1e-14))) << d << ' ' << length;
      EXPECT_FALSE(is_near(a, b, angle * (1 - 1e-14))) << d << ' ' << length;
    }
  }
  EXPECT_FALSE(is_near({1, 0, 0}, {-1, 1e-20, 0}, 1.5));
  EXPECT_TRUE(is_near({1e100, 1e90, 0}, {1e-170, 0, 0}, 1.01e-10));  // the square of 1e-170 is 0
  EXPECT_FALSE(is_near({1e100, 1e90, 0}, {1e-170, 0, 0}, 0.99e-10));
}

TEST(near_neighbours, are_counted_and_the_first_pair_is_named) {
  Points points = point_sets::make("random", 1000);
  EXPECT_EQ(near_neighbours(triangulate(points).lists(), points, kMillimetre).pairs, 0u);
  const auto beside = [&](std::size_t i, std::size_t j, double distance) {
    points[i] = points[j];
    points[i].x += distance;
    points[i] = {2 * points[i].x, 2 * points[i].y, 2 * points[i].z};  // lengths do not matter
  };
  beside(700, 300, 1e-10);
  beside(20, 900, 1e-12);
  beside(5, 60, 1e-9);
  const NearNeighbours found = near_neighbours(triangulate(points).lists(), points, kMillimetre);
  EXPECT_EQ(found.pairs, 2u);
  EXPECT_EQ(found.first, 20u);
  EXPECT_EQ(found.second, 900u);
}

}  // namespace
}  // namespace files
