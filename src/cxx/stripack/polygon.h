#pragma once
// INTRSC, INSIDE: arcs that cross, and points in polygons on the sphere.
// For Real = float, double and Int = int32_t, int64_t. The method: Renka, ACM TOMS 23 (1997), Algorithm 772.

#include "capi/pstripack.h"
#include "stripack/expressions.h"

namespace pstripack {

/// IER of INTRSC. The point is written only if `done`.
enum class IntersectionStatus {
  done = 0,
  parallel = 1,   ///< both ends are equally far from the plane: p1 = p2, a zero normal, or no such point
  antipodal = 2,  ///< the ends are opposite each other
  not_finite = PSTRIPACK_BAD_COORDINATE  ///< NaN or infinity in the arguments
};

/// INTRSC: the point, of length 1, where the great circle through p1 and p2 crosses the great circle with the
/// given normal (of any length). Of the two such points it is the one nearer to the arc from p1 to p2.
template <class Real>
IntersectionStatus intersection(const Vector<Real>& p1, const Vector<Real>& p2, const Vector<Real>& normal,
                                Vector<Real>& point);

/// IER of INSIDE.
enum class PolygonStatus {
  done = 0,
  bad_count = 1,          ///< nv < 3 or nv > lv
  bad_vertex = 2,         ///< an entry of listv outside 1..lv
  self_intersecting = 3,  ///< the crossings contradict each other
  no_reference = 4,       ///< no edge gives a usable point inside: P is zero, or aligned with all such points
  not_finite = PSTRIPACK_BAD_COORDINATE  ///< NaN or infinity in P or in a vertex
};

/// INSIDE: `result` is true if p lies in the region left of the polygon with the vertices listv[0..nv-1],
/// which are indices 1..lv of `vertices`. For a clockwise polygon that region is the outside. `result` is
/// false unless `done`. Within rounding of the boundary either answer is possible.
template <class Real, class Int>
PolygonStatus inside(const Vector<Real>& p, Int lv, const Nodes<Real>& vertices, Int nv, const Int* listv,
                     bool& result);

}  // namespace pstripack
