#pragma once
// Writing NetCDF files.

#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
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
#include "text_file.h"

namespace files {

/// A NetCDF file being written: first all definitions, then the values. If another process has begun the
/// file, the definitions are looked up and this process adds its rows.
class NetcdfWriter {
 public:
  explicit NetcdfWriter(const OutputFile& file, int kind = NC_NETCDF4 | NC_CLASSIC_MODEL)
      : name_(file.name()), is_begun_(file.is_begun()) {
    if (is_begun_) {
      check(nc_open(file.path().c_str(), NC_WRITE, &id_));
    } else {
      check(nc_create(file.path().c_str(), NC_CLOBBER | kind, &id_));
      check(nc_set_fill(id_, NC_NOFILL, nullptr));
    }
  }
  ~NetcdfWriter() {
    if (id_ >= 0) nc_abort(id_);
  }
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;

  /// Defines a dimension. `length`: number of rows of this process.
  int dimension(const char* name, std::size_t length, const Share& share = {}) {
    int dimension = 0;
    check(is_begun_ ? nc_inq_dimid(id_, name, &dimension)
                    : nc_def_dim(id_, name, share.total(length), &dimension));
    rows_[dimension] = {share.before, length};
    names_.insert(name);
    return dimension;
  }
  int variable(const char* name, nc_type type, const std::vector<int>& dimensions) {
    int variable = 0;
    check(is_begun_ ? nc_inq_varid(id_, name, &variable)
                    : nc_def_var(id_, name, type, static_cast<int>(dimensions.size()), dimensions.data(),
                                 &variable));
    dimensions_[variable] = dimensions;
    names_.insert(name);
    return variable;
  }
  /// Defines longitudes and latitudes with the units degrees_east and degrees_north that CF requires.
  std::pair<int, int> lon_lat(const char* lon_name, const char* lat_name, const std::vector<int>& of_lon,
                              const std::vector<int>& of_lat) {
    const int lon = angle(lon_name, of_lon, "degrees_east"), lat = angle(lat_name, of_lat, "degrees_north");
    attribute(lon, "standard_name", "longitude");
    attribute(lat, "standard_name", "latitude");
    return {lon, lat};
  }
  /// Defines the density of the nodes. Nothing if `values` is empty.
  int density(const std::vector<double>& values, int nodes) {
    return values.empty() ? -1 : variable("meshDensity", NC_DOUBLE, {nodes});
  }
  /// Defines a variable with these dimensions for each column, numbers or texts of equal length. Renames
  /// columns whose names are taken. `of_mesh`: attributes of each variable.
  std::vector<int> columns(const Columns& all, const std::vector<int>& dimensions, const Notes& of_mesh) {
    std::vector<int> ids;
    for (const Column& c : all) {
      const std::string name = free_name(c.name);
      std::vector<int> shape = dimensions;
      if (c.is_text()) {
        expect_short_texts(c);
        shape.push_back(dimension((name + "_length").c_str(), longest(c)));
      }
      const int id = variable(name.c_str(), c.is_text() ? NC_CHAR : c.whole ? NC_INT : NC_DOUBLE, shape);
      const bool renamed = name != c.name && c.long_name.empty();
      if (renamed || !c.long_name.empty()) attribute(id, "long_name", renamed ? c.name : c.long_name);
      if (!c.units.empty()) attribute(id, "units", c.units);
      if (!c.is_text() && !c.whole) attribute(id, "_FillValue", NC_FILL_DOUBLE);
      for (const auto& [attribute_name, text] : of_mesh) attribute(id, attribute_name.c_str(), text);
      ids.push_back(id);
    }
    return ids;
  }
  void put(const std::vector<int>& ids, const Columns& all) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const Column& c = all[k];
      if (c.is_text()) {
        const std::size_t length = longest(c);
        std::string bytes;
        for (std::size_t i = 0; i < c.size(); ++i) (bytes += c.texts[i]).resize((i + 1) * length);
        const Slab slab = slab_of(ids[k]);
        check(nc_put_vara_text(id_, ids[k], slab.start.data(), slab.count.data(), bytes.data()));
      } else if (c.whole) {
        put(ids[k], std::vector<std::int32_t>(c.numbers.begin(), c.numbers.end()));
      } else if (std::any_of(c.numbers.begin(), c.numbers.end(), [](double v) { return std::isnan(v); })) {
        std::vector<double> filled = c.numbers;
        for (double& v : filled)
          if (std::isnan(v)) v = NC_FILL_DOUBLE;
        put(ids[k], filled);
      } else {
        put(ids[k], c.numbers);
      }
    }
  }
  void attributes(const Notes& notes) {
    for (const auto& [name, text] : notes) attribute(NC_GLOBAL, name.c_str(), text);
  }
  /// Defines a variable of angles in degrees or radians.
  int angle(const char* name, const std::vector<int>& dimensions, const char* units) {
    const int id = variable(name, NC_DOUBLE, dimensions);
    attribute(id, "units", units);
    return id;
  }
  void attribute(int variable, const char* name, const std::string& text) {
    if (!is_begun_) check(nc_put_att_text(id_, variable, name, text.size(), text.data()));
  }
  void attribute(int variable, const char* name, int value) {
    if (!is_begun_) check(nc_put_att_int(id_, variable, name, NC_INT, 1, &value));
  }
  void attribute(int variable, const char* name, double value) {
    if (!is_begun_) check(nc_put_att_double(id_, variable, name, NC_DOUBLE, 1, &value));
  }
  void end_definitions() {
    if (!is_begun_) check(nc_enddef(id_));
  }
  void put(int variable, const std::vector<double>& values) {
    const Slab slab = slab_of(variable);
    check(nc_put_vara_double(id_, variable, slab.start.data(), slab.count.data(), values.data()));
  }
  void put(int variable, const std::vector<std::int32_t>& values) {
    const Slab slab = slab_of(variable);
    check(nc_put_vara_int(id_, variable, slab.start.data(), slab.count.data(), values.data()));
  }
  /// Writes variables of `width` values a row, some rows at a time: row(i, values) sets the values of row i
  /// of all variables, which are 0 before, on threads; it must not throw. Several variables, at most 16, have
  /// width 1.
  template <class Value, class Row>
  void put_rows(const std::vector<int>& variables, std::size_t rows, std::size_t width, const Row& row) {
    const std::size_t together = variables.size() * width;
    const std::size_t most = std::min(rows, std::max<std::size_t>((std::size_t{1} << 20) / together, 1));
    std::vector<Value> values(most * together);
    for (std::size_t first = 0; first < rows; first += most) {
      const std::size_t count = std::min(most, rows - first);
      pstripack::parallel_pieces(
          count, pstripack::threads_for(10 * count), [&](std::size_t begin, std::size_t end, int) {
            std::array<Value, 16> one;  // a row of all variables, if there are several
            for (std::size_t i = begin; i < end; ++i) {
              Value* const to = variables.size() > 1 ? one.data() : values.data() + i * width;
              std::fill(to, to + together, Value{});
              row(first + i, to);
              for (std::size_t k = 0; variables.size() > 1 && k < together; ++k)
                values[k * most + i] = one[k];
            }
          });
      for (std::size_t k = 0; k < variables.size(); ++k) {
        Slab slab = slab_of(variables[k]);
        slab.start[0] += first, slab.count[0] = count;
        const Value* const from = values.data() + k * most;
        if constexpr (std::is_same_v<Value, double>)
          check(nc_put_vara_double(id_, variables[k], slab.start.data(), slab.count.data(), from));
        else
          check(nc_put_vara_int(id_, variables[k], slab.start.data(), slab.count.data(), from));
      }
    }
  }
  void put(int x, int y, int z, const std::vector<Point>& points) {
    std::vector<double> values(points.size());
    for (const auto& [variable, component] :
         {std::pair(x, &Point::x), std::pair(y, &Point::y), std::pair(z, &Point::z)}) {
      for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i].*component;
      put(variable, values);
    }
  }
  void close() {
    const int id = id_;
    id_ = -1;
    check(nc_close(id));
  }

 private:
  void check(int status) const {
    if (status != NC_NOERR) throw std::runtime_error(name_ + ": cannot be written: " + nc_strerror(status));
  }
  /// The rows of a variable that this process writes.
  struct Slab {
    std::vector<std::size_t> start, count;
  };
  Slab slab_of(int variable) const {
    Slab slab;
    for (const int dimension : dimensions_.at(variable)) {
      const auto [before, here] = rows_.at(dimension);
      slab.start.push_back(before);
      slab.count.push_back(here);
    }
    return slab;
  }
  /// NetCDF gives all texts of a column the length of the longest.
  void expect_short_texts(const Column& c) const {
    std::size_t all = 0;
    for (const std::string& text : c.texts) all += text.size();
    const double bytes = static_cast<double>(longest(c)) * static_cast<double>(c.size());
    if (bytes > 64e6 && bytes > 16 * static_cast<double>(all))
      throw std::runtime_error(
          fmt::format("{}: column '{}' has a text of {} bytes, as long as which all in a NetCDF file are, "
                      "{:.0f} MB: leave the "
                      "column out by --columns, or write CSV or GeoJSON",
                      name_, point_sets::excerpt(c.name), longest(c), bytes / 1e6));
  }
  static std::size_t longest(const Column& texts) {
    std::size_t most = 1;
    for (const std::string& text : texts.texts) most = std::max(most, text.size());
    return most;
  }
  /// A name that NetCDF allows and no other variable has. Blanks are replaced, since some readers do not
  /// accept them.
  std::string free_name(std::string name) {
    const auto is_plain = [](char c) {
      return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    for (char& c : name)
      if (!is_plain(c)) c = '_';
    if (name.empty() || (name[0] >= '0' && name[0] <= '9')) name = "_" + name;
    while (names_.count(name) > 0) name += "_given";
    return name;
  }
  std::string name_;
  bool is_begun_;
  int id_ = -1;
  std::map<int, std::pair<std::size_t, std::size_t>>
      rows_;                                    ///< of each dimension: rows of earlier processes, own rows
  std::map<int, std::vector<int>> dimensions_;  ///< of each variable
  std::set<std::string> names_;                 ///< of dimensions and variables
};

}  // namespace files
