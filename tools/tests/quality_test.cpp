// Reports of a run: the quality of its mesh and the time left.

#include "methods/quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "files/measures.h"
#include "point_sets.h"

namespace methods {
namespace {

TEST(quality, of_an_icosahedron_and_of_a_prolate_octahedron) {
  const double pi = std::acos(-1);
  const Quality regular = quality_of(files::triangulate(point_sets::make("icosahedral", 12)));
  EXPECT_EQ(regular.cells[5], 12U);
  EXPECT_NEAR(regular.smallest_angle, 60, 1e-9);
  EXPECT_NEAR(regular.largest_ratio, 1, 1e-9);
  EXPECT_NEAR(regular.largest_angle, 60, 1e-9);
  EXPECT_EQ(regular.obtuse, 0);
  EXPECT_EQ(
      regular.text(),
      "cells by sides: 5: 12; angles 60.0 to 60.0 degrees; neighbouring areas up to 1.00 : 1; all triangles "
      "hold their circumcentre");

  // Both poles and three nodes on the equator. A cell's corner, equally far from a pole and two nodes on the
  // equator, has tan(latitude) = cos(60 degrees).
  const double h = std::sqrt(3) / 2;
  const Quality bipyramid =
      quality_of(files::triangulate({{0, 0, 1}, {1, 0, 0}, {-0.5, h, 0}, {-0.5, -h, 0}, {0, 0, -1}}));
  EXPECT_EQ(bipyramid.cells[3], 2U);
  EXPECT_EQ(bipyramid.cells[4], 3U);
  EXPECT_EQ(bipyramid.obtuse, 0);
  const double lat = std::atan(0.5);
  const files::Point a{std::cos(lat), 0, std::sin(lat)},
      b{-0.5 * std::cos(lat), h * std::cos(lat), std::sin(lat)},
      c{-0.5 * std::cos(lat), -h * std::cos(lat), std::sin(lat)};
  const double pole = files::triangle_area(a, b, c), lune = (4 * pi - 2 * pole) / 3;
  EXPECT_NEAR(bipyramid.largest_ratio, std::max(pole / lune, lune / pole), 1e-9);
  // A cube cut by diagonals: right angles do not hold their circumcentre strictly.
  const Quality cube = quality_of(files::triangulate(
      {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}, {-1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {-1, -1, -1}}));
  EXPECT_EQ(cube.obtuse, 12);
  EXPECT_EQ(cube.largest_angle, 90);
  EXPECT_NE(cube.text().find("; 12 triangles do not hold their circumcentre"), std::string::npos)
      << cube.text();
  EXPECT_THROW(quality_of(files::triangulate({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})), files::NoMesh);
}

}  // namespace
}  // namespace methods
