#pragma once
// First generators from an advancing front. They are nearly a centroidal tessellation already, and one with
// few defects. That matters because a quasi-Newton method finds the nearest minimum of the energy, so the
// hexagons that it ends with are those that it began with. (Rebay 1993, Efficient unstructured mesh
// generation by means of Delaunay triangulation and Bowyer-Watson algorithm; Engwirda and Ivers 2016,
// Off-centre Steiner points for Delaunay-refinement on curved surfaces.)
//
// The size h(p) = s density(p)^(-1/4) is the wanted distance of neighbours. The front begins with an edge at
// each of the 20 face centres of an icosahedron and grows by apexes of equilateral triangles on edges:
//
//            apex              An apex nearer than 0.75 h to a node is dropped.
//           .    .             The apex nearest to a face centre comes next: it is
//      h  .        .  h        moved to where the distances to the nodes around it
//       .            .         differ least from h, and becomes a node. Its edges to
//     p ----- h ----- q        nodes up to 1.3 h away have new apexes.
//
// So each face is filled with one lattice. The lattices of neighbouring faces have the same orientation and
// meet along the edges of the icosahedron with few faults. On a sphere at least 12 cells have 5 sides, and
// for many generators chains of 5-7 pairs (dislocations) begin at these ("scars": Bausch et al. 2003, Grain
// boundary scars and spherical crystallography). The order of insertion puts them around the 12 corners,
// which come last. If the front has jumped over a small region of high density, another front begins there.
//
// The number of nodes of a front is known beforehand within one percent only. So the front is given about
// sqrt(n) too many, and some are removed:
//
//     6   6   6   6   6        A row of nodes ends at a dislocation, in the cell with
//       6   6   6   6          5 sides. Removing that node shortens the row and makes no
//     6   6   5---7   6        new defect. Removing any other node would leave a hole.
//       6   6   6   6

#include <cstddef>
#include <vector>

#include "geometry/point.h"
#include "scvt/density.h"

namespace pstripack::scvt {

/// From this number of generators on a front has fewer defects than refined levels.
constexpr std::size_t kFewestOfAFront = 3000;

/// n distinct unit vectors, arranged nearly as the generators of a centroidal tessellation of this density.
/// For n < 1000, and for densities that vary too much within a cell, they are random_generators(). O(n log
/// n), on one thread. Neighbours on the sphere have close numbers. The result has the same bits on every
/// machine if the density has. Throws BadDensity, std::bad_alloc.
std::vector<Point> front_generators(std::size_t n, const Density& density);

}  // namespace pstripack::scvt
