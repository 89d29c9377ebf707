#include "files/columns.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/parallel_for.h"
#include "files/measures.h"
#include "point_sets.h"

namespace files {

const Column* find(const Columns& columns, const std::string& name) {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

void make_names_differ(Columns& columns, std::vector<std::string> taken) {
  for (Column& c : columns) {
    while (std::find(taken.begin(), taken.end(), c.name) != taken.end()) c.name += "_given";
    taken.push_back(c.name);
  }
}

Column whole_numbers(std::string name, std::string long_name, std::vector<double> numbers) {
  return {std::move(name), std::move(long_name), "", std::move(numbers), {}, true};
}

AngleUnit::AngleUnit(const std::string& text) {
  std::string word;
  for (const char c : text)
    if (c != ' ' && c != '_') word += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (word == "rad" || word == "radian" || word == "radians") radians = true;
  for (const char* const name : {"degrees", "degree", "deg", "arcdegrees", "arcdegree", "angulardegrees",
                                 "angulardegree", "\xC2\xB0"}) {
    if (degrees || word.rfind(name, 0) != 0) continue;
    const std::string rest = word.substr(std::strlen(name));
    axis = rest == "east" || rest == "e" ? 'o' : rest == "north" || rest == "n" ? 'a' : '\0';
    degrees = axis != '\0' || rest.empty();
  }
}

LonLat::LonLat(const std::vector<pstripack::Point>& points, bool in_degrees)
    : lon(points.size()), lat(points.size()), degrees(in_degrees) {
  const double scale = degrees ? kRadian : 1;
  pstripack::parallel_for(points.size(), points.size(), [&](std::size_t i) {
    const pstripack::Point& p = points[i];
    lon[i] = std::atan2(p.y, p.x) * scale;
    lat[i] = std::atan2(p.z, std::sqrt(p.x * p.x + p.y * p.y)) * scale;
  });
}

std::vector<pstripack::Point> points_of(const LonLat& angles) {
  const auto sine = angles.degrees ? point_sets::sin_degrees : point_sets::sin_radians;
  const auto cosine = angles.degrees ? point_sets::cos_degrees : point_sets::cos_radians;
  std::vector<pstripack::Point> points(angles.lon.size(), {kMissing, kMissing, kMissing});
  pstripack::parallel_for(points.size(), points.size(), [&](std::size_t i) {
    const double lon = angles.lon[i], lat = angles.lat[i], r = cosine(lat);
    if (std::isfinite(lon) && std::isfinite(lat)) points[i] = {r * cosine(lon), r * sine(lon), sine(lat)};
  });
  return points;
}

LonLat angles_of(const std::vector<pstripack::Point>& points, const LonLat& given, bool degrees) {
  if (given.empty()) return {points, degrees};
  LonLat angles = given;
  if (given.degrees == degrees) return angles;
  for (auto* const values : {&angles.lon, &angles.lat})
    for (double& v : *values) v = degrees ? v * kRadian : v / kRadian;
  angles.degrees = degrees;
  return angles;
}

Columns at_nodes(const Columns& columns, const std::vector<std::size_t>& nodes) {
  Columns found = columns;
  for (Column& column : found) {
    column.numbers = values_at(column.numbers, nodes);
    column.texts = values_at(column.texts, nodes);
  }
  return found;
}

LonLat at_nodes(const LonLat& angles, const std::vector<std::size_t>& nodes) {
  LonLat found = angles;
  found.lon = values_at(angles.lon, nodes);
  found.lat = values_at(angles.lat, nodes);
  return found;
}

}  // namespace files
