// Nodes of GeoJSON (RFC 7946): features with a Point or MultiPoint; their properties are columns.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "files/geojson.h"
#include "files/nearest.h"
#include "files/nodes.h"
#include "files/text_file.h"
#include "files/text_table.h"

namespace files {
namespace {

using json = Json;

std::vector<std::string> names_of(const Columns& columns) {
  std::vector<std::string> names;
  for (const Column& c : columns) names.push_back(c.name);
  return names;
}

/// Collects points and properties from one feature after another.
class Features {
 public:
  Features(Nodes& nodes, const ReadOptions& options, std::size_t bytes)
      : nodes_(nodes), options_(options), most_values_(16 * bytes + 1000000) {}

  /// Throws if the feature has no geometry, unless missing ones are kept, or one other than Point or
  /// MultiPoint.
  void add(const json& feature) {
    ++count_;
    const auto geometry = feature.find("geometry"), properties = feature.find("properties");
    if (options_.with_cells && properties != feature.end() && is_cell(*properties))
      return add_cell(*properties);
    const bool has_geometry = geometry != feature.end() && geometry->is_object();
    if (!has_geometry && !options_.keep_missing)
      fail(here(), "has no geometry: remove it, give it a Point, or say --skip-missing");
    const std::size_t first = nodes_.lines.size();
    if (has_geometry)
      add_points(*geometry);
    else
      add_node(kMissing, kMissing);
    if (properties == feature.end() || !properties->is_object()) return;
    for (const auto& [name, value] : properties->items())
      for (std::size_t i = first; i < nodes_.lines.size(); ++i) set(name, i, value);
  }

  /// All columns, with a value for each node.
  Columns take_columns() {
    expect_few_values();
    for (Column& c : columns_)
      if (c.is_text())
        c.texts.resize(nodes_.lines.size());
      else
        c.numbers.resize(nodes_.lines.size(), kMissing);
    return std::move(columns_);
  }

 private:
  /// True for the properties of a cell of `voronoi`.
  static bool is_cell(const json& properties) {
    const auto has = [&](const char* name) {
      const auto found = properties.find(name);
      return found != properties.end() && found->is_number();
    };
    return has("lon") && has("lat") && has("node") && has("degree") && has("area");
  }

  /// Adds the node of the cell; of several parts of a cell once.
  void add_cell(const json& properties) {
    nodes_.kind = "GeoJSON, nodes of cells, lon lat in degrees";
    if (!cells_.insert(properties["node"].get<double>()).second) return;
    add_point({properties["lon"], properties["lat"]});
    for (const auto& [name, value] : properties.items()) set(name, nodes_.lines.size() - 1, value);
  }

  /// Each column has a value for each node, so features with names of their own would take any memory.
  void expect_few_values() const {
    if (columns_.size() * nodes_.lines.size() > most_values_)
      fail(here(), "the properties have {} different names, the last '{}': give all features the same",
           columns_.size(), excerpt(columns_.back().name));
  }

  /// The feature, in messages.
  std::string here() const { return fmt::format("{}: feature {}", nodes_.file, count_); }

  void add_points(const json& geometry) {
    const std::string type = text_of(geometry, "type");
    if (type != "Point" && type != "MultiPoint")
      fail(here(), "'{}' is not a Point or MultiPoint: nodes are points{}", excerpt(type),
           type.find("Polygon") != type.npos ? "; meshes are read from UGRID, MPAS and OFF, "
                                               "`plot` also takes the cells of `pstripack voronoi`"
                                             : "");
    const auto coordinates = geometry.find("coordinates");
    if (coordinates == geometry.end() || !coordinates->is_array())
      fail(here(), "its geometry has no coordinates");
    if (type == "Point")
      add_point(*coordinates);
    else
      for (const json& point : *coordinates) add_point(point);
  }

  void add_node(double lon, double lat) {
    nodes_.given.lon.push_back(lon);
    nodes_.given.lat.push_back(lat);
    nodes_.lines.push_back(count_);
  }

  void add_point(const json& point) {
    const auto is_number = [](const json& value) { return value.is_number(); };
    if (!point.is_array() || point.size() < 2 || !std::all_of(point.begin(), point.end(), is_number))
      fail(here(), "expected coordinates [longitude, latitude] or [longitude, latitude, altitude]");
    if (point.size() > 2) set("altitude", nodes_.lines.size(), point[2]);
    add_node(point[0].get<double>(), point[1].get<double>());
  }

  void set(const std::string& name, std::size_t i, const json& value) {
    auto c = std::find_if(columns_.begin(), columns_.end(), [&](const Column& k) { return k.name == name; });
    if (c == columns_.end()) {
      c = columns_.insert(c, Column{name});
      expect_few_values();
    }
    if (value.is_null()) return;
    const bool needs_digits = value.is_number_integer() && std::fabs(value.get<double>()) > 0x1p53;
    if (value.is_number() && !needs_digits && !c->is_text()) {
      c->numbers.resize(i, kMissing);
      return c->numbers.push_back(value.get<double>());
    }
    if (!c->is_text())
      for (const double v : std::exchange(c->numbers, {}))
        c->texts.push_back(std::isnan(v) ? "" : fmt::format("{}", v));
    c->texts.resize(i);
    c->texts.push_back(value.is_string() ? value.get<std::string>() : value.dump());
    bytes_ += c->texts.back().size();  // each point of a MultiPoint has its own
    if (bytes_ > most_values_)
      fail(here(), "the property '{}' has a long text for many points: leave it out", excerpt(name));
  }

  Nodes& nodes_;
  const ReadOptions& options_;
  std::set<double> cells_;  ///< numbers of their nodes
  Columns columns_;
  std::size_t count_ = 0, bytes_ = 0;
  const std::size_t most_values_;  ///< of all columns together
};

/// `may_miss`: some may be NaN.
const std::vector<double>* numbers_of_all(const Columns& columns, const char* name, bool may_miss = false) {
  const Column* const c = find(columns, name);
  const auto is_missing = [&](double v) { return !may_miss && std::isnan(v); };
  return c == nullptr || c->is_text() || std::any_of(c->numbers.begin(), c->numbers.end(), is_missing)
             ? nullptr
             : &c->numbers;
}

void remove(Columns& columns, const std::string& name) {
  columns.erase(
      std::remove_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; }),
      columns.end());
}

/// RFC 7946 wants longitudes from -180 to 180. If the properties lon and lat give the same places, they are
/// the angles before conversion: use them.
void take_given_angles(Nodes& nodes, Columns& columns) {
  const auto* const lon = numbers_of_all(columns, "lon");
  const auto* const lat = numbers_of_all(columns, "lat");
  bool same = lon != nullptr && lat != nullptr;
  for (std::size_t i = 0; same && i < nodes.given.lon.size(); ++i)
    same = std::fabs(std::remainder((*lon)[i] - nodes.given.lon[i], 360)) < 1e-9 &&
           (*lat)[i] == nodes.given.lat[i];
  if (same) {
    nodes.given.lon = *lon;
    for (const char* const name : {"lon", "lat"}) remove(columns, name);
  }
}

/// The columns that --columns names after those of the place.
std::vector<std::string> chosen(const ReadOptions& options, const Columns& columns, const std::string& file) {
  std::vector<std::string> words = parts_of(options.columns, ',');
  const std::string axes = options.coordinates == Coordinates::xyz ? "xyz" : "oa";
  for (std::size_t k = 0; k < axes.size(); ++k)
    if (k >= words.size() || axis_of(words[k]) != axes[k])
      fail(file, "the coordinates are those of the geometry: give --columns {},NAME",
           axes == "oa" ? "lon,lat" : "x,y,z");
  words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(axes.size()));
  for (const std::string& word : words)
    if (find(columns, word) == nullptr)
      fail(file, "there is no property '{}'{}; the features have {}", excerpt(word),
           did_you_mean(word, names_of(columns)), listed(names_of(columns)));
  return words;
}

/// Takes the value out of the columns: the property `name`, or the only numeric property if `name` is empty.
Column value_of(Columns& columns, std::string name, const std::string& file) {
  Columns numbers;
  for (const Column& c : columns)
    if (!c.is_text()) numbers.push_back({c.name});
  if (name.empty() && numbers.size() == 1) name = numbers[0].name;
  if (find(numbers, name) == nullptr)
    fail(file, "{}{}; properties that are numbers: {}",
         name.empty() ? "which property is the value? Say --variable"
                      : fmt::format("no property '{}' is a number", excerpt(name)),
         did_you_mean(name, names_of(numbers)), listed(names_of(numbers)));
  const Column value = *find(columns, name);
  remove(columns, name);
  return value;
}

}  // namespace

bool is_geojson(const std::string& contents) {
  const std::size_t mark = contents.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0;
  const std::size_t begin = contents.find_first_not_of(" \t\r\n", mark);
  return begin != contents.npos && contents[begin] == '{';
}

Nodes read_geojson(const std::string& file, const ReadOptions& options, const std::string& contents) {
  Nodes nodes;
  nodes.file = file;
  nodes.kind = "GeoJSON, lon lat in degrees";
  nodes.lines_are = "feature";
  Features features(nodes, options, contents.size());
  const json root = read_features(contents, file, "points", {"Point", "MultiPoint"},
                                  [&](const json& feature, std::size_t) { features.add(feature); });
  const std::size_t n = nodes.given.lon.size();
  if (n == 0) fail(file, "no points: there are no features");
  for (const auto& [name, text] : root.items())
    if (is_note(name) && text.is_string()) nodes.notes[name] = text.get<std::string>();

  Columns columns = features.take_columns();
  std::vector<std::string> wanted;
  if (!options.columns.empty()) wanted = chosen(options, columns, file);
  if (const std::size_t bad = first_beyond_pole(nodes.given); bad < n)
    fail(file, "{}: latitude {} is beyond the pole: GeoJSON has [longitude, latitude] in degrees{}",
         nodes.place(bad), nodes.given.lat[bad], hint_beyond_pole(nodes.given, ""));
  if (options.coordinates == Coordinates::xyz) {
    const std::vector<double>* axes[3];
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr const char* kNames[] = {"x", "y", "z"};
      axes[k] = numbers_of_all(columns, kNames[k], options.keep_missing);
      if (axes[k] == nullptr)
        fail(file, "--coordinates xyz needs the property '{}', a number, of all features", kNames[k]);
    }
    for (std::size_t i = 0; i < n; ++i) nodes.points.push_back({(*axes[0])[i], (*axes[1])[i], (*axes[2])[i]});
    nodes.given = {};
    nodes.kind = "GeoJSON, x y z";
    for (const char* const name : {"x", "y", "z", "lon", "lat"}) remove(columns, name);
  } else {
    take_given_angles(nodes, columns);
    nodes.points = points_of(nodes.given);
    make_names_differ(columns, {"lon", "lat"});
  }

  if (options.with_values) {
    std::string variable = options.variable;
    if (variable.empty() && !wanted.empty()) variable = wanted[0];
    nodes.value = value_of(columns, variable, file);
  }
  if (!options.with_columns) return nodes;
  for (Column& c : columns)
    if (options.columns.empty() || std::find(wanted.begin(), wanted.end(), c.name) != wanted.end())
      nodes.columns.push_back(std::move(c));
  return nodes;
}

}  // namespace files
