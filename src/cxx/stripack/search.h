#pragma once
// TRFIND, NEARND, GETNP: searches in a triangulation, for (Real, Int) = (float, int32_t), (double, int32_t),
// (double, int64_t). They always return and do not change the triangulation.

#include "capi/pstripack.h"
#include "lists/adjacency_lists.h"
#include "stripack/expressions.h"
#include "stripack/list_edit.h"

namespace pstripack {

/// Location of a point. i3 > 0: i1, i2, i3 is the counterclockwise triangle that contains the point. i3 =
/// 0: the point is outside; i1 and i2 are the rightmost and the leftmost boundary node visible from it, and
/// i1 = i2 if all are visible. All 0: not found, because all nodes lie on one great circle, or the point is
/// zero or not finite.
template <class Int>
struct Location {
  Int i1, i2, i3;
};

/// TRFIND: finds point p, starting at node `start` (a random node if not in 1..n). If p lies in a triangle,
/// b1, b2, b3 are the weights of its corners: non-negative, up to a common factor, b3 = 0 if p lies on the
/// arc i1-i2. By the original's formula where its error is below 2^-20 of the largest, and under
/// original_rules(); else by differences.
///
/// The walk of Renka, ACM TOMS 23 (1997), Algorithm 772, by rounded tests. If it fails it restarts at a
/// random node. The random seeds are 1, 2, 3 in every call, so that there is no state; under original rules
/// they are the thread's seeds_of_thread. If restarts do not succeed soon, a walk by exact signs decides.
/// O(sqrt n) steps in a Delaunay triangulation of evenly spread nodes. Allocates nothing.
template <class Real, class Int>
Location<Int> trfind(Int start, const Vector<Real>& p, const ListsView<Int>& lists, const Nodes<Real>& nodes,
                     Real& b1, Real& b2, Real& b3);

/// The same for unchecked lists of `count` nodes: throws BrokenLists if they are invalid.
template <class Real, class Int>
Location<Int> trfind_in_edited(Int start, const Vector<Real>& p, const EditedLists<Int>& lists, Int count,
                               const Nodes<Real>& nodes);

/// NEARND: the node nearest to p among those that TRFIND finds and at most 22 further natural neighbours of
/// p; `angle` is its distance in radians. `start` as in TRFIND, but 1 if not in 1..n. Returns 0 if n < 3 or
/// p is not found; `angle` is then untouched (float, as in Algorithm 772) or 0 (double, as in the Fortran
/// 90 text, unless original_rules() leave it untouched). Allocates nothing.
template <class Real, class Int>
Int nearnd(const Vector<Real>& p, Int start, const ListsView<Int>& lists, const Nodes<Real>& nodes,
           Real& angle);

/// IER of GETNP. Nothing is written unless `done`.
enum class NextNearestStatus {
  done = 0,
  too_short = 1,                          ///< l < 2
  not_finite = PSTRIPACK_BAD_COORDINATE,  ///< a distance is NaN or infinite
  bad_nodes = PSTRIPACK_BAD_NUMBER,       ///< npts[0..l-2] holds a number below 1, or the same one twice
  broken_lists = PSTRIPACK_BAD_LISTS,     ///< a list runs into a loop; other defects are not checked
  none_left = PSTRIPACK_NONE_LEFT  ///< all neighbours are in npts: l > n, or vectors far from unit length
};

/// GETNP: given node npts[0] and the l-2 nodes nearest to it, writes the next nearest node into npts[l-1] and
/// -cos of its distance into `distance`. It searches the neighbours of the given nodes, which is correct in a
/// Delaunay triangulation; among equally near nodes it takes the first. O(l). The method: Renka, ACM TOMS 23
/// (1997), Algorithm 772. The routine is not told N (lists.n is not used), so it cannot detect a node number
/// above N.
///
/// The original marks nodes by the signs of LEND. Here LEND is only read, so threads may share a
/// triangulation. The marks are in a table: throws std::bad_alloc.
template <class Real, class Int>
NextNearestStatus next_nearest(const ListsView<Int>& lists, const Nodes<Real>& nodes, Int l, Int* npts,
                               Real& distance);

}  // namespace pstripack
