#include "mesh_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

namespace comparison {
namespace {

std::string write(const std::string& name, const std::string& points, const std::string& triangles) {
  const std::string prefix = testing::TempDir() + "mesh_files_test_" + name;
  std::ofstream(prefix + "_points.txt") << points;
  std::ofstream(prefix + "_triangles.txt") << triangles;
  return prefix;
}

const char* const kPoints = "1 0 0\n0 1 0\n0 0 1\n-1 -1 -1\n";
const char* const kTriangles = "1 2 3\n1 4 2\n2 4 3\n3 4 1\n";

TEST(mesh_files, are_equal_whatever_the_order_of_triangles_and_corners) {
  const MeshFiles a = read_mesh(write("a", kPoints, kTriangles));
  const MeshFiles b = read_mesh(write("b", kPoints, "4 1 3\n3 1 2\n3 2 4\n2 1 4\n"));
  const MeshComparison c = compare_meshes(a, b);
  EXPECT_EQ(c.largest_distance, 0);
  EXPECT_EQ(c.only_in_a, 0u);
  EXPECT_EQ(c.only_in_b, 0u);
}

TEST(mesh_files, that_differ_are_measured) {
  const MeshFiles a = read_mesh(write("c", kPoints, kTriangles));
  const MeshFiles b = read_mesh(write("d", "1 0 0\n0 1 0\n0 0 1.5\n-1 -1 -1\n", "1 2 3\n1 4 2\n2 3 4\n"));
  const MeshComparison c = compare_meshes(a, b);
  EXPECT_EQ(c.largest_distance, 0.5);
  EXPECT_EQ(c.only_in_a, 2u);
  EXPECT_EQ(c.only_in_b, 1u);
}

TEST(mesh_files, that_cannot_be_read_are_refused) {
  EXPECT_THROW(read_mesh("/no/such/mesh"), std::runtime_error);
  EXPECT_THROW(read_mesh(write("e", kPoints, "1 2 5\n")), std::runtime_error);
  EXPECT_THROW(read_mesh(write("f", kPoints, "1 2\n")), std::runtime_error);
  EXPECT_THROW(read_mesh(write("g", kPoints, "1 2 3 4\n")), std::runtime_error);
}

}  // namespace
}  // namespace comparison
