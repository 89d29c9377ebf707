#pragma once
// CRLIST, CIRCUM: the Voronoi diagram of a triangulation. For
// (Real, Int) = (float, int32_t), (double, int32_t), (double, int64_t).

#include <cstdint>
#include <stdexcept>
#include <string>

#include "capi/pstripack.h"
#include "geometry/predicates.h"
#include "lists/adjacency_lists.h"
#include "stripack/expressions.h"

namespace pstripack {

/// CIRCUM: the circumcentre of triangle a, b, c on the sphere, on the side from which a, b, c is
/// counterclockwise. False, with `centre` untouched, if two corners coincide.
template <class Real>
bool circumcentre(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c, Vector<Real>& centre);

/// IER of CRLIST.
enum class VoronoiStatus {
  done = 0,
  too_few_nodes = 1,     ///< n < 3; nb = 0, nothing else is written
  too_few_columns = 2,   ///< NCOL < nb - 2; nb and the first NCOL columns of LTRI are written
  coincident_nodes = 3,  ///< a triangle without circumcentre; its centre and radius are not written
  not_finite = PSTRIPACK_BAD_COORDINATE,  ///< a coordinate is NaN or infinite; LPTR, LNEW unchanged
  broken_lists = PSTRIPACK_BAD_LISTS      ///< not the lists of a triangulation (the original does not check);
                                          ///< LPTR, LNEW unchanged
};

/// CRLIST's arrays, with their lengths in brackets.
template <class Real, class Int>
struct VoronoiArrays {
  Int ncol;                 ///< columns in ltri
  Int* lptr;                ///< [6n-12] changed if there is a boundary
  Int* lnew;                ///< changed if there is a boundary
  Int* ltri;                ///< [6*ncol] the triangles that close the sphere; untouched if nb = 0
  Int* listc;               ///< [6n-12] the triangle left of the arc in each slot
  Int* nb;                  ///< number of boundary nodes
  Real *xc, *yc, *zc, *rc;  ///< [2n-4] circumcentres and radii (radians) of the triangles
};

/// CRLIST: circumcentres and radii of all triangles and, by slots of LIST, their order around each node. If
/// the nodes lie in a hemisphere, nb-2 triangles of boundary nodes close the sphere on the far side; they
/// come first, and the slots of their arcs are added to LPTR. O(n) plus the swaps among these triangles, on
/// threads for large n; the result has the same bytes for any number of threads. Always returns: if rounded
/// swap tests of cocircular boundary nodes would cycle, exact ones take over. Takes up to 92 bytes per node
/// during the call (Real = double, Int = int32_t), 76 more if the lists are not canonical. Throws
/// std::bad_alloc before anything is written.
template <class Real, class Int>
VoronoiStatus voronoi(const ListsView<Int>& lists, const Nodes<Real>& nodes,
                      const VoronoiArrays<Real, Int>& out);
/// The same for directions: exact tests decide the far side, and centres have the accuracy of
/// geometry/measures.h. RC is not written.
VoronoiStatus voronoi_of_directions(const ListsView<std::int32_t>& lists, const Directions& nodes,
                                    const VoronoiArrays<double, std::int32_t>& out);

/// Two nodes, numbers from 1, so close that a double cannot hold the area of their cells: 2^-510 rad or less.
struct NodesTooClose : std::invalid_argument {
  NodesTooClose(std::int32_t a, std::int32_t b)
      : std::invalid_argument(
            "nodes " + std::to_string(a) + " and " + std::to_string(b) +
            ", counted from 1, are less than 3e-154 rad apart: a double cannot hold the areas of "
            "their cells; leave one of them out"),
        first(a),
        second(b) {}
  std::int32_t first, second;
};

/// area[n]: the areas of the Voronoi cells of the nodes, in steradians, right relative to themselves
/// (geometry/measures.h). If the nodes lie in a hemisphere, the cells of boundary nodes share the rest of the
/// sphere. False if these are not the lists of a triangulation of the nodes. On threads for large n. Throws
/// NodesTooClose, std::bad_alloc.
bool cell_areas(const ListsView<std::int32_t>& lists, const Directions& nodes, double* area);

}  // namespace pstripack
