#pragma once
// TRFIND, NEARND: searches in a triangulation. For
// (Real, Int) = (float, int32_t), (double, int32_t), (double, int64_t).
// They keep no state between calls, allocate nothing and always return.

#include "stripack/adjacency_lists.h"
#include "stripack/expressions.h"

namespace pstripack {

/// Where a point lies. Three nodes: the counterclockwise triangle that contains it. i3 = 0: it is
/// outside; i1 and i2 are the rightmost and leftmost boundary node that it sees, i1 = i2 if it sees
/// them all. All 0: not found: all nodes lie on one great circle, or the point is zero or not finite.
template <class Int>
struct Location {
  Int i1, i2, i3;
};

/// TRFIND: finds point p, starting at node `start` (random if not in 1..n; the seeds are 1, 2, 3 in
/// every call). b1, b2, b3 are written as in TRFIND: for a triangle the weights of the corners, up to
/// scale, none negative; b3 = 0 where p lies on the arc i1-i2.
/// Where the walk, which goes by rounded tests, does not end soon, an exact search of all triangles decides.
template <class Real, class Int>
Location<Int> trfind(Int start, const Vector<Real>& p, const ListsView<Int>& lists, const Nodes<Real>& nodes,
                     Real& b1, Real& b2, Real& b3);

/// NEARND: the node nearest to p among the natural neighbours that TRFIND and at most 22 further
/// insertions give, and in `angle` its distance in radians. `start` as in TRFIND, but 1 if not in 1..n.
/// 0 if n < 3 or p is not found; `angle` is then untouched (float, as Algorithm 772) or 0 (double, as
/// the Fortran 90 text).
template <class Real, class Int>
Int nearnd(const Vector<Real>& p, Int start, const ListsView<Int>& lists, const Nodes<Real>& nodes,
           Real& angle);

}  // namespace pstripack
