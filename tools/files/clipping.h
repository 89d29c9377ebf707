#pragma once
// Voronoi cells cut at the hull of their nodes or at polygons of the map.

#include <vector>

#include "files/mesh.h"
#include "files/width_regions.h"

namespace files {

/// The parts of the cells in the convex hull of the nodes. Without boundary nodes the hull is the whole
/// sphere.
Faces clipped_to_hull(const Faces& cells, const Mesh& mesh);

/// The parts of convex cells in each of the polygons, of which every part belongs to one, named by the
/// columns `polygon`, unless there are only polygons from no file, and, if any has one, `polygon_name`; their
/// areas are known. Sides of polygons, straight on the map, are divided into arcs within 5e-7 of the length
/// of the side, or 1e-9 radians. A part with a hole is cut in two; so are parts at meridians or the
/// equator, if no cap of 75 degrees around its middle holds the polygon. Corners are right to 1e-15 radians;
/// parts narrower than 1e-14 are left out. Throws NoMesh, naming the feature and two sides, if the rings of a
/// polygon cross.
Faces clipped_to_polygons(const Faces& cells, const std::vector<MapRegion>& polygons);

/// Throws NoMesh, naming the feature and two sides, if sides of the polygon cross or lie on each other.
/// Decided exactly.
void expect_no_crossing(const MapRegion& polygon);

}  // namespace files
