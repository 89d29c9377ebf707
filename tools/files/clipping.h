#pragma once
// Voronoi cells cut at the hull of their nodes or at a region of longitudes and latitudes.

#include <vector>

#include "files/mesh.h"
#include "files/width_regions.h"

namespace files {

/// Bounds in degrees; west < east <= west + 360, south < north.
struct Region {
  double west = -180, east = 180, south = -90, north = 90;
};

/// The parts of the cells in the convex hull of the nodes. Without boundary nodes the hull is the whole
/// sphere.
Faces clipped_to_hull(const Faces& cells, const Mesh& mesh);

/// The parts of the cells in the region: none, one or several pieces of each cell; none in a region narrower
/// than 1e-10 degrees. Parallels are approximated by arcs of great circles within 0.0001 degrees. Throws
/// NoMesh if a side is a half turn.
Faces clipped_to_region(const Faces& cells, const Region& region);

/// The parts of whole cells in each of the polygons, of which every part belongs to one, named by the columns
/// `polygon` and, if any has one, `polygon_name`; their areas are known. Sides of polygons are straight on
/// the map, approximated by arcs that change the area of a polygon by a millionth or less, unless it is
/// narrower than 0.3 % of its length. A part with a hole is cut in two; so are parts at the longitude
/// 180, and at meridians or the equator if no cap of 75 degrees around its middle holds the polygon. Corners
/// are right to 1e-15 radians; parts narrower than 1e-14 are left out. Throws NoMesh, naming the feature and
/// two sides, if the rings of a polygon cross.
Faces clipped_to_polygons(const Faces& cells, const std::vector<MapRegion>& polygons);

/// Throws NoMesh, naming the feature and two sides, if rings of the polygon cross.
void expect_no_crossing(const MapRegion& polygon);

}  // namespace files
