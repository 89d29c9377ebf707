// Nodes of NetCDF files. They are those of a UGRID mesh, or xCell, yCell, zCell, or a pair of longitudes and
// latitudes, which lon_lat_of() finds. The two variables of a pair have one shape, or are the axes of a grid,
// which is read row by row of latitude. Their units are those of the attribute; without it radians for
// lonCell and latCell, else those of the options, else degrees if the values cannot be radians, else it is an
// error.

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "files/nearest.h"
#include "files/nodes.h"
#include "files/text_table.h"
#include "lists/limits.h"
#include "parallel/local_nodes.h"
#include "point_sets.h"
#include "text_file.h"

namespace files {
namespace {

using point_sets::excerpt;
using Names = std::vector<std::string>;

/// The header of a file in a classic format: CDF-1, CDF-2 or CDF-5.
class ClassicHeader {
 public:
  /// Throws if the file ends before its last value: libnetcdf takes what is missing as zeros.
  static void expect_whole(std::istream&& file, const std::string& name) {
    if (!ClassicHeader(file).is_whole())
      throw std::runtime_error(name + ": incomplete NetCDF file: it ends before its last value");
  }

 private:
  explicit ClassicHeader(std::istream& file) : file_(file) {}

  bool is_whole() {
    struct Extent {
      std::uint64_t begin, bytes;
      bool has_records;
    };
    std::vector<Extent> variables;
    const std::uint64_t version = number(4) - 0x43444600;  // "CDF" and the version
    if (version != 1 && version != 2 && version != 5) return true;
    count_size_ = version == 5 ? 8 : 4;
    const std::uint64_t records = number(count_size_);
    std::vector<std::uint64_t> lengths;
    for_each_item([&] { lengths.push_back(number(count_size_)); });
    skip_attributes();
    for_each_item([&] {
      Extent& v = variables.emplace_back(Extent{0, 1, false});
      const std::uint64_t rank = number(count_size_);
      for (std::uint64_t d = 0; d < rank && file_; ++d) {
        const std::uint64_t dimension = number(count_size_),
                            length = dimension < lengths.size() ? lengths[dimension] : 1;
        if (length == 0)
          v.has_records = true;
        else
          v.bytes *= length;
      }
      skip_attributes();
      v.bytes *= size_of_type();
      number(count_size_);  // the size once more
      v.begin = number(version == 1 ? 4 : 8);
    });
    std::uint64_t record = 0, end = 0;
    const auto with_records =
        std::count_if(variables.begin(), variables.end(), [](const Extent& v) { return v.has_records; });
    for (const Extent& v : variables)
      if (v.has_records) record += with_records == 1 ? v.bytes : padded(v.bytes);
    for (const Extent& v : variables)
      if (!v.has_records || records > 0)
        end = std::max(end, v.begin + v.bytes + (v.has_records ? (records - 1) * record : 0));
    return file_ && file_.seekg(0, std::ios::end).tellg() >= static_cast<std::streamoff>(end);
  }

  static std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }
  std::uint64_t number(int bytes) {
    std::uint64_t value = 0;
    for (; bytes > 0; --bytes) value = value << 8 | static_cast<std::uint64_t>(file_.get() & 0xff);
    return value;
  }
  void skip(std::uint64_t bytes) { file_.ignore(static_cast<std::streamsize>(padded(bytes))); }
  /// For dimensions, attributes and variables: reads their names, and calls read() for the rest of each.
  template <class Read>
  void for_each_item(const Read& read) {
    number(4);
    for (std::uint64_t left = number(count_size_); left > 0 && file_; --left) {
      skip(number(count_size_));
      read();
    }
  }
  std::uint64_t size_of_type() {
    constexpr int kSizes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    return static_cast<std::uint64_t>(kSizes[std::min<std::uint64_t>(number(4), 11)]);
  }
  void skip_attributes() {
    for_each_item([&] {
      const std::uint64_t size = size_of_type();
      skip(size * number(count_size_));
    });
  }

  std::istream& file_;
  int count_size_ = 4;
};

/// What the header says of a variable.
struct Variable {
  std::string name;
  int id = -1;
  nc_type type = NC_CHAR;
  std::vector<int> dimensions = {};
  std::vector<std::size_t> lengths = {};

  bool has_numbers() const { return type != NC_CHAR && type <= NC_UINT64; }
  std::size_t size() const {
    std::size_t product = 1;
    for (const std::size_t length : lengths) product *= length;
    return product;
  }
  /// The number of dimensions of length 1, such as WRF's Time, before the others.
  std::size_t leading_ones() const {
    std::size_t count = 0;
    while (count < lengths.size() && lengths[count] == 1) ++count;
    return count;
  }
  /// The dimensions without these; at least one.
  std::vector<int> dimensions_of_places() const {
    const std::size_t extra = std::min(leading_ones(), std::max<std::size_t>(lengths.size(), 1) - 1);
    return {dimensions.begin() + static_cast<std::ptrdiff_t>(extra), dimensions.end()};
  }
  /// True if the dimensions are those of the nodes, possibly after others of length 1.
  bool is_of(const std::vector<int>& nodes) const {
    return dimensions.size() >= nodes.size() && dimensions.size() - nodes.size() <= leading_ones() &&
           std::equal(nodes.rbegin(), nodes.rend(), dimensions.rbegin());
  }
};

/// A NetCDF file open for reading.
class File {
 public:
  File(const std::string& name, const std::string& contents, const ReadOptions& options)
      : name_(name), options_(options) {
    if (contents.empty()) {
      ClassicHeader::expect_whole(std::ifstream(name, std::ios::binary), name);
      check("", nc_open(name.c_str(), NC_NOWRITE, &id_));
    } else {  // NetCDF takes bytes to read as void*, and does not change them without NC_WRITE
      ClassicHeader::expect_whole(std::istringstream(contents), name);
      check("",
            nc_open_mem(name.c_str(), NC_NOWRITE, contents.size(), const_cast<char*>(contents.data()), &id_));
    }
    int count = 0;
    call("", nc_inq_nvars, &count);
    for (int id = 0; id < count; ++id) add(id);
  }
  ~File() { nc_close(id_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(name_ + ": " + what); }
  /// function(file, arguments...) of libnetcdf.
  template <class... Parameters, class... Arguments>
  void call(const std::string& variable, int (*function)(int, Parameters...), Arguments... arguments) const {
    check(variable, function(id_, arguments...));
  }

  const std::vector<Variable>& variables() const { return variables_; }
  const Variable* find(const std::string& name) const {
    const auto found =
        std::find_if(variables_.begin(), variables_.end(), [&](const Variable& v) { return v.name == name; });
    return found == variables_.end() ? nullptr : &*found;
  }
  const Variable& variable(const std::string& name) const {
    const Variable* const found = find(name);
    if (found == nullptr)
      fail(fmt::format("there is no variable '{}'{}; the file has {}", excerpt(name),
                       did_you_mean(name, names()), listed(names())));
    return *found;
  }
  Names names() const {
    Names all;
    for (const Variable& v : variables_) all.push_back(v.name);
    return all;
  }

  /// An attribute, or "" if it is none or no text.
  std::string text(int variable, const char* attribute) const {
    std::string text;
    nc_type type = NC_CHAR;
    std::size_t length = 0;
    if (nc_inq_att(id_, variable, attribute, &type, &length) != NC_NOERR) return text;
    if (type == NC_CHAR) {
      text.resize(length);
      call(attribute, nc_get_att_text, variable, attribute, text.data());
    } else if (type == NC_STRING && length == 1) {
      char* string = nullptr;
      call(attribute, nc_get_att_string, variable, attribute, &string);
      if (string != nullptr) text = string;
      nc_free_string(1, &string);
    }
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();  // of Fortran
    return text;
  }
  /// An attribute, or `otherwise` if it is not one number.
  double number(int variable, const char* attribute, double otherwise) const {
    std::size_t length = 0;
    double value = 0;
    if (nc_inq_attlen(id_, variable, attribute, &length) != NC_NOERR || length != 1 ||
        nc_get_att_double(id_, variable, attribute, &value) != NC_NOERR)
      return otherwise;
    return value;
  }

  /// The values of a variable as its attributes tell them; NaN: missing. Ranks that read parts get theirs of
  /// the last dimension.
  std::vector<double> values(const Variable& v) const {
    std::vector<std::size_t> start(v.lengths.size()), count = v.lengths;
    if (is_read_in_parts() && !count.empty()) {
      start.back() = before(count.back());
      count.back() = pstripack::slice_begin(count.back(), options_.part + 1, options_.parts) - start.back();
    }
    std::size_t size = 1;
    for (const std::size_t length : count) size *= expect_few(v, length, size);
    std::vector<double> values(size);
    call(v.name, nc_get_vara_double, v.id, start.data(), count.data(), values.data());
    const double fill = number(v.id, "_FillValue", NC_FILL_DOUBLE),
                 missing = number(v.id, "missing_value", fill);
    const double scale = number(v.id, "scale_factor", 1), offset = number(v.id, "add_offset", 0);
    for (double& value : values)
      if (value == fill || value == missing || !std::isfinite(value))
        value = std::nan("");
      else if (scale != 1 || offset != 0)  // scale and offset of 1 and 0 would turn -0 into 0
        value = value * scale + offset;
    return values;
  }
  bool is_packed(const Variable& v) const {
    return number(v.id, "scale_factor", 1) != 1 || number(v.id, "add_offset", 0) != 0;
  }
  /// Returns `rows`. A header of a few bytes can announce any number of values.
  std::size_t expect_few(const Variable& v, std::size_t rows, std::size_t row) const {
    constexpr std::size_t most = pstripack::most_nodes<std::int32_t>();
    if (rows > most / std::max<std::size_t>(row, 1))
      fail(fmt::format("variable {}: {} times {} values; there can be {} nodes at most", excerpt(v.name),
                       rows, row, most));
    return rows;
  }

  std::string dimension_name(int dimension) const {
    char name[NC_MAX_NAME + 1];
    call("", nc_inq_dimname, dimension, name);
    return excerpt(name);
  }
  std::size_t length_of(int dimension) const {
    std::size_t length = 0;
    call("", nc_inq_dimlen, dimension, &length);
    return length;
  }
  /// "T(time=12, lat=96)".
  std::string shape(const std::string& name, const std::vector<int>& dimensions) const {
    Names parts;
    for (const int dimension : dimensions)
      parts.push_back(fmt::format("{}={}", dimension_name(dimension), length_of(dimension)));
    return fmt::format("{}({})", excerpt(name), fmt::join(parts, ", "));
  }

  const ReadOptions& options() const { return options_; }
  bool is_read_in_parts() const { return options_.parts > 1; }
  /// The number of values that lower ranks read of so many, or of a variable.
  std::size_t before(std::size_t n) const { return pstripack::slice_begin(n, options_.part, options_.parts); }
  std::size_t before(const Variable& v) const { return v.lengths.empty() ? 0 : before(v.lengths.back()); }

 private:
  void check(const std::string& variable, int status) const {
    if (status != NC_NOERR)
      fail((variable.empty() ? "" : "variable " + excerpt(variable) + ": ") + nc_strerror(status));
  }
  void add(int id) {
    char name[NC_MAX_NAME + 1];
    int rank = 0;
    call("", nc_inq_varname, id, name);
    Variable& v = variables_.emplace_back(Variable{name, id});
    call(name, nc_inq_vartype, id, &v.type);
    call(name, nc_inq_varndims, id, &rank);
    v.dimensions.resize(static_cast<std::size_t>(rank));
    call(name, nc_inq_vardimid, id, v.dimensions.data());
    for (const int dimension : v.dimensions) v.lengths.push_back(length_of(dimension));
  }

  std::string name_;
  const ReadOptions& options_;
  std::vector<Variable> variables_;
  int id_ = -1;
};

/// The values of a coordinate or density.
std::vector<double> read_of_nodes(const File& file, const Variable& v) {
  if (file.is_read_in_parts() && v.lengths.size() != 1)
    file.fail("variable " + excerpt(v.name) +
              ": several ranks read variables of one dimension, each its part");
  std::vector<double> values = file.values(v);
  for (std::size_t i = 0; !file.options().keep_missing && i < values.size(); ++i)
    if (std::isnan(values[i]))
      file.fail(
          fmt::format("variable {}, value {}: missing or not finite: remove the node, or say --skip-missing",
                      excerpt(v.name), file.before(v) + i + 1));
  return values;
}

/// The words of a text, without empty ones.
Names words_of(const std::string& text, char separator) {
  Names words = parts_of(text, separator);
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  return words;
}

template <class Item>
bool is_among(const std::vector<Item>& items, const Item& item) {
  return std::find(items.begin(), items.end(), item) != items.end();
}

Column read_column(const File& file, const Variable& v) {
  Column column{v.name, file.text(v.id, "long_name"), file.text(v.id, "units"), file.values(v)};
  column.whole =
      (v.type == NC_INT || v.type == NC_SHORT || v.type == NC_BYTE) && !file.is_packed(v) &&
      std::none_of(column.numbers.begin(), column.numbers.end(), [](double x) { return std::isnan(x); });
  return column;
}

/// Texts of equal length, padded with zeros or blanks.
Column read_texts(const File& file, const Variable& v, std::size_t nodes) {
  const std::size_t length = v.lengths.back();
  std::string bytes(nodes * file.expect_few(v, length, nodes), '\0');
  file.call(v.name, nc_get_var_text, v.id, bytes.data());
  Column column{v.name, file.text(v.id, "long_name")};
  for (std::size_t i = 0; i < nodes; ++i) {
    std::string text = bytes.substr(i * length, length);
    text.resize(std::min(text.size(), text.find('\0')));
    text.resize(text.find_last_not_of(' ') + 1);
    column.texts.push_back(std::move(text));
  }
  return column;
}

enum class Holds { longitudes, latitudes, rotated, unknown };

/// What a variable holds by its attributes. `rotated`: longitudes or latitudes that count from another pole.
Holds what_holds(const File& file, const Variable& v) {
  const std::string standard_name = file.text(v.id, "standard_name"), units = file.text(v.id, "units");
  if (standard_name == "grid_longitude" || standard_name == "grid_latitude") return Holds::rotated;
  if (standard_name == "longitude") return Holds::longitudes;
  if (standard_name == "latitude") return Holds::latitudes;
  static const std::set<std::string> east{"degrees_east", "degree_east", "degree_E",
                                          "degrees_E",    "degreeE",     "degreesE"},
      north{"degrees_north", "degree_north", "degree_N", "degrees_N", "degreeN", "degreesN"};
  return east.count(units) > 0    ? Holds::longitudes
         : north.count(units) > 0 ? Holds::latitudes
                                  : Holds::unknown;
}

std::string why_not_rotated(const std::string& names) {
  return fmt::format(
      "{}: angles of a rotated pole, not longitudes and latitudes, which `cdo "
      "setgridtype,curvilinear` adds to the file",
      names);
}

/// The dimensions of nodes with these longitudes and latitudes; empty: they do not belong together.
std::vector<int> dimensions_of_nodes(const Variable& lon, const Variable& lat) {
  const std::vector<int> of_lon = lon.dimensions_of_places(), of_lat = lat.dimensions_of_places();
  if (of_lon == of_lat) return of_lon;
  return of_lon.size() == 1 && of_lat.size() == 1 ? std::vector<int>{of_lat[0], of_lon[0]}
                                                  : std::vector<int>{};
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
  Names lons, lats, rotated, bounds;
  for (const Variable& v : file.variables()) bounds.push_back(file.text(v.id, "bounds"));
  for (const Variable& v : file.variables()) {
    if (is_among(bounds, v.name)) continue;
    const auto is = [&](char axis, std::string Pair::*side) {
      return axis_of(v.name) == axis ||
             std::any_of(usual.begin(), usual.end(), [&](const Pair& p) { return p.*side == v.name; });
    };
    const Holds holds = what_holds(file, v);
    if (holds == Holds::rotated)
      rotated.push_back(v.name);
    else if (holds == Holds::longitudes || (holds == Holds::unknown && is('o', &Pair::first)))
      lons.push_back(v.name);
    else if (holds == Holds::latitudes || is('a', &Pair::second))
      lats.push_back(v.name);
  }
  if (lons.empty() && lats.empty())
    file.fail(rotated.empty() ? "no nodes: expected variables xCell, yCell, zCell, or lonCell, latCell, or "
                                "lon, lat, or others whose units are degrees_east and degrees_north; or name "
                                "them by --columns LON,LAT"
                              : why_not_rotated(listed(rotated)));
  if (lons.empty() || lats.empty())
    file.fail(fmt::format("there is no variable of {} beside {}: name both by --columns LON,LAT",
                          lons.empty() ? "longitudes" : "latitudes", listed(lons.empty() ? lats : lons)));

  const Variable* const of_value = file.find(value);
  if (of_value != nullptr) {
    Names lon, lat;
    for (const std::string& word : words_of(file.text(of_value->id, "coordinates"), ' '))
      if (is_among(lons, word))
        lon.push_back(word);
      else if (is_among(lats, word))
        lat.push_back(word);
    if (lon.size() == 1 && lat.size() == 1) return {lon[0], lat[0]};
  }
  const auto of_nodes = [&](const Pair& p) {
    return dimensions_of_nodes(*file.find(p.first), *file.find(p.second));
  };
  std::vector<Pair> pairs;
  for (const Pair& p : usual)
    if (is_among(lons, p.first) && is_among(lats, p.second)) pairs.push_back(p);
  for (const std::string& lon : lons)
    for (const std::string& lat : lats)
      if (const Pair p{lon, lat}; !is_among(pairs, p) && !of_nodes(p).empty()) pairs.push_back(p);
  const auto end = std::stable_partition(pairs.begin(), pairs.end(), [&](const Pair& p) {
    return of_value != nullptr && of_value->is_of(of_nodes(p));
  });
  if (end != pairs.begin()) pairs.erase(end, pairs.end());
  if (pairs.empty() || (pairs.size() > 1 && !is_among(usual, pairs[0])))
    file.fail(fmt::format("longitudes {} and latitudes {}: name two of them by --columns LON,LAT",
                          listed(lons), listed(lats)));
  return pairs.front();
}

/// Longitudes or latitudes.
struct AnglesOfNodes {
  const Variable& variable;
  std::vector<double> values;
  bool are_degrees;
};

/// True if the angles are in degrees, since radians are never as large.
bool are_beyond_radians(const std::vector<double>& values, bool are_latitudes) {
  constexpr double kRightAngle = 1.5707963267948966, kRounding = 1 + 1e-6;  // of single precision
  double largest = 0;
  for (const double angle : values) largest = std::max(largest, std::fabs(angle));
  return largest > (are_latitudes ? 1 : 4) * kRightAngle * kRounding &&
         largest <= (are_latitudes ? 90 : 360) * kRounding;
}

/// True if the units of the variable are degrees, false if radians.
bool in_degrees(const File& file, const Variable& v, const std::vector<double>& values, bool are_latitudes) {
  const std::string units = file.text(v.id, "units");
  const Units said = file.options().units;
  if (units.rfind("deg", 0) == 0) return true;
  if (units.rfind("rad", 0) == 0) return false;
  if (units.empty()) {
    if (v.name == "lonCell" || v.name == "latCell") return false;
    if (said != Units::said_or_unmistakable) return said == Units::degrees;
    if (!file.is_read_in_parts() && are_beyond_radians(values, are_latitudes)) return true;
  }
  file.fail(fmt::format("variable {}: units '{}'; expected degrees or radians{}", excerpt(v.name),
                        excerpt(units), units.empty() ? ": say --units degrees or radians" : ""));
}

/// Reads angles. Radians of type float that mean a multiple of pi/2 become the double that means it.
AnglesOfNodes read_angles(const File& file, const std::string& name, bool are_latitudes) {
  const Variable& v = file.variable(name);
  AnglesOfNodes angles{v, read_of_nodes(file, v), true};
  const Holds holds = what_holds(file, v);
  if (holds == Holds::rotated) file.fail(why_not_rotated(excerpt(name)));
  if (holds == (are_latitudes ? Holds::longitudes : Holds::latitudes))
    file.fail(fmt::format("variable {} holds {}: give the longitudes first, --columns LON,LAT", excerpt(name),
                          are_latitudes ? "longitudes" : "latitudes"));
  if (const std::vector<int> dimensions = v.dimensions_of_places(); dimensions.size() > 2)
    file.fail(fmt::format("variable {}: expected one place per node; take one time out, say by ncks -d {},0",
                          file.shape(name, dimensions), file.dimension_name(dimensions[0])));
  angles.are_degrees = in_degrees(file, v, angles.values, are_latitudes);
  if (v.type == NC_FLOAT && !angles.are_degrees)
    for (double& angle : angles.values) angle = point_sets::radians_of_single(angle);
  return angles;
}

/// Points, and the angles and variables that belong to them.
struct Places {
  std::vector<Point> points;
  LonLat given;
  std::vector<int> dimensions = {};
  std::vector<int> variables;
  Grid grid = {};
  const char* units = "";  ///< of the angles
};

Places from_angles(const File& file, const std::string& lon_name, const std::string& lat_name) {
  const AnglesOfNodes lon = read_angles(file, lon_name, false), lat = read_angles(file, lat_name, true);
  const Angles angles{lon.values.data(), lat.values.data(), 1, lon.are_degrees, lat.are_degrees};
  if (const std::size_t bad = first_beyond_pole(angles, lat.values.size()); bad < lat.values.size())
    file.fail(fmt::format("variable {}, value {}: {} is beyond the pole{}", excerpt(lat_name),
                          file.before(lat.variable) + bad + 1, lat.values[bad],
                          !lat.are_degrees ? ": is the attribute units wrong, and are these degrees?"
                          : lon.values.size() == lat.values.size()
                              ? hint_beyond_pole(angles, lat.values.size(),
                                                 what_holds(file, lat.variable) == Holds::unknown
                                                     ? excerpt(lat_name) + "," + excerpt(lon_name)
                                                     : "")
                              : ""));
  Places places;
  places.variables = {lon.variable.id, lat.variable.id};
  places.dimensions = dimensions_of_nodes(lon.variable, lat.variable);
  if (lon.variable.dimensions_of_places() == lat.variable.dimensions_of_places()) {
    places.given.lon = lon.values;
    places.given.lat = lat.values;
  } else {
    if (places.dimensions.empty())
      file.fail(fmt::format("variables {} and {}: expected one shape, or two axes of one dimension each",
                            excerpt(lon_name), excerpt(lat_name)));
    file.expect_few(lat.variable, lat.values.size(), lon.values.size());
    if (file.is_read_in_parts())
      file.fail("a grid: several ranks read a list of nodes, each its part: use `pstripack convert`");
    const auto degrees_of = [](const AnglesOfNodes& axis) {
      std::vector<double> values = axis.values;
      for (double& angle : values) angle *= axis.are_degrees ? 1 : 57.29577951308232;
      return values;
    };
    places.grid = {degrees_of(lon), degrees_of(lat)};
    places.given = Grid{lon.values, lat.values}.places();
  }
  places.points =
      points_of({places.given.lon.data(), places.given.lat.data(), 1, lon.are_degrees, lat.are_degrees},
                places.given.lon.size());
  places.given.degrees = lat.are_degrees;
  places.units = lat.are_degrees ? "degrees" : "radians";
  if (lon.are_degrees != lat.are_degrees) places.given = {};  // angles in two units cannot be written back
  return places;
}

Places from_coordinates(const File& file, const std::string& x_name, const std::string& y_name,
                        const std::string& z_name) {
  const Variable &x = file.variable(x_name), &y = file.variable(y_name), &z = file.variable(z_name);
  if (x.dimensions != y.dimensions || x.dimensions != z.dimensions)
    file.fail(fmt::format("variables {}, {}, {}: expected one shape", excerpt(x_name), excerpt(y_name),
                          excerpt(z_name)));
  const std::vector<double> xs = read_of_nodes(file, x), ys = read_of_nodes(file, y),
                            zs = read_of_nodes(file, z);
  Places places;
  for (std::size_t i = 0; i < xs.size(); ++i) places.points.push_back({xs[i], ys[i], zs[i]});
  places.dimensions = x.dimensions;
  places.variables = {x.id, y.id, z.id};
  return places;
}

/// Adds longitudes and latitudes that the file has beside the vectors. If they cannot be used, those computed
/// from the vectors serve as well.
void add_angles(const File& file, Places& places, const std::string& lon_name, const std::string& lat_name) {
  if (!places.given.empty() || file.find(lon_name) == nullptr || file.find(lat_name) == nullptr) return;
  try {
    Places angles = from_angles(file, lon_name, lat_name);
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
                    bool is_mpas = false) {
  const Variable& v = file.variable(name);
  if (v.lengths.size() != 2 || v.lengths[1] != 3)
    file.fail("variable " + excerpt(name) + ": expected faces of three corners each");
  file.expect_few(v, v.lengths[0] / 2, 1);  // a triangulation has at most twice as many triangles as nodes
  std::vector<long long> corners(v.size());
  file.call(name, nc_get_var_longlong, v.id, corners.data());
  if (is_mpas && file.options().with_boundary && is_among(corners, 0LL)) {
    nodes.vertices = from_coordinates(file, "xVertex", "yVertex", "zVertex").points;
    if (nodes.vertices.size() != v.lengths[0])
      file.fail(fmt::format("{} vertices in xVertex, {} in {}", nodes.vertices.size(), v.lengths[0], name));
    for (std::size_t i = 0; i < nodes.vertices.size(); ++i)
      if (!has_direction(nodes.vertices[i]))
        file.fail(fmt::format("vertex {}: xVertex, yVertex, zVertex are 0", i + 1));
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

/// Reads the nodes of a UGRID mesh; sets `kind` and triangles of `nodes`.
Places read_ugrid(const File& file, Nodes& nodes, const Variable& mesh) {
  Places places;
  const Names angles = words_of(file.text(mesh.id, "node_coordinates"), ' ');
  // Files written by pstripack also have the vectors, which need no rounding.
  if (file.find(mesh.name + "_node_x") != nullptr) {
    places = from_coordinates(file, mesh.name + "_node_x", mesh.name + "_node_y", mesh.name + "_node_z");
    if (angles.size() > 1) add_angles(file, places, angles[0], angles[1]);
    nodes.kind += ", UGRID, x y z";
  } else {
    if (angles.size() < 2)
      file.fail("variable " + excerpt(mesh.name) + ": expected node_coordinates 'lon lat'");
    places = from_angles(file, angles[0], angles[1]);
    nodes.kind += fmt::format(", UGRID, lon lat in {}", places.units);
  }
  nodes.points = places.points;
  const std::string faces = file.text(mesh.id, "face_node_connectivity");
  if (file.options().with_triangles && !faces.empty())  // UGRID's default of start_index is 0
    read_triangles(file, nodes, faces,
                   static_cast<long long>(file.number(file.variable(faces).id, "start_index", 0)));
  return places;
}

/// The nodes whose coordinates --columns names; removes their names from `names`.
Places read_chosen(const File& file, Nodes& nodes, Names& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    file.variable(names[i]);
    if (std::count(names.begin(), names.end(), names[i]) > 1)
      file.fail(fmt::format("variable '{}' is chosen twice", excerpt(names[i])));
  }
  const std::size_t count = file.options().coordinates == Coordinates::xyz ? 3 : 2;
  if (names.size() < count)
    file.fail(fmt::format("--columns names {} variable{}: expected {}", names.size(),
                          names.size() == 1 ? "" : "s",
                          count == 3 ? "those of x, y and z" : "longitude and latitude"));
  Places places;
  if (count == 3) {
    places = from_coordinates(file, names[0], names[1], names[2]);
    nodes.kind += fmt::format(", {} {} {}", names[0], names[1], names[2]);
  } else {
    places = from_angles(file, names[0], names[1]);
    nodes.kind += fmt::format(", {} {} in {}", names[0], names[1], places.units);
  }
  names.erase(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(count));
  return places;
}

/// The values of the variable `name`, or of the only one if `name` is empty.
Column read_value(const File& file, const std::string& name, const Places& places) {
  const Variable* found = file.find(name);
  if (found == nullptr) {
    Names names;
    for (const Variable& v : file.variables())
      if (!is_among(places.variables, v.id) && v.has_numbers() && v.is_of(places.dimensions))
        names.push_back(v.name);
    if (!name.empty() || names.size() != 1)
      file.fail(fmt::format("{}say --variable NAME; variables with one value per node: {}",
                            name.empty() ? "" : "there is no variable " + excerpt(name) + "; ",
                            listed(names)));
    found = file.find(names[0]);
  }
  const Variable& v = *found;
  if (v.is_of(places.dimensions)) return read_column(file, v);
  const std::size_t layers = v.leading_ones();  // the first dimension with several
  file.fail(fmt::format("variable {}: expected {}{}", file.shape(v.name, v.dimensions),
                        file.shape(v.name, places.dimensions),
                        v.dimensions.size() > places.dimensions.size() && layers < v.lengths.size()
                            ? fmt::format("; take one layer out, say by ncks -d {},0",
                                          file.dimension_name(v.dimensions[layers]))
                            : ""));
}

/// The variables with a number or a text for each node, except the coordinates; or only those in `wanted`.
/// Texts are not read if several ranks read parts.
Columns read_columns(const File& file, std::size_t nodes, const Places& places, const Names& wanted) {
  Columns columns;
  for (const Variable& v : file.variables()) {
    const bool is_wanted = is_among(wanted, v.name);
    if (is_among(places.variables, v.id) || v.name == "meshDensity" || (!wanted.empty() && !is_wanted))
      continue;
    if (v.type == NC_CHAR && !file.is_read_in_parts() &&
        v.dimensions.size() == places.dimensions.size() + 1 &&
        std::equal(places.dimensions.begin(), places.dimensions.end(), v.dimensions.begin()))
      columns.push_back(read_texts(file, v, nodes));
    else if (v.has_numbers() && v.is_of(places.dimensions))
      columns.push_back(read_column(file, v));
    else if (is_wanted)
      file.fail(fmt::format("variable {}: expected one value per node, {}", file.shape(v.name, v.dimensions),
                            file.shape(v.name, places.dimensions)));
  }
  return columns;
}

void read_notes(const File& file, Notes& notes) {
  int count = 0;
  file.call("", nc_inq_natts, &count);
  for (int a = 0; a < count; ++a) {
    char name[NC_MAX_NAME + 1];
    file.call("", nc_inq_attname, NC_GLOBAL, a, name);
    if (is_note(name)) notes[name] = file.text(NC_GLOBAL, name);
  }
  // What MPAS' tools write in a mesh that they make of this one.
  const std::string parents = file.text(NC_GLOBAL, "file_id"), older = file.text(NC_GLOBAL, "parent_id");
  if (!parents.empty()) notes["parent_id"] = parents + (older.empty() ? "" : "\n" + older);
}

}  // namespace

Nodes read_netcdf(const std::string& name, const ReadOptions& options, const std::string& contents) {
  const File file(name, contents, options);
  Nodes nodes;
  nodes.file = name;
  nodes.kind = "NetCDF";
  Places places;
  Names wanted = words_of(options.columns, ',');
  const auto mesh = std::find_if(file.variables().begin(), file.variables().end(), [&](const Variable& v) {
    return file.text(v.id, "cf_role") == "mesh_topology";
  });
  if (!wanted.empty()) {
    places = read_chosen(file, nodes, wanted);
  } else if (mesh != file.variables().end()) {
    places = read_ugrid(file, nodes, *mesh);
  } else if (file.find("xCell") != nullptr && options.coordinates != Coordinates::lonlat) {
    places = from_coordinates(file, "xCell", "yCell", "zCell");
    add_angles(file, places, "lonCell", "latCell");
    add_angles(file, places, "lon", "lat");
    nodes.kind += ", xCell yCell zCell";
  } else {
    const auto [lon, lat] = lon_lat_of(file, options.with_values ? options.variable : "");
    places = from_angles(file, lon, lat);
    nodes.kind += fmt::format(", {} {} in {}", lon, lat, places.units);
  }
  nodes.points = std::move(places.points);
  nodes.given = std::move(places.given);
  nodes.grid = std::move(places.grid);
  for (const int dimension : places.dimensions) nodes.shape.push_back(file.length_of(dimension));
  if (file.is_read_in_parts()) nodes.before = file.before(nodes.shape.at(0));
  if (nodes.points.empty() && !file.is_read_in_parts()) file.fail("no nodes: the variables are empty");
  if (options.with_values) {
    std::string variable = options.variable;
    if (variable.empty() && !wanted.empty()) variable = wanted[0];
    for (const std::string& usual : options.usual_variables)
      if (variable.empty() && file.find(usual) != nullptr) variable = usual;
    nodes.value = read_value(file, variable, places);
    wanted.erase(std::remove(wanted.begin(), wanted.end(), variable), wanted.end());
  }
  if (options.with_columns && (options.columns.empty() || !wanted.empty()))
    nodes.columns = read_columns(file, nodes.points.size(), places, wanted);
  read_notes(file, nodes.notes);
  if (const Variable* const density = file.find("meshDensity")) nodes.density = read_of_nodes(file, *density);
  if (nodes.density.size() != nodes.points.size()) nodes.density.clear();
  if (options.with_triangles && file.find("xCell") != nullptr && file.find("cellsOnVertex") != nullptr)
    read_triangles(file, nodes, "cellsOnVertex", 1, true);
  const double radius = file.number(NC_GLOBAL, "sphere_radius", 1);
  if (radius > 0 && std::isfinite(radius)) nodes.radius = radius;
  return nodes;
}

}  // namespace files
