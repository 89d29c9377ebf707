#pragma once
// Triangulations and Voronoi diagrams for the writers. Nodes, triangles and slots count from 1.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

#include "files/measures.h"
#include "files/nodes.h"
#include "lists/adjacency_lists.h"
#include "trmesh/trmesh.h"

namespace files {

/// Where the rows of a table that are here are among those of all processes, which write it one after the
/// other.
struct Share {
  std::size_t before = 0;  ///< rows of the processes before
  std::size_t all = 0;     ///< of all processes; 0: there is only this one

  std::size_t total(std::size_t here) const { return all == 0 ? here : all; }
};

/// Nodes and the canonical lists of their triangulation.
struct Mesh {
  std::vector<Point> points;    ///< as given
  LonLat given;                 ///< their longitudes and latitudes, if they were given
  std::vector<double> density;  ///< of each node; empty: unknown
  Columns columns;              ///< values of each node
  Notes notes;
  std::vector<std::int32_t> list, lptr, lend;
  std::int32_t lnew = 0;

  std::size_t triangles() const;
  bool has_boundary() const;  ///< a hemisphere holds all nodes
  pstripack::ListsView<std::int32_t> lists() const {
    return {points.size(), list.data(), lptr.data(), lend.data(), lnew};
  }
};

/// Why nodes have no triangulation; nodes from 0.
struct NoMesh : std::runtime_error {
  using runtime_error::runtime_error;
};
struct CoincidentNodes : NoMesh {
  CoincidentNodes(std::size_t f, std::size_t s) : NoMesh("two nodes coincide"), first(f), second(s) {}
  std::size_t first, second;
};

/// What `triangulate` calls. It is TRMESH of this process (trmesh/trmesh.h), unless a program puts that of
/// many processes in its place.
using Trmesh = std::function<pstripack::TrmeshResult(const pstripack::TrmeshCall&)>;
void set_trmesh(Trmesh trmesh);

/// The Delaunay triangulation of at least three nodes that all have a direction. Throws NoMesh if all of them
/// lie on one great circle, two coincide, or there are too many.
Mesh triangulate(std::vector<Point> points);

/// Whether all nodes are within 1e-14 radians of one great circle: rounding of their coordinates decides
/// which triangles and cells they have.
bool are_on_one_great_circle_up_to_rounding(const std::vector<Point>& points);

/// A node, and the first one in its direction.
struct Duplicate {
  std::size_t node, first;
};

/// All but the first of the nodes in each direction, in increasing order. Throws as triangulate.
std::vector<Duplicate> duplicates(const std::vector<Point>& points);

/// The mesh of these triangles (counterclockwise, from 0). Throws NoMesh unless every node is a corner and
/// the triangles around each node form one cycle or one fan.
Mesh mesh_of(std::vector<Point> points, const pstripack::Triangles& triangles);

/// Three corners per triangle, counterclockwise, the smallest first.
std::vector<std::int32_t> triangles_of(const Mesh& mesh);

std::vector<Point> unit(const std::vector<Point>& points);

/// The centre of the circumscribed cap of each triangle.
std::vector<Point> circumcentres(const std::vector<Point>& unit_points,
                                 const std::vector<std::int32_t>& triangles);

/// Polygons on the unit sphere: face f has the corners corner[begin[f]] ... corner[begin[f+1]-1],
/// counterclockwise.
struct Faces {
  std::vector<Point> points;
  std::vector<Point> centres;      ///< the node that each face belongs to; empty: none
  std::vector<std::size_t> nodes;  ///< its index; empty: that of the face
  std::vector<std::size_t> begin;
  std::vector<std::int32_t> corner;
  LonLat given_points, given_centres;  ///< their angles, if they were given
  Columns columns_of_points, columns_of_faces;
  Share share_of_points, share_of_faces;

  std::size_t size() const { return begin.size() - 1; }
  std::size_t node_of(std::size_t f) const { return nodes.empty() ? f : nodes[f]; }
  std::size_t corners(std::size_t f) const { return begin[f + 1] - begin[f]; }
  std::size_t most_corners() const;
};

/// The direction of the sum of each face's corners.
std::vector<Point> centroids(const Faces& faces);

/// In steradians.
std::vector<double> areas(const Faces& faces);

/// The triangles as faces.
Faces triangle_faces(const Mesh& mesh);

/// The Voronoi diagram: one face per node. If the nodes lie in a hemisphere, the cells of boundary nodes
/// share the rest of the sphere (STRIPACK's CRLIST).
Faces voronoi_faces(const Mesh& mesh);

/// Adds what files of faces can hold: the given angles and columns of the nodes, the number of neighbours of
/// each, and the areas of the faces in sr and km2. Columns that are named like these get `_given` behind
/// their names.
void add_columns(Faces& faces, const Mesh& mesh);

/// What a process has of a mesh that covers the sphere: some nodes in a row, and the triangles of which such
/// a node is the smallest corner. Parts one after the other are the mesh.
struct MeshPart {
  Share share_of_nodes, share_of_triangles;
  std::size_t nodes = 0;              ///< here
  std::vector<Point> points;          ///< the nodes here, then their neighbours elsewhere; unit vectors
  std::vector<std::int32_t> numbers;  ///< of the points in the whole mesh
  std::vector<std::int32_t> corner;   ///< three for each triangle, the smallest number first: places in
                                      ///< points, from 1
  std::vector<double> degrees;        ///< of the nodes here: number of neighbours
  std::vector<double> density;        ///< of the nodes here
  Columns columns;                    ///< of the nodes here
  Notes notes;

  std::vector<Point> nodes_here() const {
    return {points.begin(), points.begin() + static_cast<std::ptrdiff_t>(nodes)};
  }
  /// The corners as nodes of the whole mesh.
  std::vector<std::int32_t> corners_by_number() const;
};

/// Its triangles as faces, whose points are those here; with the columns that files of faces can hold.
Faces triangle_faces(const MeshPart& part);

}  // namespace files
