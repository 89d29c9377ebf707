#pragma once
// ADDNOD, DELNOD: nodes are added to and deleted from a triangulation (Renka, ACM TOMS 23 (1997), Algorithm
// 772). For (Real, Int) = (float, int32_t), (double, int32_t), (double, int64_t). The routines allocate
// nothing and always return.

#include "stripack/arc_edit.h"

namespace pstripack {

/// IER of ADDNOD; L > 0: node k coincides with node L.
enum class AddnodStatus {
  done = 0,
  too_few_nodes = PSTRIPACK_TOO_FEW_NODES,  ///< k < 4
  collinear = PSTRIPACK_COLLINEAR,  ///< all nodes lie on one great circle, or node k is the zero vector
  too_many_nodes = PSTRIPACK_TOO_MANY_NODES,  ///< 6k-12 does not fit an integer
  not_finite = PSTRIPACK_BAD_COORDINATE,      ///< a coordinate of node k is NaN or infinite
  broken = broken_lists
};

/// ADDNOD: adds node k = lists.n to the triangulation of nodes 1..k-1, which stays a Delaunay triangulation
/// if it was one. The search starts at node `start`; at node k-1 if start < 1, at a random node if start >
/// k-1. The lists are changed only if the result is 0 or, partly, if it is broken_lists. Expected O(1)
/// after the search.
///
/// A node with the coordinates of node k is always found in a Delaunay triangulation; Algorithm 772 misses
/// many on the hull.
template <class Real, class Int>
Int addnod(Int start, const Nodes<Real>& nodes, const EditedLists<Int>& lists);

/// IER of DELNOD.
enum class DelnodStatus {
  done = 0,
  bad_argument = 1,     ///< k not in 1..n, n < 4 or lwk < 0; nothing is changed
  too_few_columns = 2,  ///< only lwk is changed: columns needed
  not_linked = 3,       ///< k has fewer than 3 neighbours; or one of them does not list k, and the lists are
                        ///< changed in part, but not LNEW, n, x, y, z
  not_reduced = 4,      ///< an interior node kept more than 3 neighbours although there is a boundary; arcs
                        ///< were exchanged, but LNEW, n, x, y, z are unchanged
  optim_failed = 5,     ///< deleted; OptimFailure has OPTIM's code
  not_optimal = 6,      ///< deleted; OPTIM ran out of iterations
  broken = broken_lists
};

/// DELNOD: deletes node k; the numbers of higher nodes drop by one in x, y, z, LEND and all lists. n =
/// lists.n, on return one less. lwk: in, columns of iwk; out, columns needed: the number of neighbours of k
/// minus 3 (minus 2 on the boundary). iwk: the arcs that replace those of k. O(degree squared) if k = n,
/// else O(n).
template <class Real, class Int>
DelnodStatus delnod(Int k, Int& n, Real* x, Real* y, Real* z, const EditedLists<Int>& lists, Int& lwk,
                    Int* iwk, OptimFailure<Int>& failure);

}  // namespace pstripack
