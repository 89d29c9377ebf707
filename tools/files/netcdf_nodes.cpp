// Nodes of NetCDF files. They are those of a UGRID mesh, or xCell, yCell, zCell, or a pair of longitudes and
// latitudes, which lon_lat_of() finds. The two variables of a pair have one shape, or are the axes of a grid,
// which is read row by row of latitude. Their units are those of the attribute; without it radians for
// lonCell and latCell, else those of the options, else degrees if the values cannot be radians, else it is an
// error.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/system.h"
#include "files/measures.h"
#include "files/nearest.h"
#include "files/netcdf_file.h"
#include "files/text_file.h"
#include "files/text_table.h"
#include "point_sets.h"

namespace files {
namespace {

using Names = std::vector<std::string>;
using File = NetcdfFile;
using Variable = NetcdfVariable;

/// The values of a coordinate or density.
std::vector<double> read_of_nodes(const File& file, const Variable& v) {
  std::vector<double> values = file.values(v);
  for (std::size_t i = 0; !file.options().keep_missing && i < values.size(); ++i)
    if (std::isnan(values[i]))
      file.fail("variable {}, value {}: missing or not finite: remove the node, or say --skip-missing",
                excerpt(v.path), i + 1);
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

std::string paths_of(const std::vector<const Variable*>& variables) {
  Names names;
  for (const Variable* const v : variables) names.push_back(v->path);
  return listed(names);
}

/// A variable of numbers or texts.
Column read_column(const File& file, const Variable& v) {
  Column column{v.name(), file.text(v, "long_name"), file.text(v, "units")};
  if (v.has_numbers()) column.numbers = file.values(v);
  const bool are_integers = v.type != NC_FLOAT && v.type != NC_DOUBLE && !file.is_packed(v);
  const bool need_digits = are_integers && largest_of(column.numbers) > 0x1p53;
  if (!v.has_numbers() || need_digits) {
    column.numbers.clear();
    column.texts = file.texts(v);
  }
  column.whole = are_integers && !column.is_text() &&
                 std::all_of(column.numbers.begin(), column.numbers.end(),
                             [](double x) { return -0x1p31 <= x && x < 0x1p31; });
  return column;
}

/// True if the variable has a number or a text for each node. Characters have a dimension more, that of the
/// text.
bool has_one_per_node(const Variable& v, const std::vector<int>& nodes) {
  if (v.has_numbers()) return v.is_of(nodes);
  if (v.lengths.empty()) return false;
  Variable texts = v;
  if (v.type == NC_CHAR) texts.dimensions.pop_back(), texts.lengths.pop_back();
  return (v.type == NC_CHAR || v.type == NC_STRING) && texts.is_of(nodes);
}

enum class Holds { longitudes, latitudes, rotated, unknown };

/// What a variable holds by its attributes. `rotated`: longitudes or latitudes that count from another pole;
/// ICON gives this standard name also to others, in radians and without a grid mapping.
Holds what_holds(const File& file, const Variable& v) {
  const std::string standard_name = file.text(v, "standard_name"), axis = file.text(v, "axis");
  const AngleUnit unit(file.text(v, "units"));
  if (standard_name == "grid_longitude" || standard_name == "grid_latitude") {
    const bool has_rotated_pole =
        std::any_of(file.variables().begin(), file.variables().end(), [&](const Variable& mapping) {
          return file.text(mapping, "grid_mapping_name") == "rotated_latitude_longitude";
        });
    if (has_rotated_pole || !unit.radians) return Holds::rotated;
    return standard_name == "grid_longitude" ? Holds::longitudes : Holds::latitudes;
  }
  const bool is_angle = unit.degrees || unit.radians;
  if (standard_name == "longitude" || unit.axis == 'o' || (is_angle && axis == "X")) return Holds::longitudes;
  if (standard_name == "latitude" || unit.axis == 'a' || (is_angle && axis == "Y")) return Holds::latitudes;
  return Holds::unknown;
}

/// The dimensions of nodes with these longitudes and latitudes; empty: they do not belong together.
std::vector<int> dimensions_of_nodes(const Variable& lon, const Variable& lat) {
  const std::vector<int> of_lon = lon.dimensions_of_places(), of_lat = lat.dimensions_of_places();
  if (of_lon == of_lat) return of_lon;
  return of_lon.size() == 1 && of_lat.size() == 1 ? std::vector<int>{of_lat[0], of_lon[0]}
                                                  : std::vector<int>{};
}

/// Usual names of longitudes and latitudes: of MPAS, CF, SCRIP, NEMO, ICON, WRF, and POP.
using PairOfNames = std::pair<std::string_view, std::string_view>;
constexpr PairOfNames kUsual[] = {{"lonCell", "latCell"},    {"lon", "lat"},
                                  {"longitude", "latitude"}, {"grid_center_lon", "grid_center_lat"},
                                  {"nav_lon", "nav_lat"},    {"glamt", "gphit"},
                                  {"clon", "clat"},          {"XLONG", "XLAT"},
                                  {"XLONG_M", "XLAT_M"},     {"TLONG", "TLAT"}};

/// Longitudes and latitudes; null: none.
using Pair = std::pair<const Variable*, const Variable*>;

/// The position of a pair in the list of usual names; behind its end if it is not there.
std::ptrdiff_t rank_of(const Pair& pair) {
  const std::string lon = pair.first->name(), lat = pair.second->name();
  return std::find(std::begin(kUsual), std::end(kUsual), PairOfNames(lon, lat)) - std::begin(kUsual);
}

/// The longitudes and latitudes of a file by what its attributes and names say.
struct Candidates {
  std::vector<const Variable*> lons, lats, rotated;
  std::vector<const Variable*> said;  ///< those whose attributes say it, or that they are angles

  explicit Candidates(const File& file) {
    Names bounds;
    for (const Variable& v : file.variables()) bounds.push_back(file.text(v, "bounds"));
    for (const Variable& v : file.variables()) {
      if (is_among(bounds, v.name())) continue;
      const Holds holds = what_holds(file, v);
      const auto is_called = [&, name = v.name()](char axis, auto side) {
        return holds == Holds::unknown &&
               (axis_of(name) == axis || std::any_of(std::begin(kUsual), std::end(kUsual),
                                                     [&](const auto& pair) { return pair.*side == name; }));
      };
      const AngleUnit unit(file.text(v, "units"));
      if (holds != Holds::unknown || unit.degrees || unit.radians) said.push_back(&v);
      if (holds == Holds::rotated)
        rotated.push_back(&v);
      else if (holds == Holds::longitudes || is_called('o', &PairOfNames::first))
        lons.push_back(&v);
      else if (holds == Holds::latitudes || is_called('a', &PairOfNames::second))
        lats.push_back(&v);
    }
  }

  /// Those among the words of an attribute of `from`; none unless one longitude and one latitude are.
  Pair among(const File& file, const Names& words, const Variable& from) const {
    std::vector<const Variable*> lon, lat;
    for (const std::string& word : words) {
      const Variable* const v = file.find(word, &from);
      if (is_among(lons, v)) lon.push_back(v);
      if (is_among(lats, v)) lat.push_back(v);
    }
    return lon.size() == 1 && lat.size() == 1 ? Pair{lon[0], lat[0]} : Pair{};
  }
};

/// The longitudes and latitudes that the attribute `coordinates` of the variable `value` names. Else the
/// candidates whose dimensions are those of `value`, of these those with an attribute that says what they
/// are, and of these a usual pair, or the only one.
Pair lon_lat_of(const File& file, const std::string& value) {
  const Candidates candidates(file);
  const std::vector<const Variable*>&lons = candidates.lons, &lats = candidates.lats,
                          &rotated = candidates.rotated;
  if (lons.empty() && lats.empty()) {
    if (!rotated.empty())
      file.fail(
          "{}: angles of a rotated pole: `cdo setgridtype,curvilinear` adds longitudes and latitudes to the "
          "file; if they are longitudes and latitudes, say --columns LON,LAT",
          paths_of(rotated));
    file.fail(
        "no nodes: expected variables xCell, yCell, zCell, or lonCell, latCell, or lon, lat, or others whose "
        "units are degrees_east and degrees_north; or name them by --columns LON,LAT");
  }
  if (lons.empty() || lats.empty())
    file.fail("there is no variable of {} beside {}: name both by --columns LON,LAT",
              lons.empty() ? "longitudes" : "latitudes", paths_of(lons.empty() ? lats : lons));

  const Variable* const of_value = value.empty() ? nullptr : file.find(value);
  if (of_value != nullptr)
    if (const Pair told =
            candidates.among(file, words_of(file.text(*of_value, "coordinates"), ' '), *of_value);
        told.first != nullptr)
      return told;
  std::map<std::tuple<bool, bool, std::ptrdiff_t>, std::vector<Pair>> pairs;  // the best first
  for (const Variable* const lon : lons)
    for (const Variable* const lat : lats) {
      const std::vector<int> nodes = dimensions_of_nodes(*lon, *lat);
      if (nodes.empty()) continue;
      const bool is_of_value = of_value != nullptr && of_value->is_of(nodes),
                 is_said = is_among(candidates.said, lon) || is_among(candidates.said, lat);
      pairs[{!is_of_value, !is_said, rank_of({lon, lat})}].emplace_back(lon, lat);
    }
  if (pairs.empty() && lons.size() == 1 && lats.size() == 1) return {lons[0], lats[0]};
  if (pairs.empty() || pairs.begin()->second.size() > 1)
    file.fail("longitudes {} and latitudes {}: name two of them by --columns LON,LAT", paths_of(lons),
              paths_of(lats));
  return pairs.begin()->second[0];
}

/// True if the angles are in degrees, since radians are never as large.
bool are_beyond_radians(const std::vector<double>& values, bool are_latitudes) {
  constexpr double kRightAngle = 1.5707963267948966, kRounding = 1 + 1e-6;  // of single precision
  const double largest = largest_of(values);
  return largest > (are_latitudes ? 1 : 4) * kRightAngle * kRounding &&
         largest <= (are_latitudes ? 90 : 360) * kRounding;
}

/// True if the units of the variable are degrees, false if radians.
bool in_degrees(const File& file, const Variable& v, const std::vector<double>& values, bool are_latitudes) {
  const std::string units = file.text(v, "units");
  const AngleUnit unit(units);
  const Units said = file.options().units;
  if (unit.degrees || unit.radians) return unit.degrees;
  if (units.empty()) {
    if (v.name() == "lonCell" || v.name() == "latCell") return false;
    if (said != Units::said_or_unmistakable) return said == Units::degrees;
    if (are_beyond_radians(values, are_latitudes)) return true;
  }
  file.fail("variable {}: units '{}'; expected degrees or radians{}", excerpt(v.path), excerpt(units),
            units.empty() ? ": say --units degrees or radians" : "");
}

/// Reads angles. Radians of type float that mean a multiple of pi/2 become the double that means it.
std::vector<double> read_angles(const File& file, const Variable& v, bool are_latitudes, bool& are_degrees) {
  std::vector<double> angles = read_of_nodes(file, v);
  if (what_holds(file, v) == (are_latitudes ? Holds::longitudes : Holds::latitudes))
    file.fail("variable {} holds {}: give the longitudes first, --columns LON,LAT", excerpt(v.path),
              are_latitudes ? "longitudes" : "latitudes");
  if (const std::vector<int> dimensions = v.dimensions_of_places(); dimensions.size() > 2)
    file.fail("variable {}: expected one place per node; extract one time, say by ncks -d {},0",
              file.shape(v.path, dimensions), file.dimension_name(dimensions[0]));
  are_degrees = in_degrees(file, v, angles, are_latitudes);
  if (v.type == NC_FLOAT && !are_degrees && !file.is_packed(v))
    for (double& angle : angles) angle = point_sets::radians_of_single(angle);
  return angles;
}

/// Points, and the angles and variables that belong to them.
struct Places {
  std::vector<Point> points;
  LonLat given;
  std::vector<int> dimensions = {};
  std::vector<const Variable*> variables;
  Grid grid = {};
  std::string names = "";  ///< "lon lat in degrees"
};

/// Throws if there are too many nodes, or too many values for the memory.
void expect_to_fit(const File& file, const Variable& lat, std::size_t rows, std::size_t columns) {
  if (!file.options().only_axes) file.expect_few(lat, rows, columns);
  constexpr double kBytes = 25;  // of a value, while widths are limited
  const double bytes = kBytes * static_cast<double>(rows) * static_cast<double>(columns),
               most = static_cast<double>(pstripack::available_memory()), finer = std::sqrt(bytes / most);
  if (finer > 1)
    file.fail(
        "a grid of {} times {} values needs about {:.3g} GB, and {:.3g} GB are free: make it coarser, "
        "say by cdo remapbil,r{:.0f}x{:.0f}",
        rows, columns, bytes / 1e9, most / 1e9, std::floor(static_cast<double>(columns) / finer),
        std::floor(static_cast<double>(rows) / finer));
}

/// If one is in degrees and the other in radians, both become degrees.
Places from_angles(const File& file, const Pair& pair) {
  const Variable &lon = *pair.first, &lat = *pair.second;
  Places places;
  bool lon_in_degrees, lat_in_degrees;
  LonLat& given = places.given;
  given.lon = read_angles(file, lon, false, lon_in_degrees);
  given.lat = read_angles(file, lat, true, lat_in_degrees);
  given.degrees = lon_in_degrees || lat_in_degrees;
  if (lon_in_degrees != lat_in_degrees)
    for (double& angle : lon_in_degrees ? given.lat : given.lon) angle *= kRadian;
  if (const std::size_t bad = first_beyond_pole(given); bad < given.lat.size())
    file.fail("variable {}, value {}: {} is beyond the pole{}", excerpt(lat.path), bad + 1, given.lat[bad],
              !lat_in_degrees ? ": is the attribute units wrong, and are these degrees?"
              : given.lon.size() == given.lat.size()
                  ? hint_beyond_pole(given, what_holds(file, lat) == Holds::unknown
                                                ? excerpt(lat.path) + "," + excerpt(lon.path)
                                                : "")
                  : "");
  places.variables = {&lon, &lat};
  places.dimensions = dimensions_of_nodes(lon, lat);
  if (lon.dimensions_of_places() != lat.dimensions_of_places()) {
    if (places.dimensions.empty())
      file.fail("variables {} and {}: expected one shape, or two axes of one dimension each",
                excerpt(lon.path), excerpt(lat.path));
    expect_to_fit(file, lat, given.lat.size(), given.lon.size());
    const LonLat axes = angles_of({}, given, true);
    places.grid = {axes.lon, axes.lat};
    const bool degrees = given.degrees;
    given = file.options().only_axes ? LonLat() : Grid{given.lon, given.lat}.places();
    given.degrees = degrees;
  }
  places.points = points_of(given);
  places.names = fmt::format("{} {} in {}", lon.path, lat.path, given.degrees ? "degrees" : "radians");
  return places;
}

Places from_coordinates(const File& file, const Variable& x, const Variable& y, const Variable& z) {
  if (x.dimensions != y.dimensions || x.dimensions != z.dimensions)
    file.fail("variables {}, {}, {}: expected one shape", excerpt(x.path), excerpt(y.path), excerpt(z.path));
  const std::vector<double> xs = read_of_nodes(file, x), ys = read_of_nodes(file, y),
                            zs = read_of_nodes(file, z);
  Places places;
  for (std::size_t i = 0; i < xs.size(); ++i) places.points.push_back({xs[i], ys[i], zs[i]});
  places.dimensions = x.dimensions_of_places();
  places.variables = {&x, &y, &z};
  places.names = fmt::format("{} {} {}", x.path, y.path, z.path);
  return places;
}

/// Adds longitudes and latitudes that the file has beside the vectors. If they cannot be used, those computed
/// from the vectors serve as well.
void add_angles(const File& file, Places& places, const Pair& pair) {
  if (!places.given.empty() || pair.first == nullptr || pair.second == nullptr) return;
  try {
    Places angles = from_angles(file, pair);
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

/// The corners of faces, row after row; `kNoCorner`: missing. `columns`: most corners of a face.
constexpr long long kNoCorner = -1000000000000000000;
struct Corners {
  std::vector<long long> all;
  std::size_t columns;
};
Corners read_corners(const File& file, const Variable& v, bool is_transposed) {
  if (v.lengths.size() != 2) file.fail("variable {}: expected corners of faces", excerpt(v.path));
  const std::size_t faces = v.lengths[is_transposed ? 1 : 0], columns = v.lengths[is_transposed ? 0 : 1];
  file.expect_few(v, faces / 2, 1);  // a triangulation has at most twice as many triangles as nodes
  const std::vector<double> values = file.values(v);
  Corners corners{{}, columns};
  for (std::size_t f = 0; f < faces; ++f)
    for (std::size_t k = 0; k < columns; ++k) {
      const double value = values[is_transposed ? k * faces + f : f * columns + k];
      corners.all.push_back(std::isnan(value) ? kNoCorner : static_cast<long long>(value));
    }
  return corners;
}

/// Reads the triangles of an MPAS mesh. Corners of 0 are missing: such triangles are left out unless
/// `with_boundary`.
void read_mpas_triangles(const File& file, Nodes& nodes) {
  const Variable& v = file.variable("cellsOnVertex");
  if (v.lengths.size() != 2 || v.lengths[1] != 3)
    file.fail("variable cellsOnVertex: expected faces of three corners each");
  std::vector<long long> corners = read_corners(file, v, false).all;
  if (file.options().with_boundary && is_among(corners, 0LL)) {
    nodes.vertices =
        from_coordinates(file, file.variable("xVertex"), file.variable("yVertex"), file.variable("zVertex"))
            .points;
    if (nodes.vertices.size() != v.lengths[0])
      file.fail("{} vertices in xVertex, {} in cellsOnVertex", nodes.vertices.size(), v.lengths[0]);
    for (std::size_t i = 0; i < nodes.vertices.size(); ++i)
      if (!has_direction(nodes.vertices[i])) file.fail("vertex {}: xVertex, yVertex, zVertex are 0", i + 1);
  } else {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      if (corners[k] == 0 || corners[k + 1] == 0 || corners[k + 2] == 0) continue;
      for (std::size_t j = 0; j < 3; ++j) corners[kept++] = corners[k + j];
    }
    corners.resize(kept);
  }
  set_triangles(nodes, corners, 1);
}

/// Reads the faces of a UGRID mesh if all are triangles; else `kind` tells how many are not.
void read_faces(const File& file, Nodes& nodes, const Variable& mesh) {
  const std::string name = file.text(mesh, "face_node_connectivity"),
                    dimension = file.text(mesh, "face_dimension");
  if (name.empty()) return;
  const Variable& v = file.variable(name, &mesh);
  const bool is_transposed = v.dimensions.size() == 2 && file.dimension_name(v.dimensions[0]) != dimension &&
                             file.dimension_name(v.dimensions[1]) == dimension;
  const Corners corners = read_corners(file, v, is_transposed);
  std::vector<long long> triangles;
  std::size_t faces = 0;
  for (std::size_t begin = 0; begin < corners.all.size(); begin += corners.columns, ++faces) {
    const std::size_t before = triangles.size();
    for (std::size_t k = 0; k < corners.columns; ++k)
      if (const long long corner = corners.all[begin + k]; corner != kNoCorner) triangles.push_back(corner);
    const std::size_t count = triangles.size() - before;
    if (count < 3)
      file.fail("variable {}, face {}: {} corners, expected 3 or more", excerpt(v.path), faces + 1, count);
    if (count > 3) ++nodes.polygons;
    if (count > 3) triangles.resize(before);
  }
  if (nodes.polygons > 0)
    nodes.kind +=
        fmt::format(", without its faces, {} of {} with more than three corners", nodes.polygons, faces);
  else  // UGRID's default of start_index is 0
    set_triangles(nodes, triangles, static_cast<long long>(file.number(v, "start_index", 0)));
}

/// The UGRID mesh that the attribute `mesh` of the variable `value` names, else the first of faces, else the
/// first; null: the file has none.
const Variable* ugrid_mesh_of(const File& file, const std::string& value) {
  const Variable* const of_value = value.empty() ? nullptr : file.find(value);
  const Variable* const wanted =
      of_value == nullptr ? nullptr : file.find(file.text(*of_value, "mesh"), of_value);
  const Variable* found = nullptr;
  bool has_faces = false;
  for (const Variable& v : file.variables()) {
    if (file.text(v, "cf_role") != "mesh_topology") continue;
    if (&v == wanted) return &v;
    const bool is_of_faces = file.number(v, "topology_dimension", 2) == 2;
    if (found == nullptr || (is_of_faces && !has_faces)) found = &v, has_faces = is_of_faces;
  }
  return found;
}

/// Reads the nodes of a UGRID mesh.
Places read_ugrid(const File& file, const Variable& mesh) {
  const Names words = words_of(file.text(mesh, "node_coordinates"), ' '),
              vectors = words_of(file.text(mesh, kNodeVectors), ' ');
  if (words.size() < 2) file.fail("variable {}: expected node_coordinates 'lon lat'", excerpt(mesh.path));
  Pair angles = Candidates(file).among(file, words, mesh);
  if (angles.first == nullptr) angles = {&file.variable(words[0], &mesh), &file.variable(words[1], &mesh)};
  Places places;
  // Files written by pstripack also have the vectors, which need no rounding.
  if (vectors.size() == 3) {
    places = from_coordinates(file, file.variable(vectors[0], &mesh), file.variable(vectors[1], &mesh),
                              file.variable(vectors[2], &mesh));
    add_angles(file, places, angles);
    places.names = "x y z";
  } else {
    places = from_angles(file, angles);
    places.names = places.given.degrees ? "lon lat in degrees" : "lon lat in radians";
  }
  places.names = "UGRID, " + places.names;
  return places;
}

/// The nodes whose coordinates --columns names; removes their names from `names`.
Places read_chosen(const File& file, Names& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    file.variable(names[i]);
    if (std::count(names.begin(), names.end(), names[i]) > 1)
      file.fail("variable '{}' is chosen twice", excerpt(names[i]));
  }
  const std::size_t count = file.options().coordinates == Coordinates::xyz ? 3 : 2;
  if (names.size() < count)
    file.fail("--columns names {} variable{}: expected {}", names.size(), names.size() == 1 ? "" : "s",
              count == 3 ? "those of x, y and z" : "longitude and latitude");
  const Variable &first = file.variable(names[0]), &second = file.variable(names[1]);
  Places places = count == 3 ? from_coordinates(file, first, second, file.variable(names[2]))
                             : from_angles(file, {&first, &second});
  names.erase(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(count));
  return places;
}

/// Throws because the variable has other dimensions than the nodes. Says how to bring it to theirs, if it has
/// all of them.
[[noreturn]] void fail_of_shape(const File& file, const Variable& v, const std::string& expected,
                                const std::vector<int>& nodes) {
  std::string cuts, order;
  for (std::size_t d = 0; d < v.dimensions.size(); ++d)
    if (v.lengths[d] != 1 && !is_among(nodes, v.dimensions[d]))
      cuts += fmt::format(" -d {},0", file.dimension_name(v.dimensions[d]));
  for (const int dimension : nodes) order += (order.empty() ? "" : ",") + file.dimension_name(dimension);
  const bool has_all =
      std::all_of(nodes.begin(), nodes.end(), [&](int n) { return is_among(v.dimensions, n); });
  file.fail("variable {}: expected {}{}{}", file.shape(v.path, v.dimensions), expected,
            file.shape(v.path, nodes),
            !has_all       ? ""
            : cuts.empty() ? "; exchange the dimensions, by ncpdq -a " + order
                           : "; extract one layer, say by ncks" + cuts);
}

/// The values of the variable `name`, or of the only one if `name` is empty.
Column read_value(const File& file, const std::string& name, const Places& places) {
  const Variable* found = name.empty() ? nullptr : file.find(name);
  if (found == nullptr) {
    std::vector<const Variable*> others;
    for (const Variable& v : file.variables())
      if (!is_among(places.variables, &v) && v.has_numbers() && v.is_of(places.dimensions))
        others.push_back(&v);
    if (!name.empty() || others.size() != 1)
      file.fail("{}say --variable NAME; variables with one value per node: {}",
                name.empty() ? "" : "there is no variable " + excerpt(name) + "; ", paths_of(others));
    found = others[0];
  }
  const Variable& v = *found;
  if (!v.is_of(places.dimensions)) fail_of_shape(file, v, "", places.dimensions);
  if (!v.has_numbers()) file.fail("variable {}: expected numbers", excerpt(v.path));
  Column column = read_column(file, v);
  if (column.is_text()) column = {column.name, column.long_name, column.units, file.values(v)};
  return column;
}

/// The variables with a number or a text for each node, except the coordinates; or only those in `wanted`.
Columns read_columns(const File& file, const Places& places, const Names& wanted) {
  Columns columns;
  for (const Variable& v : file.variables()) {
    const bool is_wanted = std::any_of(wanted.begin(), wanted.end(),
                                       [&](const std::string& name) { return file.find(name) == &v; });
    if (is_among(places.variables, &v) || v.name() == "meshDensity" || (!wanted.empty() && !is_wanted))
      continue;
    if (has_one_per_node(v, places.dimensions))
      columns.push_back(read_column(file, v));
    else if (is_wanted)
      fail_of_shape(file, v, "one value per node, ", places.dimensions);
  }
  make_names_differ(columns, {});
  return columns;
}

/// The length of the vectors, if they have one; else 1.
double length_of_all(const std::vector<Point>& points) {
  const auto length = [](const Point& p) { return std::hypot(p.x, p.y, p.z); };
  const double first = points.empty() ? 1 : length(points[0]);
  const bool is_other = std::any_of(points.begin(), points.end(), [&](const Point& p) {
    return !(std::fabs(length(p) - first) <= kSameLength * first);
  });
  return is_other || std::fabs(first - 1) <= kSameLength ? 1 : first;
}

void read_notes(const File& file, Notes& notes) {
  for (const std::string& name : file.attributes(file.global()))
    if (is_note(name)) notes[name] = file.text(file.global(), name.c_str());
  // What MPAS' tools write in a mesh that they make of this one.
  const std::string parents = file.text(file.global(), "file_id"),
                    older = file.text(file.global(), "parent_id");
  if (!parents.empty()) notes["parent_id"] = parents + (older.empty() ? "" : "\n" + older);
}

}  // namespace

std::vector<std::string> netcdf_variables(const std::string& file) {
  const ReadOptions options;
  return File(file, "", options).names();
}

Nodes read_netcdf(const std::string& name, const ReadOptions& options, const std::string& contents) {
  const File file(name, contents, options);
  Nodes nodes;
  nodes.file = name;
  nodes.kind = "NetCDF";
  nodes.variables = file.names();
  Places places;
  Names wanted = words_of(options.columns, ',');
  const std::string value = options.with_values ? options.variable : "";
  const Variable* const mesh = ugrid_mesh_of(file, value);
  const Variable* const x = file.find("xCell");
  const bool is_ugrid = wanted.empty() && mesh != nullptr;
  if (is_ugrid) {
    places = read_ugrid(file, *mesh);
  } else if (!wanted.empty()) {
    places = read_chosen(file, wanted);
  } else if (x != nullptr && options.coordinates != Coordinates::lonlat) {
    if (file.text(file.global(), "on_a_sphere").rfind("NO", 0) == 0)
      file.fail(
          "on_a_sphere is NO: a planar mesh, which is not read; if its nodes lie on a sphere: ncatted -a "
          "on_a_sphere,global,o,c,YES");
    places = from_coordinates(file, *x, file.variable("yCell"), file.variable("zCell"));
    add_angles(file, places, {file.find("lonCell"), file.find("latCell")});
    add_angles(file, places, {file.find("lon"), file.find("lat")});
  } else {
    places = from_angles(file, lon_lat_of(file, value));
  }
  nodes.kind += ", " + places.names;
  nodes.points = std::move(places.points);
  nodes.given = std::move(places.given);
  nodes.grid = std::move(places.grid);
  for (const int dimension : places.dimensions) nodes.shape.push_back(file.length_of(dimension));
  if (nodes.points.empty() && nodes.grid.lon.empty()) file.fail("no nodes: the variables are empty");
  if (options.with_values) {
    std::string variable = options.variable;
    if (variable.empty() && !wanted.empty()) variable = wanted[0];
    for (const std::string& usual : options.usual_variables)
      if (variable.empty() && file.find(usual) != nullptr) variable = usual;
    nodes.value = read_value(file, variable, places);
    wanted.erase(std::remove(wanted.begin(), wanted.end(), variable), wanted.end());
  }
  if (options.with_columns && (options.columns.empty() || !wanted.empty()))
    nodes.columns = read_columns(file, places, wanted);
  read_notes(file, nodes.notes);
  if (const Variable* const density = file.find("meshDensity")) nodes.density = read_of_nodes(file, *density);
  if (nodes.density.size() != nodes.points.size()) nodes.density.clear();
  if (options.with_triangles && is_ugrid) read_faces(file, nodes, *mesh);
  if (options.with_triangles && x != nullptr && file.find("cellsOnVertex") != nullptr)
    read_mpas_triangles(file, nodes);
  const double radius =
      file.number(file.global(), "sphere_radius", x == nullptr ? 1 : length_of_all(nodes.points));
  if (radius > 0 && std::isfinite(radius)) nodes.radius = radius;
  if (const Variable* const nominal = file.find("nominalMinDc");
      nominal != nullptr && nominal->lengths.empty())
    nodes.nominal = file.values(*nominal)[0] / nodes.radius;
  return nodes;
}

}  // namespace files
