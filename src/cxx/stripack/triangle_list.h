#pragma once
// TRLIST, TRLIST2, BNODES: triangles and boundary of a triangulation. For Int = int32_t, int64_t.

#include "lists/adjacency_lists.h"

namespace pstripack {

/// IER of TRLIST, TRLIST2. The number of triangles is 0 unless it is `done`.
enum class TriangleListStatus {
  done = 0,
  bad_argument = 1,  ///< n < 3, or NROW neither 6 nor 9; LTRI untouched
  broken_lists = 2   ///< a neighbour does not list the node, or lists it between others, or lists are not
                     ///< closed; columns may be written
};

/// TRLIST: column t (t = 1..nt) of LTRI(rows, nt):
///   rows 1-3  the corners, counterclockwise, smallest first;
///   rows 4-6  the triangle opposite the corner in row 1-3, 0 = none;
///   rows 7-9  (rows = 9) the arc opposite the corner, arcs numbered from 1.
/// Triangles are numbered by their smallest corner, then in the order of the list of that node; an arc is
/// numbered with the later of its triangles. `rows` = 3 is TRLIST2. O(n), on threads for large n; the
/// result has the same bytes for any number of threads. Takes 79 bytes per node during the call, 52 more if
/// the lists are not canonical (Int = int32_t). Throws std::bad_alloc before anything is written.
template <class Int>
TriangleListStatus triangle_list(const ListsView<Int>& lists, int rows, Int& nt, Int* ltri);

template <class Int>
struct BoundaryCounts {
  Int boundary_nodes, arcs, triangles;
};

/// BNODES: writes the boundary nodes, at most n, counterclockwise, starting with the smallest number.
/// `nodes` is untouched if the triangles cover the sphere.
template <class Int>
BoundaryCounts<Int> boundary_nodes(const ListsView<Int>& lists, Int* nodes);

}  // namespace pstripack
