// The quality of a mesh; accuracy_test.cpp has its numbers.

#include "methods/quality.h"

#include <gtest/gtest.h>

#include "point_sets.h"

namespace methods {
namespace {

TEST(quality, of_an_icosahedron_and_of_a_cube) {
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
