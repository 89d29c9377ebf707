#pragma once
// Coast lines from files of other people.

#include <string>
#include <vector>

#include "geometry/point.h"

namespace pictures {

/// Lines on the sphere: runs of unit vectors.
using Lines = std::vector<std::vector<pstripack::Point>>;

/// Natural Earth's land in `folder`, where Debian's libmagics++-data has it, as fine as pictures of this
/// radius (degrees) need. Throws std::runtime_error if it is not there.
std::string natural_earth(double radius, const std::string& folder = "/usr/share/magics");

/// The lines and the borders of the polygons of an ESRI shapefile (.shp) of longitudes and latitudes in
/// degrees, but for what runs along the antimeridian or through a pole, where files cut their polygons.
/// Throws std::runtime_error with the file and the remedy if it is none.
Lines read_shapefile(const std::string& file);

}  // namespace pictures
