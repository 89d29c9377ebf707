// Nodes of NetCDF files. They are those of a UGRID mesh, or xCell, yCell, zCell, or a pair of longitudes and
// latitudes, which lon_lat_of() finds. The two variables of a pair have one shape, or are the axes of a grid,
// which is read row by row of latitude. Their units are those of the attribute; without it radians for
// lonCell and latCell, else those of the options, else degrees if the values cannot be radians, else it is an
// error.

#include <fcntl.h>
#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include "files/classic_netcdf.h"
#include "files/nearest.h"
#include "files/nodes.h"
#include "files/reading_guard.h"
#include "files/text_table.h"
#include "lists/limits.h"
#include "parallel/local_nodes.h"
#include "point_sets.h"
#include "text_file.h"

namespace files {
namespace {

using point_sets::excerpt;

/// The bytes of a file, as memory.
class MappedFile {
 public:
  explicit MappedFile(const std::string& name) {
    const int descriptor = open(name.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status {};
    if (descriptor >= 0 && fstat(descriptor, &status) == 0 && status.st_size > 0) {
      size_ = static_cast<std::size_t>(status.st_size);
      bytes_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
    }
    const int error = errno;
    if (descriptor >= 0) close(descriptor);
    if (bytes_ == MAP_FAILED)
      throw std::runtime_error(fmt::format("{}: cannot be read: {}", name, std::strerror(error)));
  }
  ~MappedFile() { munmap(bytes_, size_); }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  std::string_view bytes() const { return {static_cast<const char*>(bytes_), size_}; }

 private:
  void* bytes_ = MAP_FAILED;
  std::size_t size_ = 0;
};

/// A NetCDF file open for reading. status() and call() call libnetcdf.
class File {
 public:
  File(const std::string& name, const std::string& contents, const ReadOptions& options)
      : name_(name), options_(options), guard_(name, options.exit_code) {
    if (contents.empty())
      check_header(MappedFile(name).bytes());
    else
      check_header(contents);
    guard_.grant(contents.size());
    if (contents.empty())
      call("", nc_open, name.c_str(), NC_NOWRITE, &id_);
    else  // NetCDF takes bytes to read as void*, and does not change them without NC_WRITE.
      call("", nc_open_mem, name.c_str(), NC_NOWRITE, contents.size(), const_cast<char*>(contents.data()),
           &id_);
  }
  ~File() { status(nc_close, id_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(name_ + ": " + what); }
  template <class... Parameters, class... Arguments>
  int status(int (*function)(Parameters...), Arguments... arguments) const {
    const ReadingGuard::Limits limits(guard_);
    return function(arguments...);
  }
  template <class... Parameters, class... Arguments>
  void call(const std::string& variable, int (*function)(Parameters...), Arguments... arguments) const {
    if (const int error = status(function, arguments...); error != NC_NOERR)
      fail((variable.empty() ? "" : "variable " + excerpt(variable) + ": ") + nc_strerror(error));
  }
  /// To be called before values are read. Throws if there are more than the file can hold: no value of the
  /// classic formats is compressed, and deflate, the usual compression, makes nothing smaller than 1/1032.
  void expect(const std::string& variable, int id, std::size_t values) const {
    nc_type type = NC_BYTE;
    std::size_t size = 1;
    call(variable, nc_inq_vartype, id_, id, &type);
    call(variable, nc_inq_type, id_, type, nullptr, &size);
    const std::size_t most = (is_classic_ ? 1 : 1032) * length_ / std::max<std::size_t>(size, 1);
    if (values > most)
      fail(fmt::format("variable {}: {} values; the file, {} bytes long, has room for {}: it is damaged",
                       excerpt(variable), values, length_, most));
    guard_.grant(values * std::max(size, sizeof(double)));
  }
  int id() const { return id_; }
  Units units() const { return options_.units; }  ///< of angles without units
  bool keeps_missing() const { return options_.keep_missing; }
  bool is_read_in_parts() const { return options_.parts > 1; }
  /// The first node that this rank reads, and how many.
  std::pair<std::size_t, std::size_t> part_of(std::size_t n) const {
    const std::size_t first = pstripack::slice_begin(n, options_.part, options_.parts);
    return {first, pstripack::slice_begin(n, options_.part + 1, options_.parts) - first};
  }

 private:
  void check_header(std::string_view bytes) {
    length_ = bytes.size();
    is_classic_ = bytes.substr(0, 3) == "CDF";
    if (is_classic_) check_classic_netcdf(bytes, name_);
  }

  std::string name_;
  const ReadOptions& options_;
  mutable ReadingGuard guard_;
  std::size_t length_ = 0;
  bool is_classic_ = false;
  int id_ = -1;
};

struct Variable {
  std::string name;
  std::vector<int> dimensions;
  std::size_t before = 0;  ///< number of values that lower ranks read
  std::vector<double> values;
  std::string units;  ///< empty: not in the file
  int id = -1;
};

bool has(const File& file, const std::string& name) {
  int id;
  return file.status(nc_inq_varid, file.id(), name.c_str(), &id) == NC_NOERR;
}

std::string text_attribute(const File& file, int variable, const char* name) {
  std::string text;
  nc_type type = NC_CHAR;
  std::size_t length = 0;
  if (file.status(nc_inq_att, file.id(), variable, name, &type, &length) != NC_NOERR) return text;
  if (type == NC_CHAR) {
    text.resize(length);
    file.call(name, nc_get_att_text, file.id(), variable, name, text.data());
  } else if (type == NC_STRING && length == 1) {
    char* string = nullptr;
    file.call(name, nc_get_att_string, file.id(), variable, name, &string);
    if (string != nullptr) text = string;
    file.status(nc_free_string, std::size_t{1}, &string);
  }
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();  // of Fortran
  return text;
}

/// The number of the variable and the length of each of its dimensions.
std::pair<int, std::vector<std::size_t>> shape_of(const File& file, const std::string& name,
                                                  std::vector<int>& dimensions) {
  int id, rank;
  file.call(name, nc_inq_varid, file.id(), name.c_str(), &id);
  file.call(name, nc_inq_varndims, file.id(), id, &rank);
  dimensions.resize(static_cast<std::size_t>(rank));
  file.call(name, nc_inq_vardimid, file.id(), id, dimensions.data());
  std::vector<std::size_t> lengths(dimensions.size());
  for (std::size_t d = 0; d < lengths.size(); ++d)
    file.call(name, nc_inq_dimlen, file.id(), dimensions[d], &lengths[d]);
  return {id, lengths};
}

// A damaged header of a few bytes can announce any number of values: check it before allocating memory.
void require_few(const File& file, const std::string& name, std::size_t rows, std::size_t row) {
  constexpr std::size_t most = pstripack::most_nodes<std::int32_t>();
  if (rows > most / std::max<std::size_t>(row, 1))
    file.fail(fmt::format("variable {}: {} times {} values; there can be {} nodes at most", excerpt(name),
                          rows, row, most));
}

/// The numbers of a variable. Its last dimension is that of the nodes; others may come before it.
std::vector<double> read_numbers(const File& file, const std::string& name) {
  std::vector<int> dimensions;
  auto [id, lengths] = shape_of(file, name, dimensions);
  std::vector<std::size_t> start(lengths.size());
  if (file.is_read_in_parts() && !lengths.empty())
    std::tie(start.back(), lengths.back()) = file.part_of(lengths.back());
  std::size_t count = 1;
  for (const std::size_t length : lengths) count *= length;
  file.expect(name, id, count);
  std::vector<double> values(count);
  file.call(name, nc_get_vara_double, file.id(), id, start.data(), lengths.data(), values.data());
  return values;
}

/// A number of an attribute, or `otherwise`.
double number_attribute(const File& file, int variable, const char* name, double otherwise) {
  std::size_t length = 0;
  double value = 0;
  if (file.status(nc_inq_attlen, file.id(), variable, name, &length) != NC_NOERR || length != 1 ||
      file.status(nc_get_att_double, file.id(), variable, name, &value) != NC_NOERR)
    return otherwise;
  return value;
}

Variable read(const File& file, const std::string& name) {
  Variable v;
  v.name = name;
  const auto [id, lengths] = shape_of(file, name, v.dimensions);
  std::size_t count = 1;
  for (const std::size_t length : lengths) {
    require_few(file, name, length, count);
    count *= length;
  }
  if (file.is_read_in_parts()) {
    if (lengths.size() != 1)
      file.fail("variable " + excerpt(name) +
                ": several ranks read variables of one dimension, each its part");
    v.before = file.part_of(lengths[0]).first;
  }
  v.values = read_numbers(file, name);
  v.units = text_attribute(file, id, "units");
  v.id = id;
  if (file.status(nc_inq_attid, file.id(), id, "scale_factor", nullptr) == NC_NOERR)
    file.fail("variable " + excerpt(name) + ": packed (scale_factor); expected plain numbers");
  const double fill = number_attribute(file, id, "_FillValue", std::nan("")),
               missing = number_attribute(file, id, "missing_value", std::nan(""));
  for (std::size_t i = 0; i < v.values.size(); ++i) {
    double& value = v.values[i];
    if (std::isfinite(value) && value != fill && value != missing) continue;
    if (!file.keeps_missing())
      file.fail(
          fmt::format("variable {}, value {}: missing or not finite: remove the node, or say "
                      "--skip-missing",
                      excerpt(name), v.before + i + 1));
    value = std::nan("");
  }
  return v;
}

std::string name_of(const File& file, int variable) {
  char name[NC_MAX_NAME + 1];
  file.call("", nc_inq_varname, file.id(), variable, name);
  return name;
}

std::vector<std::string> variables_in(const File& file) {
  int count = 0;
  file.call("", nc_inq_nvars, file.id(), &count);
  std::vector<std::string> names;
  for (int v = 0; v < count; ++v) names.push_back(name_of(file, v));
  return names;
}

/// The words of a text, without empty ones.
std::vector<std::string> words_of(const std::string& text, char separator) {
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, separator);)
    if (!word.empty()) words.push_back(word);
  return words;
}

bool is_among(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string dimension_name(const File& file, int dimension) {
  char name[NC_MAX_NAME + 1];
  file.call("", nc_inq_dimname, file.id(), dimension, name);
  return excerpt(name);
}

/// "T(time=12, lat=96)".
std::string shape_text(const File& file, const std::string& name, const std::vector<int>& dimensions) {
  std::string text;
  for (const int dimension : dimensions) {
    std::size_t length = 0;
    file.call(name, nc_inq_dimlen, file.id(), dimension, &length);
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", dimension_name(file, dimension), length);
  }
  return fmt::format("{}({})", excerpt(name), text);
}

/// True if the dimensions are those of the nodes, possibly after others of length 1.
bool is_of_nodes(const File& file, const std::string& name, const std::vector<int>& of_nodes) {
  std::vector<int> dimensions;
  const std::vector<std::size_t> lengths = shape_of(file, name, dimensions).second;
  if (dimensions.size() < of_nodes.size()) return false;
  const std::size_t extra = dimensions.size() - of_nodes.size();
  for (std::size_t d = 0; d < extra; ++d)
    if (lengths[d] != 1) return false;
  return std::equal(of_nodes.begin(), of_nodes.end(),
                    dimensions.begin() + static_cast<std::ptrdiff_t>(extra));
}

/// The dimensions of a variable without the first ones that have length 1, such as WRF's Time; at least one.
std::vector<int> dimensions_of_places(const File& file, const std::string& name) {
  std::vector<int> dimensions;
  const std::vector<std::size_t> lengths = shape_of(file, name, dimensions).second;
  std::size_t extra = 0;
  while (extra + 1 < lengths.size() && lengths[extra] == 1) ++extra;
  dimensions.erase(dimensions.begin(), dimensions.begin() + static_cast<std::ptrdiff_t>(extra));
  return dimensions;
}

/// Names of the variables with one value per node, without these coordinates.
std::vector<std::string> names_of_values(const File& file, const std::vector<int>& of_nodes,
                                         const std::vector<int>& coordinates) {
  int count = 0;
  file.call("", nc_inq_nvars, file.id(), &count);
  std::vector<std::string> names;
  for (int v = 0; v < count; ++v) {
    const std::string name = name_of(file, v);
    nc_type type = NC_CHAR;
    file.call(name, nc_inq_vartype, file.id(), v, &type);
    const bool is_coordinate = std::find(coordinates.begin(), coordinates.end(), v) != coordinates.end();
    if (!is_coordinate && type != NC_CHAR && type <= NC_UINT64 && type != NC_STRING &&
        is_of_nodes(file, name, of_nodes))
      names.push_back(name);
  }
  return names;
}

/// The value of each node, NaN where it is missing.
Column read_column(const File& file, const std::string& name) {
  int id = -1;
  nc_type type = NC_CHAR;
  file.call(name, nc_inq_varid, file.id(), name.c_str(), &id);
  file.call(name, nc_inq_vartype, file.id(), id, &type);
  Column column{name, text_attribute(file, id, "long_name"), text_attribute(file, id, "units")};
  column.numbers = read_numbers(file, name);
  const double fill = number_attribute(file, id, "_FillValue", NC_FILL_DOUBLE);
  const double missing = number_attribute(file, id, "missing_value", fill);
  const double scale = number_attribute(file, id, "scale_factor", 1);
  const double offset = number_attribute(file, id, "add_offset", 0);
  for (double& v : column.numbers)
    if (v == fill || v == missing || !std::isfinite(v))
      v = std::nan("");
    else if (scale != 1 || offset != 0)  // scale and offset of 1 and 0 would turn -0 into 0
      v = v * scale + offset;
  column.whole =
      (type == NC_INT || type == NC_SHORT || type == NC_BYTE) && scale == 1 && offset == 0 &&
      std::none_of(column.numbers.begin(), column.numbers.end(), [](double v) { return std::isnan(v); });
  return column;
}

/// The values of the variable `name`, or of the only one if `name` is empty.
Column read_value(const File& file, std::string name, const std::vector<int>& of_nodes,
                  const std::vector<int>& coordinates) {
  if (name.empty() || !has(file, name)) {
    const std::vector<std::string> names = names_of_values(file, of_nodes, coordinates);
    if (!name.empty() || names.size() != 1)
      file.fail(fmt::format("{}say --variable NAME; variables with one value per node: {}",
                            name.empty() ? "" : "there is no variable " + excerpt(name) + "; ",
                            listed(names)));
    name = names[0];
  }
  std::vector<int> dimensions;
  const std::vector<std::size_t> lengths = shape_of(file, name, dimensions).second;
  if (!is_of_nodes(file, name, of_nodes)) {
    std::size_t extra = 0;  // the first dimension with several layers
    while (extra < lengths.size() && lengths[extra] == 1) ++extra;
    const bool has_layers = dimensions.size() > of_nodes.size() && extra < lengths.size();
    file.fail(fmt::format("variable {}: expected {}{}", shape_text(file, name, dimensions),
                          shape_text(file, name, of_nodes),
                          has_layers ? fmt::format("; take one layer out, say by ncks -d {},0",
                                                   dimension_name(file, dimensions[extra]))
                                     : ""));
  }
  return read_column(file, name);
}

/// Texts of equal length, padded with zeros or blanks.
Column read_texts(const File& file, int id, const std::string& name, std::size_t nodes, std::size_t length) {
  require_few(file, name, nodes, length);
  file.expect(name, id, nodes * length);
  std::string bytes(nodes * length, '\0');
  file.call(name, nc_get_var_text, file.id(), id, bytes.data());
  Column column{name, text_attribute(file, id, "long_name")};
  for (std::size_t i = 0; i < nodes; ++i) {
    std::string text = bytes.substr(i * length, length);
    text.resize(std::min(text.size(), text.find('\0')));
    text.resize(text.find_last_not_of(' ') + 1);
    column.texts.push_back(std::move(text));
  }
  return column;
}

/// The variables with a number or a text for each node, except the coordinates; or only those in `wanted`.
/// Texts are not read if several ranks read parts.
Columns read_columns(const File& file, std::size_t nodes, const std::vector<int>& of_nodes,
                     const std::vector<int>& coordinates, const std::vector<std::string>& wanted) {
  Columns columns;
  int count = 0;
  file.call("", nc_inq_nvars, file.id(), &count);
  for (int v = 0; v < count; ++v) {
    const std::string name = name_of(file, v);
    nc_type type = NC_CHAR;
    file.call(name, nc_inq_vartype, file.id(), v, &type);
    std::vector<int> dimensions;
    const std::vector<std::size_t> lengths = shape_of(file, name, dimensions).second;
    const bool is_wanted = std::find(wanted.begin(), wanted.end(), name) != wanted.end();
    if (std::find(coordinates.begin(), coordinates.end(), v) != coordinates.end() || name == "meshDensity")
      continue;
    if (!wanted.empty() && !is_wanted) continue;
    if (type == NC_CHAR && !file.is_read_in_parts() && dimensions.size() == of_nodes.size() + 1 &&
        std::equal(of_nodes.begin(), of_nodes.end(), dimensions.begin()))
      columns.push_back(read_texts(file, v, name, nodes, lengths.back()));
    else if (type != NC_CHAR && type <= NC_UINT64 && is_of_nodes(file, name, of_nodes))
      columns.push_back(read_column(file, name));
    else if (is_wanted)
      file.fail(fmt::format("variable {}: expected one value per node, {}",
                            shape_text(file, name, dimensions), shape_text(file, name, of_nodes)));
  }
  return columns;
}

enum class Holds { longitudes, latitudes, rotated, unknown };

/// What a variable holds by its attributes. `rotated`: longitudes or latitudes that count from another pole.
Holds what_holds(const File& file, int id) {
  const std::string standard_name = text_attribute(file, id, "standard_name"),
                    units = text_attribute(file, id, "units");
  if (standard_name == "grid_longitude" || standard_name == "grid_latitude") return Holds::rotated;
  if (standard_name == "longitude") return Holds::longitudes;
  if (standard_name == "latitude") return Holds::latitudes;
  const auto is_one_of = [](const std::string& word, std::initializer_list<const char*> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  if (is_one_of(units, {"degrees_east", "degree_east", "degree_E", "degrees_E", "degreeE", "degreesE"}))
    return Holds::longitudes;
  if (is_one_of(units, {"degrees_north", "degree_north", "degree_N", "degrees_N", "degreeN", "degreesN"}))
    return Holds::latitudes;
  return Holds::unknown;
}

std::string why_not_rotated(const std::string& names) {
  return fmt::format(
      "{}: angles of a rotated pole, not longitudes and latitudes, which `cdo "
      "setgridtype,curvilinear` adds to the file",
      names);
}

/// The dimensions of nodes with these longitudes and latitudes; empty: they do not belong together.
std::vector<int> dimensions_of_nodes(const std::vector<int>& lon, const std::vector<int>& lat) {
  if (lon == lat) return lon;
  return lon.size() == 1 && lat.size() == 1 ? std::vector<int>{lat[0], lon[0]} : std::vector<int>{};
}

/// The variables of longitudes and latitudes: those that the attribute `coordinates` of the variable `value`
/// names, else a usual pair, else the only pair whose attributes or names say what it is. Pairs whose
/// dimensions are not those of `value` come last.
std::pair<std::string, std::string> lon_lat_of(const File& file, const std::string& value) {
  using Pair = std::pair<std::string, std::string>;
  // Of MPAS, CF, SCRIP, NEMO, ICON, WRF, POP and CICE.
  static const std::vector<Pair> usual{{"lonCell", "latCell"},    {"lon", "lat"},
                                       {"longitude", "latitude"}, {"grid_center_lon", "grid_center_lat"},
                                       {"nav_lon", "nav_lat"},    {"glamt", "gphit"},
                                       {"clon", "clat"},          {"XLONG", "XLAT"},
                                       {"XLONG_M", "XLAT_M"},     {"TLONG", "TLAT"}};
  const std::vector<std::string> names = variables_in(file);
  std::vector<std::string> lons, lats, rotated, bounds;
  for (std::size_t v = 0; v < names.size(); ++v)
    bounds.push_back(text_attribute(file, static_cast<int>(v), "bounds"));
  for (std::size_t v = 0; v < names.size(); ++v) {
    if (is_among(bounds, names[v])) continue;
    Holds holds = what_holds(file, static_cast<int>(v));
    if (holds == Holds::unknown) {
      const auto is = [&](char axis, std::string Pair::*side) {
        return axis_of(names[v]) == axis ||
               std::any_of(usual.begin(), usual.end(), [&](const Pair& p) { return p.*side == names[v]; });
      };
      holds = is('o', &Pair::first)    ? Holds::longitudes
              : is('a', &Pair::second) ? Holds::latitudes
                                       : Holds::unknown;
    }
    if (holds == Holds::longitudes) lons.push_back(names[v]);
    if (holds == Holds::latitudes) lats.push_back(names[v]);
    if (holds == Holds::rotated) rotated.push_back(names[v]);
  }
  if (lons.empty() && lats.empty())
    file.fail(rotated.empty() ? "no nodes: expected variables xCell, yCell, zCell, or lonCell, latCell, or "
                                "lon, lat, or others whose units are degrees_east and degrees_north; or name "
                                "them by --columns LON,LAT"
                              : why_not_rotated(listed(rotated)));
  if (lons.empty() || lats.empty())
    file.fail(fmt::format("there is no variable of {} beside {}: name both by --columns LON,LAT",
                          lons.empty() ? "longitudes" : "latitudes", listed(lons.empty() ? lats : lons)));

  const bool has_value = is_among(names, value);
  if (has_value) {
    const auto id = static_cast<int>(std::find(names.begin(), names.end(), value) - names.begin());
    const std::vector<std::string> said = words_of(text_attribute(file, id, "coordinates"), ' ');
    std::vector<std::string> lon, lat;
    for (const std::string& word : said)
      if (is_among(lons, word))
        lon.push_back(word);
      else if (is_among(lats, word))
        lat.push_back(word);
    if (lon.size() == 1 && lat.size() == 1) return {lon[0], lat[0]};
  }
  std::vector<Pair> pairs;
  for (const Pair& p : usual)
    if (is_among(lons, p.first) && is_among(lats, p.second)) pairs.push_back(p);
  const auto of_nodes = [&](const Pair& p) {
    return dimensions_of_nodes(dimensions_of_places(file, p.first), dimensions_of_places(file, p.second));
  };
  for (const std::string& lon : lons)
    for (const std::string& lat : lats)
      if (const Pair p{lon, lat};
          std::find(pairs.begin(), pairs.end(), p) == pairs.end() && !of_nodes(p).empty())
        pairs.push_back(p);
  if (const auto end = std::stable_partition(
          pairs.begin(), pairs.end(),
          [&](const Pair& p) { return has_value && is_of_nodes(file, value, of_nodes(p)); });
      end != pairs.begin())
    pairs.erase(end, pairs.end());
  if (pairs.empty() || (pairs.size() > 1 && std::find(usual.begin(), usual.end(), pairs[0]) == usual.end()))
    file.fail(fmt::format("longitudes {} and latitudes {}: name two of them by --columns LON,LAT",
                          listed(lons), listed(lats)));
  return pairs.front();
}

/// True if the angles are in degrees, since radians are never as large.
bool are_beyond_radians(const Variable& v, bool are_latitudes) {
  constexpr double kRightAngle = 1.5707963267948966, kRounding = 1 + 1e-6;  // of single precision
  double largest = 0;
  for (const double angle : v.values) largest = std::max(largest, std::fabs(angle));
  return largest > (are_latitudes ? 1 : 4) * kRightAngle * kRounding &&
         largest <= (are_latitudes ? 90 : 360) * kRounding;
}

/// True if the units of the variable are degrees, false if radians.
bool in_degrees(const File& file, const Variable& v, bool are_latitudes) {
  if (v.units.rfind("deg", 0) == 0) return true;
  if (v.units.rfind("rad", 0) == 0) return false;
  if (v.units.empty() && (v.name == "lonCell" || v.name == "latCell")) return false;
  if (v.units.empty() && file.units() != Units::said_or_unmistakable) return file.units() == Units::degrees;
  if (v.units.empty() && !file.is_read_in_parts() && are_beyond_radians(v, are_latitudes)) return true;
  file.fail(fmt::format("variable {}: units '{}'; expected degrees or radians{}", excerpt(v.name),
                        excerpt(v.units), v.units.empty() ? ": say --units degrees or radians" : ""));
}

/// Points, and the angles and variables that belong to them.
struct Places {
  std::vector<Point> points;
  LonLat given;
  std::vector<int> dimensions;
  std::vector<int> variables;
  std::size_t before = 0;  ///< number of nodes that lower ranks read
  Grid grid = {};
};

/// Reads angles. Radians of type float that mean a multiple of pi/2 become the double that means it.
Variable read_angles(const File& file, const std::string& name, bool are_latitudes, bool& are_degrees) {
  Variable v = read(file, name);
  const Holds holds = what_holds(file, v.id);
  if (holds == Holds::rotated) file.fail(why_not_rotated(excerpt(name)));
  if (holds == (are_latitudes ? Holds::longitudes : Holds::latitudes))
    file.fail(fmt::format("variable {} holds {}: give the longitudes first, --columns LON,LAT", excerpt(name),
                          are_latitudes ? "longitudes" : "latitudes"));
  v.dimensions = dimensions_of_places(file, name);
  if (v.dimensions.size() > 2)
    file.fail(fmt::format("variable {}: expected one place per node; take one time out, say by ncks -d {},0",
                          shape_text(file, name, v.dimensions), dimension_name(file, v.dimensions[0])));
  are_degrees = in_degrees(file, v, are_latitudes);
  nc_type type = NC_DOUBLE;
  file.call(name, nc_inq_vartype, file.id(), v.id, &type);
  if (type == NC_FLOAT && !are_degrees)
    for (double& angle : v.values) angle = point_sets::radians_of_single(angle);
  return v;
}

Places from_angles(const File& file, const std::string& lon_name, const std::string& lat_name,
                   const char*& units) {
  bool lon_in_degrees = true, lat_in_degrees = true;
  const Variable lon = read_angles(file, lon_name, false, lon_in_degrees),
                 lat = read_angles(file, lat_name, true, lat_in_degrees);
  units = lat_in_degrees ? "degrees" : "radians";
  Angles angles{lon.values.data(), lat.values.data(), 1, lon_in_degrees, lat_in_degrees};
  if (const std::size_t bad = first_beyond_pole(angles, lat.values.size()); bad < lat.values.size())
    file.fail(fmt::format("variable {}, value {}: {} is beyond the pole{}", excerpt(lat.name),
                          lat.before + bad + 1, lat.values[bad],
                          !lat_in_degrees ? ": is the attribute units wrong, and are these degrees?"
                          : lon.values.size() == lat.values.size()
                              ? hint_beyond_pole(angles, lat.values.size(),
                                                 what_holds(file, lat.id) == Holds::unknown
                                                     ? excerpt(lat.name) + "," + excerpt(lon.name)
                                                     : "")
                              : ""));
  Places places;
  places.variables = {lon.id, lat.id};
  places.before = lat.before;
  places.dimensions = dimensions_of_nodes(lon.dimensions, lat.dimensions);
  if (lon.dimensions == lat.dimensions) {
    places.given.lon = lon.values;
    places.given.lat = lat.values;
  } else {
    if (places.dimensions.empty())
      file.fail(fmt::format("variables {} and {}: expected one shape, or two axes of one dimension each",
                            excerpt(lon.name), excerpt(lat.name)));
    require_few(file, lat.name, lat.values.size(), lon.values.size());
    if (file.is_read_in_parts())
      file.fail("a grid: several ranks read a list of nodes, each its part: use `pstripack convert`");
    const auto degrees_of = [](std::vector<double> angles, bool are_degrees) {
      for (double& angle : angles) angle *= are_degrees ? 1 : 57.29577951308232;
      return angles;
    };
    places.grid = {degrees_of(lon.values, lon_in_degrees), degrees_of(lat.values, lat_in_degrees)};
    for (const double y : lat.values)
      for (const double x : lon.values) {
        places.given.lon.push_back(x);
        places.given.lat.push_back(y);
      }
  }
  angles.lon = places.given.lon.data();
  angles.lat = places.given.lat.data();
  places.points = points_of(angles, places.given.lon.size());
  places.given.degrees = lat_in_degrees;
  if (lon_in_degrees != lat_in_degrees) places.given = {};  // angles in two units cannot be written back
  return places;
}

Places from_coordinates(const File& file, const std::string& x_name, const std::string& y_name,
                        const std::string& z_name) {
  const Variable x = read(file, x_name), y = read(file, y_name), z = read(file, z_name);
  if (x.dimensions != y.dimensions || x.dimensions != z.dimensions)
    file.fail(fmt::format("variables {}, {}, {}: expected one shape", excerpt(x_name), excerpt(y_name),
                          excerpt(z_name)));
  Places places;
  places.points.resize(x.values.size());
  for (std::size_t i = 0; i < places.points.size(); ++i)
    places.points[i] = {x.values[i], y.values[i], z.values[i]};
  places.dimensions = x.dimensions;
  places.variables = {x.id, y.id, z.id};
  places.before = x.before;
  return places;
}

/// Adds longitudes and latitudes that the file has beside the vectors. If they cannot be used, those computed
/// from the vectors serve as well.
void add_angles(const File& file, Places& places, const std::string& lon_name, const std::string& lat_name) {
  if (!places.given.empty() || !has(file, lon_name) || !has(file, lat_name)) return;
  const char* units = "";
  try {
    Places angles = from_angles(file, lon_name, lat_name, units);
    if (angles.dimensions != places.dimensions) return;
    for (std::size_t i = 0; i < places.points.size(); ++i) {
      const Point &p = places.points[i], &q = angles.points[i];
      const double length = dot(p, p), c = dot(p, q);
      if (!(c > 0 && length - c * c <= 1e-10 * length)) return;  // the angles belong to other nodes
    }
    places.given = std::move(angles.given);
    places.variables.insert(places.variables.end(), angles.variables.begin(), angles.variables.end());
  } catch (const std::runtime_error&) {
  }
}

/// Corners of triangles, row after row, counted from `first`. Corners of MPAS may be missing: such triangles
/// are left out unless `with_boundary`.
void read_triangles(const File& file, Nodes& nodes, const std::string& name, long long first,
                    bool is_mpas = false, bool with_boundary = false) {
  std::vector<int> dimensions;
  const auto [id, lengths] = shape_of(file, name, dimensions);
  if (lengths.size() != 2 || lengths[1] != 3)
    file.fail("variable " + excerpt(name) + ": expected faces of three corners each");
  require_few(file, name, lengths[0] / 2, 1);  // a triangulation has at most twice as many triangles as nodes
  file.expect(name, id, 3 * lengths[0]);
  std::vector<long long> corners(3 * lengths[0]);
  file.call(name, nc_get_var_longlong, file.id(), id, corners.data());
  if (with_boundary && std::find(corners.begin(), corners.end(), 0) != corners.end()) {
    nodes.vertices = from_coordinates(file, "xVertex", "yVertex", "zVertex").points;
    if (nodes.vertices.size() != lengths[0])
      file.fail(fmt::format("{} vertices in xVertex, {} in {}", nodes.vertices.size(), lengths[0], name));
    for (std::size_t v = 0; v < nodes.vertices.size(); ++v)
      if (!has_direction(nodes.vertices[v]))
        file.fail(fmt::format("vertex {}: xVertex, yVertex, zVertex are 0", v + 1));
  } else if (is_mpas) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      if (corners[k] == 0 || corners[k + 1] == 0 || corners[k + 2] == 0) continue;
      for (std::size_t j = 0; j < 3; ++j) corners[kept++] = corners[k + j];
    }
    corners.resize(kept);
  }
  set_triangles(nodes, corners, first);
}

/// The name of the variable that describes a UGRID mesh of faces; empty if the file has none.
std::string ugrid_mesh(const File& file) {
  int count = 0;
  file.call("", nc_inq_nvars, file.id(), &count);
  for (int v = 0; v < count; ++v) {
    if (text_attribute(file, v, "cf_role") != "mesh_topology") continue;
    char name[NC_MAX_NAME + 1];
    file.call("", nc_inq_varname, file.id(), v, name);
    return name;
  }
  return "";
}

/// Reads the nodes; sets `kind` and triangles of `nodes`.
Places read_ugrid(const File& file, Nodes& nodes, const std::string& mesh, bool with_triangles) {
  int id = 0;
  Places places;
  file.call(mesh, nc_inq_varid, file.id(), mesh.c_str(), &id);
  std::istringstream names(text_attribute(file, id, "node_coordinates"));
  std::string lon, lat;
  names >> lon >> lat;
  // Files written by pstripack also have the vectors, which need no rounding.
  if (has(file, mesh + "_node_x")) {
    places = from_coordinates(file, mesh + "_node_x", mesh + "_node_y", mesh + "_node_z");
    add_angles(file, places, lon, lat);
    nodes.kind += ", UGRID, x y z";
  } else {
    if (lat.empty()) file.fail("variable " + excerpt(mesh) + ": expected node_coordinates 'lon lat'");
    const char* units = "";
    places = from_angles(file, lon, lat, units);
    nodes.kind += fmt::format(", UGRID, lon lat in {}", units);
  }
  nodes.points = places.points;
  const std::string faces = text_attribute(file, id, "face_node_connectivity");
  if (!with_triangles || faces.empty()) return places;
  int faces_id = 0;
  file.call(faces, nc_inq_varid, file.id(), faces.c_str(), &faces_id);
  long long first = 0;
  file.status(nc_get_att_longlong, file.id(), faces_id, "start_index", &first);  // UGRID's default is 0
  read_triangles(file, nodes, faces, first);
  return places;
}

void read_notes(const File& file, Notes& notes) {
  int count = 0;
  file.call("", nc_inq_natts, file.id(), &count);
  for (int a = 0; a < count; ++a) {
    char name[NC_MAX_NAME + 1];
    file.call("", nc_inq_attname, file.id(), NC_GLOBAL, a, name);
    if (is_note(name)) notes[name] = text_attribute(file, NC_GLOBAL, name);
  }
  // What MPAS' tools write in a mesh that they make of this one.
  std::string parents = text_attribute(file, NC_GLOBAL, "file_id");
  const std::string older = text_attribute(file, NC_GLOBAL, "parent_id");
  if (!parents.empty()) notes["parent_id"] = parents + (older.empty() ? "" : "\n" + older);
}

/// The nodes whose coordinates --columns names; removes their names from `names`.
Places read_chosen(const File& file, Nodes& nodes, std::vector<std::string>& names, Coordinates coordinates) {
  const std::vector<std::string> variables = variables_in(file);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!has(file, names[i]))
      file.fail(fmt::format("there is no variable '{}'{}; the file has {}", excerpt(names[i]),
                            did_you_mean(names[i], variables), listed(variables)));
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i))
      file.fail(fmt::format("variable '{}' is chosen twice", excerpt(names[i])));
  }
  const std::size_t count = coordinates == Coordinates::xyz ? 3 : 2;
  if (names.size() < count)
    file.fail(fmt::format("--columns names {} variable{}: expected {}", names.size(),
                          names.size() == 1 ? "" : "s",
                          count == 3 ? "those of x, y and z" : "longitude and latitude"));
  Places places;
  if (count == 3) {
    places = from_coordinates(file, names[0], names[1], names[2]);
    nodes.kind += fmt::format(", {} {} {}", names[0], names[1], names[2]);
  } else {
    const char* units = "";
    places = from_angles(file, names[0], names[1], units);
    nodes.kind += fmt::format(", {} {} in {}", names[0], names[1], units);
  }
  names.erase(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(count));
  return places;
}

}  // namespace

Nodes read_netcdf(const std::string& name, const ReadOptions& options, const std::string& contents) {
  const File file(name, contents, options);
  Nodes nodes;
  nodes.file = name;
  nodes.kind = "NetCDF";
  Places places;
  std::vector<std::string> wanted = words_of(options.columns, ',');
  if (!wanted.empty()) {
    places = read_chosen(file, nodes, wanted, options.coordinates);
  } else if (const std::string mesh = ugrid_mesh(file); !mesh.empty()) {
    places = read_ugrid(file, nodes, mesh, options.with_triangles);
  } else if (has(file, "xCell") && options.coordinates != Coordinates::lonlat) {
    places = from_coordinates(file, "xCell", "yCell", "zCell");
    add_angles(file, places, "lonCell", "latCell");
    add_angles(file, places, "lon", "lat");
    nodes.kind += ", xCell yCell zCell";
  } else {
    const char* units = "";
    const auto [lon, lat] = lon_lat_of(file, options.with_values ? options.variable : "");
    places = from_angles(file, lon, lat, units);
    nodes.kind += fmt::format(", {} {} in {}", lon, lat, units);
  }
  nodes.points = std::move(places.points);
  nodes.before = places.before;
  nodes.given = std::move(places.given);
  nodes.grid = std::move(places.grid);
  for (const int dimension : places.dimensions) {
    nodes.shape.emplace_back();
    file.call("", nc_inq_dimlen, file.id(), dimension, &nodes.shape.back());
  }
  if (nodes.points.empty() && !file.is_read_in_parts()) file.fail("no nodes: the variables are empty");
  if (options.with_values) {
    std::string variable = options.variable;
    if (variable.empty() && !wanted.empty()) variable = wanted[0];
    for (const std::string& usual : options.usual_variables)
      if (variable.empty() && has(file, usual)) variable = usual;
    nodes.value = read_value(file, variable, places.dimensions, places.variables);
    wanted.erase(std::remove(wanted.begin(), wanted.end(), variable), wanted.end());
  }
  if (options.with_columns && (options.columns.empty() || !wanted.empty()))
    nodes.columns = read_columns(file, nodes.points.size(), places.dimensions, places.variables, wanted);
  read_notes(file, nodes.notes);
  if (has(file, "meshDensity")) nodes.density = read(file, "meshDensity").values;
  if (nodes.density.size() != nodes.points.size()) nodes.density.clear();
  if (options.with_triangles && has(file, "xCell") && has(file, "cellsOnVertex"))
    read_triangles(file, nodes, "cellsOnVertex", 1, true, options.with_boundary);
  if (const double radius = number_attribute(file, NC_GLOBAL, "sphere_radius", 1);
      radius > 0 && std::isfinite(radius))
    nodes.radius = radius;
  return nodes;
}

}  // namespace files
