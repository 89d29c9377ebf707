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
//            apex              An apex nearer than 0.75 h to a node is no candidate (any more). Candidates
//            come
//           .    .             in the order of their distance to the nearest face centre. The next one is
//           moved to
//      h  .        .  h        where the distances to all nodes around it differ least from h, and becomes a
//      node:
//       .            .         its edges to nodes up to 1.3 h away have new apexes.
//     p ----- h ----- q
//
// So each face gets one crystal; crystals of neighbouring faces have the same orientation and meet along the
// edges of the icosahedron with hardly a fault. The sphere's curvature has to be paid by at least 12 cells of
// 5 sides, and for many generators by chains of 5-7 pairs (dislocations) that begin at these ("scars": Bausch
// et al. 2003, Grain boundary scars and spherical crystallography). The order puts all of that round the 12
// corners, which come last.
//
//     6   6   6   6   6        There come a few more nodes than wanted. A dislocation is the end of a row of
//     nodes
//       6   6   6   6          (the cell of 5 sides): a node is taken from some of these rows, and nothing
//       else
//     6   6   5---7   6        changes. Removing any other node would leave a hole.
//       6   6   6   6

#include <cstddef>
#include <vector>

#include "geometry/point.h"
#include "scvt/density.h"

namespace pstripack::scvt {

/// n distinct unit vectors that lie as the generators of a centroidal tessellation of this density would. In
/// O(n log n), on one thread; random ones for small n, and for densities that vary too much within a cell.
/// Neighbours on the sphere have close numbers. Same bits on every machine, if the density has. Throws
/// BadDensity, std::bad_alloc.
std::vector<Point> front_generators(std::size_t n, const Density& density);

}  // namespace pstripack::scvt
