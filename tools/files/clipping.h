#pragma once
// Voronoi cells cut at the hull of their nodes or at a region of longitudes and latitudes.

#include "files/mesh.h"

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

}  // namespace files
