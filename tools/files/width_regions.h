#pragma once
// Regions of GeoJSON and of MPAS-Limited-Area, and regions with a width of cells each.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "geometry/point.h"

namespace files {

/// A box of the map, in degrees; west < east <= west + 360, south < north.
struct Region {
  double west = -180, east = 180, south = -90, north = 90;
};

struct MapRegion {
  std::size_t feature = 0;  ///< its number in the file, from 1; 0: it is from no file
  std::string name = {};    ///< its property `name` or `id`, or its member `id`; empty: it has none
  /// Closed lines of longitudes and latitudes, in degrees, straight on the map (RFC 7946): the outlines and
  /// the holes of its polygons. A place is inside if a meridian from it crosses an odd number of sides.
  std::vector<std::vector<std::pair<double, double>>> rings = {};
  /// If its sides are arcs of great circles: the corners of each closed line. `rings` then are within 2e-7
  /// rad of the arcs; those of a channel are its parallels.
  std::vector<std::vector<pstripack::Point>> corners = {};

  /// Pairs of increasing longitudes, of any turn, between which the parallel is inside.
  std::vector<std::pair<double, double>> inside(double lat) const;
  bool contains(const pstripack::Point& p) const;
  double area() const;  ///< on the unit sphere, to about 1e-3 of itself
};

MapRegion region_of_box(const Region& box);
/// The side of the closed line of arcs between these corners on which `inside` lies.
MapRegion region_of_arcs(std::vector<pstripack::Point> corners, const pstripack::Point& inside);
/// An ellipse of n corners around a place in degrees: half its axes in radians; the first, `a`, turned by
/// `turn` degrees from north to east.
MapRegion ellipse_region(double lon, double lat, double a, double b, double turn, int n);
/// Replaces straight lines on the map by arcs between the same corners. Throws std::runtime_error, one line
/// that begins with `name`, if no one arc joins two of them.
void follow_great_circles(const std::string& name, MapRegion& region);
struct WidthRegion : MapRegion {
  double width = 0;       ///< property `width`, km
  double transition = 0;  ///< property `transition`, km; 0 without it
};

/// The region of a file of MPAS-Limited-Area: a circle, an ellipse, a channel, or a polygon, of great
/// circles. `radius`: of the sphere, metres. Throws std::runtime_error: one line with file, line and key.
MapRegion read_pts(const std::string& file, double radius);
/// The polygons of a GeoJSON file, or read_pts() of a NAME.pts. Throws as read_width_regions().
std::vector<MapRegion> read_polygons(const std::string& file, double radius = 6371000);

/// A region for each feature. Throws std::runtime_error: one line with file, feature, and remedy.
std::vector<WidthRegion> read_width_regions(const std::string& file);

}  // namespace files
