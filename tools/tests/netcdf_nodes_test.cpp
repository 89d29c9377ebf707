// Nodes of NetCDF files.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netcdf.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "files/nodes.h"
#include "point_sets.h"
#include "support/this_program.h"

namespace files {
namespace {

using Points = std::vector<Point>;

Points points_of(const std::string& file) { return read(file).points; }

std::string error_of(const std::string& file) {
  try {
    read(file);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "no error";
}

class NetcdfFile {
 public:
  NetcdfFile() : name_(testing::TempDir() + "netcdf_nodes_test.nc") {
    check(nc_create(name_.c_str(), NC_CLOBBER, &id_));
  }
  ~NetcdfFile() { std::remove(name_.c_str()); }

  int dimension(const char* name, std::size_t length) {
    int dimension = 0;
    check(nc_def_dim(id_, name, length, &dimension));
    return dimension;
  }
  NetcdfFile& with(const char* name, const std::vector<int>& dimensions, const std::vector<double>& values,
                   const std::string& units = "", nc_type type = NC_DOUBLE) {
    int variable = 0;
    check(nc_def_var(id_, name, type, static_cast<int>(dimensions.size()), dimensions.data(), &variable));
    if (!units.empty()) check(nc_put_att_text(id_, variable, "units", units.size(), units.data()));
    const double fill = -999;
    check(nc_put_att_double(id_, variable, "_FillValue", type, 1, &fill));
    check(nc_enddef(id_));
    check(nc_put_var_double(id_, variable, values.data()));
    check(nc_redef(id_));
    return *this;
  }
  NetcdfFile& attribute(const char* variable, const char* name, double value) {
    int id = 0;
    check(nc_inq_varid(id_, variable, &id));
    check(nc_put_att_double(id_, id, name, NC_DOUBLE, 1, &value));
    return *this;
  }
  NetcdfFile& text(const char* variable, const char* name, const std::string& value) {
    int id = 0;
    check(nc_inq_varid(id_, variable, &id));
    check(nc_put_att_text(id_, id, name, value.size(), value.data()));
    return *this;
  }
  NetcdfFile& note(const char* name, const std::string& text) {
    check(nc_put_att_text(id_, NC_GLOBAL, name, text.size(), text.data()));
    return *this;
  }
  std::string closed() {
    check(nc_close(id_));
    return name_;
  }

 private:
  static void check(int status) { ASSERT_EQ(status, NC_NOERR) << nc_strerror(status); }
  std::string name_;
  int id_ = 0;
};

TEST(netcdf, coordinates_are_taken_as_they_are) {
  NetcdfFile file;
  const int n = file.dimension("nCells", 3);
  file.with("lonCell", {n}, {9, 9, 9}).with("xCell", {n}, {6371229, 0, 0});
  file.with("yCell", {n}, {0, 6371229, 0}).with("zCell", {n}, {0, 0, 2});
  EXPECT_EQ(points_of(file.closed()), (Points{{6371229, 0, 0}, {0, 6371229, 0}, {0, 0, 2}}));
}

TEST(netcdf, mpas_meshes_are_on_a_sphere_of_their_radius) {
  for (const char* const is_on_a_sphere : {"YES", "NO              "}) {
    NetcdfFile file;
    const int n = file.dimension("nCells", 2);
    file.with("xCell", {n}, {6371220, 0}).with("yCell", {n}, {0, 0}).with("zCell", {n}, {0, 6371220});
    const std::string name = file.note("on_a_sphere", is_on_a_sphere).closed();
    if (*is_on_a_sphere == 'Y')
      EXPECT_EQ(read(name).radius, 6371220);
    else
      EXPECT_NE(error_of(name).find("on_a_sphere is NO: a planar mesh"), std::string::npos);
  }
}

TEST(netcdf, radians_nearest_to_a_right_angle_mean_it_also_in_single_precision) {
  const double pi = std::acos(-1.0);
  for (const nc_type type : {NC_DOUBLE, NC_FLOAT})
    for (const bool has_axes : {false, true}) {
      NetcdfFile file;
      const int m = file.dimension("m", 3), n = file.dimension("n", 3);
      file.with("lonCell", {m}, {0, pi, 1.5 * pi}, "", type);
      file.with("latCell", {has_axes ? n : m}, {0, pi / 2, -pi / 2}, "", type);
      const Nodes nodes = read(file.closed());
      const Points expected = has_axes ? Points{{1, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, 1},
                                                {0, 0, 1}, {0, 0, -1}, {0, 0, -1}, {0, 0, -1}}
                                       : Points{{1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
      EXPECT_EQ(nodes.points, expected);
      if (has_axes) {
        EXPECT_EQ(nodes.grid.lat, (std::vector<double>{0, 90, -90}));
      }
      EXPECT_EQ(nodes.given.lat.back(), -pi / 2);  // so that a copy in double precision is the same place
    }
  NetcdfFile file;  // a double is not a float
  const int n = file.dimension("n", 2);
  file.with("lonCell", {n}, {0, 1}).with("latCell", {n}, {static_cast<float>(pi / 2), 0});
  EXPECT_NE(points_of(file.closed()).at(0).x, 0);
}

TEST(netcdf, angles_are_in_the_units_of_the_attribute) {
  const double right = std::acos(0.0);
  {
    NetcdfFile file;
    const int n = file.dimension("n", 2);
    file.with("lon", {n}, {0, 90}, "degrees_east").with("lat", {n}, {90, 0}, "degrees_north");
    EXPECT_EQ(points_of(file.closed()), (Points{{0, 0, 1}, {0, 1, 0}}));
  }
  for (const char* const units : {"radians", ""}) {  // MPAS writes none
    NetcdfFile file;
    const int n = file.dimension("nCells", 2);
    file.with("lonCell", {n}, {0, right}, units).with("latCell", {n}, {right, 0}, units);
    const Points points = points_of(file.closed());
    ASSERT_EQ(points.size(), 2u);
    EXPECT_NEAR(points[0].z, 1, 1e-15);
    EXPECT_NEAR(points[1].y, 1, 1e-15);
  }
}

TEST(netcdf, axes_are_a_grid_and_fields_are_pairs) {
  {
    NetcdfFile file;
    const int nx = file.dimension("x", 2), ny = file.dimension("y", 2);  // two dimensions of equal length
    file.with("longitude", {nx}, {0, 90}, "degrees").with("latitude", {ny}, {0, 30}, "degrees");
    const Points points = points_of(file.closed());
    ASSERT_EQ(points.size(), 4u);
    EXPECT_EQ(points[1], (Point{0, 1, 0}));
    EXPECT_NEAR(points[2].z, 0.5, 1e-15);
  }
  NetcdfFile file;
  const int nx = file.dimension("x", 2), ny = file.dimension("y", 1);
  file.with("lon", {ny, nx}, {0, 90}, "degrees").with("lat", {ny, nx}, {0, 90}, "degrees");
  EXPECT_EQ(points_of(file.closed()).size(), 2u);
}

TEST(netcdf, coordinates_may_be_missing_if_the_caller_says_so) {
  NetcdfFile file;  // -999 is _FillValue
  const int n = file.dimension("n", 4);
  file.with("TLONG", {n}, {1, -999, 3, 4}, "degrees_east")
      .with("TLAT", {n}, {1, 2, 1e30, 4}, "degrees_north");
  file.attribute("TLAT", "missing_value", 1e30);
  const std::string name = file.closed();
  EXPECT_NE(error_of(name).find("variable TLONG, value 2: missing or not finite: remove the node, or say"),
            std::string::npos);
  ReadOptions options;
  options.keep_missing = true;
  Nodes nodes = read(name, options);
  ASSERT_EQ(nodes.points.size(), 4u);
  for (const std::size_t i : {0, 1, 2, 3}) EXPECT_EQ(std::isnan(nodes.points[i].x), i == 1 || i == 2);
  nodes.keep({0, 3});
  nodes.keep({1});
  EXPECT_EQ(nodes.place(0), "node 4");
}

/// NEMO, ICON, WRF, POP and CORDEX: the nodes are where each file has its longitudes and latitudes.
TEST(netcdf, coordinates_of_models_are_found) {
  const std::vector<double> lon{0, 40, 80, 5, 45, 85}, lat{0, 1, 2, 30, 31, 32};
  const auto kind_of = [](const std::string& file, const std::string& value) {
    ReadOptions options;
    options.with_values = !value.empty();
    options.variable = value;
    const Nodes nodes = read(file, options);
    EXPECT_EQ(nodes.points.size(), 6u) << nodes.kind;
    return nodes.kind;
  };
  const std::vector<std::pair<const char*, const char*>> names{
      {"nav_lon", "nav_lat"}, {"glamt", "gphit"}, {"XLONG", "XLAT"}, {"TLONG", "TLAT"}, {"lon", "lat"}};
  for (const auto& [lon_name, lat_name] : names)
    for (const bool has_time : {false, true}) {
      NetcdfFile file;
      const int t = file.dimension("Time", 1), y = file.dimension("y", 2), x = file.dimension("x", 3);
      const std::vector<int> shape = has_time ? std::vector<int>{t, y, x} : std::vector<int>{y, x};
      // The first has no units: longitudes from 0 to 85 are no radians.
      file.with(lon_name, shape, lon).with(lat_name, shape, lat, "degree_north");
      file.with("ULON", shape, lat, "degrees_east").with("ULAT", shape, lat, "degrees_north");
      file.with("T", {t, y, x}, lat).with("U", {y, x}, lat).text("U", "coordinates", "time ULAT ULON");
      const std::string name = file.closed();
      EXPECT_EQ(kind_of(name, "T"), fmt::format("NetCDF, {} {} in degrees", lon_name, lat_name));
      EXPECT_EQ(kind_of(name, "U"), "NetCDF, ULON ULAT in degrees");
      EXPECT_EQ(kind_of(name, ""), fmt::format("NetCDF, {} {} in degrees", lon_name, lat_name));
    }
  {
    NetcdfFile file;  // whose pair of usual names is that of another grid
    const int n = file.dimension("n", 6), m = file.dimension("m", 2), k = file.dimension("k", 2);
    file.with("clon", {m}, {0, 1}, "radian").with("clat", {m}, {0, 1}, "radian");
    file.with("a", {n}, lat).text("a", "standard_name", "longitude").text("a", "units", "radian");
    file.with("b", {n}, lat, "degreeN").text("b", "bounds", "b_bounds").with("s", {n}, lat);
    file.with("b_bounds", {n, k}, std::vector<double>(12), "degreeN");
    const std::string name = file.closed();
    EXPECT_EQ(kind_of(name, "s"), "NetCDF, a b in degrees");
    EXPECT_EQ(read(name).kind, "NetCDF, clon clat in radians");
  }
  int id = 0, n = 0, variable = 0;  // NetCDF-4 has attributes of type string
  const std::string name = testing::TempDir() + "netcdf_nodes_test_string.nc";
  nc_create(name.c_str(), NC_CLOBBER | NC_NETCDF4, &id);
  nc_def_dim(id, "n", 6, &n);
  for (const char* units : {"degrees_east", "degrees_north"}) {
    nc_def_var(id, units + 8, NC_DOUBLE, 1, &n, &variable);
    nc_put_att_string(id, variable, "units", 1, &units);
    nc_put_var_double(id, variable, lat.data());
  }
  nc_close(id);
  EXPECT_EQ(kind_of(name, ""), "NetCDF, east north in degrees");
  std::remove(name.c_str());
}

ReadOptions values_of(const std::string& variable) {
  ReadOptions options;
  options.with_values = true;
  options.variable = variable;
  return options;
}

/// Writes 20 nodes in a format of NetCDF; returns the bytes of the file.
std::string nodes_in(int format, const std::string& name) {
  int id = 0, n = 0, records = 0, variable = 0;
  nc_create(name.c_str(), NC_CLOBBER | format, &id);
  nc_def_dim(id, "n", 20, &n);
  nc_def_dim(id, "time", NC_UNLIMITED, &records);
  const int dimensions[] = {records, n};
  std::vector<double> values;
  for (const auto& [axis, unit] : {std::pair("lon", "degrees_east"), std::pair("lat", "degrees_north")}) {
    nc_def_var(id, axis, NC_DOUBLE, 1, &n, &variable);
    nc_put_att_text(id, variable, "units", std::strlen(unit), unit);
  }
  nc_def_var(id, "T", NC_FLOAT, 2, dimensions, &variable);
  nc_enddef(id);
  for (int i = 0; i < 20; ++i) values.push_back(4 * i);
  nc_put_var_double(id, 0, values.data());
  nc_put_var_double(id, 1, values.data());
  const std::size_t start[] = {0, 0}, count[] = {1, 20};
  nc_put_vara_double(id, 2, start, count, values.data());
  nc_close(id);
  return contents(name);
}

// Past failure: libnetcdf reads what a truncated file lacks as zeros.
TEST(netcdf, that_is_truncated_is_refused) {
  const Folder folder;
  const std::string name = folder.path() + "/x.nc";
  for (const int format : {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4}) {
    const std::string bytes = nodes_in(format, name);
    EXPECT_EQ(read(name, values_of("T")).value.numbers.back(), 76);
    for (std::size_t size = bytes.size() - 1; size > 8; size -= std::min(size, 1 + bytes.size() / 25)) {
      std::ofstream(name, std::ios::binary) << bytes.substr(0, size);
      const std::string error = error_of(name);
      EXPECT_NE(error.find(format == NC_NETCDF4 ? "NetCDF: " : ": incomplete NetCDF file: it ends before"),
                error.npos)
          << format << " " << size << ": " << error;
    }
  }
}

TEST(netcdf, values_have_the_dimensions_of_the_nodes) {
  NetcdfFile file;
  const int time = file.dimension("time", 1), ny = file.dimension("lat", 2), nx = file.dimension("lon", 3);
  const int other = file.dimension("other", 3), layers = file.dimension("layers", 2);
  file.with("lon", {nx}, {0, 90, 180}, "degrees").with("lat", {ny}, {0, 30}, "degrees");
  file.with("t", {time, ny, nx}, {1, 2, 3, 4, -999, 6}, "K").with("turned", {nx, ny}, {1, 2, 3, 4, 5, 6});
  file.with("elsewhere", {ny, other}, {1, 2, 3, 4, 5, 6});
  file.with("deep", {layers, ny, nx}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  file.with("packed", {ny, nx}, {1, 2, 3, 4, -999, -5});
  file.attribute("packed", "scale_factor", 10).attribute("packed", "add_offset", 100);
  file.attribute("packed", "missing_value", -5);
  file.note("scvt_density", "bump").note("title", "a title").note("creator", "not a note");
  const std::string name = file.closed();
  const Nodes nodes = read(name, values_of("t"));
  ASSERT_EQ(nodes.value.numbers.size(), 6u);
  EXPECT_EQ(nodes.value.numbers[3], 4);  // the first of the second row
  EXPECT_NEAR(nodes.points[3].z, 0.5, 1e-15);
  EXPECT_TRUE(std::isnan(nodes.value.numbers[4]));
  EXPECT_EQ(nodes.value.name, "t");
  EXPECT_EQ(nodes.value.units, "K");
  EXPECT_EQ(nodes.notes, (Notes{{"scvt_density", "bump"}, {"title", "a title"}}));
  const Nodes packed = read(name, values_of("packed"));
  EXPECT_EQ(packed.value.numbers[2], 130);
  EXPECT_TRUE(std::isnan(packed.value.numbers[4]) && std::isnan(packed.value.numbers[5]));
  for (const char* const variable : {"turned", "elsewhere", "deep", "none", ""}) {
    try {
      read(name, values_of(variable));
      ADD_FAILURE() << variable << " was read";
    } catch (const std::runtime_error& e) {
      const std::string words = *variable == '\0' || variable == std::string("none")
                                    ? "variables with one value per node: t, packed"
                                    : "expected " + std::string(variable) + "(lat=2, lon=3)";
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  }
}

TEST(netcdf, the_only_variable_on_the_nodes_is_the_value) {
  NetcdfFile file;
  const int n = file.dimension("n", 2), m = file.dimension("m", 1);
  file.with("lon", {n}, {0, 90}).with("lat", {n}, {0, 30}).with("t", {n}, {1, 2}).with("u", {m}, {1});
  EXPECT_EQ(read(file.closed(), values_of("")).value.numbers, (std::vector<double>{1, 2}));
}

TEST(netcdf, angles_stay_beside_the_vectors_unless_they_are_of_other_nodes) {
  for (const bool same : {true, false}) {
    NetcdfFile file;
    const int n = file.dimension("nCells", 2);
    file.with("lon", {n}, {-270, same ? 180.0 : 170.0}, "degrees").with("lat", {n}, {0, 0}, "degrees");
    file.with("xCell", {n}, {0, -2}).with("yCell", {n}, {3, 0}).with("zCell", {n}, {0, 0});
    const Nodes nodes = read(file.closed());
    EXPECT_EQ(nodes.points, (Points{{0, 3, 0}, {-2, 0, 0}}));
    EXPECT_EQ(nodes.given.lon, same ? (std::vector<double>{-270, 180}) : std::vector<double>{});
  }
}

TEST(netcdf, columns_are_the_variables_of_the_nodes) {
  NetcdfFile file;
  const int n = file.dimension("n", 2), m = file.dimension("m", 3);
  file.with("lon", {n}, {0, 90}, "degrees").with("lat", {n}, {90, 0}, "degrees");
  file.with("east", {n}, {90, 0}, "degrees").with("north", {n}, {0, 90}, "degrees");
  file.with("t", {n}, {5, -999}, "K").with("other", {m}, {1, 2, 3});
  const std::string name = file.closed();
  ReadOptions options;
  options.with_columns = true;
  const Nodes nodes = read(name, options);
  ASSERT_EQ(nodes.columns.size(), 3u);
  EXPECT_EQ(nodes.columns[2].name, "t");
  EXPECT_EQ(nodes.columns[2].units, "K");
  EXPECT_EQ(nodes.columns[2].numbers[0], 5);
  EXPECT_TRUE(std::isnan(nodes.columns[2].numbers[1]));
  options.columns = "east,north,t";
  const Nodes chosen = read(name, options);
  EXPECT_EQ(chosen.points, (Points{{0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(chosen.columns.size(), 1u);
  for (const auto& [columns, words] :
       {std::pair("east,nroth", "there is no variable 'nroth'; did you mean north?"),
        std::pair("east", "--columns names 1 variable: expected longitude and latitude"),
        std::pair("east,north,east", "variable 'east' is chosen twice"),
        std::pair("east,north,other", "variable other(m=3): expected one value per node, other(n=2)")}) {
    options.columns = columns;
    try {
      read(name, options);
      ADD_FAILURE() << columns << " was read";
    } catch (const std::runtime_error& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace files
