#pragma once
// Triangles and Voronoi cells as polygons and lines of a map.

#include <cstdint>
#include <vector>

#include "files/mesh.h"
#include "files/width_regions.h"
#include "triangulation.h"

namespace bindings {

/// The triangles, or the Voronoi cells.
files::Faces faces_of(const Triangulation& mesh, bool cells);

/// Polygons or lines: number k has the corners x, y in xy[2*begin[k]] ... xy[2*begin[k+1]-1].
struct Outlines {
  Buffer<double> xy;
  Buffer<std::int32_t> begin;
  Buffer<std::int32_t> face;  ///< the triangle or node that it belongs to
};

/// A part of a map: up to `radius` degrees around a place.
struct Window {
  bool orthographic;  ///< x to the right, y upwards, in radii of the sphere; else longitudes and latitudes
  double lon, lat, radius;
};

// Sides that are a half turn, which their ends do not determine, raise NoTriangulation.

/// Polygons of longitudes and latitudes in degrees, cut at the dateline and closed along a pole (MapLines of
/// files/map_rings.h). A face narrower than rounding has none.
Outlines map_polygons(const Triangulation& mesh, bool cells);

struct CutCells {
  Outlines outlines;    ///< as above, of the parts inside
  Buffer<double> area;  ///< of what is inside of each cell, in steradians
};
/// The parts of Voronoi cells in polygons that do not overlap. Throws files::NoMesh as clipped_to_polygons()
/// of files/clipping.h.
CutCells cut_cells(const Triangulation& mesh, const std::vector<files::MapRegion>& polygons);

/// The visible parts of the faces, and of their sides, each once; arcs are curved.
Outlines polygons_in(const Window& window, const Triangulation& mesh, bool cells);
Outlines lines_in(const Window& window, const Triangulation& mesh, bool cells);

}  // namespace bindings
