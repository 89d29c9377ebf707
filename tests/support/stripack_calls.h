/* The routines of STRIPACK as C functions: what the libraries libstripack* call. Internal to PSTRIPACK,
 * not installed; exported from libpstripack because those libraries are linked to it. TRMESH itself is
 * pstripack_trmesh of pstripack.h.
 *
 * Arguments and results are those of the routine of the same name, inputs by value; see the headers of
 * src/cxx/stripack. Node and slot numbers count from 1. None is collective, writes to stdout or throws. None
 * keeps state, but for the random seeds of each thread where PSTRIPACK_ORDER is not canonical. The suffix
 * names the kinds: _r4, _r8 reals of 32 and 64 bits, with integers of 32 bits; _i8 reals and integers of 64
 * bits; _i4, _i8 without reals. Other kinds are further instances of the macros below.
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
 *            memory; -9 not the lists of a triangulation. On -6 nothing but ier is written
 *   trfind   b1, b2, b3, i1, i2, i3; all of i1, i2, i3 are 0 if p[3] is not found
 *   nearnd   the nearest node, 0 if there is none; al in radians
 *   getnp    npts[l], of which the last is written; df; ier: 0; 1 l < 2; -5 a coordinate is not finite; -6
 *            out of memory; -10 npts holds a number below 1 or one twice; -11 no node left
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

#include <stdint.h>

#ifdef __cplusplus
#define PSTRIPACK_NOEXCEPT noexcept
extern "C" {
#else
#define PSTRIPACK_NOEXCEPT
#endif

#define PSTRIPACK_CALL(result) __attribute__((visibility("default"))) result

#define PSTRIPACK_LIST_CALLS(Int, suffix)                                                                  \
  PSTRIPACK_CALL(Int)                                                                                      \
  pstripack_lstptr_##suffix(Int lpl, Int nb, const Int* list, const Int* lptr) PSTRIPACK_NOEXCEPT;         \
  PSTRIPACK_CALL(Int) pstripack_nbcnt_##suffix(Int lpl, const Int* lptr) PSTRIPACK_NOEXCEPT;               \
  PSTRIPACK_CALL(void)                                                                                     \
  pstripack_bnodes_##suffix(Int n, const Int* list, const Int* lptr, const Int* lend, Int* nodes, Int* nb, \
                            Int* na, Int* nt) PSTRIPACK_NOEXCEPT;                                          \
  PSTRIPACK_CALL(void)                                                                                     \
  pstripack_trlist_##suffix(Int n, const Int* list, const Int* lptr, const Int* lend, Int nrow, Int* nt,   \
                            Int* ltri, Int* ier) PSTRIPACK_NOEXCEPT;                                       \
  PSTRIPACK_CALL(void)                                                                                     \
  pstripack_trlist2_##suffix(Int n, const Int* list, const Int* lptr, const Int* lend, Int* nt, Int* ltri, \
                             Int* ier) PSTRIPACK_NOEXCEPT;

#define PSTRIPACK_SPHERE_CALLS(Real, Int, suffix)                                                          \
  PSTRIPACK_CALL(void)                                                                                     \
  pstripack_trans_##suffix(Int n, const Real* rlat, const Real* rlon, Real* x, Real* y, Real* z)           \
      PSTRIPACK_NOEXCEPT;                                                                                  \
  PSTRIPACK_CALL(void)                                                                                     \
  pstripack_scoord_##suffix(Real px, Real py, Real pz, Real* plat, Real* plon, Real* pnrm)                 \
      PSTRIPACK_NOEXCEPT;                                                                                  \
  PSTRIPACK_CALL(Int)                                                                                      \
  pstripack_left_##suffix(Real x1, Real y1, Real z1, Real x2, Real y2, Real z2, Real x0, Real y0, Real z0) \
      PSTRIPACK_NOEXCEPT;                                                                                  \
  PSTRIPACK_CALL(Real)                                                                                     \
  pstripack_areas_##suffix(const Real* v1, const Real* v2, const Real* v3) PSTRIPACK_NOEXCEPT;             \
  PSTRIPACK_CALL(void)                                                                                     \
  pstripack_circum_##suffix(const Real* v1, const Real* v2, const Real* v3, Real* c, Int* ier)             \
      PSTRIPACK_NOEXCEPT;                                                                                  \
  PSTRIPACK_CALL(void)                                                                                     \
  pstripack_triareas_##suffix(Int n, const Real* x, const Real* y, const Real* z, Int nt,                  \
                              const Int* triangles, Real* triarea) PSTRIPACK_NOEXCEPT;

#define PSTRIPACK_MESH_CALLS(Real, Int, suffix)                                                              \
  PSTRIPACK_CALL(void)                                                                                       \
  pstripack_crlist_##suffix(Int n, Int ncol, const Real* x, const Real* y, const Real* z, const Int* list,   \
                            const Int* lend, Int* lptr, Int* lnew, Int* ltri, Int* listc, Int* nb, Real* xc, \
                            Real* yc, Real* zc, Real* rc, Int* ier) PSTRIPACK_NOEXCEPT;                      \
  PSTRIPACK_CALL(void)                                                                                       \
  pstripack_trfind_##suffix(Int nst, const Real* p, Int n, const Real* x, const Real* y, const Real* z,      \
                            const Int* list, const Int* lptr, const Int* lend, Real* b1, Real* b2, Real* b3, \
                            Int* i1, Int* i2, Int* i3) PSTRIPACK_NOEXCEPT;                                   \
  PSTRIPACK_CALL(Int)                                                                                        \
  pstripack_nearnd_##suffix(const Real* p, Int ist, Int n, const Real* x, const Real* y, const Real* z,      \
                            const Int* list, const Int* lptr, const Int* lend, Real* al) PSTRIPACK_NOEXCEPT;

#define PSTRIPACK_QUERY_CALLS(Real, Int, suffix)                                                           \
  PSTRIPACK_CALL(void)                                                                                     \
  pstripack_getnp_##suffix(const Real* x, const Real* y, const Real* z, const Int* list, const Int* lptr,  \
                           const Int* lend, Int l, Int* npts, Real* df, Int* ier) PSTRIPACK_NOEXCEPT;      \
  PSTRIPACK_CALL(Int)                                                                                      \
  pstripack_inside_##suffix(const Real* p, Int lv, const Real* xv, const Real* yv, const Real* zv, Int nv, \
                            const Int* listv, Int* ier) PSTRIPACK_NOEXCEPT;                                \
  PSTRIPACK_CALL(void)                                                                                     \
  pstripack_intrsc_##suffix(const Real* p1, const Real* p2, const Real* cn, Real* p, Int* ier)             \
      PSTRIPACK_NOEXCEPT;                                                                                  \
  PSTRIPACK_CALL(Int) pstripack_jrand_##suffix(Int n, Int* ix, Int* iy, Int* iz) PSTRIPACK_NOEXCEPT;

PSTRIPACK_LIST_CALLS(int32_t, i4)
PSTRIPACK_SPHERE_CALLS(float, int32_t, r4)
PSTRIPACK_SPHERE_CALLS(double, int32_t, r8)
PSTRIPACK_MESH_CALLS(float, int32_t, r4)
PSTRIPACK_MESH_CALLS(double, int32_t, r8)
PSTRIPACK_LIST_CALLS(int64_t, i8)
PSTRIPACK_SPHERE_CALLS(double, int64_t, i8)
PSTRIPACK_MESH_CALLS(double, int64_t, i8)
PSTRIPACK_QUERY_CALLS(float, int32_t, r4)
PSTRIPACK_QUERY_CALLS(double, int32_t, r8)
PSTRIPACK_QUERY_CALLS(double, int64_t, i8)

#ifdef __cplusplus
}
#endif
#endif
