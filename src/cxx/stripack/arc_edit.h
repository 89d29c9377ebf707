#pragma once
// SWPTST, OPTIM, DELARC, EDGE: swap and removal of arcs (Renka, ACM TOMS 23 (1997), Algorithm 772).
// For (Real, Int) = (float, int32_t), (double, int32_t), (double, int64_t). The routines allocate nothing and
// always return.

#include "stripack/expressions.h"
#include "stripack/list_edit.h"

namespace pstripack {

/// SWPTST: true if node n4 lies strictly above the plane of the counterclockwise triangle n1, n2, n3 in
/// rounded arithmetic, so that the common arc n1-n2 of the two triangles should be swapped. False for NaN.
template <class Real, class Int>
bool swptst(Int n1, Int n2, Int n3, Int n4, const Nodes<Real>& nodes) {
  return height(nodes[n1], nodes[n2], nodes[n3], nodes[n4]) > 0;
}

/// IER of OPTIM. On an error the swaps made before it stay.
enum class OptimStatus {
  done = 0,
  not_all = 1,       ///< the last allowed iteration still made swaps
  bad_argument = 2,  ///< na < 0 or nit < 1; nit = 0
  no_arc = 3,        ///< a column does not hold two neighbours
  not_swapped = 4,   ///< the nodes to be joined were neighbours
  broken = broken_lists
};

/// OPTIM: swaps the arcs in the columns of iwk(2,na), each a pair of neighbours, until they are locally
/// optimal, in at most nit iterations through all columns. Updates the columns. nit: on return, the number
/// of iterations made. The routine is not told N: a node number above all those in the columns is used as
/// an index only if two lists agree on it.
template <class Real, class Int>
OptimStatus optim(const Nodes<Real>& nodes, Int na, const EditedLists<Int>& lists, Int& nit, Int* iwk);

/// The same for lists that are being edited; throws BrokenLists.
template <class Real, class Int>
OptimStatus optimize(const CheckedEditor<Int>& lists, const Nodes<Real>& nodes, Int na, Int& nit, Int* iwk);

template <class Int>
struct OptimFailure {
  Int nit = 0, ier = 0;
};

/// IER of DELARC. Nothing is changed unless it is `done` or `broken`.
enum class DelarcStatus {
  done = 0,
  bad_argument = 1,     ///< lists.n < 4, or io1, io2 not two of its nodes
  not_on_boundary = 2,  ///< no boundary arc
  cuts_off = 3,         ///< the third corner of its triangle is already on the boundary
  no_neighbours = 4,    ///< the two do not list each other
  broken = broken_lists
};

/// DELARC: removes the boundary arc io1-io2 and its triangle.
template <class Int>
DelarcStatus delarc(Int io1, Int io2, const EditedLists<Int>& lists);

/// IER of EDGE.
enum class EdgeStatus {
  done = 0,
  bad_argument = 1,     ///< in1 < 1, in2 < 1, in1 = in2, lwk < 0; nothing is changed
  too_few_columns = 2,  ///< more than lwk arcs are crossed; only iwk is changed
  not_found = 3,     ///< the walk from in1 to in2 failed: null triangles or broken lists; only iwk is changed
  optim_failed = 4,  ///< the arc is there; OptimFailure has OPTIM's code
  not_optimal = 5,   ///< the arc is there; OPTIM ran out of iterations
  broken = broken_lists,  ///< only iwk is changed, unless several entries are wrong
  not_possible =
      PSTRIPACK_NO_EDGE  ///< nodes on the arc, up to rounding, or triangles that overlap; only iwk is changed
};

/// EDGE: makes in1-in2 an arc by swapping the arcs that it crosses, and then optimises the new arcs beside
/// it. EDGE is not told N, so it cannot detect in1 or in2 above N. lwk: in, columns of iwk; out, number of
/// arcs crossed (unchanged if there are none, and on errors except optim_failed, not_optimal). iwk, on
/// `done`: the arcs left of in1-in2, a column 0, the arcs right of it; or left and right exchanged.
template <class Real, class Int>
EdgeStatus edge(Int in1, Int in2, const Nodes<Real>& nodes, Int& lwk, Int* iwk, const EditedLists<Int>& lists,
                OptimFailure<Int>& failure);

}  // namespace pstripack
