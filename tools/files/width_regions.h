#pragma once
// Polygons of GeoJSON, and regions with a width of cells each.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace files {

struct MapRegion {
  std::size_t feature = 0;  ///< its number in the file, from 1
  std::string name = {};    ///< its property `name` or `id`, or its member `id`; empty: it has none
  /// Closed lines of longitudes and latitudes, in degrees, straight on the map (RFC 7946): the outlines and
  /// the holes of its polygons. A place is inside if a meridian from it crosses an odd number of sides.
  std::vector<std::vector<std::pair<double, double>>> rings = {};

  /// Pairs of increasing longitudes, within -180 to 540, between which the parallel is inside.
  std::vector<std::pair<double, double>> inside(double lat) const;
  double area() const;  ///< on the unit sphere, to about 1e-3 of itself
};

struct WidthRegion : MapRegion {
  double width = 0;       ///< property `width`, km
  double transition = 0;  ///< property `transition`, km; 0 without it
};

/// The polygons of the file; first their outline, then their holes. Throws as read_width_regions().
std::vector<MapRegion> read_polygons(const std::string& file);

/// A region for each feature. Throws std::runtime_error: one line with file, feature, and remedy.
std::vector<WidthRegion> read_width_regions(const std::string& file);

}  // namespace files
