#include <fmt/format.h>
#include <netcdf.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "node_sets.h"
#include "point_sets.h"

namespace comparison {
namespace {

using pstripack::Point;

/// A NetCDF file that is open for reading.
class File {
 public:
  explicit File(const std::string& name) : name_(name) { check(nc_open(name.c_str(), NC_NOWRITE, &id_), ""); }
  ~File() { nc_close(id_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(name_ + ": " + what); }
  void check(int status, const std::string& variable) const {
    if (status != NC_NOERR)
      fail((variable.empty() ? "" : "variable " + variable + ": ") + nc_strerror(status));
  }
  int id() const { return id_; }

 private:
  std::string name_;
  int id_ = -1;
};

struct Variable {
  std::string name;
  std::vector<int> dimensions;
  std::vector<double> values;
  std::string units;  ///< empty: the file does not say
};

bool has(const File& file, const std::string& name) {
  int id;
  return nc_inq_varid(file.id(), name.c_str(), &id) == NC_NOERR;
}

Variable read(const File& file, const std::string& name) {
  Variable v;
  v.name = name;
  const auto check = [&](int status) { file.check(status, name); };
  int id, rank;
  check(nc_inq_varid(file.id(), name.c_str(), &id));
  check(nc_inq_varndims(file.id(), id, &rank));
  v.dimensions.resize(static_cast<std::size_t>(rank));
  check(nc_inq_vardimid(file.id(), id, v.dimensions.data()));
  std::size_t count = 1;
  for (const int dimension : v.dimensions) {
    std::size_t length;
    check(nc_inq_dimlen(file.id(), dimension, &length));
    count *= length;
  }
  v.values.resize(count);
  check(nc_get_var_double(file.id(), id, v.values.data()));
  std::size_t length;
  if (nc_inq_attlen(file.id(), id, "units", &length) == NC_NOERR) {
    v.units.resize(length);
    check(nc_get_att_text(file.id(), id, "units", v.units.data()));
  }
  if (nc_inq_attid(file.id(), id, "scale_factor", nullptr) == NC_NOERR)
    file.fail("variable " + name + ": packed (scale_factor); expected plain numbers");
  double fill = 0;
  const bool has_fill = nc_get_att_double(file.id(), id, "_FillValue", &fill) == NC_NOERR;
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(v.values[i]) || (has_fill && v.values[i] == fill))
      file.fail(fmt::format("variable {}, value {}: missing or not finite", name, i + 1));
  return v;
}

/// True: degrees, false: radians.
bool in_degrees(const File& file, const Variable& v) {
  if (v.units.rfind("degree", 0) == 0) return true;
  if (v.units.rfind("rad", 0) == 0) return false;
  if (v.units.empty() && (v.name == "lonCell" || v.name == "latCell")) return false;
  file.fail(fmt::format("variable {}: units '{}'; expected degrees or radians", v.name, v.units));
}

Point node(double lon, bool lon_in_degrees, double lat, bool lat_in_degrees) {
  if (lon_in_degrees && lat_in_degrees) return point_sets::from_degrees(lon, lat);
  constexpr double kRadian = 0.017453292519943295769;
  if (lon_in_degrees) lon *= kRadian;
  if (lat_in_degrees) lat *= kRadian;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

std::vector<Point> from_angles(const File& file, const Variable& lon, const Variable& lat) {
  const bool lon_in_degrees = in_degrees(file, lon), lat_in_degrees = in_degrees(file, lat);
  const double pole = lat_in_degrees ? 90 : 1.5707963267948966;
  for (std::size_t i = 0; i < lat.values.size(); ++i)
    if (std::fabs(lat.values[i]) > pole * (1 + 1e-6))  // single precision rounds a pole up
      file.fail(fmt::format("variable {}, value {}: {} is beyond the pole", lat.name, i + 1, lat.values[i]));
  std::vector<Point> points;
  const auto add = [&](double x, double y) { points.push_back(node(x, lon_in_degrees, y, lat_in_degrees)); };
  if (lon.dimensions == lat.dimensions) {
    for (std::size_t i = 0; i < lon.values.size(); ++i) add(lon.values[i], lat.values[i]);
  } else if (lon.dimensions.size() == 1 && lat.dimensions.size() == 1) {
    for (const double y : lat.values)
      for (const double x : lon.values) add(x, y);
  } else {
    file.fail(fmt::format("variables {} and {}: expected one shape, or two axes of one dimension each",
                          lon.name, lat.name));
  }
  return points;
}

std::vector<Point> from_coordinates(const File& file) {
  const Variable x = read(file, "xCell"), y = read(file, "yCell"), z = read(file, "zCell");
  if (x.dimensions != y.dimensions || x.dimensions != z.dimensions)
    file.fail("variables xCell, yCell, zCell: expected one shape");
  std::vector<Point> points;
  for (std::size_t i = 0; i < x.values.size(); ++i) points.push_back({x.values[i], y.values[i], z.values[i]});
  return points;
}

}  // namespace

std::vector<Point> read_netcdf(const std::string& name) {
  const File file(name);
  const auto points = [&]() -> std::optional<std::vector<Point>> {
    if (has(file, "xCell")) return from_coordinates(file);
    for (const auto& [lon, lat] :
         {std::pair("lonCell", "latCell"), std::pair("lon", "lat"), std::pair("longitude", "latitude")})
      if (has(file, lon)) return from_angles(file, read(file, lon), read(file, lat));
    return std::nullopt;
  }();
  if (!points)
    file.fail("no nodes: expected variables xCell, yCell, zCell, or lonCell, latCell, or lon, lat");
  if (points->empty()) file.fail("no nodes: the variables are empty");
  return *points;
}

}  // namespace comparison
