#pragma once
// Voronoi cells cut at the hull of their nodes or at a region of longitudes and latitudes.

#include "files/mesh.h"

namespace files {

/// Degrees; west < east <= west + 360, south < north.
struct Region {
  double west = -180, east = 180, south = -90, north = 90;
};

/// A cell of nodes on one circle is a lune: two sides, each a half turn, whose ends do not tell where they
/// are. They get corners in their middles.
void divide_half_turns(Faces& cells, const Mesh& mesh);

/// What lies in the convex hull of the nodes, which is the sphere unless a hemisphere holds them all.
Faces clipped_to_hull(const Faces& cells, const Mesh& mesh);

/// What lies in the region: no piece, one or several of each cell. Parallels become arcs of great circles
/// within 0.0001 degrees. Throws NoMesh if a side is a half turn.
Faces clipped_to_region(const Faces& cells, const Region& region);

}  // namespace files
