#pragma once
// STRIPACK's routines as Fortran symbols, REAL*8, INTEGER*4: ours (trmesh_, ...) from libstripack, and the
// original's (cstrmesh_, ...) from libngmath, with the same arguments. Logical functions return 0 or not 0.

extern "C" {

#define STRIPACK_ROUTINES(of)                                                                                \
  void of##addnod_(const int* nst, const int* k, const double* x, const double* y, const double* z,          \
                   int* list, int* lptr, int* lend, int* lnew, int* ier);                                    \
  double of##areas_(const double* v1, const double* v2, const double* v3);                                   \
  void of##bdyadd_(const int* kk, const int* i1, const int* i2, int* list, int* lptr, int* lend, int* lnew); \
  void of##bnodes_(const int* n, const int* list, const int* lptr, const int* lend, int* nodes, int* nb,     \
                   int* na, int* nt);                                                                        \
  void of##circum_(const double* v1, const double* v2, const double* v3, double* c, int* ier);               \
  void of##covsph_(const int* kk, const int* n0, int* list, int* lptr, int* lend, int* lnew);                \
  void of##delarc_(const int* n, const int* io1, const int* io2, int* list, int* lptr, int* lend, int* lnew, \
                   int* ier);                                                                                \
  void of##delnb_(const int* n0, const int* nb, const int* n, int* list, int* lptr, int* lend, int* lnew,    \
                  int* lph);                                                                                 \
  void of##delnod_(const int* k, int* n, double* x, double* y, double* z, int* list, int* lptr, int* lend,   \
                   int* lnew, int* lwk, int* iwk, int* ier);                                                 \
  void of##edge_(const int* in1, const int* in2, const double* x, const double* y, const double* z,          \
                 int* lwk, int* iwk, int* list, int* lptr, int* lend, int* ier);                             \
  void of##getnp_(const double* x, const double* y, const double* z, const int* list, const int* lptr,       \
                  int* lend, const int* l, int* npts, double* df, int* ier);                                 \
  void of##insert_(const int* k, const int* lp, int* list, int* lptr, int* lnew);                            \
  int of##inside_(const double* p, const int* lv, const double* xv, const double* yv, const double* zv,      \
                  const int* nv, const int* listv, int* ier);                                                \
  void of##intadd_(const int* kk, const int* i1, const int* i2, const int* i3, int* list, int* lptr,         \
                   int* lend, int* lnew);                                                                    \
  void of##intrsc_(const double* p1, const double* p2, const double* cn, double* p, int* ier);               \
  int of##jrand_(const int* n, int* ix, int* iy, int* iz);                                                   \
  int of##left_(const double* x1, const double* y1, const double* z1, const double* x2, const double* y2,    \
                const double* z2, const double* x0, const double* y0, const double* z0);                     \
  int of##lstptr_(const int* lpl, const int* nb, const int* list, const int* lptr);                          \
  int of##nbcnt_(const int* lpl, const int* lptr);                                                           \
  int of##nearnd_(const double* p, const int* ist, const int* n, const double* x, const double* y,           \
                  const double* z, const int* list, const int* lptr, const int* lend, double* al);           \
  void of##optim_(const double* x, const double* y, const double* z, const int* na, int* list, int* lptr,    \
                  int* lend, int* nit, int* iwk, int* ier);                                                  \
  double of##store_(const double* x);                                                                        \
  void of##swap_(const int* in1, const int* in2, const int* io1, const int* io2, int* list, int* lptr,       \
                 int* lend, int* lp21);                                                                      \
  int of##swptst_(const int* n1, const int* n2, const int* n3, const int* n4, const double* x,               \
                  const double* y, const double* z);                                                         \
  void of##trfind_(const int* nst, const double* p, const int* n, const double* x, const double* y,          \
                   const double* z, const int* list, const int* lptr, const int* lend, double* b1,           \
                   double* b2, double* b3, int* i1, int* i2, int* i3);                                       \
  void of##trlist_(const int* n, const int* list, const int* lptr, const int* lend, const int* nrow,         \
                   int* nt, int* ltri, int* ier);                                                            \
  void of##trmesh_(const int* n, const double* x, const double* y, const double* z, int* list, int* lptr,    \
                   int* lend, int* lnew, int* near, int* next, double* dist, int* ier);

STRIPACK_ROUTINES()
STRIPACK_ROUTINES(cs)

// Where the arguments differ.
void trans_(const int* n, const double* rlat, const double* rlon, double* x, double* y, double* z);
void cstransd_(const int* n, const double* rlat, const double* rlon, double* x, double* y, double* z);
void scoord_(const double* px, const double* py, const double* pz, double* plat, double* plon, double* pnrm);
void csscoordd_(const double* px, const double* py, const double* pz, double* plat, double* plon,
                double* pnrm);
void crlist_(const int* n, const int* ncol, const double* x, const double* y, const double* z,
             const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
             double* xc, double* yc, double* zc, double* rc, int* ier);
void cscrlist_(const int* n, const int* ncol, const double* x, const double* y, const double* z,
               const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
               double* rlato, double* rlono, double* rc, int* ier);
void cstrprnt_(const int* n, const double* x, const double* y, const double* z, const int* iflag,
               const int* list, const int* lptr, const int* lend, const int* lout);
void cstrlprt_(const int* n, const double* x, const double* y, const double* z, const int* iflag,
               const int* nrow, const int* nt, const int* ltri, const int* lout);

// Only ours. TRPRNT and TRLPRT do not look at LOUT (libstripack_r4 and libstripack_i8 do). A Fortran string's
// length is a hidden last argument.
void trprnt_(const int* n, const double* x, const double* y, const double* z, const int* iflag,
             const int* list, const int* lptr, const int* lend, const int* lout);
void trlprt_(const int* n, const double* x, const double* y, const double* z, const int* iflag,
             const int* nrow, const int* nt, const int* ltri, const int* lout);
void trplot_(const int* lun, const double* pltsiz, const double* elat, const double* elon, const double* a,
             const int* n, const double* x, const double* y, const double* z, const int* list,
             const int* lptr, const int* lend, const char* title, const int* numbr, int* ier,
             unsigned long title_length);
void vrplot_(const int* lun, const double* pltsiz, const double* elat, const double* elon, const double* a,
             const int* n, const double* x, const double* y, const double* z, const int* nt, const int* listc,
             const int* lptr, const int* lend, const double* xc, const double* yc, const double* zc,
             const char* title, const int* numbr, int* ier, unsigned long title_length);
void voronoi_poly_count_(const int* n, const int* lend, const int* lptr, const int* listc);
}
