#pragma once
// Meshes of a part of the sphere, cut out of a mesh of the sphere as MPAS-Limited-Area does it:
//
//    7 6 5 4 3 2 1 0 0 0 0     0      cells of the region: their node lies in it, or its boundary passes
//     7 6 5 4 3 2 1 0 0 0 0           through them (or a chain of cells follows it: has_chains)
//    7 6 5 4 3 2 1 0 0 0 0     1..5   relaxation zone: layers of neighbours around them
//     7 6 5 4 3 2 1 0 0 0 0    6, 7   specified zone
//
// The number of a cell is its bdyMaskCell; an edge or a vertex has the least number of its cells. All other
// cells are left out. What stays are whole cells of the mesh of the sphere.

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "files/clipping.h"
#include "files/mesh.h"
#include "files/width_regions.h"

namespace files {

constexpr std::int32_t kLayers = 7;  ///< of cells around the region
constexpr std::int32_t kLeftOut = -1;
constexpr auto kBdyMaskCell = "bdyMaskCell";

struct LimitedArea {
  std::string name;                 ///< in messages
  std::vector<MapRegion> polygons;  ///< they may overlap
  /// The layer 0 of MPAS-Limited-Area, for polygons of arcs: from the cell of each corner to that of the next
  /// a chain of neighbours along the arc, and what these chains enclose.
  bool has_chains = false;

  /// Pairs of increasing longitudes between which the parallel is inside: degrees, of any turn.
  std::vector<std::pair<double, double>> inside(double lat) const;
  bool contains(const Point& p) const;
  /// The closed lines around all polygons: unit vectors, whose arcs are within 2e-7 rad of the line. Some
  /// lead to a pole, or around a whole map, through the area.
  std::vector<std::vector<Point>> boundary() const;
  /// A box of longitudes and latitudes around each polygon.
  std::vector<Region> boxes() const;
};

/// `great_circles`: sides are arcs, and layer 0 is that of MPAS-Limited-Area.
LimitedArea box_area(std::string name, const Region& box, bool great_circles = false);
/// `radius` in radians.
LimitedArea circle_area(std::string name, double lon, double lat, double radius, bool great_circles = false);
/// Those of read_polygons(); of NAME.pts with great circles. Throws std::runtime_error if one crosses itself,
/// or if all angles of GeoJSON may be radians, which `are_degrees` denies: one line with file, feature, place
/// and remedy.
LimitedArea file_area(const std::string& file, double radius, bool are_degrees, bool great_circles);

/// Sets mesh.layers: for each node 0 to 7 as above, else kLeftOut. The triangles should be those of
/// Delaunay. Throws std::runtime_error if no node lies in the area, if the cells of the area are not
/// connected, or if the mesh ends before the last layer: one line with place and remedy.
void set_layers(Mesh& mesh, const LimitedArea& area);

/// The nodes that are not left out, the triangles between them, and a column bdyMaskCell. Throws as
/// mesh_with_boundary().
Mesh cut(const Mesh& mesh);
/// mesh_of(). Throws NoMesh with a remedy if the boundary touches itself.
Mesh mesh_with_boundary(std::vector<Point> points, const pstripack::Triangles& triangles);

}  // namespace files
