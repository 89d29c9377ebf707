#include "files/nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/parallel_for.h"
#include "files/nearest.h"
#include "files/text_file.h"
#include "files/text_table.h"
#include "point_sets.h"

namespace files {
namespace {

constexpr double kRightAngle = 1.5707963267948966;
constexpr double kSlack = 1 + 1e-6;  // single precision rounds a pole up

bool has_magic_of_netcdf(std::string_view bytes) {
  return bytes.substr(0, 3) == "CDF" || bytes.substr(0, 4) == "\x89HDF";
}

/// True if there are control characters other than tabs and line ends near the beginning.
bool is_binary(std::string_view bytes) {
  const std::string_view begin = bytes.substr(0, 4096);
  return std::any_of(begin.begin(), begin.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' &&
           std::string_view("\t\n\v\f\r").find(c) == std::string_view::npos;
  });
}

/// Sets the nodes from given angles. Angles too large for radians are degrees. `to_exchange`: value of
/// --columns for the hint that longitudes and latitudes may be exchanged.
void set_angles(Nodes& nodes, LonLat given, Units units, const std::string& to_exchange) {
  const std::size_t n = given.lon.size();
  if (units == Units::said_or_unmistakable) {
    const double lon = largest_of(given.lon), lat = largest_of(given.lat);
    if (lon <= 4 * kRightAngle * kSlack && lat <= kRightAngle * kSlack)
      fail(nodes.file,
           "the angles may be degrees or radians: say --units degrees or --units radians (longitudes "
           "reach {:.4g}, latitudes {:.4g}{})",
           lon, lat, lon > kRightAngle && lat > 0.8 * kRightAngle ? ", as radians do" : "");
    units = Units::degrees;
  }
  given.degrees = units == Units::degrees;
  if (const std::size_t bad = first_beyond_pole(given); bad < n)
    fail(nodes.file, "{}: latitude {} is beyond the pole: the columns are 'lon lat', in {}{}",
         nodes.place(bad), given.lat[bad], given.degrees ? "degrees" : "radians",
         hint_beyond_pole(given, to_exchange));
  for (std::size_t i = 0; !given.degrees && i < n; ++i)
    if (std::fabs(given.lon[i]) > 8 * kRightAngle)
      fail(nodes.file, "{}: longitude {} is more than two turns in radians; --units degrees?", nodes.place(i),
           given.lon[i]);
  nodes.points = points_of(given);
  nodes.kind += given.degrees ? ", lon lat in degrees" : ", lon lat in radians";
  nodes.given = std::move(given);
}

/// Sets the nodes from longitudes and latitudes, or from x, y and z.
void set_places(Nodes& nodes, std::vector<std::vector<double>> axes, Units units,
                const std::string& to_exchange) {
  if (axes.size() == 2) {
    LonLat given;
    given.lon = std::move(axes[0]);
    given.lat = std::move(axes[1]);
    return set_angles(nodes, std::move(given), units, to_exchange);
  }
  for (std::size_t i = 0; i < axes[0].size(); ++i)
    nodes.points.push_back({axes[0][i], axes[1][i], axes[2][i]});
  nodes.kind += ", x y z";
}

/// Which columns of a text are read.
struct Choice {
  std::vector<std::size_t> place;    ///< lon and lat, or x, y, z
  bool is_guess = false;             ///< x y z without names: may be lon lat value
  std::vector<std::size_t> columns;  ///< the other ones to read
  std::optional<std::size_t> value;
  bool is_lonlat() const { return place.size() == 2; }
};

/// The columns of the coordinates by name; empty if no names fit. If two name one axis, the first of those
/// that the caller has chosen; else throws.
std::vector<std::size_t> place_by_names(const std::vector<std::size_t>& candidates, const TextLayout& layout,
                                        Coordinates coordinates, bool chosen) {
  const auto axes = [&](std::string_view names) {
    std::vector<std::size_t> found;
    for (const char axis : names) {
      std::vector<std::size_t> all;
      for (const std::size_t c : candidates)
        if (axis_of(layout.name(c)) == axis) all.push_back(c);
      if (all.size() > 1 && !chosen)
        fail(layout.where, "the header names column '{}' twice, {} and {}: choose columns by number",
             excerpt(layout.name(all[0])), all[0] + 1, all[1] + 1);
      if (!all.empty()) found.push_back(all[0]);
    }
    return found;
  };
  if (coordinates != Coordinates::xyz) {
    const std::vector<std::size_t> found = axes("oa");
    if (found.size() == 2) return found;
    if (found.size() == 1) {
      const bool has_lon = axis_of(layout.name(found[0])) == 'o';
      fail(layout.where, "a column '{}' without a {}: name both by --columns LON,LAT; the header has {}",
           excerpt(layout.name(found[0])), has_lon ? "latitude" : "longitude", listed(layout.names));
    }
  }
  if (coordinates == Coordinates::lonlat) return {};
  const std::vector<std::size_t> found = axes("xyz");
  return found.size() == 3 ? found : std::vector<std::size_t>{};
}

Choice choose(const TextLayout& layout, const ReadOptions& options) {
  const std::string& where = layout.where;
  const bool chosen = !options.columns.empty(), detected = options.coordinates == Coordinates::detected;
  std::vector<std::size_t> candidates(layout.columns);
  std::iota(candidates.begin(), candidates.end(), std::size_t{0});
  if (chosen) candidates = columns_named(options.columns, layout);
  Choice choice;
  if (!layout.names.empty()) choice.place = place_by_names(candidates, layout, options.coordinates, chosen);
  if (choice.place.empty()) {
    std::size_t columns = options.coordinates == Coordinates::xyz ? 3 : 2;
    if (!chosen && detected) {
      if (!layout.names.empty())
        fail(where, "no columns named lon and lat, or x, y and z: name them by --columns; the header has {}",
             listed(layout.names));
      const bool is_third = options.variable == "3";  // so the first two are lon lat
      const bool has_value = options.with_values || (options.may_have_value && layout.columns > 2);
      columns = is_third ? 2 : layout.columns - (has_value ? 1 : 0);
      const bool may_be_either = has_value && !options.with_values && layout.columns == 3;
      if ((columns != 2 && columns != 3) || may_be_either)
        fail(where,
             "has {} column{}: say --coordinates lonlat or xyz, or choose --columns 1,2, or of fixed "
             "widths 22-30,13-20; expected 'lon lat{}' or 'x y z{}'",
             layout.columns, layout.columns == 1 ? "" : "s", has_value ? " value" : "",
             has_value ? " value" : "");
      choice.is_guess = options.lengths_decide && !has_value && columns == 3;
    }
    if (candidates.size() < columns)
      fail(where, "has {} columns; --coordinates {} needs {}{}", candidates.size(),
           columns == 3 ? "xyz" : "lonlat", columns, options.with_values ? " and a value" : "");
    choice.place.assign(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(columns));
  }
  const auto is_place = [&](std::size_t c) {
    return std::find(choice.place.begin(), choice.place.end(), c) != choice.place.end();
  };
  for (const std::size_t c : candidates)
    if (!is_place(c)) choice.columns.push_back(c);
  if (!options.with_values) return choice;

  if (!options.variable.empty()) {
    const std::vector<std::size_t> named = columns_named(options.variable, layout);
    if (named.size() != 1) fail(where, "--variable names one column, not '{}'", options.variable);
    if (is_place(named[0]))
      fail(where, "column {} is a coordinate, not a value: choose another --variable", options.variable);
    choice.value = named[0];
  } else if (choice.columns.size() == 1 || (!choice.columns.empty() && (chosen || layout.names.empty()))) {
    choice.value = choice.columns[0];
  } else if (choice.columns.empty()) {
    fail(where, "has {} columns; expected 'lon lat value' or 'x y z value'", layout.columns);
  } else {
    fail(where, "which column is the value? Say --variable; the header has {}", listed(layout.names));
  }
  return choice;
}

/// The unit of angles in the header; `otherwise` if the header has none.
Units units_of(const TextLayout& layout, const Choice& choice, Units otherwise, const std::string& file) {
  if (layout.names.empty()) return otherwise;
  const auto of_column = [&](std::size_t c) {
    const AngleUnit unit(layout.units[c]);
    const std::string& name = layout.names[c];
    if (unit.degrees || name.find("_deg") != name.npos) return Units::degrees;
    if (unit.radians || name.find("_rad") != name.npos) return Units::radians;
    return Units::said_or_unmistakable;
  };
  const Units lon = of_column(choice.place[0]), lat = of_column(choice.place[1]);
  if (lon == Units::said_or_unmistakable) return lat == Units::said_or_unmistakable ? otherwise : lat;
  if (lat != Units::said_or_unmistakable && lat != lon)
    fail(line_of(file, std::max<std::size_t>(1, layout.header_line)),
         "one of longitude and latitude is in degrees, the other in radians: convert one of them");
  return lon;
}

/// True if three columns without names are lon lat and a value: not vectors of one length, and within the
/// range of longitudes and latitudes. Throws if they may be vectors that are rounded.
bool is_lonlat_value(const Nodes& nodes, const TextRows& rows, Units units) {
  double shortest = INFINITY, longest = 0, most_lon = 0, most_lat = 0;
  const auto& x = rows.numbers;
  for (std::size_t i = 0; i < x[0].size(); ++i) {
    if (std::isnan(x[0][i]) || std::isnan(x[1][i]) || std::isnan(x[2][i])) continue;
    const double length = std::hypot(x[0][i], x[1][i], x[2][i]);
    if (length == 0) continue;  // refused later
    shortest = std::min(shortest, length), longest = std::max(longest, length);
    most_lon = std::max(most_lon, std::fabs(x[0][i])), most_lat = std::max(most_lat, std::fabs(x[1][i]));
  }
  if (longest <= (1 + kSameLength) * shortest || most_lon > 360 || most_lat > 90) return false;
  const bool may_be_radians = most_lon <= 4 * kRightAngle && most_lat <= kRightAngle;
  if (units == Units::said_or_unmistakable && (may_be_radians || longest <= 1.001 * shortest))
    fail(nodes.file,
         "three columns without names may be x y z, of lengths {:.7g} to {:.7g}, or lon lat "
         "and a value: say --coordinates xyz, or --columns 1,2,3",
         shortest, longest);
  return true;
}

Column column_of(TextRows& rows, const TextLayout& layout, std::size_t c) {
  Column column{layout.name(c), "", layout.units.empty() ? "" : layout.units[c]};
  column.numbers = std::move(rows.numbers[c]);
  column.texts = std::move(rows.texts[c]);
  return column;
}

void read_text(Nodes& nodes, std::string_view text, const ReadOptions& options) {
  nodes.kind = "text";
  if (const auto widths = fixed_widths(options.columns); !widths.empty()) {
    ReadOptions of_table = options;
    of_table.columns.clear();
    for (std::size_t c = 1; c <= widths.size(); ++c)
      of_table.columns += fmt::format("{}{}", c > 1 ? "," : "", c);
    of_table.text = {'\t', false, widths};
    return read_text(nodes, text, of_table);
  }
  const TextLayout layout = layout_of(text, nodes.file, options.text);
  Choice choice = choose(layout, options);
  std::vector<Role> roles(layout.columns, Role::skipped);
  if (options.with_columns)
    for (const std::size_t c : choice.columns) roles[c] = Role::carried;
  for (const std::size_t c : choice.place) roles[c] = options.keep_missing ? Role::value : Role::place;
  if (choice.value) roles[*choice.value] = Role::value;
  TextRows rows = rows_of(text, nodes.file, layout, roles);
  nodes.lines = std::move(rows.lines);
  if (choice.is_guess && is_lonlat_value(nodes, rows, options.units)) {
    choice.place.pop_back();
    choice.columns.push_back(2);
  }
  if (choice.value) nodes.value = column_of(rows, layout, *choice.value);
  if (layout.names.empty()) nodes.value.name.clear();
  if (options.with_columns) {
    if (!rows.segments.empty()) {
      for (double& s : rows.segments) ++s;
      nodes.columns.push_back(
          whole_numbers("segment", "number of the segment in the input", std::move(rows.segments)));
    }
    for (const std::size_t c : choice.columns)
      if (c != choice.value) nodes.columns.push_back(column_of(rows, layout, c));
    make_names_differ(nodes.columns, choice.is_lonlat() ? std::vector<std::string>{"lon", "lat"}
                                                        : std::vector<std::string>{});
  }
  set_places(nodes, values_at(rows.numbers, choice.place),
             choice.is_lonlat() ? units_of(layout, choice, options.units, nodes.file) : options.units,
             fmt::format("{},{}", choice.place[1] + 1, choice.place[0] + 1));
}

void read_raw(Nodes& nodes, std::string_view bytes, const ReadOptions& options) {
  nodes.kind = "raw doubles";
  if (options.coordinates == Coordinates::detected)
    fail(nodes.file, "raw doubles have no format information: give --coordinates xyz or lonlat");
  const std::size_t columns = options.coordinates == Coordinates::xyz ? 3 : 2;
  if (bytes.empty() || bytes.size() % (columns * sizeof(double)) != 0)
    fail(nodes.file, "{} bytes are not rows of {} doubles of 8 bytes", bytes.size(), columns);
  std::vector<double> values(bytes.size() / sizeof(double));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  std::vector<std::vector<double>> axes(columns);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) && !(options.keep_missing && std::isnan(values[i])))
      fail(nodes.file, "{}: column {} is not finite: remove the row", nodes.place(i / columns),
           i % columns + 1);
    axes[i % columns].push_back(values[i]);
  }
  set_places(nodes, std::move(axes), options.units, "");
}

/// OFF: comments behind #, the word OFF, the counts of vertices, faces and edges, vertices `x y z`, faces
/// `count corner...` with corners from 0.
void read_off(Nodes& nodes, std::string text, const ReadOptions& options) {
  nodes.kind = "OFF";
  for (std::size_t begin = text.find('#'); begin != text.npos; begin = text.find('#', begin))
    text.erase(begin, std::min(text.size(), text.find('\n', begin)) - begin);
  std::istringstream in(text);
  std::string word;
  std::size_t vertices = 0, faces = 0, edges = 0;
  if (!(in >> word >> vertices >> faces >> edges))
    fail(nodes.file, "expected OFF and the counts of vertices, faces, edges");
  if (vertices > text.size() || faces > text.size()) fail(nodes.file, "counts larger than the file");
  nodes.points.resize(vertices);
  for (std::size_t i = 0; i < vertices; ++i)
    if (Point& p = nodes.points[i]; !(in >> p.x >> p.y >> p.z))
      fail(nodes.file, "{}: expected x y z", nodes.place(i));
  if (!options.with_triangles) return;
  std::vector<long long> corners(3 * faces);
  for (std::size_t f = 0; f < faces; ++f) {
    std::size_t count = 0;
    in >> count;
    for (std::size_t k = 0; k < 3; ++k) in >> corners[3 * f + k];
    if (!in || count != 3) fail(nodes.file, "face {}: expected a triangle, 3 A B C", f + 1);
  }
  set_triangles(nodes, corners, 0);
}

}  // namespace

void refuse_foreign(const std::string& file, const std::string& contents) {
  constexpr const char *kToCsv = "libreoffice --headless --convert-to csv %",
                       *kToOff = "python3 -c \"import meshio; meshio.read('%').write('out.off')\"",
                       *kToGeojson = "ogr2ogr -f GeoJSON -t_srs EPSG:4326 out.geojson %";
  struct Foreign {
    std::string_view begin, inside;
    const char *name, *command;  ///< %: the file
  };
  using namespace std::string_view_literals;
  static constexpr Foreign kForeign[] = {
      {"\0\0\x27\x0A"sv, "", "a shapefile", kToGeojson},
      {"SQLite format 3", "", "a GeoPackage", kToGeojson},
      {"<", "<kml", "KML", kToGeojson},
      {"PK\x03\x04", ".kml", "KMZ", kToGeojson},
      {"PK\x03\x04", "xl/workbook", "a spreadsheet", kToCsv},
      {"PK\x03\x04", "opendocument.spreadsheet", "a spreadsheet", kToCsv},
      {"\xD0\xCF\x11\xE0", "", "a spreadsheet", kToCsv},
      {"PAR1", "", "Parquet",
       "python3 -c \"import pandas; pandas.read_parquet('%').to_csv('out.csv', index=False)\""},
      {"GRIB", "", "GRIB", "cdo -f nc copy % out.nc"},
      {"<", "<VTKFile", "a VTK mesh", kToOff},
      {"# vtk DataFile", "", "a VTK mesh", kToOff},
      {"$MeshFormat", "", "a mesh of gmsh", kToOff},
      {"", "MSHID=", "a mesh of JIGSAW",
       "awk -F'[=;]' '/^POINT/{n=$2;next} n-->0{print $1,$2,$3}' % > out.txt"}};
  const std::string_view whole(contents), head = whole.substr(0, 4096);
  const auto refuse = [&](const char* name, std::string by) {
    by.replace(by.find('%'), 1, file);
    fail(file, "{}: convert it first, by `{}`", name, by);
  };
  for (const Foreign& f : kForeign)
    if (whole.substr(0, f.begin.size()) == f.begin &&
        (f.begin.empty() ? head : whole).find(f.inside) != whole.npos)
      refuse(f.name, f.command);
  const std::string suffix = std::filesystem::path(file).extension();
  if (suffix == ".14" || suffix == ".gr3")
    refuse("a grid of ADCIRC or SCHISM", "awk 'NR==2{n=$2} NR>2&&NR<=n+2{print $2,$3,$4}' % > out.txt");
}

LonLat Grid::places() const {
  LonLat all;
  for (const double y : lat)
    for (const double x : lon) {
      all.lon.push_back(x);
      all.lat.push_back(y);
    }
  return all;
}

std::string Nodes::place(std::size_t i) const {
  return fmt::format("node {}", number(i)) +
         (i < lines.size() ? fmt::format(" ({} {})", lines_are, lines[i]) : "");
}

NodeValues at_nodes(const NodeValues& values, const std::vector<std::size_t>& nodes) {
  return {at_nodes(values.given, nodes),
          values_at(values.density, nodes),
          at_nodes(values.columns, nodes),
          values.notes,
          values_at(values.layers, nodes),
          values.radius,
          values.nominal};
}

void Nodes::keep(const std::vector<std::size_t>& indices) {
  if (shape.empty()) shape.push_back(points.size());
  if (numbers.empty())
    for (std::size_t i = 0; i < points.size(); ++i) numbers.push_back(i + 1);
  numbers = values_at(numbers, indices);
  points = values_at(points, indices);
  lines = values_at(lines, indices);
  value = at_nodes(Columns{value}, indices)[0];
  static_cast<NodeValues&>(*this) = at_nodes(*this, indices);
  grid = {};
  triangles.clear();
  vertices.clear();
}

double largest_of(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::fabs(v));
  return most;
}

std::string hint_beyond_pole(const LonLat& a, const std::string& to_exchange) {
  if (!a.degrees) return "; --units degrees?";
  if (largest_of(a.lon) > 90 || largest_of(a.lat) > 360) return "";
  return "; are they exchanged?" + (to_exchange.empty() ? "" : " Then say --columns " + to_exchange);
}

std::size_t first_beyond_pole(const LonLat& a) {
  const double pole = (a.degrees ? 90 : kRightAngle) * kSlack;
  const auto is_beyond = [&](double lat) { return std::fabs(lat) > pole; };
  return static_cast<std::size_t>(std::find_if(a.lat.begin(), a.lat.end(), is_beyond) - a.lat.begin());
}

void set_triangles(Nodes& nodes, const std::vector<long long>& corners, long long first) {
  nodes.triangles.resize(corners.size() / 3);
  for (std::size_t t = 0; t < nodes.triangles.size(); ++t) {
    pstripack::Triangle& triangle = nodes.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const long long node = corners[3 * t + k] - first;
      const bool is_missing = node == -1 && !nodes.vertices.empty();
      if ((node < 0 && !is_missing) || node >= static_cast<long long>(nodes.points.size()))
        fail(nodes.file, "triangle {}: there is no node {}", t + 1, corners[3 * t + k]);
      triangle[k] = static_cast<pstripack::index_t>(node);
    }
    if (triangle[0] < 0 || triangle[1] < 0 || triangle[2] < 0) continue;
    const auto at = [&](std::size_t k) { return nodes.points[static_cast<std::size_t>(triangle[k])]; };
    const int sign = pstripack::left(at(0), at(1), at(2));
    if (sign == 0) fail(nodes.file, "triangle {}: its corners lie on one great circle", t + 1);
    if (sign < 0) std::swap(triangle[1], triangle[2]);
  }
}

bool is_note(const std::string& name) {
  constexpr const char* kNames[] = {"title", "history", "source", "institution", "references", "comment"};
  return name.rfind("scvt_", 0) == 0 ||
         std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

bool is_netcdf(const std::string& file) {
  char begin[4] = "";
  if (!std::filesystem::is_regular_file(file)) return false;  // what is read from a pipe is gone
  std::ifstream(file, std::ios::binary).read(begin, sizeof begin);
  return has_magic_of_netcdf({begin, sizeof begin});
}

Nodes read(const std::string& file, const ReadOptions& options) {
  Nodes nodes;
  nodes.file = file == "-" ? "stdin" : file;
  const bool may_be_netcdf =
      options.container == Container::detected || options.container == Container::netcdf;
  if (may_be_netcdf && file != "-" && is_netcdf(file)) return read_netcdf(file, options);

  const std::string contents = contents_of(file);
  if (may_be_netcdf && has_magic_of_netcdf(contents)) return read_netcdf(nodes.file, options, contents);
  if (options.container == Container::netcdf) fail(nodes.file, "not a NetCDF file");
  if (options.container == Container::raw) {
    if (options.with_values) fail(nodes.file, "values are read from text, NetCDF and GeoJSON only");
    read_raw(nodes, contents, options);
    return nodes;
  }
  if (contents.compare(0, 2, "\xFF\xFE") == 0 || contents.compare(0, 2, "\xFE\xFF") == 0)
    fail(nodes.file + ":1", "UTF-16: save the file as UTF-8");
  if (contents.compare(0, 2, "\x1F\x8B") == 0) fail(nodes.file, "compressed by gzip: use `gunzip` first");
  refuse_foreign(nodes.file, contents);
  if (is_binary(contents))
    fail(nodes.file, "binary, but not NetCDF; raw doubles need --from raw and --coordinates");
  if (options.container == Container::geojson ||
      (options.container == Container::detected && is_geojson(contents)))
    return read_geojson(nodes.file, options, contents);
  std::string first_word;
  std::istringstream(contents.substr(0, 4096)) >> first_word;
  if (first_word == "OFF" && !options.with_values)
    read_off(nodes, contents, options);
  else
    read_text(nodes, contents, options);
  return nodes;
}

#ifndef HAVE_NETCDF
std::vector<std::string> netcdf_variables(const std::string&) { return {}; }
Nodes read_netcdf(const std::string& file, const ReadOptions&, const std::string&) {
  fail(file, "a NetCDF file, which this build cannot read: build with libnetcdf-dev");
}
#endif

}  // namespace files
