#include "files/width_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "files/geojson.h"
#include "files/measures.h"
#include "files/text_file.h"
#include "numbers.h"

namespace files {
namespace {

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {
    read_features(contents_of(file_), file_, "polygons", {"Polygon", "MultiPolygon"},
                  [&](const Json& feature, std::size_t number) { add(feature, number); });
    if (features.empty()) throw std::runtime_error(file_ + ": no polygons: there are no features");
  }

  struct Feature {
    std::vector<MapRegion> polygons;
    Json properties;
  };
  std::vector<Feature> features;

  WidthRegion width_region(const Feature& feature) {
    WidthRegion region;
    number_ = region.feature = feature.polygons.front().feature;
    for (const MapRegion& polygon : feature.polygons)
      region.rings.insert(region.rings.end(), polygon.rings.begin(), polygon.rings.end());
    region.width = length(feature.properties, "width");
    if (feature.properties.contains("transition") && !feature.properties["transition"].is_null())
      region.transition = length(feature.properties, "transition");
    if (!(region.width > 0)) fail("it needs the property width, in km and above 0");
    if (!(region.transition >= 0)) fail("its property transition must be in km, and not negative");
    return region;
  }

 private:
  void add(const Json& feature, std::size_t number) {
    number_ = number;
    const auto geometry = feature.find("geometry");
    const std::string type =
        geometry != feature.end() && geometry->is_object() ? text_of(*geometry, "type") : "";
    if (type != "Polygon" && type != "MultiPolygon")
      fail(fmt::format("'{}' is not a Polygon or MultiPolygon", excerpt(type)));
    const auto coordinates = geometry->find("coordinates");
    if (coordinates == geometry->end() || !coordinates->is_array()) fail("its geometry has no coordinates");
    Feature& added = features.emplace_back();
    if (type == "Polygon")
      added.polygons.push_back(polygon_of(*coordinates));
    else
      for (const Json& polygon : *coordinates) added.polygons.push_back(polygon_of(polygon));
    if (added.polygons.empty()) fail("a MultiPolygon without polygons");
    const auto properties = feature.find("properties");
    added.properties = properties != feature.end() && properties->is_object() ? *properties : Json::object();
    const std::string name = name_of(feature, added.properties);
    for (MapRegion& polygon : added.polygons) polygon.name = name;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: feature {}: {}", file_, number_, what));
  }

  /// Not a number if there is none.
  static double length(const Json& properties, const char* name) {
    double value = std::nan("");
    const auto found = properties.find(name);
    if (found == properties.end()) return value;
    if (found->is_number()) value = found->get<double>();
    if (found->is_string() && !point_sets::parse(found->get<std::string>(), value)) value = std::nan("");
    return std::isfinite(value) ? value : std::nan("");
  }

  static std::string name_of(const Json& feature, const Json& properties) {
    const auto text = [](const Json& value) {
      return value.is_string() ? value.get<std::string>() : value.is_number() ? value.dump() : "";
    };
    for (const char* const name : {"name", "Name", "NAME", "id", "Id", "ID"})
      if (properties.contains(name) && !text(properties[name]).empty()) return text(properties[name]);
    return feature.contains("id") ? text(feature["id"]) : "";
  }

  MapRegion polygon_of(const Json& polygon) const {
    MapRegion region{number_};
    if (!polygon.is_array() || polygon.empty()) fail("a polygon without rings");
    for (const Json& ring : polygon) {
      if (!ring.is_array() || ring.size() < 4) fail("a ring with fewer than four corners");
      auto& corners = region.rings.emplace_back();
      for (const Json& corner : ring) {
        if (!corner.is_array() || corner.size() < 2 || !corner[0].is_number() || !corner[1].is_number())
          fail("expected corners [longitude, latitude]");
        corners.emplace_back(corner[0].get<double>(), corner[1].get<double>());
        const auto [lon, lat] = corners.back();
        if (!(std::fabs(lat) <= 90)) fail(fmt::format("latitude {:g} is beyond the pole", lat));
        if (!(lon >= -180 && lon <= 540)) fail(fmt::format("longitude {:g} is not within -180 to 540", lon));
        const double before = corners.size() > 1 ? corners[corners.size() - 2].first : lon;
        if (std::fabs(lon - before) > 180 && std::fabs(lon - before) < 360)
          fail(fmt::format(
              "its side from longitude {:g} to {:g} goes around the globe: cut the polygon at 180, "
              "or write {:g} in place of {:g}",
              before, lon, std::min(before, lon) + 360, std::min(before, lon)));
      }
      make_cap(corners);
      const auto [first, last] = std::pair(corners.front(), corners.back());
      if (std::fabs(first.first - last.first) == 360)
        fail(fmt::format("a ring around a pole: continue it by {:g},{:g} {:g},{:g} and its first corner",
                         last.first, std::copysign(90, last.second), first.first,
                         std::copysign(90, last.second)));
      if (first != last) fail("a ring that is not closed: repeat its first corner");
    }
    return region;
  }

  /// A ring once around the globe along a parallel becomes the cap between the parallel and the nearer pole.
  static void make_cap(std::vector<std::pair<double, double>>& corners) {
    const auto [west, east] = std::minmax_element(corners.begin(), corners.end());
    const double lat = west->second, pole = std::copysign(90, lat);
    for (const auto& corner : corners)
      if (corner.second != lat || std::fabs(lat) == 90 || east->first - west->first != 360) return;
    corners = {*west, *east, {east->first, pole}, {west->first, pole}, *west};
  }

  std::string file_;
  std::size_t number_ = 0;
};

}  // namespace

std::vector<std::pair<double, double>> MapRegion::inside(double lat) const {
  lat = std::min(lat, std::nextafter(90.0, 0.0));  // a pole is in a region that reaches it
  std::vector<double> crossings;
  for (const auto& ring : rings)
    for (std::size_t i = 1; i < ring.size(); ++i) {
      const auto [x1, y1] = ring[i - 1];
      const auto [x2, y2] = ring[i];
      if ((y1 <= lat) != (y2 <= lat)) crossings.push_back(x1 + (lat - y1) / (y2 - y1) * (x2 - x1));
    }
  std::sort(crossings.begin(), crossings.end());
  std::vector<std::pair<double, double>> pairs;
  for (std::size_t i = 1; i < crossings.size(); i += 2) pairs.emplace_back(crossings[i - 1], crossings[i]);
  return pairs;
}

bool MapRegion::contains(const pstripack::Point& p) const {
  for (const auto& [west, east] : inside(latitude(p)))
    if (west + std::fmod(std::fmod(longitude(p) - west, 360) + 360, 360) < east) return true;
  return false;
}

double MapRegion::area() const {
  constexpr int kStrips = 1000;
  double south = 90, north = -90, area = 0;
  for (const auto& ring : rings)
    for (const auto& corner : ring)
      south = std::min(south, corner.second), north = std::max(north, corner.second);
  const double height = (north - south) / kStrips;
  for (int k = 0; k < kStrips; ++k) {
    const double lat = south + (k + 0.5) * height;
    for (const auto& [west, east] : inside(lat)) area += (east - west) * height * std::cos(lat * kDegree);
  }
  return area * kDegree * kDegree;
}

std::vector<MapRegion> read_polygons(const std::string& file) {
  if (std::filesystem::path(file).extension() == ".pts") return read_pts(file, 1000 * kEarthRadius);
  std::vector<MapRegion> polygons;
  Reader reader(file);
  for (Reader::Feature& feature : reader.features)
    for (MapRegion& polygon : feature.polygons) polygons.push_back(std::move(polygon));
  return polygons;
}

std::vector<WidthRegion> read_width_regions(const std::string& file) {
  Reader reader(file);
  std::vector<WidthRegion> regions;
  for (const Reader::Feature& feature : reader.features) regions.push_back(reader.width_region(feature));
  return regions;
}

}  // namespace files
