#pragma once
// STRIPACK's routines as Fortran symbols: ours (trmesh_, ...) from libstripack, or from the library that
// STRIPACK_REAL, STRIPACK_INTEGER and STRIPACK_8_ARGUMENTS describe, and the original's (cstrmesh_, ...) from
// libngmath, with the same arguments. Logical functions return 0 or not 0.

#ifndef STRIPACK_REAL
#define STRIPACK_REAL double
#define STRIPACK_INTEGER int
#endif

using StripackReal = STRIPACK_REAL;
using StripackInteger = STRIPACK_INTEGER;

extern "C" {

#define STRIPACK_ROUTINES(of)                                                                                \
  void of##addnod_(const StripackInteger* nst, const StripackInteger* k, const StripackReal* x,              \
                   const StripackReal* y, const StripackReal* z, StripackInteger* list,                      \
                   StripackInteger* lptr, StripackInteger* lend, StripackInteger* lnew,                      \
                   StripackInteger* ier);                                                                    \
  StripackReal of##areas_(const StripackReal* v1, const StripackReal* v2, const StripackReal* v3);           \
  void of##bdyadd_(const StripackInteger* kk, const StripackInteger* i1, const StripackInteger* i2,          \
                   StripackInteger* list, StripackInteger* lptr, StripackInteger* lend,                      \
                   StripackInteger* lnew);                                                                   \
  void of##bnodes_(const StripackInteger* n, const StripackInteger* list, const StripackInteger* lptr,       \
                   const StripackInteger* lend, StripackInteger* nodes, StripackInteger* nb,                 \
                   StripackInteger* na, StripackInteger* nt);                                                \
  void of##circum_(const StripackReal* v1, const StripackReal* v2, const StripackReal* v3, StripackReal* c,  \
                   StripackInteger* ier);                                                                    \
  void of##covsph_(const StripackInteger* kk, const StripackInteger* n0, StripackInteger* list,              \
                   StripackInteger* lptr, StripackInteger* lend, StripackInteger* lnew);                     \
  void of##delarc_(const StripackInteger* n, const StripackInteger* io1, const StripackInteger* io2,         \
                   StripackInteger* list, StripackInteger* lptr, StripackInteger* lend,                      \
                   StripackInteger* lnew, StripackInteger* ier);                                             \
  void of##delnb_(const StripackInteger* n0, const StripackInteger* nb, const StripackInteger* n,            \
                  StripackInteger* list, StripackInteger* lptr, StripackInteger* lend,                       \
                  StripackInteger* lnew, StripackInteger* lph);                                              \
  void of##delnod_(const StripackInteger* k, StripackInteger* n, StripackReal* x, StripackReal* y,           \
                   StripackReal* z, StripackInteger* list, StripackInteger* lptr, StripackInteger* lend,     \
                   StripackInteger* lnew, StripackInteger* lwk, StripackInteger* iwk, StripackInteger* ier); \
  void of##edge_(const StripackInteger* in1, const StripackInteger* in2, const StripackReal* x,              \
                 const StripackReal* y, const StripackReal* z, StripackInteger* lwk, StripackInteger* iwk,   \
                 StripackInteger* list, StripackInteger* lptr, StripackInteger* lend, StripackInteger* ier); \
  void of##getnp_(const StripackReal* x, const StripackReal* y, const StripackReal* z,                       \
                  const StripackInteger* list, const StripackInteger* lptr, StripackInteger* lend,           \
                  const StripackInteger* l, StripackInteger* npts, StripackReal* df, StripackInteger* ier);  \
  void of##insert_(const StripackInteger* k, const StripackInteger* lp, StripackInteger* list,               \
                   StripackInteger* lptr, StripackInteger* lnew);                                            \
  StripackInteger of##inside_(const StripackReal* p, const StripackInteger* lv, const StripackReal* xv,      \
                              const StripackReal* yv, const StripackReal* zv, const StripackInteger* nv,     \
                              const StripackInteger* listv, StripackInteger* ier);                           \
  void of##intadd_(const StripackInteger* kk, const StripackInteger* i1, const StripackInteger* i2,          \
                   const StripackInteger* i3, StripackInteger* list, StripackInteger* lptr,                  \
                   StripackInteger* lend, StripackInteger* lnew);                                            \
  void of##intrsc_(const StripackReal* p1, const StripackReal* p2, const StripackReal* cn, StripackReal* p,  \
                   StripackInteger* ier);                                                                    \
  StripackInteger of##jrand_(const StripackInteger* n, StripackInteger* ix, StripackInteger* iy,             \
                             StripackInteger* iz);                                                           \
  StripackInteger of##left_(const StripackReal* x1, const StripackReal* y1, const StripackReal* z1,          \
                            const StripackReal* x2, const StripackReal* y2, const StripackReal* z2,          \
                            const StripackReal* x0, const StripackReal* y0, const StripackReal* z0);         \
  StripackInteger of##lstptr_(const StripackInteger* lpl, const StripackInteger* nb,                         \
                              const StripackInteger* list, const StripackInteger* lptr);                     \
  StripackInteger of##nbcnt_(const StripackInteger* lpl, const StripackInteger* lptr);                       \
  StripackInteger of##nearnd_(const StripackReal* p, const StripackInteger* ist, const StripackInteger* n,   \
                              const StripackReal* x, const StripackReal* y, const StripackReal* z,           \
                              const StripackInteger* list, const StripackInteger* lptr,                      \
                              const StripackInteger* lend, StripackReal* al);                                \
  void of##optim_(const StripackReal* x, const StripackReal* y, const StripackReal* z,                       \
                  const StripackInteger* na, StripackInteger* list, StripackInteger* lptr,                   \
                  StripackInteger* lend, StripackInteger* nit, StripackInteger* iwk, StripackInteger* ier);  \
  StripackReal of##store_(const StripackReal* x);                                                            \
  void of##swap_(const StripackInteger* in1, const StripackInteger* in2, const StripackInteger* io1,         \
                 const StripackInteger* io2, StripackInteger* list, StripackInteger* lptr,                   \
                 StripackInteger* lend, StripackInteger* lp21);                                              \
  StripackInteger of##swptst_(const StripackInteger* n1, const StripackInteger* n2,                          \
                              const StripackInteger* n3, const StripackInteger* n4, const StripackReal* x,   \
                              const StripackReal* y, const StripackReal* z);                                 \
  void of##trfind_(const StripackInteger* nst, const StripackReal* p, const StripackInteger* n,              \
                   const StripackReal* x, const StripackReal* y, const StripackReal* z,                      \
                   const StripackInteger* list, const StripackInteger* lptr, const StripackInteger* lend,    \
                   StripackReal* b1, StripackReal* b2, StripackReal* b3, StripackInteger* i1,                \
                   StripackInteger* i2, StripackInteger* i3);                                                \
  void of##trlist_(const StripackInteger* n, const StripackInteger* list, const StripackInteger* lptr,       \
                   const StripackInteger* lend, const StripackInteger* nrow, StripackInteger* nt,            \
                   StripackInteger* ltri, StripackInteger* ier);

STRIPACK_ROUTINES()
STRIPACK_ROUTINES(cs)

// Where the arguments differ.
void cstrmesh_(const StripackInteger* n, const StripackReal* x, const StripackReal* y, const StripackReal* z,
               StripackInteger* list, StripackInteger* lptr, StripackInteger* lend, StripackInteger* lnew,
               StripackInteger* near, StripackInteger* next, StripackReal* dist, StripackInteger* ier);
#ifdef STRIPACK_8_ARGUMENTS
void trmesh_(const StripackInteger* n, const StripackReal* x, const StripackReal* y, const StripackReal* z,
             StripackInteger* list, StripackInteger* lptr, StripackInteger* lend, StripackInteger* ier);
#else
void trmesh_(const StripackInteger* n, const StripackReal* x, const StripackReal* y, const StripackReal* z,
             StripackInteger* list, StripackInteger* lptr, StripackInteger* lend, StripackInteger* lnew,
             StripackInteger* near, StripackInteger* next, StripackReal* dist, StripackInteger* ier);
#endif
void trans_(const StripackInteger* n, const StripackReal* rlat, const StripackReal* rlon, StripackReal* x,
            StripackReal* y, StripackReal* z);
void cstransd_(const StripackInteger* n, const StripackReal* rlat, const StripackReal* rlon, StripackReal* x,
               StripackReal* y, StripackReal* z);
void scoord_(const StripackReal* px, const StripackReal* py, const StripackReal* pz, StripackReal* plat,
             StripackReal* plon, StripackReal* pnrm);
void csscoordd_(const StripackReal* px, const StripackReal* py, const StripackReal* pz, StripackReal* plat,
                StripackReal* plon, StripackReal* pnrm);
void crlist_(const StripackInteger* n, const StripackInteger* ncol, const StripackReal* x,
             const StripackReal* y, const StripackReal* z, const StripackInteger* list,
             const StripackInteger* lend, StripackInteger* lptr, StripackInteger* lnew, StripackInteger* ltri,
             StripackInteger* listc, StripackInteger* nb, StripackReal* xc, StripackReal* yc,
             StripackReal* zc, StripackReal* rc, StripackInteger* ier);
void cscrlist_(const StripackInteger* n, const StripackInteger* ncol, const StripackReal* x,
               const StripackReal* y, const StripackReal* z, const StripackInteger* list,
               const StripackInteger* lend, StripackInteger* lptr, StripackInteger* lnew,
               StripackInteger* ltri, StripackInteger* listc, StripackInteger* nb, StripackReal* rlato,
               StripackReal* rlono, StripackReal* rc, StripackInteger* ier);
void cstrprnt_(const StripackInteger* n, const StripackReal* x, const StripackReal* y, const StripackReal* z,
               const StripackInteger* iflag, const StripackInteger* list, const StripackInteger* lptr,
               const StripackInteger* lend, const StripackInteger* lout);
void cstrlprt_(const StripackInteger* n, const StripackReal* x, const StripackReal* y, const StripackReal* z,
               const StripackInteger* iflag, const StripackInteger* nrow, const StripackInteger* nt,
               const StripackInteger* ltri, const StripackInteger* lout);

// Only in our libraries. The length of a Fortran string is a hidden last argument.
void trprnt_(const StripackInteger* n, const StripackReal* x, const StripackReal* y, const StripackReal* z,
             const StripackInteger* iflag, const StripackInteger* list, const StripackInteger* lptr,
             const StripackInteger* lend, const StripackInteger* lout);
void trlprt_(const StripackInteger* n, const StripackReal* x, const StripackReal* y, const StripackReal* z,
             const StripackInteger* iflag, const StripackInteger* nrow, const StripackInteger* nt,
             const StripackInteger* ltri, const StripackInteger* lout);
void trplot_(const StripackInteger* lun, const StripackReal* pltsiz, const StripackReal* elat,
             const StripackReal* elon, const StripackReal* a, const StripackInteger* n, const StripackReal* x,
             const StripackReal* y, const StripackReal* z, const StripackInteger* list,
             const StripackInteger* lptr, const StripackInteger* lend, const char* title,
             const StripackInteger* numbr, StripackInteger* ier, unsigned long title_length);
void vrplot_(const StripackInteger* lun, const StripackReal* pltsiz, const StripackReal* elat,
             const StripackReal* elon, const StripackReal* a, const StripackInteger* n, const StripackReal* x,
             const StripackReal* y, const StripackReal* z, const StripackInteger* nt,
             const StripackInteger* listc, const StripackInteger* lptr, const StripackInteger* lend,
             const StripackReal* xc, const StripackReal* yc, const StripackReal* zc, const char* title,
             const StripackInteger* numbr, StripackInteger* ier, unsigned long title_length);
void voronoi_poly_count_(const StripackInteger* n, const StripackInteger* lend, const StripackInteger* lptr,
                         const StripackInteger* listc);
void trlist2_(const StripackInteger* n, const StripackInteger* list, const StripackInteger* lptr,
              const StripackInteger* lend, StripackInteger* nt, StripackInteger* ltri, StripackInteger* ier);
void triareas_(const StripackInteger* n, const StripackReal* x, const StripackReal* y, const StripackReal* z,
               const StripackInteger* nt, const StripackInteger* triangles, StripackReal* triarea);
}
