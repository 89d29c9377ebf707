#pragma once
// The mesh of MPAS: cells, the edges between them and the vertices where three cells meet; who touches whom,
// and the lengths, areas and weights with which models compute (TRiSK: Thuburn, Ringler, Skamarock and Klemp,
// J. Comput. Phys. 228, 2009; Ringler, Thuburn, Klemp and Skamarock, J. Comput. Phys. 229, 2010).
//
//              |             c, d   cells: nodes of the triangles, c < d
//          ___ w             v, w   vertices: circumcentres of the triangles
//         /    |             e      the edge from v to w, and its point, the middle of the arc c-d
//        |     |             n      normal of e, from its cell 1, which is c, to its cell 2
//        |  c  e --> n  d    t      tangent of e, from its vertex 1, which is v, to its vertex 2: t = k x n,
//        |     |                    k upwards
//         \_g_ v             g      the edge of c before v
//              |             kite   of v in c: the quadrangle v, e, c, g, signed: the triangles v, e, c and
//                                   v, c, g are counterclockwise where that of the nodes is acute
//
// Around each cell and each vertex all is counterclockwise, and begins with the edge of smallest number:
//
//    cell c   edges    e_0     e_1     e_2   ...     the cell across e_j is the j-th neighbour,
//             vertices     v_0     v_1     v_2 ...   v_j is shared by e_j and e_j+1
//    vertex v edges    e_0     e_1     e_2
//             cells        c_0     c_1     c_2       c_j lies between e_j and e_j+1
//
// A mesh may have a boundary, where cells were cut away. What is left are whole cells; -1 stands for a
// missing cell or edge. A vertex at the boundary begins with the first of its cells, so that -1 comes last.
// An edge at the boundary is what it was before: its cell 2 is the mirror image of cell 1 at the edge.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "files/mesh.h"
#include "geometry/measures.h"

namespace files {

/// Indices begin with 0.
struct MpasMesh {
  using Index = std::int32_t;
  using Two = std::array<Index, 2>;
  using Three = std::array<Index, 3>;
  static constexpr Index kNone = -1;

  std::vector<Point> cells, vertices;  ///< unit vectors
  std::vector<Three> cells_on_vertex, edges_on_vertex;
  std::vector<Two> cells_on_edge, vertices_on_edge;

  /// Tables of all cells, one after another: the rows [begin[c], begin[c+1]) belong to cell c, one for each
  /// of its edges. Other tables have a row for each cell or edge.
  std::vector<Index> begin;
  std::vector<Index> edges_on_cell, vertices_on_cell;
  std::vector<double> shares;     ///< of the cell: area of the kite of the vertex over that of the cell
  std::vector<double> outflows;   ///< length of the edge, dvEdge; negative if n points into the cell
  std::vector<double> areas;      ///< of the cells
  std::vector<double> distances;  ///< of each edge: from cell to cell, dcEdge
  std::vector<double> widths;     ///< of each edge: from vertex to vertex, dvEdge
  /// Of each vertex: those that its triangle shares with its cells, 0 if there is no cell.
  std::vector<std::array<double, 3>> kites;

  std::size_t sides(std::size_t cell) const {
    return static_cast<std::size_t>(begin[cell + 1] - begin[cell]);
  }
  std::size_t most_sides() const;
  /// The row of the j-th edge of a cell. j may be up to twice the number of sides.
  std::size_t row(std::size_t cell, std::size_t j) const {
    const std::size_t n = sides(cell);
    return static_cast<std::size_t>(begin[cell]) + (j < n ? j : j - n);
  }
  /// The place of an edge among those of its cell.
  std::size_t place(std::size_t edge, std::size_t cell) const {
    std::size_t j = 0;
    while (edges_on_cell[row(cell, j)] != static_cast<Index>(edge)) ++j;
    return j;
  }
  /// The other cell of an edge of the cell.
  Index across(Index edge, std::size_t cell) const {
    const Two& both = cells_on_edge[static_cast<std::size_t>(edge)];
    return both[0] == static_cast<Index>(cell) ? both[1] : both[0];
  }
  bool is_at_boundary(std::size_t vertex) const { return cells_on_vertex[vertex][2] == kNone; }

  Point edge_point(std::size_t edge) const;
  /// The angle of n, from east towards north, at the edge's point.
  double angle(std::size_t edge, const Point& e) const;
  double triangle_area(std::size_t vertex) const;
  pstripack::Angles angles(std::size_t vertex) const;  ///< of the triangle, which must be whole

  /// The edges whose normal velocities give the tangential one of an edge: those of cell 1 counterclockwise
  /// from the edge on, then those of cell 2. Calls take(e', weight).
  template <class Take>
  void for_each_around(std::size_t edge, const Take& take) const {
    for (std::size_t side = 0; side < 2; ++side) {
      if (cells_on_edge[edge][side] == kNone) continue;
      const auto cell = static_cast<std::size_t>(cells_on_edge[edge][side]);
      const std::size_t j = place(edge, cell);
      double rest =
          side == 0 ? 0.5 : -0.5;  // 1/2 - share of the vertices passed, and the sign of n at the edge
      for (std::size_t k = 1; k < sides(cell); ++k) {
        const double share = shares[row(cell, j + k - 1)];
        rest -= side == 0 ? share : -share;
        take(edges_on_cell[row(cell, j + k)], rest * outflows[row(cell, j + k)] / distances[edge]);
      }
    }
  }
};

/// The mesh of these cells and vertices. `cells_on_vertex`: counterclockwise, kNone at the boundary. Edges
/// are numbered as MPAS' converter numbers them. Throws NoMesh unless the vertices of each cell are one
/// cycle.
MpasMesh mpas_mesh(std::vector<Point> cells, std::vector<Point> vertices,
                   std::vector<MpasMesh::Three> cells_on_vertex);

/// That of a triangulation. Nodes at its boundary have no whole cell: they are left out, and so are those
/// outside a limited area. `kept`: the nodes that are cells, if some are left out; else empty.
MpasMesh mpas_mesh(const Mesh& mesh, std::vector<std::size_t>& kept);

}  // namespace files
