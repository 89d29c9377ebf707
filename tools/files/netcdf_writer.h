#pragma once
// Writing NetCDF files.

#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/parallel_for.h"
#include "files/mesh.h"
#include "files/output_file.h"
#include "files/text_file.h"

namespace files {

/// A NetCDF file being written: variables are defined with the functions that give their values, which
/// write() then calls.
class NetcdfWriter {
 public:
  using Dimensions = std::vector<int>;

  explicit NetcdfWriter(OutputFile& file, int kind = NC_NETCDF4 | NC_CLASSIC_MODEL) : name_(file.name()) {
    std::size_t buffer = std::size_t{1} << 20;  // of classic files; NetCDF's own of some kB takes longer
    check(nc__create(file.path().c_str(), NC_CLOBBER | kind, 0, &buffer, &id_));
    check(nc_set_fill(id_, NC_NOFILL, nullptr));
  }
  ~NetcdfWriter() {
    if (id_ >= 0) nc_abort(id_);
  }
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;

  int dimension(const std::string& name, std::size_t length) {
    int dimension = 0;
    check(nc_def_dim(id_, name.c_str(), length, &dimension));
    lengths_[dimension] = length;
    names_.insert(name);
    return dimension;
  }
  /// Defines a variable without values.
  int define(const std::string& name, nc_type type, const Dimensions& dimensions,
             const Notes& attributes = {}) {
    int variable = 0;
    check(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(),
                     &variable));
    names_.insert(name);
    for (const auto& [attribute_name, text] : attributes) attribute(variable, attribute_name.c_str(), text);
    return variable;
  }
  /// Defines a variable of double or std::int32_t. `values` must outlive the writer.
  template <class Value>
  int variable(const std::string& name, const Dimensions& dimensions, const Notes& attributes,
               const std::vector<Value>& values) {
    return elements<Value>(name, dimensions, attributes, [&values](std::size_t k) { return values[k]; });
  }
  template <class Value>
  int variable(const std::string&, const Dimensions&, const Notes&, std::vector<Value>&&) = delete;
  /// Defines longitudes and latitudes, in degrees, with the units that CF requires.
  void lon_lat(const std::string& lon, const std::string& lat, int of_lon, int of_lat,
               const std::vector<double>& lons, const std::vector<double>& lats) {
    variable(lon, {of_lon}, {{"units", "degrees_east"}, {"standard_name", "longitude"}}, lons);
    variable(lat, {of_lat}, {{"units", "degrees_north"}, {"standard_name", "latitude"}}, lats);
  }
  /// Defines the vectors as three variables.
  void components(const std::vector<std::string>& names, int dimension, const Notes& attributes,
                  const std::vector<Point>& points) {
    constexpr double Point::*kComponents[] = {&Point::x, &Point::y, &Point::z};
    for (std::size_t k = 0; k < 3; ++k)
      rows<double>(
          names[k], {dimension}, attributes,
          [&points, component = kComponents[k]](std::size_t i, double* to) { *to = points[i].*component; });
  }
  /// Defines the density of the nodes, if it is not empty.
  void density(const std::vector<double>& values, int nodes, const Notes& attributes = {}) {
    if (!values.empty()) variable("meshDensity", {nodes}, attributes, values);
  }
  /// Defines a variable with these dimensions for each column, numbers or texts of equal length. Renames
  /// columns whose names are taken. `of_mesh`: attributes of each variable.
  void columns(const Columns& all, const Dimensions& dimensions, const Notes& of_mesh) {
    for (const Column& c : all) {
      const std::string name = free_name(c.name);
      int id;
      if (c.is_text()) {
        expect_short_texts(c);
        id = rows<char>(
            name, {dimensions[0], dimension(name + "_length", longest(c))}, {},
            [&c](std::size_t i, char* to) { std::copy(c.texts[i].begin(), c.texts[i].end(), to); });
      } else if (c.whole) {
        id = elements<std::int32_t>(name, dimensions, {},
                                    [&c](std::size_t k) { return static_cast<std::int32_t>(c.numbers[k]); });
      } else {
        id = elements<double>(name, dimensions, {}, [&c](std::size_t k) {
          return std::isnan(c.numbers[k]) ? NC_FILL_DOUBLE : c.numbers[k];
        });
      }
      const bool renamed = name != c.name && c.long_name.empty();
      if (renamed || !c.long_name.empty()) attribute(id, "long_name", renamed ? c.name : c.long_name);
      if (!c.units.empty()) attribute(id, "units", c.units);
      if (!c.is_text() && !c.whole) attribute(id, "_FillValue", NC_FILL_DOUBLE);
      for (const auto& [attribute_name, text] : of_mesh) attribute(id, attribute_name.c_str(), text);
    }
  }
  /// Defines a variable: row(i, values) sets the values of row i, which are 0 before, on threads; it must not
  /// throw.
  template <class Value, class Row>
  int rows(const std::string& name, const Dimensions& dimensions, const Notes& attributes, const Row& row) {
    const int id = define(name, type_of<Value>(), dimensions, attributes);
    const std::size_t width = width_of(dimensions),
                      count = dimensions.empty() ? 1 : lengths_.at(dimensions[0]);
    writing_.emplace_back([=] { put_rows<Value>(id, dimensions, count, width, row); });
    return id;
  }

  void attributes(const Notes& notes) {
    for (const auto& [name, text] : notes) attribute(NC_GLOBAL, name.c_str(), text);
  }
  void attribute(int variable, const char* name, const std::string& text) {
    check(nc_put_att_text(id_, variable, name, text.size(), text.data()));
  }
  void attribute(int variable, const char* name, int value) {
    check(nc_put_att_int(id_, variable, name, NC_INT, 1, &value));
  }
  void attribute(int variable, const char* name, double value) {
    check(nc_put_att_double(id_, variable, name, NC_DOUBLE, 1, &value));
  }
  /// Copies an attribute of another file.
  void attribute(int variable, const char* name, int from_file, int from_variable) {
    check(nc_copy_att(from_file, from_variable, name, id_, variable));
  }

  /// write(number of the file) then writes the values of a variable that only was defined.
  void add(const std::function<void(int)>& write_one) {
    writing_.emplace_back([this, write_one] { write_one(id_); });
  }
  /// Writes all values. Must be the last call.
  void write() {
    check(nc_enddef(id_));
    for (const auto& write_one : writing_) write_one();
    check(nc_close(std::exchange(id_, -1)));
  }

 private:
  void check(int status) const {
    if (status != NC_NOERR) throw std::runtime_error(name_ + ": cannot be written: " + nc_strerror(status));
  }
  template <class Value>
  static constexpr nc_type type_of() {
    return std::is_same_v<Value, double> ? NC_DOUBLE : std::is_same_v<Value, char> ? NC_CHAR : NC_INT;
  }
  /// Defines a variable: value(k) is its k-th value.
  template <class Value, class ValueAt>
  int elements(const std::string& name, const Dimensions& dimensions, const Notes& attributes,
               const ValueAt& value) {
    const std::size_t width = width_of(dimensions);
    return rows<Value>(name, dimensions, attributes, [value, width](std::size_t i, Value* to) {
      for (std::size_t k = 0; k < width; ++k) to[k] = value(i * width + k);
    });
  }
  /// Number of values in a row of the first dimension.
  std::size_t width_of(const Dimensions& dimensions) const {
    return dimensions.size() < 2 ? 1 : lengths_.at(dimensions[1]);
  }
  /// Some rows at a time.
  template <class Value, class Row>
  void put_rows(int variable, const Dimensions& dimensions, std::size_t rows, std::size_t width,
                const Row& row) const {
    if (rows == 0) return;  // of no faces, whose width may be 0
    const std::size_t most = std::min(rows, std::max<std::size_t>((std::size_t{1} << 20) / width, 1));
    std::vector<Value> values(most * width);
    std::vector<std::size_t> start(dimensions.size()), count{0, width};
    for (std::size_t first = 0; first < rows; first += most) {
      count[0] = std::min(most, rows - first);
      pstripack::parallel_for(count[0], 10 * count[0], [&](std::size_t i) {
        Value* const to = values.data() + i * width;
        std::fill(to, to + width, Value{});
        row(first + i, to);
      });
      if (!start.empty()) start[0] = first;
      check(nc_put_vara(id_, variable, start.data(), count.data(), values.data()));
    }
  }
  /// NetCDF gives all texts of a column the length of the longest.
  void expect_short_texts(const Column& c) const {
    std::size_t all = 0;
    for (const std::string& text : c.texts) all += text.size();
    const double bytes = static_cast<double>(longest(c)) * static_cast<double>(c.size());
    if (bytes > 64e6 && bytes > 16 * static_cast<double>(all))
      throw std::runtime_error(
          fmt::format("{}: column '{}' has a text of {} bytes, and NetCDF stores all texts as long as this, "
                      "{:.0f} MB: leave the column out by --columns, or write CSV or GeoJSON",
                      name_, excerpt(c.name), longest(c), bytes / 1e6));
  }
  static std::size_t longest(const Column& texts) {
    std::size_t most = 1;
    for (const std::string& text : texts.texts) most = std::max(most, text.size());
    return most;
  }
  /// A name that NetCDF allows and no other variable has. Blanks are replaced, since some readers do not
  /// accept them.
  std::string free_name(std::string name) const {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    for (char& c : name)
      if (!is_digit(c) && !(c >= 'a' && c <= 'z') && !(c >= 'A' && c <= 'Z')) c = '_';
    if (name.empty() || is_digit(name[0])) name = "_" + name;
    while (names_.count(name) > 0) name += "_given";
    return name;
  }

  std::string name_;
  int id_ = -1;
  std::map<int, std::size_t> lengths_;          ///< of each dimension
  std::set<std::string> names_;                 ///< of dimensions and variables
  std::vector<std::function<void()>> writing_;  ///< the values
};

}  // namespace files
