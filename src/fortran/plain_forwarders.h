// Made by docs/api/make-api.py. The symbols of libstripack* that only call their C function. Compiled once for each
// routine of each library: see stripack_abi.F90.
// clang-format off

#include "capi/plain_calls.h"

#if STRIPACK_INTEGER_BYTES == 8
#define OF_INTEGER(name) name##_i8
#define OF_REAL(name) name##_i8
#elif STRIPACK_REAL_BYTES == 8
#define OF_INTEGER(name) name##_i4
#define OF_REAL(name) name##_r8
#else
#define OF_INTEGER(name) name##_i4
#define OF_REAL(name) name##_r4
#endif

#define IDENT(routine) \
  static const volatile char ident[] = "@(#)PSTRIPACK " STRIPACK_LIBRARY " " routine; \
  if (ident[0] != '@') return

#pragma GCC visibility push(default)
#include "stripack.h"

using Int = stripack_integer;
using Real = stripack_real;

#ifdef STRIPACK_TRLIST
void trlist_(const Int* n, const Int* list, const Int* lptr, const Int* lend, const Int* nrow, Int* nt,
    Int* ltri, Int* ier) {
  IDENT("TRLIST");
  OF_INTEGER(pstripack_trlist)(*n, list, lptr, lend, *nrow, nt, ltri, ier);
}
#endif

#ifdef STRIPACK_TRLIST2
void trlist2_(const Int* n, const Int* list, const Int* lptr, const Int* lend, Int* nt, Int* ltri, Int* ier) {
  OF_INTEGER(pstripack_trlist2)(*n, list, lptr, lend, nt, ltri, ier);
}
#endif

#ifdef STRIPACK_BNODES
void bnodes_(const Int* n, const Int* list, const Int* lptr, const Int* lend, Int* nodes, Int* nb, Int* na,
    Int* nt) {
  OF_INTEGER(pstripack_bnodes)(*n, list, lptr, lend, nodes, nb, na, nt);
}
#endif

#ifdef STRIPACK_TRFIND
void trfind_(const Int* nst, const Real* p, const Int* n, const Real* x, const Real* y, const Real* z,
    const Int* list, const Int* lptr, const Int* lend, Real* b1, Real* b2, Real* b3, Int* i1, Int* i2,
    Int* i3) {
  IDENT("TRFIND");
  OF_REAL(pstripack_trfind)(*nst, p, *n, x, y, z, list, lptr, lend, b1, b2, b3, i1, i2, i3);
}
#endif

#ifdef STRIPACK_NEARND
Int nearnd_(const Real* p, const Int* ist, const Int* n, const Real* x, const Real* y, const Real* z,
    const Int* list, const Int* lptr, const Int* lend, Real* al) {
  return OF_REAL(pstripack_nearnd)(p, *ist, *n, x, y, z, list, lptr, lend, al);
}
#endif

#ifdef STRIPACK_GETNP
void getnp_(const Real* x, const Real* y, const Real* z, const Int* list, const Int* lptr, const Int* lend,
    const Int* l, Int* npts, Real* df, Int* ier) {
  IDENT("GETNP");
  OF_REAL(pstripack_getnp)(x, y, z, list, lptr, lend, *l, npts, df, ier);
}
#endif

#ifdef STRIPACK_NBCNT
Int nbcnt_(const Int* lpl, const Int* lptr) {
  return OF_INTEGER(pstripack_nbcnt)(*lpl, lptr);
}
#endif

#ifdef STRIPACK_LSTPTR
Int lstptr_(const Int* lpl, const Int* nb, const Int* list, const Int* lptr) {
  return OF_INTEGER(pstripack_lstptr)(*lpl, *nb, list, lptr);
}
#endif

#ifdef STRIPACK_ADDNOD
void addnod_(const Int* nst, const Int* k, const Real* x, const Real* y, const Real* z, Int* list, Int* lptr,
    Int* lend, Int* lnew, Int* ier) {
  OF_REAL(pstripack_addnod)(*nst, *k, x, y, z, list, lptr, lend, lnew, ier);
}
#endif

#ifdef STRIPACK_DELARC
void delarc_(const Int* n, const Int* io1, const Int* io2, Int* list, Int* lptr, Int* lend, Int* lnew,
    Int* ier) {
  OF_INTEGER(pstripack_delarc)(*n, *io1, *io2, list, lptr, lend, lnew, ier);
}
#endif

#ifdef STRIPACK_OPTIM
void optim_(const Real* x, const Real* y, const Real* z, const Int* na, Int* list, Int* lptr, Int* lend,
    Int* nit, Int* iwk, Int* ier) {
  OF_REAL(pstripack_optim)(x, y, z, *na, list, lptr, lend, nit, iwk, ier);
}
#endif

#ifdef STRIPACK_INTADD
void intadd_(const Int* kk, const Int* i1, const Int* i2, const Int* i3, Int* list, Int* lptr, Int* lend,
    Int* lnew) {
  OF_INTEGER(pstripack_intadd)(*kk, *i1, *i2, *i3, list, lptr, lend, lnew);
}
#endif

#ifdef STRIPACK_BDYADD
void bdyadd_(const Int* kk, const Int* i1, const Int* i2, Int* list, Int* lptr, Int* lend, Int* lnew) {
  OF_INTEGER(pstripack_bdyadd)(*kk, *i1, *i2, list, lptr, lend, lnew);
}
#endif

#ifdef STRIPACK_COVSPH
void covsph_(const Int* kk, const Int* n0, Int* list, Int* lptr, Int* lend, Int* lnew) {
  OF_INTEGER(pstripack_covsph)(*kk, *n0, list, lptr, lend, lnew);
}
#endif

#ifdef STRIPACK_INSERT
void insert_(const Int* k, const Int* lp, Int* list, Int* lptr, Int* lnew) {
  OF_INTEGER(pstripack_insert)(*k, *lp, list, lptr, lnew);
}
#endif

#ifdef STRIPACK_DELNB
void delnb_(const Int* n0, const Int* nb, const Int* n, Int* list, Int* lptr, Int* lend, Int* lnew, Int* lph)
    {
  OF_INTEGER(pstripack_delnb)(*n0, *nb, *n, list, lptr, lend, lnew, lph);
}
#endif

#ifdef STRIPACK_SWAP
void swap_(const Int* in1, const Int* in2, const Int* io1, const Int* io2, Int* list, Int* lptr, Int* lend,
    Int* lp21) {
  OF_INTEGER(pstripack_swap)(*in1, *in2, *io1, *io2, list, lptr, lend, lp21);
}
#endif

#ifdef STRIPACK_SWPTST
Int swptst_(const Int* n1, const Int* n2, const Int* n3, const Int* n4, const Real* x, const Real* y,
    const Real* z) {
  return OF_REAL(pstripack_swptst)(*n1, *n2, *n3, *n4, x, y, z);
}
#endif

#ifdef STRIPACK_CRLIST
void crlist_(const Int* n, const Int* ncol, const Real* x, const Real* y, const Real* z, const Int* list,
    const Int* lend, Int* lptr, Int* lnew, Int* ltri, Int* listc, Int* nb, Real* xc, Real* yc, Real* zc,
    Real* rc, Int* ier) {
  IDENT("CRLIST");
  OF_REAL(pstripack_crlist)(*n, *ncol, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier);
}
#endif

#ifdef STRIPACK_CIRCUM
void circum_(const Real* v1, const Real* v2, const Real* v3, Real* c, Int* ier) {
  OF_REAL(pstripack_circum)(v1, v2, v3, c, ier);
}
#endif

#ifdef STRIPACK_TRANS
void trans_(const Int* n, const Real* rlat, const Real* rlon, Real* x, Real* y, Real* z) {
  OF_REAL(pstripack_trans)(*n, rlat, rlon, x, y, z);
}
#endif

#ifdef STRIPACK_SCOORD
void scoord_(const Real* px, const Real* py, const Real* pz, Real* plat, Real* plon, Real* pnrm) {
  OF_REAL(pstripack_scoord)(*px, *py, *pz, plat, plon, pnrm);
}
#endif

#ifdef STRIPACK_AREAS
Real areas_(const Real* v1, const Real* v2, const Real* v3) {
  return OF_REAL(pstripack_areas)(v1, v2, v3);
}
#endif

#ifdef STRIPACK_TRIAREAS
void triareas_(const Int* n, const Real* x, const Real* y, const Real* z, const Int* nt, const Int* triangles,
    Real* triarea) {
  OF_REAL(pstripack_triareas)(*n, x, y, z, *nt, triangles, triarea);
}
#endif

#ifdef STRIPACK_LEFT
Int left_(const Real* x1, const Real* y1, const Real* z1, const Real* x2, const Real* y2, const Real* z2,
    const Real* x0, const Real* y0, const Real* z0) {
  return OF_REAL(pstripack_left)(*x1, *y1, *z1, *x2, *y2, *z2, *x0, *y0, *z0);
}
#endif

#ifdef STRIPACK_INSIDE
Int inside_(const Real* p, const Int* lv, const Real* xv, const Real* yv, const Real* zv, const Int* nv,
    const Int* listv, Int* ier) {
  return OF_REAL(pstripack_inside)(p, *lv, xv, yv, zv, *nv, listv, ier);
}
#endif

#ifdef STRIPACK_INTRSC
void intrsc_(const Real* p1, const Real* p2, const Real* cn, Real* p, Int* ier) {
  OF_REAL(pstripack_intrsc)(p1, p2, cn, p, ier);
}
#endif

#ifdef STRIPACK_JRAND
Int jrand_(const Int* n, Int* ix, Int* iy, Int* iz) {
  return OF_REAL(pstripack_jrand)(*n, ix, iy, iz);
}
#endif

#pragma GCC visibility pop
