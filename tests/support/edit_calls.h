/* The routines of STRIPACK that change a triangulation, as C functions: what the libraries libstripack* call.
 * Internal to PSTRIPACK, not installed; conventions as in stripack_calls.h, but input that the routine
 * changes goes by pointer. Details: src/cxx/stripack/list_edit.h, arc_edit.h, node_edit.h.
 *
 *   insert   k becomes the neighbour after the one in slot lp
 *   intadd   node kk is linked to the corners of the triangle i1, i2, i3
 *   bdyadd   node kk is linked to the boundary nodes from i1 (rightmost) to i2 (leftmost)
 *   covsph   node kk is linked to all boundary nodes, of which n0 is one
 *   swap     arc io1-io2 gives way to in1-in2; lp21: slot of in1 in the list of in2; 0 refused; -13
 *   delnb    nb is removed from the list of n0; lph: the slot freed; -1 no such node; -2 no neighbour; -13
 *   delarc   boundary arc io1-io2 is removed; ier 0; 1 bad argument; 2 not a boundary arc; 3 the third corner
 *            is on the boundary; 4 not neighbours; -13
 *   swptst   1 if n4 lies above the plane of n1, n2, n3, else 0
 *   optim    ier 0; 1 nit iterations did not do; 2 bad argument; 3 not an arc; 4 no exchange possible; -13
 *   edge     ier 0; 1 bad argument; 2 lwk too small; 3 no way from in1 to in2; 4 optim failed; 5 optim
 *            returned 1; -13; -16 exchanges would not end, nothing but iwk is changed
 *   addnod   ier 0; L > 0 node k coincides with L; -1 k < 4; -2 all nodes on one great circle, or node k is
 *            zero; -4 6k-12 is too large; -5 node k is not finite; -13
 *   delnod   ier 0; 1 bad argument; 2 lwk too small; 3 fewer than 3 neighbours, or one does not list k;
 *            4 no triangulation of the gap; 5 optim failed; 6 optim returned 1; -13
 *
 * edge, delnod: where optim failed, *nit and *optim_ier are what it returned; else they are not written.
 * -13: not the lists of a triangulation; insert, intadd, bdyadd, covsph then change nothing, the others
 * perhaps a part. Each case that STRIPACK does not have (below -2) prints one line on stderr.
 */
#ifndef PSTRIPACK_EDIT_CALLS_H
#define PSTRIPACK_EDIT_CALLS_H

#include "support/stripack_calls.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PSTRIPACK_NODE_EDIT_CALLS(Real, Int, suffix)                                                         \
  PSTRIPACK_CALL(void)                                                                                       \
  pstripack_edge_##suffix(Int in1, Int in2, const Real* x, const Real* y, const Real* z, Int* lwk, Int* iwk, \
                          Int* list, Int* lptr, Int* lend, Int* ier, Int* nit, Int* optim_ier)               \
      PSTRIPACK_NOEXCEPT;                                                                                    \
  PSTRIPACK_CALL(void)                                                                                       \
  pstripack_delnod_##suffix(Int k, Int* n, Real* x, Real* y, Real* z, Int* list, Int* lptr, Int* lend,       \
                            Int* lnew, Int* lwk, Int* iwk, Int* ier, Int* nit, Int* optim_ier)               \
      PSTRIPACK_NOEXCEPT;

PSTRIPACK_NODE_EDIT_CALLS(float, int32_t, r4)
PSTRIPACK_NODE_EDIT_CALLS(double, int32_t, r8)
PSTRIPACK_NODE_EDIT_CALLS(double, int64_t, i8)

#ifdef __cplusplus
}
#endif
#endif
