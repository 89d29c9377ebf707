// Nodes of text, OFF and raw doubles: what is read, what is refused, and the messages.

#include "files/nodes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "error_of.h"
#include "point_sets.h"

namespace files {
namespace {

using Points = std::vector<Point>;

/// A temporary file with these bytes.
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

void expect_error(const std::string& bytes, const std::string& words, const ReadOptions& options = {}) {
  const std::string error = error_of([&] { read_bytes(bytes, options); });
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

TEST(text, radians_nearest_to_a_right_angle_mean_it) {
  const std::string rows =
      "0 1.5707963267948966\n2 -1.5707963267948966\n3.141592653589793 0\n-3.141592653589793 0.5\n"
      "4.71238898038469 0\n6.283185307179586 0\n-12.566370614359172 0\n1.5707963267948966 0\n";
  const Points expected{{0, 0, 1},  {0, 0, -1}, {-1, 0, 0}, {-std::cos(0.5), 0, std::sin(0.5)},
                        {0, -1, 0}, {1, 0, 0},  {1, 0, 0},  {0, 1, 0}};
  EXPECT_EQ(read_bytes(rows, kRadians).points, expected);
  expect_error("lon,lat [rad]\n1,2\n", "latitude 2 is beyond the pole");
  expect_error("lon [deg],lat [rad]\n10,0.5\n",
               ":1: one of longitude and latitude is in degrees, the other in radians: convert one of them");
  EXPECT_EQ(read_bytes("lon [rad],lat [rad]\n1,-1.5707963267948966\n").points, (Points{{0, 0, -1}}));
  EXPECT_EQ(
      read_bytes(bytes_of({2, std::acos(0.0)}), with(Container::raw, Coordinates::lonlat, Units::radians))
          .points,
      (Points{{0, 0, 1}}));
}

TEST(text, other_radians_are_what_they_are) {
  const double right = std::acos(0.0);
  for (const double lat : {std::nextafter(right, 0), std::nextafter(right, 2), 1.5707963, 1.570796327,
                           static_cast<double>(static_cast<float>(right))}) {
    const Point p = read_bytes(fmt::format("0 {}\n", lat), kRadians).points.at(0);
    EXPECT_DOUBLE_EQ(p.x, std::cos(lat)) << lat;
    EXPECT_NE(p.x, 0) << lat;
  }
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

// Stations with the pressure: vectors whose lengths happen to differ by less than a hundredth.
TEST(text, three_columns_without_names_are_vectors_only_if_they_have_one_length_or_cannot_be_angles) {
  ReadOptions options;
  options.with_columns = options.lengths_decide = true;
  const Nodes stations =
      read_bytes("8.5 47.3 1013.2\n6.1 46.2 1012.9\n9.8 46.8 1011.5\n7.4 46.9 1013\n", options);
  EXPECT_EQ(stations.points[0], point_sets::from_degrees(8.5, 47.3));
  EXPECT_EQ(stations.columns.at(0).numbers, (std::vector<double>{1013.2, 1012.9, 1011.5, 1013}));
  for (const char* const rows : {"0.6 0.8 0\n0 0.5999999 0.8\n0 0 0\n", "3822 0 5097\n0 -3824 5096\n"})
    EXPECT_EQ(read_bytes(rows, options).kind, "text, x y z") << rows;
  for (const char* const rows : {"0.577 0.577 0.577\n1 0 0\n", "8.5 47.3 1013.2\n6.1 46.2 1013.1\n"}) {
    expect_error(rows, "may be x y z, of lengths", options);
    ReadOptions said = options;
    said.units = Units::degrees;
    EXPECT_EQ(read_bytes(rows, said).given.lat.size(), 2u);
    said.coordinates = Coordinates::xyz;
    EXPECT_EQ(read_bytes(rows, said).kind, "text, x y z");
  }
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
  expect_error("nan 0 1\n", ":1: 'nan' is not a finite number: remove the row, or say --skip-missing",
               options);
  options.coordinates = Coordinates::lonlat;
  options.variable = "4";
  EXPECT_EQ(read_bytes("90 0 7 8\n", options).value.numbers[0], 8);
  for (const char* const column : {"2", "5", "3.5", "-1"}) {
    options.variable = column;
    expect_error("90 0 7 8\n", column == std::string("2") ? "column 2 is a coordinate" : "there is no column",
                 options);
  }
  options.coordinates = Coordinates::detected;
  options.variable = "3";  // so the first two are lon lat
  EXPECT_EQ(read_bytes("90 0 7 8\n", options).value.numbers[0], 7);
  EXPECT_EQ(read_bytes("90 0 7 8 9\n", options).points, (Points{{0, 1, 0}}));
  options.variable = "3,4";
  expect_error("90 0 7 8\n", "--variable names one column, not '3,4'", options);
  options.container = Container::raw;
  expect_error("x", "values are read from text, NetCDF and GeoJSON only", options);
}

ReadOptions with_columns(const std::string& columns = "") {
  ReadOptions options;
  options.units = Units::degrees;
  options.with_columns = true;
  options.columns = columns;
  return options;
}

std::string names_of(const Columns& columns) {
  std::string names;
  for (const Column& c : columns) names += (names.empty() ? "" : " ") + c.name;
  return names;
}

TEST(tables, longitudes_and_latitudes_stay_as_they_are_given) {
  // None of these longitudes can be computed back from the direction.
  const std::string rows = "30 40\n-179.99999999999997 89.9\n359.7 -0.1\n";
  const Nodes nodes = read_bytes(rows, kDegrees);
  EXPECT_EQ(nodes.given.lon, (std::vector<double>{30, -179.99999999999997, 359.7}));
  EXPECT_EQ(nodes.given.lat, (std::vector<double>{40, 89.9, -0.1}));
  const LonLat back = angles_of(nodes.points, nodes.given, true);
  EXPECT_EQ(back.lon, nodes.given.lon);
  EXPECT_NE(LonLat(nodes.points, true).lon, nodes.given.lon);
  const LonLat radians = angles_of(nodes.points, nodes.given, false);
  EXPECT_NEAR(radians.lon[2], 359.7 * std::acos(0.0) / 90, 1e-15);
  EXPECT_TRUE(read_bytes("1 0 0\n0 1 0\n").given.empty());
}

TEST(tables, have_columns_by_the_names_in_their_header) {
  const std::string mark = "\xEF\xBB\xBF", header = "mag,Latitude,LONGITUDE,depth (km)\n";
  const Nodes nodes = read_bytes(mark + header + "1,0,90,\n 2 ,90, 0 ,nan\n", with_columns());
  EXPECT_EQ(nodes.points, (Points{{0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(nodes.lines, (std::vector<std::size_t>{2, 3}));
  ASSERT_EQ(names_of(nodes.columns), "mag depth");
  EXPECT_EQ(nodes.columns[0].numbers, (std::vector<double>{1, 2}));
  EXPECT_EQ(nodes.columns[1].units, "km");
  EXPECT_TRUE(std::isnan(nodes.columns[1].numbers[0]) && std::isnan(nodes.columns[1].numbers[1]));
  EXPECT_EQ(read_bytes("a b z y x\n7 8 3 2 1\n").points, (Points{{1, 2, 3}}));
  EXPECT_EQ(read_bytes("lon [rad] lat [rad]\n0 1.5\n").kind, "text, lon lat in radians");
  EXPECT_EQ(read_bytes("lon_deg lat_deg\n0 1.5\n").kind, "text, lon lat in degrees");
  EXPECT_EQ(
      names_of(read_bytes("# text of many years\n# lon lat value [K]\n100 20 3\n", with_columns()).columns),
      "value");
}

TEST(tables, are_separated_by_commas_semicolons_tabs_or_blanks) {
  for (const std::string rows : {"90,0,a b\n0,90,\n", "90; 0; a b\n0;90;\n", "90\t0\ta b\n0\t90\t\n"}) {
    ReadOptions options = with_columns();
    options.coordinates = Coordinates::lonlat;
    const Nodes nodes = read_bytes(rows, options);
    EXPECT_EQ(nodes.points, (Points{{0, 1, 0}, {0, 0, 1}})) << rows;
    EXPECT_EQ(nodes.columns.at(0).texts, (std::vector<std::string>{"a b", ""})) << rows;
  }
  EXPECT_EQ(read_bytes("90 \t0\n0\t\t90\n").points.size(), 2u);
  const Nodes quoted = read_bytes("lon,lat,place\n90,0,\"5 km S of \"\"A\"\", #2\"\r\n", with_columns());
  EXPECT_EQ(quoted.columns.at(0).texts.at(0), "5 km S of \"A\", #2");
}

TEST(tables, keep_their_texts) {
  const Nodes nodes = read_bytes(
      "Stations of the network, 2024\n"
      "lon,lat,id,wmo,big,e,depth\n1,2,7,010010,1,1.0E2,1.50\n3,4,007,02,17179869184000001,1E2,NA\n5,"
      "\xE2\x88\x92"
      "6,8,3,2,3,2\n",
      with_columns(""));
  EXPECT_EQ(nodes.given.lat, (std::vector<double>{2, 4, -6}));  // by a minus of typography
  ASSERT_EQ(nodes.columns.size(), 5u);
  for (const std::size_t k : {0, 1, 2, 3}) EXPECT_TRUE(nodes.columns[k].is_text()) << k;
  EXPECT_EQ(nodes.columns[2].texts[1], "17179869184000001");
  EXPECT_EQ(nodes.columns[4].numbers[0], 1.5);
  EXPECT_EQ(nodes.columns[4].texts, (std::vector<std::string>{"1.50", "NA", "2"}));
}

TEST(tables, may_have_fixed_widths_and_said_separators) {
  const Nodes fixed =
      read_bytes("ACW 17.11  -61.78 FORT #2\nAE  25.33   55.51 HO!\n\n", with_columns("11-17,4-9,1-3,19-30"));
  EXPECT_EQ(fixed.given.lon, (std::vector<double>{-61.78, 55.51}));
  EXPECT_EQ(fixed.columns.at(1).texts, (std::vector<std::string>{"FORT #2", "HO!"}));
  ReadOptions options = with_columns("4,3,1");
  options.text = {'\t', false};
  const Nodes geonames = read_bytes("x \"y! #\t\t42.5\t1.5\n\"z\t\t43\t2\n", options);
  EXPECT_EQ(geonames.given.lon, (std::vector<double>{1.5, 2}));
  EXPECT_EQ(geonames.columns.at(0).texts, (std::vector<std::string>{"x \"y! #", "\"z"}));
  // A table, no grid of ADCIRC, whose second line has two numbers.
  EXPECT_EQ(read_bytes("lon lat a b\n5 4 3 2\n1 2 3 4\n9 9 9 9\n", with_columns("")).given.lon.at(1), 1);
  EXPECT_EQ(read_bytes("lat,lon,lon,lat,v\n1,2,3,4,5\n", with_columns("2,1,4,3,5")).given.lon.at(0), 2);
}

TEST(tables, begin_rows_with_errors_of_spreadsheets) {
  for (const std::string rows : {"lon,lat,v\n#N/A,40,1\n100,50,#N/A\n", "#N/A 40 1\n100 50 #DIV/0!\n",
                                 "#VALUE!;40;1\n100;50;#N/A\n"}) {
    ReadOptions options = with_columns("1,2,3");
    expect_error(rows, "' is not a finite number: remove the row, or say --skip-missing", options);
    options.keep_missing = true;
    const Nodes nodes = read_bytes(rows, options);
    ASSERT_EQ(nodes.points.size(), 2u) << rows;
    EXPECT_TRUE(std::isnan(nodes.points[0].x) && std::isnan(nodes.columns.at(0).numbers.at(1))) << rows;
  }
}

TEST(tables, keep_columns_of_one_name) {
  EXPECT_EQ(names_of(read_bytes("lon,lat,v,v\n100,2,3,4\n", with_columns()).columns), "v v_given");
}

TEST(tables, have_comments_and_segments) {
  const Nodes nodes =
      read_bytes("% by GMT\n> first\n100 0 # here\n  ! none\n101 0\n> second\n102 0\n", with_columns());
  EXPECT_EQ(nodes.lines, (std::vector<std::size_t>{3, 5, 7}));
  ASSERT_EQ(names_of(nodes.columns), "segment");
  EXPECT_EQ(nodes.columns[0].numbers, (std::vector<double>{1, 1, 2}));
}

TEST(tables, have_columns_that_are_chosen) {
  const std::string rows = "7 8 90 0 9\n", named = "a,b,x_lon,x_lat,lon,lat\n7,8,90,0,1,1\n";
  EXPECT_EQ(read_bytes(rows, with_columns("3,4,1")).points, (Points{{0, 1, 0}}));
  EXPECT_EQ(names_of(read_bytes(rows, with_columns("3,4,1")).columns), "column1");
  EXPECT_EQ(read_bytes(named, with_columns("x_lon,x_lat,b")).points, (Points{{0, 1, 0}}));
  EXPECT_EQ(names_of(read_bytes(named, with_columns("X_LON,x_lat,2")).columns), "b");
  EXPECT_EQ(read_bytes("lat,lon,mag\n0,90,1\n", with_columns("mag,lat,lon")).points, (Points{{0, 1, 0}}));
  ReadOptions value = with_columns("3,4,5");
  value.with_values = true;
  EXPECT_EQ(read_bytes(rows, value).value.numbers.at(0), 9);
  value.columns.clear();
  value.variable = "b";
  EXPECT_EQ(read_bytes(named, value).value.numbers.at(0), 8);
}

TEST(tables, that_cannot_be_used_are_refused_with_line_reason_and_remedy) {
  const auto refused = [](const std::string& bytes, const std::string& words,
                          const std::string& columns = "") {
    expect_error(bytes, words, with_columns(columns));
  };
  refused("lon,lat\n", ":1: a header line, and no row of numbers after it: add the nodes");
  refused("lon lat\ndegrees degrees\n1 2\n",
          ":2: a second header line, after the one in line 1: remove one of them");
  refused("lon,lat\n1,2\nlon,lat\n", ":3: the header line again: remove it");
  refused("lon,lat,mag\n1,2,3\n1 2 3\n",
          ":3: separated by blanks, the lines before by commas: use one separator");
  refused("lon;lat\n1,2\n", ":2: separated by commas, the lines before by semicolons: use one separator");
  refused("1 2\n3;4\n", ":2: separated by semicolons, the lines before by blanks: use one separator");
  refused("1;2\n3;4,5\n", ":2: '4,5' is not a finite number: write a decimal comma as a point");
  refused("lon,lat,mag\n1,2,3\n1,2\n", ":3: found 2 columns where the header has 3");
  refused("lon,lat,mag\n1,,3\n", ":2: nothing in column 'lat': remove the row");
  refused("lon,lat,a\n1,2,\"x\n", ":2: a double quote without an end");
  refused("lon,mag\n1,2\n", ":1: a column 'lon' without a latitude: name both by --columns LON,LAT");
  refused("a,b\n1,2\n",
          ":1: no columns named lon and lat, or x, y and z: name them by --columns; the header has a, b");
  refused("lon,lat,lon\n1,2,3\n",
          ":1: the header names column 'lon' twice, 1 and 3: choose columns by number");
  refused("lon,lat,mag,mag\n1,2,3,4\n", ":1: the header names column 'mag' twice, 3 and 4", "lon,lat,mag");
  EXPECT_EQ(read_bytes("lon,lat,lon\n1,2,3\n", with_columns("3,2")).given.lon.at(0), 3);
  refused("lon,lat,mag\n1,2,3\n", ":1: there is no column 'magg'; did you mean mag?", "lon,lat,magg");
  refused("lon,lat,mag\n1,2,3\n", ":1: there is no column 4: there are 3", "1,2,4");
  refused("lon,lat,mag\n1,2,3\n", ":1: column 'lon' is chosen twice", "lon,lat,lon");
  refused("1 2 3\n", "the columns have no names: choose them by number, not 'lon'", "lon,lat");
  refused("45N 120W\n", ":1: '45N' is not a finite number: write 45N as 45, 45S as -45, 120W as -120");
  refused("1 2\n45:30 2\n", ":2: '45:30' is not a finite number: write degrees as one decimal number");
  refused("80 100\n20 10\n", "are they exchanged? Then say --columns 2,1");
  refused("lat,mag,lon\n95,1,10\n20,1,30\n", "are they exchanged? Then say --columns 1,3");
  refused("1 2\n3 x\n",
          ":2: 'x' is not a finite number: correct it, remove the row, or choose other --columns");
  refused("10,5\t20,1\n30,1\t40,2\n",
          ":1: '5\\t20' is not a finite number: write a decimal comma as a point");
  refused("lon lat\n10,5 20,1\n",
          ":2: found 4 columns where the header has 2: write a decimal comma as a point");
  refused("5\n1 2\n3 4\n",
          ":1: a single number is the count of the points that follow; there are 2: correct");
  refused("lon,lat\r10,20\r30,40\r", ":1: lines end with CR alone: end them with LF");
  refused(
      "\x1F\x8B\x08"
      "abc",
      ": compressed by gzip: use `gunzip` first");
  refused(std::string("\xFF\xFE") + "1\0 \0", ":1: UTF-16: save the file as UTF-8");
  expect_error("3.1 1.5\n-3 -1.5\n", "latitudes 1.5, as radians do)");
  expect_error("350 1\n", "more than two turns in radians; --units degrees?", kRadians);
}

TEST(nodes, are_kept_with_all_that_belongs_to_them) {
  Nodes nodes = read_bytes("lon,lat,a,b\n10,1,x,1\n20,2,y,2\n30,3,z,3\n", with_columns());
  nodes.density = {7, 8, 9};
  nodes.keep({0, 2});
  EXPECT_EQ(nodes.given.lon, (std::vector<double>{10, 30}));
  EXPECT_EQ(nodes.lines, (std::vector<std::size_t>{2, 4}));
  EXPECT_EQ(nodes.density, (std::vector<double>{7, 9}));
  EXPECT_EQ(nodes.columns.at(0).texts, (std::vector<std::string>{"x", "z"}));
  EXPECT_EQ(nodes.columns.at(1).numbers, (std::vector<double>{1, 3}));
  EXPECT_EQ(nodes.points.at(1), point_sets::from_degrees(30, 3));
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
  expect_error("OFF\n3 1 0\n1 0 0\n0 1 0\n0 0 1\n4 0 1 2 0\n", "face 1: expected a triangle, 3 A B C", options);
  expect_error("OFF\n4 1 0\n1 0 0\n0 1 0\n0 0 1\n", "node 4: expected x y z");
}

TEST(geojson, of_many_levels_is_refused) {
  const std::string deep = std::string(75000, '[') + std::string(75000, ']');
  const std::string point =
      R"({"type": "Feature", "geometry": {"type": "Point", "coordinates": [1, 2]}, "properties": {"a": )";
  for (const std::string& bytes :
       {R"({"type": "FeatureCollection", "features": [)" + point + deep + "}}]}", point + deep + "}}",
        R"({"a": )" + deep + "}", R"({"a": )" + std::string(75000, '[')})
    expect_error(bytes, ": JSON with more than 100 levels of brackets");
  EXPECT_EQ(read_bytes(point + std::string(98, '[') + std::string(98, ']') + "}}").points.size(), 1u);
}

TEST(messages, quote_sixty_characters_of_a_file_without_control_characters) {
  const std::string sixty(60, 'a'), more = sixty + "aaa";
  expect_error("10 " + more + "\n", ":1: '" + sixty + "...' is not a finite number");
  expect_error("10 20\n10 \x7F\xFF\xC2\xB0\n", R"(:2: '\x7f\xff°' is not a finite number)");
  expect_error("lon,lat\n1,\"2\t3\"\n", R"(:2: '2\t3' in column 'lat' is not a finite number)");
  expect_error(more + ",b\n1,2\n", "the header has " + sixty + "..., b");
  expect_error(R"({"type": "Fea\u0007\n)" + more + "\"}",
               R"(the type is 'Fea\x07\n)" + std::string(55, 'a') + "...'");
  expect_error("{\"" + more + "\": " + more, "invalid literal; last read: '");
  expect_error("{" + std::string(1000, '1'), "unexpected number literal; expected string literal");
  const std::string error = error_of([] { read_bytes("{\"type\": \"" + std::string(1000, 'b') + "\x01"); });
  EXPECT_LT(error.size(), 400u) << error;
}

TEST(netcdf, is_asked_for_and_not_there) {
  expect_error("1 0 0\n", "not a NetCDF file", with(Container::netcdf, Coordinates::detected));
}

}  // namespace
}  // namespace files
