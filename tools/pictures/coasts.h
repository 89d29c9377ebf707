#pragma once
// Coast lines from shapefiles.

#include <string>
#include <vector>

#include "geometry/point.h"

namespace pictures {

/// Lines on the sphere: runs of unit vectors.
using Lines = std::vector<std::vector<pstripack::Point>>;

/// Natural Earth's shapefile of land in `folder` (Debian: libmagics++-data), at the scale that a picture with
/// this radius in degrees needs. Throws std::runtime_error if it is missing.
std::string natural_earth(double radius, const std::string& folder = "/usr/share/magics");

/// The lines, and the borders of the polygons, of an ESRI shapefile (.shp) with longitudes and latitudes in
/// degrees. Leaves out sides along the antimeridian or through a pole, where polygons are only cut. Throws
/// std::runtime_error with file and remedy if it is not such a file.
Lines read_shapefile(const std::string& file);

}  // namespace pictures
