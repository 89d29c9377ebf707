#include "files/nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/parallel_for.h"
#include "numbers.h"
#include "point_sets.h"
#include "text_file.h"

namespace files {
namespace {

constexpr double kRightAngle = 1.5707963267948966;
constexpr double kSlack = 1 + 1e-6;  // single precision rounds a pole up

bool has_magic_of_netcdf(std::string_view bytes) {
  return bytes.substr(0, 3) == "CDF" || bytes.substr(0, 4) == "\x89HDF";
}

std::string_view first_word(std::string_view text) {
  const std::size_t begin = std::min(text.size(), text.find_first_not_of(" \t\r\n"));
  text.remove_prefix(begin);
  return text.substr(0, text.find_first_of(" \t\r\n"));
}

Angles angles_in(const double* values, std::size_t stride, bool degrees) {
  return {values, values + 1, stride, degrees, degrees};
}

/// Rows `lon lat`, possibly with more columns. Angles that cannot be radians are degrees.
void set_angles(Nodes& nodes, const double* values, std::size_t columns, std::size_t n, Units units) {
  if (units == Units::said_or_unmistakable) {
    bool may_be_radians = true;
    for (std::size_t i = 0; i < n && may_be_radians; ++i)
      may_be_radians = std::fabs(values[columns * i]) <= 4 * kRightAngle * kSlack &&
                       std::fabs(values[columns * i + 1]) <= kRightAngle * kSlack;
    if (may_be_radians)
      throw std::runtime_error(
          nodes.file + ": the angles may be degrees or radians: say --units degrees or --units radians");
    units = Units::degrees;
  }
  const bool degrees = units == Units::degrees;
  const Angles angles = angles_in(values, columns, degrees);
  if (const std::size_t bad = first_beyond_pole(angles, n); bad < n)
    throw std::runtime_error(
        fmt::format("{}: {}: latitude {} is beyond the pole: the columns are 'lon lat', in {}{}", nodes.file,
                    nodes.place(bad), values[columns * bad + 1], degrees ? "degrees" : "radians",
                    degrees ? "" : "; --units degrees?"));
  nodes.points = points_of(angles, n);
  nodes.kind += degrees ? ", lon lat in degrees" : ", lon lat in radians";
}

void set_coordinates(Nodes& nodes, const double* values, std::size_t columns, std::size_t n) {
  nodes.points.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double* const v = values + columns * i;
    nodes.points[i] = {v[0], v[1], v[2]};
  }
  nodes.kind += ", x y z";
}

/// The columns of a value and its place.
struct ValueColumns {
  std::size_t place, value;
};

ValueColumns value_columns(const Nodes& nodes, std::size_t columns, const ReadOptions& options) {
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error(fmt::format("{}: has {} columns; {}", nodes.file, columns, what));
  };
  const bool detected = options.coordinates == Coordinates::detected;
  if (detected && columns != 3 && columns != 4)
    fail("expected 'lon lat value' or 'x y z value'; of more columns say --coordinates and --variable");
  const std::size_t place = options.coordinates == Coordinates::lonlat || (detected && columns == 3) ? 2 : 3;
  double column = static_cast<double>(place + 1);
  if (!options.variable.empty() && !point_sets::parse(options.variable, column))
    fail("--variable of text is the number of a column, not '" + options.variable + "'");
  if (column != std::floor(column) || column <= static_cast<double>(place) ||
      column > static_cast<double>(columns))
    fail(fmt::format("the first {} are the place: there is no value in column {}", place, column));
  return {place, static_cast<std::size_t>(column) - 1};
}

/// Rows of coordinates and values, of which some may be missing.
void read_text_with_values(Nodes& nodes, std::string_view text, const ReadOptions& options) {
  point_sets::Table table = point_sets::table_of(text, nodes.file, text.size(), true);
  const ValueColumns columns = value_columns(nodes, table.columns, options);
  nodes.lines = std::move(table.lines);
  for (std::size_t i = 0; i < nodes.lines.size(); ++i) {
    const double* const row = &table.values[table.columns * i];
    for (std::size_t k = 0; k < columns.place; ++k)
      if (std::isnan(row[k]))
        throw std::runtime_error(
            fmt::format("{}: {}: its place is 'nan': remove the row", nodes.file, nodes.place(i)));
    nodes.values.push_back(row[columns.value]);
  }
  if (columns.place == 2)
    set_angles(nodes, table.values.data(), table.columns, nodes.lines.size(), options.units);
  else
    set_coordinates(nodes, table.values.data(), table.columns, nodes.lines.size());
}

void read_text(Nodes& nodes, std::string_view text, const ReadOptions& options) {
  nodes.kind = "text";
  if (options.with_values) return read_text_with_values(nodes, text, options);
  const bool lonlat = options.coordinates == Coordinates::lonlat;
  point_sets::Table table = point_sets::table_of(text, nodes.file, lonlat ? text.size() : 3);
  if (options.coordinates == Coordinates::xyz && table.columns != 3)
    throw std::runtime_error(nodes.file + ": has 2 columns; --coordinates xyz needs 3");
  nodes.lines = std::move(table.lines);
  if (lonlat || table.columns == 2)
    set_angles(nodes, table.values.data(), table.columns, nodes.lines.size(), options.units);
  else
    set_coordinates(nodes, table.values.data(), 3, nodes.lines.size());
}

void read_raw(Nodes& nodes, std::string_view bytes, const ReadOptions& options) {
  nodes.kind = "raw doubles";
  if (options.coordinates == Coordinates::detected)
    throw std::runtime_error(nodes.file +
                             ": raw doubles have no format information: give --coordinates xyz or lonlat");
  const std::size_t columns = options.coordinates == Coordinates::xyz ? 3 : 2;
  if (bytes.empty() || bytes.size() % (columns * sizeof(double)) != 0)
    throw std::runtime_error(
        fmt::format("{}: {} bytes are not rows of {} doubles of 8 bytes", nodes.file, bytes.size(), columns));
  std::vector<double> values(bytes.size() / sizeof(double));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw std::runtime_error(fmt::format("{}: {}: column {} is not finite: remove the row", nodes.file,
                                           nodes.place(i / columns), i % columns + 1));
  if (columns == 2)
    set_angles(nodes, values.data(), 2, values.size() / 2, options.units);
  else
    set_coordinates(nodes, values.data(), 3, values.size() / 3);
}

/// OFF: the word, counts of vertices, faces and edges, vertices `x y z`, faces `count corner...` from 0.
void read_off(Nodes& nodes, const std::string& text, const ReadOptions& options) {
  nodes.kind = "OFF";
  std::istringstream in(text);
  const auto fail = [&](const std::string& what) { throw std::runtime_error(nodes.file + ": " + what); };
  std::string word;
  std::size_t vertices = 0, faces = 0, edges = 0;
  if (!(in >> word >> vertices >> faces >> edges))
    fail("expected OFF and the counts of vertices, faces, edges");
  if (vertices > text.size() || faces > text.size()) fail("counts larger than the file");
  nodes.points.resize(vertices);
  for (std::size_t i = 0; i < vertices; ++i)
    if (Point& p = nodes.points[i]; !(in >> p.x >> p.y >> p.z)) fail(nodes.place(i) + ": expected x y z");
  if (!options.with_triangles) return;
  std::vector<long long> corners(3 * faces);
  for (std::size_t f = 0; f < faces; ++f) {
    std::size_t count = 0;
    in >> count;
    for (std::size_t k = 0; k < 3; ++k) in >> corners[3 * f + k];
    if (!in || count != 3) fail(fmt::format("face {}: expected 3 and three corners", f + 1));
  }
  set_triangles(nodes, corners, 0);
}

}  // namespace

std::string Nodes::place(std::size_t i) const {
  return i < lines.size() ? fmt::format("node {} (line {})", i + 1, lines[i]) : fmt::format("node {}", i + 1);
}

std::vector<Point> points_of(const Angles& a, std::size_t n) {
  constexpr double kDegree = kRightAngle / 90;
  std::vector<Point> points(n);
  pstripack::parallel_pieces(n, pstripack::threads_for(n), [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i) {
      const double lon = a.lon[a.stride * i], lat = a.lat[a.stride * i];
      if (a.lon_in_degrees && a.lat_in_degrees) {
        points[i] = point_sets::from_degrees(lon, lat);
      } else {
        const double x = a.lon_in_degrees ? lon * kDegree : lon, y = a.lat_in_degrees ? lat * kDegree : lat;
        points[i] = {std::cos(y) * std::cos(x), std::cos(y) * std::sin(x), std::sin(y)};
      }
    }
  });
  return points;
}

std::size_t first_beyond_pole(const Angles& a, std::size_t n) {
  const double pole = (a.lat_in_degrees ? 90 : kRightAngle) * kSlack;
  std::size_t i = 0;
  while (i < n && std::fabs(a.lat[a.stride * i]) <= pole) ++i;
  return i;
}

void set_triangles(Nodes& nodes, const std::vector<long long>& corners, long long first) {
  nodes.triangles.resize(corners.size() / 3);
  for (std::size_t t = 0; t < nodes.triangles.size(); ++t) {
    pstripack::Triangle& triangle = nodes.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const long long node = corners[3 * t + k] - first;
      if (node < 0 || node >= static_cast<long long>(nodes.points.size()))
        throw std::runtime_error(
            fmt::format("{}: triangle {}: there is no node {}", nodes.file, t + 1, corners[3 * t + k]));
      triangle[k] = static_cast<pstripack::index_t>(node);
    }
    const auto at = [&](std::size_t k) { return nodes.points[static_cast<std::size_t>(triangle[k])]; };
    const int sign = pstripack::left(at(0), at(1), at(2));
    if (sign == 0)
      throw std::runtime_error(
          fmt::format("{}: triangle {}: its corners lie on one great circle", nodes.file, t + 1));
    if (sign < 0) std::swap(triangle[1], triangle[2]);
  }
}

bool is_netcdf(const std::string& file) {
  char begin[4] = "";
  std::ifstream(file, std::ios::binary).read(begin, sizeof begin);
  return has_magic_of_netcdf({begin, sizeof begin});
}

Nodes read(const std::string& file, const ReadOptions& options) {
  Nodes nodes;
  nodes.file = file == "-" ? "stdin" : file;
  const bool may_be_netcdf = options.container != Container::text && options.container != Container::raw;
  if (may_be_netcdf && file != "-" && is_netcdf(file)) return read_netcdf(file, options);

  const std::string contents = point_sets::contents_of(file);
  if (may_be_netcdf && has_magic_of_netcdf(contents)) return read_netcdf(nodes.file, options, contents);
  if (options.container == Container::netcdf) throw std::runtime_error(nodes.file + ": not a NetCDF file");
  if (options.container == Container::raw) {
    if (options.with_values)
      throw std::runtime_error(nodes.file + ": values are read from text and NetCDF only");
    read_raw(nodes, contents, options);
    return nodes;
  }
  if (std::string_view(contents).substr(0, 4096).find('\0') != std::string::npos)
    throw std::runtime_error(nodes.file +
                             ": binary, but not NetCDF; raw doubles need --from raw and --coordinates");
  if (first_word(contents) == "OFF" && !options.with_values)
    read_off(nodes, contents, options);
  else
    read_text(nodes, contents, options);
  return nodes;
}

}  // namespace files
