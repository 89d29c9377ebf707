/* The routines of STRIPACK as C functions: what the libraries libstripack* call. Internal to PSTRIPACK,
 * not installed; exported from libpstripack because those libraries are linked to it. TRMESH itself is
 * pstripack_trmesh of pstripack.h.
 *
 * Arguments and results are those of the routine of the same name, inputs by value; see the headers of
 * src/cxx/stripack. Node and slot numbers count from 1. None is collective, writes to stdout or throws. None
 * keeps state, but for the random seeds of each thread where PSTRIPACK_ORDER is not canonical. The suffix
 * names the kinds: _r4, _r8 reals of 32 and 64 bits, with integers of 32 bits; _i8 reals and integers of 64
 * bits; _i4, _i8 without reals.
 *
 *   lstptr   slot of neighbour nb in the list that ends in slot lpl; lpl if there is none
 *   nbcnt    number of neighbours in that list
 *   bnodes   nodes[nb], nb, na, nt
 *   trlist   ltri[nrow*nt]; ier: 0; 1 bad n or nrow; 2 broken lists; -6 out of memory (nt = 0 unless 0)
 *   trlist2  the same with 3 rows
 *   trans    x, y, z[n] from rlat, rlon[n] (radians); x, y may be rlat, rlon
 *   scoord   plat, plon (radians), pnrm
 *   left     1 if (x0,y0,z0) lies left of or on the great circle from (x1,y1,z1) to (x2,y2,z2), else 0
 *   areas    area of the spherical triangle v1[3], v2[3], v3[3]
 *   circum   c[3]; ier: 0; 1 two corners coincide; -5 not finite. c is untouched unless ier = 0
 *   crlist   ier: 0; 1 n < 3; 2 ncol < nb-2; 3 coincident nodes; -5 a coordinate is not finite; -6 out of
 *            memory; -13 not the lists of a triangulation. On -6 nothing but ier is written
 *   trfind   b1, b2, b3, i1, i2, i3; all of i1, i2, i3 are 0 if p[3] is not found
 *   nearnd   the nearest node, 0 if there is none; al in radians
 *   getnp    npts[l], of which the last is written; df; ier: 0; 1 l < 2; -5 a coordinate is not finite; -6
 *            out of memory; -10 npts holds a number below 1 or one twice; -15 no node left
 *   inside   1 if p[3] lies in the polygon, else 0; ier: 0; 1 bad nv; 2 bad vertex; 3 self-intersecting;
 *            4 no reference point; -5 not finite. 0 unless ier = 0
 *   intrsc   p[3]; ier: 0; 1 parallel; 2 antipodal; -5 not finite. p is untouched unless ier = 0
 *   jrand    a random integer in 1..n, or n+1 (see random.h); ix, iy, iz advance
 *   triareas triarea[nt] of triangles[3*nt]
 *
 * A negative ier, which STRIPACK does not have, also prints one line on stderr.
 */
#ifndef PSTRIPACK_STRIPACK_CALLS_H
#define PSTRIPACK_STRIPACK_CALLS_H

#include "capi/plain_calls.h"

#define PSTRIPACK_NOEXCEPT noexcept
#define PSTRIPACK_CALL(result) __attribute__((visibility("default"))) result

extern "C" {

#define PSTRIPACK_JRAND(Int, suffix) \
  PSTRIPACK_CALL(Int) pstripack_jrand_##suffix(Int n, Int* ix, Int* iy, Int* iz) PSTRIPACK_NOEXCEPT;
PSTRIPACK_JRAND(int32_t, r4)
PSTRIPACK_JRAND(int32_t, r8)
PSTRIPACK_JRAND(int64_t, i8)
}
#endif
