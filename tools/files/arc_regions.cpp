// Regions between arcs of great circles, and MPAS-Limited-Area's files of them.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "files/columns.h"
#include "files/measures.h"
#include "files/nearest.h"
#include "files/text_file.h"
#include "files/width_regions.h"
#include "numbers.h"
#include "point_sets.h"

namespace files {
namespace {

using pstripack::Point;
using Arcs = std::vector<Point>;
using Ring = std::vector<std::pair<double, double>>;

/// Adds the arc from a to b, without b, as longitudes and latitudes of a line on the map that is within 2e-7
/// rad of it and begins within 180 degrees of the end of `line`.
void add_arc(const Point& a, const Point& b, Ring& line) {
  constexpr double kStep = 0.1;  // degrees. An arc leaves a line on the map by at most step^2 / 16.
  constexpr double kShort = 1e-8;
  const double turn = std::remainder(longitude(b) - longitude(a), 360), up = latitude(b) - latitude(a);
  if (std::max(std::fabs(turn), std::fabs(up)) > kStep && length(minus(a, b)) > kShort) {
    const Point middle = unit({a.x + b.x, a.y + b.y, a.z + b.z});
    add_arc(a, middle, line);
    add_arc(middle, b, line);
    return;
  }
  const double lon = longitude(a), before = line.empty() ? lon : line.back().first;
  line.emplace_back(lon + 360 * std::round((before - lon) / 360), latitude(a));
}

/// The closed line of arcs on the map, from a turn of the first corner's longitude on. A line around a pole
/// is closed along the one that gives it the smaller area.
Ring on_map(const Arcs& corners, double lon) {
  Ring ring{{lon, 0}};
  for (std::size_t i = 0; i < corners.size(); ++i)
    add_arc(corners[i], corners[(i + 1) % corners.size()], ring);
  ring.erase(ring.begin());
  const auto [west, lat] = ring.front();
  const double end = west + 360 * std::round((ring.back().first - west) / 360);
  ring.emplace_back(end, lat);
  if (end == west) return ring;
  ring.insert(ring.end(), {{end, 90}, {west, 90}, {west, lat}});
  if (MapRegion{0, "", {ring}}.area() > 2 * kPi) (ring.end() - 2)->second = (ring.end() - 3)->second = -90;
  return ring;
}

}  // namespace

MapRegion region_of_box(const Region& box) {
  const auto [west, east, south, north] = box;
  return {0, "", {{{west, south}, {east, south}, {east, north}, {west, north}, {west, south}}}};
}

MapRegion region_of_arcs(Arcs corners, const Point& inside) {
  MapRegion region{1, "", {on_map(corners, longitude(corners[0]))}};
  Ring& ring = region.rings[0];
  if (!region.contains(inside)) {  // then all around it
    const auto [west, east] = std::minmax_element(ring.begin(), ring.end());
    const double middle = (west->first + east->first) / 2;
    if (east->first - west->first >= 360)  // a line around a pole
      for (std::size_t k = ring.size() - 3; k < ring.size() - 1; ++k) ring[k].second *= -1;
    else
      region.rings.insert(region.rings.begin(), region_of_box({middle - 180, middle + 180}).rings[0]);
  }
  region.corners = {std::move(corners)};
  return region;
}

MapRegion ellipse_region(double lon, double lat, double a, double b, double turn, int n) {
  const Point centre = point_sets::from_degrees(lon, lat), north = point_sets::from_degrees(lon, lat + 90),
              east = cross(north, centre);
  Arcs line;
  for (int k = 0; k < n; ++k) {
    const double angle = 360.0 * k / n, c = point_sets::cos_degrees(angle),
                 s = point_sets::sin_degrees(angle), radius = a * b / std::hypot(a * s, b * c),
                 up = std::cos(radius), out = std::sin(radius),
                 n_part = out * point_sets::cos_degrees(angle + turn),
                 e_part = out * point_sets::sin_degrees(angle + turn);
    line.push_back({up * centre.x + n_part * north.x + e_part * east.x,
                    up * centre.y + n_part * north.y + e_part * east.y,
                    up * centre.z + n_part * north.z + e_part * east.z});
  }
  return region_of_arcs(std::move(line), centre);
}

void follow_great_circles(const std::string& name, MapRegion& region) {
  for (Ring& ring : region.rings) {
    Arcs& line = region.corners.emplace_back();
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      const auto [x, y] = ring[i];
      const auto [to_x, to_y] = ring[i + 1];
      line.push_back(point_sets::from_degrees(x, y));
      if (std::fabs(to_x - x) >= 180 && std::fabs(y + to_y) < 180)
        fail(name,
             "{}its side from {:g},{:g} to {:g},{:g} is no arc of less than 180 degrees: "
             "add corners between them",
             region.feature > 0 ? fmt::format("feature {}: ", region.feature) : "", x, y, to_x, to_y);
    }
    ring = on_map(line, ring[0].first);
  }
}

// ---- files of MPAS-Limited-Area -----------------------------------------------------------------------

namespace {

class PtsFile {
 public:
  explicit PtsFile(const std::string& file) : file_(file) {
    std::istringstream text(contents_of(file));
    std::string line;
    for (std::size_t number = 1; std::getline(text, line); ++number) {
      const std::string where = line_of(file, number);
      line = trimmed(line.substr(0, line.find('#')));
      const std::size_t colon = line.find(':');
      if (line.empty()) continue;
      if (colon == line.npos) {
        corners_.push_back(place("a corner", {line, where}));
        continue;
      }
      const std::string key(trimmed(line.substr(0, colon)));
      const auto known = std::find_if(kKeys.begin(), kKeys.end(),
                                      [&](const std::string& name) { return lower(name) == lower(key); });
      if (known == kKeys.end()) fail(where, "unknown key '{}'{}", excerpt(key), did_you_mean(key, kKeys));
      if (!values_.emplace(*known, Value{std::string(trimmed(line.substr(colon + 1))), where}).second)
        fail(where, "{} occurs twice: remove one", *known);
    }
  }

  /// `radius`: of the sphere, metres.
  MapRegion region(double radius) const {
    const auto& [text, where] = value("Type");
    const std::string type = lower(text);
    if (type != "custom" && !corners_.empty())
      fail(where, "the Type '{}' has no corners: only custom has", excerpt(text));
    MapRegion region;
    constexpr int kCorners = 100;
    const auto radians = [&](const char* key) { return number(key, 1, 3.14159 * radius) / radius; };
    if (type == "channel") {
      const double north = number("Upper-lat", -90, 90), south = number("Lower-lat", -90, north);
      region = {1, "", {{{-180, south}, {180, south}, {180, north}, {-180, north}, {-180, south}}}};
      for (const double lat : {south, north}) {
        Arcs& parallel = region.corners.emplace_back();
        for (int k = 0; k < kCorners; ++k)
          parallel.push_back(point_sets::from_degrees(360.0 * k / kCorners, lat));
      }
    } else if (type == "custom") {
      if (corners_.size() < 3) fail(where, "custom needs three corners or more: lines of `lat, lon`");
      for (std::size_t i = 0; i < corners_.size(); ++i)
        if (dot(corners_[i], corners_[(i + 1) % corners_.size()]) < -1 + 1e-12)
          fail(where, "corner {} is opposite the next one: add a corner between them", i + 1);
      region = region_of_arcs(corners_, place("Point", value("Point")));
    } else if (type == "circle" || type == "ellipse") {
      const LonLat centre({place("Point", value("Point"))}, true);
      const bool is_circle = type == "circle";
      const double a = radians(is_circle ? "radius" : "Semi-major-axis"),
                   b = is_circle ? a : radians("Semi-minor-axis"),
                   turn = is_circle ? 0 : number("Orientation-angle", -360, 360);
      region = ellipse_region(centre.lon[0], centre.lat[0], a, b, turn, kCorners);
    } else {
      fail(where, "Type '{}': expected circle, ellipse, channel or custom", excerpt(text));
    }
    if (const auto name = values_.find("Name"); name != values_.end()) region.name = name->second.text;
    return region;
  }

 private:
  struct Value {
    std::string text, where;
  };
  inline static const std::vector<std::string> kKeys{
      "Name",      "Type",     "Point", "radius", "Semi-major-axis", "Semi-minor-axis", "Orientation-angle",
      "Upper-lat", "Lower-lat"};

  const Value& value(const std::string& key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) fail(file_, "there is no line `{}: ...`", key);
    return found->second;
  }
  double number(const std::string& key, double low, double high) const {
    const auto& [text, where] = value(key);
    double number = 0;
    if (!point_sets::parse(text, number) || !(number >= low && number <= high))
      fail(where, "{}: '{}': expected a number from {:g} to {:g}", key, excerpt(text), low, high);
    return number;
  }
  Point place(const std::string& what, const Value& from) const {
    std::string text = from.text;
    text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\t'; }),
               text.end());
    const std::vector<double> parts = numbers_between(text, ',');
    if (parts.size() != 2 || std::fabs(parts[0]) > 90 || std::fabs(parts[1]) > 360)
      fail(from.where, "{}: '{}': expected `latitude, longitude` in degrees", what, excerpt(from.text));
    return point_sets::from_degrees(parts[1], parts[0]);
  }

  std::string file_;
  std::map<std::string, Value> values_;
  std::vector<Point> corners_;
};

}  // namespace

MapRegion read_pts(const std::string& file, double radius) { return PtsFile(file).region(radius); }

}  // namespace files
