// Nodes of text, OFF and raw doubles: what is read, and what is refused with which words.

#include "files/nodes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "point_sets.h"

namespace files {
namespace {

using Points = std::vector<Point>;

/// A file with these bytes, removed in the end.
class Written {
 public:
  explicit Written(const std::string& bytes) {
    std::ofstream(name_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  ~Written() { std::remove(name_.c_str()); }
  const std::string& name() const { return name_; }

 private:
  std::string name_ = testing::TempDir() + "nodes_test";
};

Nodes read_bytes(const std::string& bytes, const ReadOptions& options = {}) {
  return read(Written(bytes).name(), options);
}

std::string error_of(const std::string& bytes, const ReadOptions& options = {}) {
  try {
    read_bytes(bytes, options);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "no error";
}

void expect_error(const std::string& bytes, const std::string& words, const ReadOptions& options = {}) {
  const std::string error = error_of(bytes, options);
  EXPECT_NE(error.find(words), std::string::npos) << error;
}

ReadOptions with(Container container, Coordinates coordinates, Units units = Units::said_or_unmistakable) {
  ReadOptions options;
  options.container = container;
  options.coordinates = coordinates;
  options.units = units;
  return options;
}

std::string bytes_of(const std::vector<double>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

const ReadOptions kDegrees = with(Container::detected, Coordinates::detected, Units::degrees);
const ReadOptions kRadians = with(Container::detected, Coordinates::detected, Units::radians);

TEST(text, nodes_know_their_lines) {
  const Nodes nodes = read_bytes("# comment\n0 90\n\n90, 0 ! east\n");
  EXPECT_EQ(nodes.points, (Points{{0, 0, 1}, {0, 1, 0}}));
  EXPECT_EQ(nodes.place(1), "node 2 (line 4)");
}

TEST(text, angles_that_may_be_radians_must_be_said) {
  const std::string small = "0 0\n0.5 0.25\n6.28 -1.57\n";
  expect_error(small, "may be degrees or radians: say --units");
  EXPECT_EQ(read_bytes(small, kDegrees).points[1], point_sets::from_degrees(0.5, 0.25));
  const Point p = read_bytes(small, kRadians).points[1];
  EXPECT_NEAR(p.y, std::cos(0.25) * std::sin(0.5), 1e-16);
  EXPECT_EQ(read_bytes(small + "0 1.58\n").kind, "text, lon lat in degrees");
  EXPECT_EQ(read_bytes(small + "6.29 0\n").kind, "text, lon lat in degrees");
}

TEST(text, latitudes_beyond_the_pole_are_refused_with_line_and_remedy) {
  expect_error("0 0\n45 170\n",
               "node 2 (line 2): latitude 170 is beyond the pole: the columns are 'lon lat'");
  expect_error("0 0\n45 17\n", "--units degrees?", kRadians);
}

TEST(text, coordinates_say_how_many_columns_count) {
  const std::string rows = "10 20 300\n30 40 500\n";
  EXPECT_EQ(read_bytes(rows).points[0], (Point{10, 20, 300}));
  EXPECT_EQ(read_bytes(rows, with(Container::text, Coordinates::lonlat)).points[0],
            point_sets::from_degrees(10, 20));
  expect_error("10 20\n", "--coordinates xyz needs 3", with(Container::text, Coordinates::xyz));
}

TEST(text, a_number_that_is_not_finite_is_refused_with_its_line) {
  expect_error("10 20\nnan 20\n", ":2: 'nan' is not a finite number");
}

TEST(text, values_follow_the_place) {
  ReadOptions options;
  options.with_values = true;
  const Nodes lonlat = read_bytes("90 0 7\n200 10 NaN\n", options);
  EXPECT_EQ(lonlat.points[0], (Point{0, 1, 0}));
  EXPECT_EQ(lonlat.value.numbers[0], 7);
  EXPECT_TRUE(std::isnan(lonlat.value.numbers[1]));
  const Nodes xyz = read_bytes("0 1 0 7\n1 0 0 8\n", options);
  EXPECT_EQ(xyz.points, (Points{{0, 1, 0}, {1, 0, 0}}));
  EXPECT_EQ(xyz.value.numbers, (std::vector<double>{7, 8}));
  expect_error("90 0 inf\n", "'inf' is not a finite number", options);
  expect_error("nan 0 1\n", "node 1 (line 1): its place is 'nan'", options);
  options.coordinates = Coordinates::lonlat;
  options.variable = "4";
  EXPECT_EQ(read_bytes("90 0 7 8\n", options).value.numbers[0], 8);
  for (const char* const column : {"2", "5", "3.5", "-1"}) {
    options.variable = column;
    expect_error("90 0 7 8\n", "there is no value in column", options);
  }
  options.container = Container::raw;
  expect_error("x", "values are read from text and NetCDF only", options);
}

TEST(raw_doubles, are_read_when_said_and_checked) {
  const ReadOptions xyz = with(Container::raw, Coordinates::xyz);
  EXPECT_EQ(read_bytes(bytes_of({1, 0, 0, 0, 1, 0}), xyz).points, (Points{{1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(read_bytes(bytes_of({0, 90, 90, 0}), with(Container::raw, Coordinates::lonlat)).points,
            (Points{{0, 0, 1}, {0, 1, 0}}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_error(bytes_of({1, 0, 0, 0, nan, 0}), "node 2: column 2 is not finite", xyz);
  expect_error(bytes_of({1, 0}), "16 bytes are not rows of 3 doubles", xyz);
  expect_error(bytes_of({1, 0, 0}), "raw doubles need --from raw");
  expect_error(bytes_of({1, 0, 0}), "give --coordinates", with(Container::raw, Coordinates::detected));
}

TEST(off, triangles_are_turned_counterclockwise) {
  const std::string text = "OFF\n3 1 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n";
  ReadOptions options;
  EXPECT_EQ(read_bytes(text, options).points.size(), 3u);
  options.with_triangles = true;
  EXPECT_EQ(read_bytes(text, options).triangles, (pstripack::Triangles{{0, 1, 2}}));
  expect_error("OFF\n3 1 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 3\n", "triangle 1: there is no node 3", options);
  expect_error("OFF\n3 1 0\n1 0 0\n0 1 0\n-1 0 0\n3 0 1 2\n", "on one great circle", options);
  expect_error("OFF\n3 1 0\n1 0 0\n0 1 0\n0 0 1\n4 0 1 2 0\n", "face 1: expected 3", options);
  expect_error("OFF\n4 1 0\n1 0 0\n0 1 0\n0 0 1\n", "node 4: expected x y z");
}

TEST(netcdf, is_asked_for_and_not_there) {
  expect_error("1 0 0\n", "not a NetCDF file", with(Container::netcdf, Coordinates::detected));
}

}  // namespace
}  // namespace files
