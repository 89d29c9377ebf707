#pragma once
// First generators from an advancing front. They are nearly a centroidal tessellation already, and what is
// more, one with few defects: a quasi-Newton method finds the nearest minimum of the energy, so the hexagons
// that it ends with are those that it began with. (Rebay 1993, Efficient unstructured mesh generation by
// means of Delaunay triangulation and Bowyer-Watson algorithm; Engwirda and Ivers 2016, Off-centre Steiner
// points for Delaunay-refinement on curved surfaces.)
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
// So each face gets one crystal; crystals of neighbouring faces have the same orientation and meet along the
// edges of the icosahedron with hardly a fault. On a sphere at least 12 cells have 5 sides, and for many
// generators chains of 5-7 pairs (dislocations) begin at these ("scars": Bausch et al. 2003, Grain boundary
// scars and spherical crystallography). The order puts them round the 12 corners, which come last. Where the
// density has a small fine place that the front jumped over, another front begins.
//
// How many nodes a front has is known within a percent beforehand, so it gets about sqrt(n) too many:
//
//     6   6   6   6   6        A row of nodes ends at a dislocation, in the cell of
//       6   6   6   6          5 sides. That node is taken away from some rows: the
//     6   6   5---7   6        row gets shorter, and there is no new defect. Any other
//       6   6   6   6          node would leave a hole.

#include <cstddef>
#include <vector>

#include "geometry/point.h"
#include "scvt/density.h"

namespace pstripack::scvt {

/// That a front puts in better order than levels do.
constexpr std::size_t kFewestOfAFront = 3000;

/// n distinct unit vectors that lie as the generators of a centroidal tessellation of this density would. In
/// O(n log n), on one thread; random ones for small n, and for densities that vary too much within a cell.
/// Neighbours on the sphere have close numbers. Same bits on every machine, if the density has. Throws
/// BadDensity, std::bad_alloc.
std::vector<Point> front_generators(std::size_t n, const Density& density);

}  // namespace pstripack::scvt
