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
  std::int64_t moved = 0;   ///< generators
  std::int64_t obtuse = 0;  ///< triangles left that do not hold their circumcentre strictly
  std::int64_t bad = 0;     ///< triangles left with an angle out of bounds: these, and others
  Point place{0, 0, 0};  ///< the generator with the smallest number at an obtuse triangle, else at a bad one
};

constexpr double kLeastAngle = 43.5, kMostAngle = 78.5;  ///< degrees

/// Moves the corners of triangles with angles outside 44.5 to 77.5 degrees until all are within these bounds.
/// So an edge of a cell is longer than a fifth of its arc: (cot 78.5 + cot 78.5)/2. Where that cannot be, as
/// around four neighbours, it ends with the fewest triangles seen that do not hold their circumcentre, then
/// the fewest with an angle out of bounds. The former are counted exactly, if their sides are longer than
/// 1e-14 rad.
///
/// Each pass triangulates and moves all these corners at once, each by what it sees of its own star: so the
/// result has the same bits for any number of threads and ranks. Collective. Throws what
/// Evaluator::triangulate throws.
Repair make_well_centred(Evaluator& evaluator, std::vector<Point>& generators);

}  // namespace pstripack::scvt
