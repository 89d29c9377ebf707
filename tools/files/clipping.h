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

/// The parts of whole cells in each of the polygons, of which every part belongs to one. Sides of polygons
/// are straight on the map, approximated by arcs of great circles within 0.0001 degrees. A part with a hole
/// is cut in two; where polygons surround the sphere, cells are also cut at the meridians 0 and 180. Corners
/// of cells are as exact as doubles; which side of a border of two cells a corner of a polygon lies on is
/// decided in both alike. So the areas of the parts of a polygon add up to its own. Throws NoMesh if the
/// rings of a polygon cross.
Faces clipped_to_polygons(const Faces& cells, const std::vector<MapRegion>& polygons);

}  // namespace files
