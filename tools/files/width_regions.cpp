#include "files/width_regions.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "files/geojson.h"
#include "files/measures.h"
#include "files/text_file.h"
#include "numbers.h"

namespace files {
namespace {

/// A ring once around the globe along a parallel becomes the cap between the parallel and the nearer pole.
void make_cap(Line& corners) {
  const auto [west, east] = std::minmax_element(corners.begin(), corners.end());
  const double lat = west->second, pole = std::copysign(90, lat);
  for (const auto& corner : corners)
    if (corner.second != lat || std::fabs(lat) == 90 || east->first - west->first != 360) return;
  corners = {*west, *east, {east->first, pole}, {west->first, pole}, *west};
}

/// The features of a file, whose rings are closed.
std::vector<Shape> shapes_of(const std::string& file) {
  std::vector<Shape> shapes = read_shapes(file, "polygons", {"Polygon", "MultiPolygon"});
  for (Shape& shape : shapes)
    for (std::vector<Line>& rings : shape.parts)
      for (Line& ring : rings) {
        if (ring.size() < 4) fail(shape.where, "a ring needs three corners and the first again");
        for (std::size_t i = 1; i < ring.size(); ++i) {
          const double lon = ring[i].first, before = ring[i - 1].first;
          if (std::fabs(lon - before) > 180 && std::fabs(lon - before) < 360)
            fail(shape.where,
                 "its side from longitude {:g} to {:g} goes around the globe: cut the polygon at "
                 "180, or write {:g} in place of {:g}",
                 before, lon, std::min(before, lon) + 360, std::min(before, lon));
        }
        make_cap(ring);
        const auto [first, last] = std::pair(ring.front(), ring.back());
        if (std::fabs(first.first - last.first) == 360)
          fail(shape.where, "a ring around a pole: continue it by {:g},{:g} {:g},{:g} and its first corner",
               last.first, std::copysign(90, last.second), first.first, std::copysign(90, last.second));
        if (first != last) fail(shape.where, "a ring that is not closed: repeat its first corner");
      }
  return shapes;
}

/// Not a number if there is none.
double number_in(const Json& properties, const char* name) {
  double value = std::nan("");
  const auto found = properties.find(name);
  if (found == properties.end()) return value;
  if (found->is_number()) value = found->get<double>();
  if (found->is_string() && !point_sets::parse(found->get<std::string>(), value)) value = std::nan("");
  return std::isfinite(value) ? value : std::nan("");
}

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

std::vector<MapRegion> read_polygons(const std::string& file, double radius) {
  if (std::filesystem::path(file).extension() == ".pts") return {read_pts(file, radius)};
  std::vector<MapRegion> all;
  for (Shape& shape : shapes_of(file))
    for (std::vector<Line>& rings : shape.parts) all.push_back({shape.number, shape.name, std::move(rings)});
  return all;
}

std::vector<WidthRegion> read_width_regions(const std::string& file) {
  std::vector<WidthRegion> regions;
  for (const Shape& shape : shapes_of(file)) {
    WidthRegion& region = regions.emplace_back();
    region.feature = shape.number;
    for (const std::vector<Line>& rings : shape.parts)
      region.rings.insert(region.rings.end(), rings.begin(), rings.end());
    region.width = number_in(shape.properties, "width");
    if (shape.properties.contains("transition") && !shape.properties["transition"].is_null())
      region.transition = number_in(shape.properties, "transition");
    if (!(region.width > 0)) fail(shape.where, "it needs the property width, in km and above 0");
    if (!(region.transition >= 0))
      fail(shape.where, "its property transition must be in km, and not negative");
  }
  return regions;
}

}  // namespace files
