#pragma once
// Made by docs/api/make-api.py. The C functions that src/fortran/plain_forwarders.inc calls.
// clang-format off

#include <cstdint>

#pragma GCC visibility push(default)
extern "C" {

void pstripack_trlist_i4(int32_t n, const int32_t* list, const int32_t* lptr, const int32_t* lend,
    int32_t nrow, int32_t* nt, int32_t* ltri, int32_t* ier) noexcept;
void pstripack_trlist_i8(int64_t n, const int64_t* list, const int64_t* lptr, const int64_t* lend,
    int64_t nrow, int64_t* nt, int64_t* ltri, int64_t* ier) noexcept;

void pstripack_trlist2_i4(int32_t n, const int32_t* list, const int32_t* lptr, const int32_t* lend,
    int32_t* nt, int32_t* ltri, int32_t* ier) noexcept;
void pstripack_trlist2_i8(int64_t n, const int64_t* list, const int64_t* lptr, const int64_t* lend,
    int64_t* nt, int64_t* ltri, int64_t* ier) noexcept;

void pstripack_bnodes_i4(int32_t n, const int32_t* list, const int32_t* lptr, const int32_t* lend,
    int32_t* nodes, int32_t* nb, int32_t* na, int32_t* nt) noexcept;
void pstripack_bnodes_i8(int64_t n, const int64_t* list, const int64_t* lptr, const int64_t* lend,
    int64_t* nodes, int64_t* nb, int64_t* na, int64_t* nt) noexcept;

void pstripack_trfind_r4(int32_t nst, const float* p, int32_t n, const float* x, const float* y,
    const float* z, const int32_t* list, const int32_t* lptr, const int32_t* lend, float* b1, float* b2,
    float* b3, int32_t* i1, int32_t* i2, int32_t* i3) noexcept;
void pstripack_trfind_r8(int32_t nst, const double* p, int32_t n, const double* x, const double* y,
    const double* z, const int32_t* list, const int32_t* lptr, const int32_t* lend, double* b1, double* b2,
    double* b3, int32_t* i1, int32_t* i2, int32_t* i3) noexcept;
void pstripack_trfind_i8(int64_t nst, const double* p, int64_t n, const double* x, const double* y,
    const double* z, const int64_t* list, const int64_t* lptr, const int64_t* lend, double* b1, double* b2,
    double* b3, int64_t* i1, int64_t* i2, int64_t* i3) noexcept;

int32_t pstripack_nearnd_r4(const float* p, int32_t ist, int32_t n, const float* x, const float* y,
    const float* z, const int32_t* list, const int32_t* lptr, const int32_t* lend, float* al) noexcept;
int32_t pstripack_nearnd_r8(const double* p, int32_t ist, int32_t n, const double* x, const double* y,
    const double* z, const int32_t* list, const int32_t* lptr, const int32_t* lend, double* al) noexcept;
int64_t pstripack_nearnd_i8(const double* p, int64_t ist, int64_t n, const double* x, const double* y,
    const double* z, const int64_t* list, const int64_t* lptr, const int64_t* lend, double* al) noexcept;

void pstripack_getnp_r4(const float* x, const float* y, const float* z, const int32_t* list,
    const int32_t* lptr, const int32_t* lend, int32_t l, int32_t* npts, float* df, int32_t* ier) noexcept;
void pstripack_getnp_r8(const double* x, const double* y, const double* z, const int32_t* list,
    const int32_t* lptr, const int32_t* lend, int32_t l, int32_t* npts, double* df, int32_t* ier) noexcept;
void pstripack_getnp_i8(const double* x, const double* y, const double* z, const int64_t* list,
    const int64_t* lptr, const int64_t* lend, int64_t l, int64_t* npts, double* df, int64_t* ier) noexcept;

int32_t pstripack_nbcnt_i4(int32_t lpl, const int32_t* lptr) noexcept;
int64_t pstripack_nbcnt_i8(int64_t lpl, const int64_t* lptr) noexcept;

int32_t pstripack_lstptr_i4(int32_t lpl, int32_t nb, const int32_t* list, const int32_t* lptr) noexcept;
int64_t pstripack_lstptr_i8(int64_t lpl, int64_t nb, const int64_t* list, const int64_t* lptr) noexcept;

void pstripack_addnod_r4(int32_t nst, int32_t k, const float* x, const float* y, const float* z,
    int32_t* list, int32_t* lptr, int32_t* lend, int32_t* lnew, int32_t* ier) noexcept;
void pstripack_addnod_r8(int32_t nst, int32_t k, const double* x, const double* y, const double* z,
    int32_t* list, int32_t* lptr, int32_t* lend, int32_t* lnew, int32_t* ier) noexcept;
void pstripack_addnod_i8(int64_t nst, int64_t k, const double* x, const double* y, const double* z,
    int64_t* list, int64_t* lptr, int64_t* lend, int64_t* lnew, int64_t* ier) noexcept;

void pstripack_delarc_i4(int32_t n, int32_t io1, int32_t io2, int32_t* list, int32_t* lptr, int32_t* lend,
    int32_t* lnew, int32_t* ier) noexcept;
void pstripack_delarc_i8(int64_t n, int64_t io1, int64_t io2, int64_t* list, int64_t* lptr, int64_t* lend,
    int64_t* lnew, int64_t* ier) noexcept;

void pstripack_optim_r4(const float* x, const float* y, const float* z, int32_t na, int32_t* list,
    int32_t* lptr, int32_t* lend, int32_t* nit, int32_t* iwk, int32_t* ier) noexcept;
void pstripack_optim_r8(const double* x, const double* y, const double* z, int32_t na, int32_t* list,
    int32_t* lptr, int32_t* lend, int32_t* nit, int32_t* iwk, int32_t* ier) noexcept;
void pstripack_optim_i8(const double* x, const double* y, const double* z, int64_t na, int64_t* list,
    int64_t* lptr, int64_t* lend, int64_t* nit, int64_t* iwk, int64_t* ier) noexcept;

void pstripack_intadd_i4(int32_t kk, int32_t i1, int32_t i2, int32_t i3, int32_t* list, int32_t* lptr,
    int32_t* lend, int32_t* lnew) noexcept;
void pstripack_intadd_i8(int64_t kk, int64_t i1, int64_t i2, int64_t i3, int64_t* list, int64_t* lptr,
    int64_t* lend, int64_t* lnew) noexcept;

void pstripack_bdyadd_i4(int32_t kk, int32_t i1, int32_t i2, int32_t* list, int32_t* lptr, int32_t* lend,
    int32_t* lnew) noexcept;
void pstripack_bdyadd_i8(int64_t kk, int64_t i1, int64_t i2, int64_t* list, int64_t* lptr, int64_t* lend,
    int64_t* lnew) noexcept;

void pstripack_covsph_i4(int32_t kk, int32_t n0, int32_t* list, int32_t* lptr, int32_t* lend, int32_t* lnew)
    noexcept;
void pstripack_covsph_i8(int64_t kk, int64_t n0, int64_t* list, int64_t* lptr, int64_t* lend, int64_t* lnew)
    noexcept;

void pstripack_insert_i4(int32_t k, int32_t lp, int32_t* list, int32_t* lptr, int32_t* lnew) noexcept;
void pstripack_insert_i8(int64_t k, int64_t lp, int64_t* list, int64_t* lptr, int64_t* lnew) noexcept;

void pstripack_delnb_i4(int32_t n0, int32_t nb, int32_t n, int32_t* list, int32_t* lptr, int32_t* lend,
    int32_t* lnew, int32_t* lph) noexcept;
void pstripack_delnb_i8(int64_t n0, int64_t nb, int64_t n, int64_t* list, int64_t* lptr, int64_t* lend,
    int64_t* lnew, int64_t* lph) noexcept;

void pstripack_swap_i4(int32_t in1, int32_t in2, int32_t io1, int32_t io2, int32_t* list, int32_t* lptr,
    int32_t* lend, int32_t* lp21) noexcept;
void pstripack_swap_i8(int64_t in1, int64_t in2, int64_t io1, int64_t io2, int64_t* list, int64_t* lptr,
    int64_t* lend, int64_t* lp21) noexcept;

int32_t pstripack_swptst_r4(int32_t n1, int32_t n2, int32_t n3, int32_t n4, const float* x, const float* y,
    const float* z) noexcept;
int32_t pstripack_swptst_r8(int32_t n1, int32_t n2, int32_t n3, int32_t n4, const double* x, const double* y,
    const double* z) noexcept;
int64_t pstripack_swptst_i8(int64_t n1, int64_t n2, int64_t n3, int64_t n4, const double* x, const double* y,
    const double* z) noexcept;

void pstripack_crlist_r4(int32_t n, int32_t ncol, const float* x, const float* y, const float* z,
    const int32_t* list, const int32_t* lend, int32_t* lptr, int32_t* lnew, int32_t* ltri, int32_t* listc,
    int32_t* nb, float* xc, float* yc, float* zc, float* rc, int32_t* ier) noexcept;
void pstripack_crlist_r8(int32_t n, int32_t ncol, const double* x, const double* y, const double* z,
    const int32_t* list, const int32_t* lend, int32_t* lptr, int32_t* lnew, int32_t* ltri, int32_t* listc,
    int32_t* nb, double* xc, double* yc, double* zc, double* rc, int32_t* ier) noexcept;
void pstripack_crlist_i8(int64_t n, int64_t ncol, const double* x, const double* y, const double* z,
    const int64_t* list, const int64_t* lend, int64_t* lptr, int64_t* lnew, int64_t* ltri, int64_t* listc,
    int64_t* nb, double* xc, double* yc, double* zc, double* rc, int64_t* ier) noexcept;

void pstripack_circum_r4(const float* v1, const float* v2, const float* v3, float* c, int32_t* ier) noexcept;
void pstripack_circum_r8(const double* v1, const double* v2, const double* v3, double* c, int32_t* ier)
    noexcept;
void pstripack_circum_i8(const double* v1, const double* v2, const double* v3, double* c, int64_t* ier)
    noexcept;

void pstripack_trans_r4(int32_t n, const float* rlat, const float* rlon, float* x, float* y, float* z)
    noexcept;
void pstripack_trans_r8(int32_t n, const double* rlat, const double* rlon, double* x, double* y, double* z)
    noexcept;
void pstripack_trans_i8(int64_t n, const double* rlat, const double* rlon, double* x, double* y, double* z)
    noexcept;

void pstripack_scoord_r4(float px, float py, float pz, float* plat, float* plon, float* pnrm) noexcept;
void pstripack_scoord_r8(double px, double py, double pz, double* plat, double* plon, double* pnrm) noexcept;
void pstripack_scoord_i8(double px, double py, double pz, double* plat, double* plon, double* pnrm) noexcept;

float pstripack_areas_r4(const float* v1, const float* v2, const float* v3) noexcept;
double pstripack_areas_r8(const double* v1, const double* v2, const double* v3) noexcept;
double pstripack_areas_i8(const double* v1, const double* v2, const double* v3) noexcept;

void pstripack_triareas_r4(int32_t n, const float* x, const float* y, const float* z, int32_t nt,
    const int32_t* triangles, float* triarea) noexcept;
void pstripack_triareas_r8(int32_t n, const double* x, const double* y, const double* z, int32_t nt,
    const int32_t* triangles, double* triarea) noexcept;
void pstripack_triareas_i8(int64_t n, const double* x, const double* y, const double* z, int64_t nt,
    const int64_t* triangles, double* triarea) noexcept;

int32_t pstripack_left_r4(float x1, float y1, float z1, float x2, float y2, float z2, float x0, float y0,
    float z0) noexcept;
int32_t pstripack_left_r8(double x1, double y1, double z1, double x2, double y2, double z2, double x0,
    double y0, double z0) noexcept;
int64_t pstripack_left_i8(double x1, double y1, double z1, double x2, double y2, double z2, double x0,
    double y0, double z0) noexcept;

int32_t pstripack_inside_r4(const float* p, int32_t lv, const float* xv, const float* yv, const float* zv,
    int32_t nv, const int32_t* listv, int32_t* ier) noexcept;
int32_t pstripack_inside_r8(const double* p, int32_t lv, const double* xv, const double* yv, const double* zv,
    int32_t nv, const int32_t* listv, int32_t* ier) noexcept;
int64_t pstripack_inside_i8(const double* p, int64_t lv, const double* xv, const double* yv, const double* zv,
    int64_t nv, const int64_t* listv, int64_t* ier) noexcept;

void pstripack_intrsc_r4(const float* p1, const float* p2, const float* cn, float* p, int32_t* ier) noexcept;
void pstripack_intrsc_r8(const double* p1, const double* p2, const double* cn, double* p, int32_t* ier)
    noexcept;
void pstripack_intrsc_i8(const double* p1, const double* p2, const double* cn, double* p, int64_t* ier)
    noexcept;

}
#pragma GCC visibility pop
