#pragma once
// Triangulations and Voronoi diagrams for the writers. Node, triangle and slot numbers begin with 1.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

#include "files/measures.h"
#include "files/nodes.h"
#include "geometry/predicates.h"
#include "lists/adjacency_lists.h"
#include "stripack/list_queries.h"
#include "trmesh/trmesh.h"

namespace files {

/// What the caller chooses of a format.
struct Variant {
  bool edges = false;      ///< UGRID: also the edges
  bool clockwise = false;  ///< GeoJSON: rings turn clockwise
};

/// Nodes and the canonical lists of their triangulation.
struct Mesh : NodeValues {
  std::vector<Point> points;  ///< as given
  Variant variant = {};
  double longest = 0;  ///< radians: triangles with a longer side are no faces; 0: all are
  std::vector<std::int32_t> list, lptr, lend;
  std::int32_t lnew = 0;

  std::size_t triangles() const;
  bool has_boundary() const;  ///< true if one hemisphere holds all nodes
  pstripack::ListsView<std::int32_t> lists() const {
    return {points.size(), list.data(), lptr.data(), lend.data(), lnew};
  }
};

/// The nodes have no triangulation. Node numbers in `what()` begin with 1, indices in members with 0.
struct NoMesh : std::runtime_error {
  using runtime_error::runtime_error;
};
struct CoincidentNodes : NoMesh {
  CoincidentNodes(std::size_t f, std::size_t s) : NoMesh("two nodes coincide"), first(f), second(s) {}
  std::size_t first, second;
};

/// The function that `triangulate` calls: TRMESH of this process (trmesh/trmesh.h), or, under mpirun, of all
/// ranks.
using Trmesh = std::function<pstripack::TrmeshResult(const pstripack::TrmeshCall&)>;
void set_trmesh(Trmesh trmesh);

/// Calls visit(neighbour) for the neighbours of a node; indices from 0.
template <class Visit>
void for_each_neighbour(const pstripack::ListReader<std::int32_t>& reader, std::size_t node,
                        const Visit& visit) {
  reader.for_each_neighbour(static_cast<std::int32_t>(node) + 1,
                            [&](std::int32_t neighbour) { visit(static_cast<std::size_t>(neighbour) - 1); });
}

/// The Delaunay triangulation of at least three nodes, none of them a zero vector. Throws NoMesh if they lie
/// on one great circle, if two coincide, or if there are too many.
Mesh triangulate(std::vector<Point> points);

/// A node, and the node with the smallest number in the same direction.
struct Duplicate {
  std::size_t node, first;
};

/// All nodes but the first of each direction, in increasing order. Throws as triangulate does.
std::vector<Duplicate> duplicates(const std::vector<Point>& points);

/// The mesh of these triangles, which are counterclockwise with corners from 0. Throws NoMesh unless every
/// node is a corner and the triangles around each node form one cycle or one fan.
Mesh mesh_of(std::vector<Point> points, const pstripack::Triangles& triangles);

/// Three corners per triangle, counterclockwise, the smallest first.
std::vector<std::int32_t> triangles_of(const Mesh& mesh);

/// Those without a side longer than mesh.longest.
std::vector<std::int32_t> triangles_to_write(const Mesh& mesh);

std::vector<Point> unit(const std::vector<Point>& points);

/// The circumcentres of the triangles of the directions of the points.
std::vector<Point> circumcentres(const std::vector<Point>& points,
                                 const std::vector<std::int32_t>& triangles);

/// Polygons on the unit sphere: face f has the corners corner[begin[f]] ... corner[begin[f+1]-1],
/// counterclockwise.
struct Faces {
  std::vector<Point> points;
  std::vector<Point> centres;      ///< the node that each face belongs to; empty: none
  std::vector<std::size_t> nodes;  ///< its index; empty: face f belongs to node f
  std::vector<std::size_t> begin;
  std::vector<std::int32_t> corner;
  std::vector<double>
      area;  ///< of triangles and whole cells, in steradians, from their nodes; NaN: not known
  LonLat given_points, given_centres;  ///< their longitudes and latitudes, if the input had them
  Columns columns_of_points, columns_of_faces;
  Columns columns_of_parts;  ///< of faces cut at polygons: add_columns() makes them columns of the faces
  Variant variant = {};

  std::size_t size() const { return begin.size() - 1; }
  std::size_t node_of(std::size_t f) const { return nodes.empty() ? f : nodes[f]; }
  std::size_t corners(std::size_t f) const { return begin[f + 1] - begin[f]; }
  std::size_t most_corners() const;
  /// The point with this number, and that of corner[k].
  const Point& numbered(std::int32_t point) const { return points[static_cast<std::size_t>(point) - 1]; }
  const Point& point(std::size_t k) const { return numbered(corner[k]); }
  /// The place in `corner`, behind k, of the next corner of face f.
  std::size_t after(std::size_t f, std::size_t k) const { return k + 1 < begin[f + 1] ? k + 1 : begin[f]; }
  /// Calls visit(f, k) for all faces f and their places k in `corner`.
  template <class Visit>
  void for_each_corner(const Visit& visit) const {
    for (std::size_t f = 0; f < size(); ++f)
      for (std::size_t k = begin[f]; k < begin[f + 1]; ++k) visit(f, k);
  }
};

/// The edges of faces, in increasing order of their nodes. All numbers begin with 1.
struct Edges {
  std::vector<std::int32_t> nodes;     ///< two for each edge, the smaller first
  std::vector<std::int32_t> faces;     ///< two for each edge, on its left and on its right; -1: none
  std::vector<std::int32_t> of_faces;  ///< for each corner of a face the edge to the next corner
};
Edges edges_of(const Faces& faces);

/// The Voronoi cells, without their nodes. If the nodes lie in a hemisphere, the corners on the far side are
/// the first or the last of each cell. `cosine`: of the least angle of sides that are divided, since sides of
/// half a turn do not determine a great circle; below -1: none are.
Faces voronoi_cells(const pstripack::ListsView<std::int32_t>& lists, const pstripack::Directions& nodes,
                    bool far_side_first, double cosine = -1 + 1e-12);

/// The centroid of each face: the direction of the integral of p over it. Right to 1e-15 rad for each unit of
/// the face's length over its width; to 1e-10 where a side is
/// nearly half a turn.
std::vector<Point> centroids(const Faces& faces);

/// The areas of the faces in steradians; from their corners, where faces.area does not know them.
std::vector<double> areas(const Faces& faces);

/// The triangles without a side longer than mesh.longest as faces.
Faces triangle_faces(const Mesh& mesh);

/// The numbers of the corners of the nodes' convex hull, counterclockwise, of a mesh with a boundary.
std::vector<std::int32_t> hull_of(const Mesh& mesh);

/// The Voronoi diagram: one face per node; sides of half a turn have a corner in their middle. If the nodes
/// lie in a hemisphere, the cells of the boundary nodes share the rest of the sphere, as in STRIPACK's
/// CRLIST. Throws NoMesh if the areas of the cells are not certain to make up the sphere. A table of their
/// areas needs no corners.
Faces voronoi_faces(const Mesh& mesh, bool with_corners = true);

/// Adds the columns that files of faces can hold: the nodes' own columns and given angles, their numbers of
/// neighbours, the areas of the faces in sr and km2, and the circumradii of triangles or the centroids of
/// cells. Own columns with one of these names get `_given` appended.
void add_columns(Faces& faces, const Mesh& mesh);

}  // namespace files
