#pragma once
// Triangles that hold their circumcentre strictly: those with angles below 90 degrees. In a mesh of such
// triangles each edge of a cell crosses the arc between its two generators, as models on the C grid need.
//
// A centroidal tessellation has some 1e-4 other triangles: where the width of cells changes, next to pairs of
// cells with 5 and 7 sides. They need no other mesh, only small moves of their corners.

#include <cstdint>
#include <vector>

#include "geometry/point.h"
#include "scvt/evaluator.h"

namespace pstripack::scvt {

struct Repair {
  std::int64_t moved = 0;    ///< generators
  std::int64_t obtuse = 0;   ///< triangles left that do not hold their circumcentre strictly; exact
  double largest_angle = 0;  ///< of a triangle, in radians
  Point place{0, 0, 0};  ///< if triangles are left: a corner of one, the generator with the smallest number
};

/// Moves the corners of triangles with an angle above 83 degrees until all angles are below 84 degrees, or,
/// where that takes too long, until all triangles hold their circumcentre. So an edge of a cell is longer
/// than a tenth of its arc: (cot 84 + cot 84)/2. It ends without that after some time; four generators around
/// one, for example, cannot have it.
///
/// Each pass triangulates and moves all these corners at once, each by what it sees of its own star: so the
/// result has the same bits for any number of threads and ranks. Collective. Throws what
/// Evaluator::triangulate throws.
Repair make_well_centred(Evaluator& evaluator, std::vector<Point>& generators);

}  // namespace pstripack::scvt
