#pragma once
// Made by docs/api/make-api.py. The C functions that src/fortran/plain_forwarders.h calls.
// clang-format off

#include <cstdint>

#pragma GCC visibility push(default)
extern "C" {

#define LIST_CALLS(Int, suffix) \
  void pstripack_trlist_##suffix(Int n, const Int* list, const Int* lptr, const Int* lend, Int nrow, \
      Int* nt, Int* ltri, Int* ier) noexcept; \
  void pstripack_trlist2_##suffix(Int n, const Int* list, const Int* lptr, const Int* lend, Int* nt, \
      Int* ltri, Int* ier) noexcept; \
  void pstripack_bnodes_##suffix(Int n, const Int* list, const Int* lptr, const Int* lend, Int* nodes, \
      Int* nb, Int* na, Int* nt) noexcept; \
  Int pstripack_nbcnt_##suffix(Int lpl, const Int* lptr) noexcept; \
  Int pstripack_lstptr_##suffix(Int lpl, Int nb, const Int* list, const Int* lptr) noexcept; \
  void pstripack_delarc_##suffix(Int n, Int io1, Int io2, Int* list, Int* lptr, Int* lend, Int* lnew, \
      Int* ier) noexcept; \
  void pstripack_intadd_##suffix(Int kk, Int i1, Int i2, Int i3, Int* list, Int* lptr, Int* lend, Int* lnew) \
      noexcept; \
  void pstripack_bdyadd_##suffix(Int kk, Int i1, Int i2, Int* list, Int* lptr, Int* lend, Int* lnew) \
      noexcept; \
  void pstripack_covsph_##suffix(Int kk, Int n0, Int* list, Int* lptr, Int* lend, Int* lnew) noexcept; \
  void pstripack_insert_##suffix(Int k, Int lp, Int* list, Int* lptr, Int* lnew) noexcept; \
  void pstripack_delnb_##suffix(Int n0, Int nb, Int n, Int* list, Int* lptr, Int* lend, Int* lnew, Int* lph) \
      noexcept; \
  void pstripack_swap_##suffix(Int in1, Int in2, Int io1, Int io2, Int* list, Int* lptr, Int* lend, \
      Int* lp21) noexcept;
LIST_CALLS(int32_t, i4)
LIST_CALLS(int64_t, i8)
#undef LIST_CALLS

#define NODE_CALLS(Real, Int, suffix) \
  void pstripack_trfind_##suffix(Int nst, const Real* p, Int n, const Real* x, const Real* y, const Real* z, \
      const Int* list, const Int* lptr, const Int* lend, Real* b1, Real* b2, Real* b3, Int* i1, Int* i2, \
      Int* i3) noexcept; \
  Int pstripack_nearnd_##suffix(const Real* p, Int ist, Int n, const Real* x, const Real* y, const Real* z, \
      const Int* list, const Int* lptr, const Int* lend, Real* al) noexcept; \
  void pstripack_getnp_##suffix(const Real* x, const Real* y, const Real* z, const Int* list, \
      const Int* lptr, const Int* lend, Int l, Int* npts, Real* df, Int* ier) noexcept; \
  void pstripack_addnod_##suffix(Int nst, Int k, const Real* x, const Real* y, const Real* z, Int* list, \
      Int* lptr, Int* lend, Int* lnew, Int* ier) noexcept; \
  void pstripack_optim_##suffix(const Real* x, const Real* y, const Real* z, Int na, Int* list, Int* lptr, \
      Int* lend, Int* nit, Int* iwk, Int* ier) noexcept; \
  Int pstripack_swptst_##suffix(Int n1, Int n2, Int n3, Int n4, const Real* x, const Real* y, const Real* z) \
      noexcept; \
  void pstripack_crlist_##suffix(Int n, Int ncol, const Real* x, const Real* y, const Real* z, \
      const Int* list, const Int* lend, Int* lptr, Int* lnew, Int* ltri, Int* listc, Int* nb, Real* xc, \
      Real* yc, Real* zc, Real* rc, Int* ier) noexcept; \
  void pstripack_circum_##suffix(const Real* v1, const Real* v2, const Real* v3, Real* c, Int* ier) \
      noexcept; \
  void pstripack_trans_##suffix(Int n, const Real* rlat, const Real* rlon, Real* x, Real* y, Real* z) \
      noexcept; \
  void pstripack_scoord_##suffix(Real px, Real py, Real pz, Real* plat, Real* plon, Real* pnrm) noexcept; \
  Real pstripack_areas_##suffix(const Real* v1, const Real* v2, const Real* v3) noexcept; \
  void pstripack_triareas_##suffix(Int n, const Real* x, const Real* y, const Real* z, Int nt, \
      const Int* triangles, Real* triarea) noexcept; \
  Int pstripack_left_##suffix(Real x1, Real y1, Real z1, Real x2, Real y2, Real z2, Real x0, Real y0, \
      Real z0) noexcept; \
  Int pstripack_inside_##suffix(const Real* p, Int lv, const Real* xv, const Real* yv, const Real* zv, \
      Int nv, const Int* listv, Int* ier) noexcept; \
  void pstripack_intrsc_##suffix(const Real* p1, const Real* p2, const Real* cn, Real* p, Int* ier) \
      noexcept; \
  Int pstripack_jrand_##suffix(Int n, Int* ix, Int* iy, Int* iz) noexcept;
NODE_CALLS(float, int32_t, r4)
NODE_CALLS(double, int32_t, r8)
NODE_CALLS(double, int64_t, i8)
#undef NODE_CALLS

}
#pragma GCC visibility pop
