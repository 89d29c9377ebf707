// The routines of STRIPACK as C functions, called by the libraries libstripack*. They are exported from
// libpstripack, to which those libraries are linked. TRMESH itself is pstripack_trmesh of pstripack.h.
//
// Arguments and results are those of the routine of the same name, with inputs by value; see docs/api and
// the headers of src/cxx/stripack. Node and slot numbers count from 1. No function is collective, writes to
// stdout or throws. None keeps state, except the random seeds of each thread if PSTRIPACK_ORDER is not
// canonical. A negative ier prints one line on stderr.
//
// The suffix gives the kinds: _r4, _r8 reals of 32 and 64 bits, with integers of 32 bits; _i8 reals and
// integers of 64 bits; _i4, _i8 integers, without reals. Further kinds need further instances of the
// macros. The declarations in plain_calls.h and those for Fortran are made from docs/api/routines.

#include <stdint.h>

#include <cstdio>

#include "base/floating_point.h"
#include "capi/plain_calls.h"
#include "capi/pstripack.h"
#include "stripack/coordinates_and_areas.h"
#include "stripack/list_queries.h"
#include "stripack/original/original_rules.h"
#include "stripack/polygon.h"
#include "stripack/random.h"
#include "stripack/search.h"
#include "stripack/triangle_list.h"
#include "stripack/voronoi.h"

namespace {

using namespace pstripack;

template <class Int>
ListsView<Int> view(Int n, const Int* list, const Int* lptr, const Int* lend) {
  return {static_cast<std::size_t>(n), list, lptr, lend, 0};
}

template <class Real>
Vector<Real> vector(const Real* v) {
  return {v[0], v[1], v[2]};
}

/// The one catch-all: runs call() and returns its code, or -6 for an exception, since only the allocator
/// throws. For a negative code prints the reason on stderr. n = 0: the routine is not told N. call() must
/// set the floating-point environment that it needs.
template <class Call>
int caught(const char* routine, long long n, const Call& call) {
  int code = PSTRIPACK_OUT_OF_MEMORY;
  try {
    code = static_cast<int>(call());
  } catch (...) {  // only std::bad_alloc is possible
  }
  const char* const why = pstripack_strerror(code);
  if (code < 0 && n > 0)
    std::fprintf(stderr, "pstripack: %s: IER = %d, N = %lld: %s\n", routine, code, n, why);
  if (code < 0 && n == 0) std::fprintf(stderr, "pstripack: %s: IER = %d: %s\n", routine, code, why);
  return code;
}

/// The same for a call that needs the default floating-point environment throughout.
template <class Call>
int code_of(const char* routine, long long n, const Call& call) {
  return caught(routine, n, [&] { return in_default_floating_point(call); });
}

template <class Int>
Int triangles(const char* routine, Int n, const Int* list, const Int* lptr, const Int* lend, int rows,
              Int* nt, Int* ltri) {
  *nt = 0;
  return code_of(routine, n, [&] { return triangle_list(view(n, list, lptr, lend), rows, *nt, ltri); });
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

#define LIST_CALLS(Int, suffix)                                                                        \
  Int pstripack_lstptr_##suffix(Int lpl, Int nb, const Int* list, const Int* lptr) noexcept {          \
    return lstptr(lpl, nb, list, lptr);                                                                \
  }                                                                                                    \
  Int pstripack_nbcnt_##suffix(Int lpl, const Int* lptr) noexcept { return nbcnt(lpl, lptr); }         \
  void pstripack_bnodes_##suffix(Int n, const Int* list, const Int* lptr, const Int* lend, Int* nodes, \
                                 Int* nb, Int* na, Int* nt) noexcept {                                 \
    const BoundaryCounts<Int> counts = boundary_nodes(view(n, list, lptr, lend), nodes);               \
    *nb = counts.boundary_nodes;                                                                       \
    *na = counts.arcs;                                                                                 \
    *nt = counts.triangles;                                                                            \
  }                                                                                                    \
  void pstripack_trlist_##suffix(Int n, const Int* list, const Int* lptr, const Int* lend, Int nrow,   \
                                 Int* nt, Int* ltri, Int* ier) noexcept {                              \
    const int rows = nrow == 6 || nrow == 9 ? static_cast<int>(nrow) : 0;                              \
    *ier = triangles("TRLIST", n, list, lptr, lend, rows, nt, ltri);                                   \
  }                                                                                                    \
  void pstripack_trlist2_##suffix(Int n, const Int* list, const Int* lptr, const Int* lend, Int* nt,   \
                                  Int* ltri, Int* ier) noexcept {                                      \
    *ier = triangles("TRLIST2", n, list, lptr, lend, 3, nt, ltri);                                     \
  }

#define NODE_CALLS(Real, Int, suffix)                                                                        \
  void pstripack_trans_##suffix(Int n, const Real* rlat, const Real* rlon, Real* x, Real* y,                 \
                                Real* z) noexcept {                                                          \
    in_default_floating_point([&] { trans(n, rlat, rlon, x, y, z); });                                       \
  }                                                                                                          \
  void pstripack_scoord_##suffix(Real px, Real py, Real pz, Real* plat, Real* plon, Real* pnrm) noexcept {   \
    const Vector<Real> v{px, py, pz};                                                                        \
    const auto p = in_default_floating_point([&] { return scoord(v); });                                     \
    *plat = p.latitude;                                                                                      \
    *plon = p.longitude;                                                                                     \
    *pnrm = p.norm;                                                                                          \
  }                                                                                                          \
  Int pstripack_left_##suffix(Real x1, Real y1, Real z1, Real x2, Real y2, Real z2, Real x0, Real y0,        \
                              Real z0) noexcept {                                                            \
    const Vector<Real> a{x1, y1, z1}, b{x2, y2, z2}, p{x0, y0, z0};                                          \
    return in_default_floating_point([&] { return closed_left(a, b, p); }) ? 1 : 0;                          \
  }                                                                                                          \
  Real pstripack_areas_##suffix(const Real* v1, const Real* v2, const Real* v3) noexcept {                   \
    return in_default_floating_point([&] { return areas(vector(v1), vector(v2), vector(v3)); });             \
  }                                                                                                          \
  void pstripack_circum_##suffix(const Real* v1, const Real* v2, const Real* v3, Real* c,                    \
                                 Int* ier) noexcept {                                                        \
    Vector<Real> centre;                                                                                     \
    *ier = code_of("CIRCUM", 0, [&] {                                                                        \
      if (!is_finite(vector(v1)) || !is_finite(vector(v2)) || !is_finite(vector(v3)))                        \
        return int{PSTRIPACK_BAD_COORDINATE};                                                                \
      return circumcentre(vector(v1), vector(v2), vector(v3), centre) ? 0 : 1;                               \
    });                                                                                                      \
    if (*ier != 0) return;                                                                                   \
    c[0] = centre.x;                                                                                         \
    c[1] = centre.y;                                                                                         \
    c[2] = centre.z;                                                                                         \
  }                                                                                                          \
  void pstripack_triareas_##suffix(Int n, const Real* x, const Real* y, const Real* z, Int nt,               \
                                   const Int* triangles, Real* triarea) noexcept {                           \
    in_default_floating_point([&] { triangle_areas(n, Nodes<Real>{x, y, z}, nt, triangles, triarea); });     \
  }                                                                                                          \
  void pstripack_crlist_##suffix(Int n, Int ncol, const Real* x, const Real* y, const Real* z,               \
                                 const Int* list, const Int* lend, Int* lptr, Int* lnew, Int* ltri,          \
                                 Int* listc, Int* nb, Real* xc, Real* yc, Real* zc, Real* rc,                \
                                 Int* ier) noexcept {                                                        \
    const VoronoiArrays<Real, Int> out{ncol, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc};                   \
    *ier = code_of("CRLIST", n, [&] {                                                                        \
      return voronoi(view(n, list, lptr, lend), Nodes<Real>{x, y, z}, out);                                  \
    });                                                                                                      \
  }                                                                                                          \
  void pstripack_trfind_##suffix(Int nst, const Real* p, Int n, const Real* x, const Real* y, const Real* z, \
                                 const Int* list, const Int* lptr, const Int* lend, Real* b1, Real* b2,      \
                                 Real* b3, Int* i1, Int* i2, Int* i3) noexcept {                             \
    Location<Int> found{0, 0, 0};                                                                            \
    code_of("TRFIND", n, [&] {                                                                               \
      found = trfind(nst, vector(p), view(n, list, lptr, lend), Nodes<Real>{x, y, z}, *b1, *b2, *b3);        \
      return 0;                                                                                              \
    });                                                                                                      \
    *i1 = found.i1;                                                                                          \
    *i2 = found.i2;                                                                                          \
    *i3 = found.i3;                                                                                          \
  }                                                                                                          \
  Int pstripack_nearnd_##suffix(const Real* p, Int ist, Int n, const Real* x, const Real* y, const Real* z,  \
                                const Int* list, const Int* lptr, const Int* lend, Real* al) noexcept {      \
    Int nearest = 0;                                                                                         \
    code_of("NEARND", n, [&] {                                                                               \
      nearest = nearnd(vector(p), ist, view(n, list, lptr, lend), Nodes<Real>{x, y, z}, *al);                \
      return 0;                                                                                              \
    });                                                                                                      \
    return nearest;                                                                                          \
  }                                                                                                          \
  void pstripack_getnp_##suffix(const Real* x, const Real* y, const Real* z, const Int* list,                \
                                const Int* lptr, const Int* lend, Int l, Int* npts, Real* df,                \
                                Int* ier) noexcept {                                                         \
    const ListsView<Int> lists = view(Int{0}, list, lptr, lend);                                             \
    *ier = caught("GETNP", 0, [&] { return next_nearest(lists, Nodes<Real>{x, y, z}, l, npts, *df); });      \
  }                                                                                                          \
  Int pstripack_inside_##suffix(const Real* p, Int lv, const Real* xv, const Real* yv, const Real* zv,       \
                                Int nv, const Int* listv, Int* ier) noexcept {                               \
    bool result = false;                                                                                     \
    *ier = code_of("INSIDE", 0, [&] {                                                                        \
      return inside(vector(p), lv, Nodes<Real>{xv, yv, zv}, nv, listv, result);                              \
    });                                                                                                      \
    return result ? 1 : 0;                                                                                   \
  }                                                                                                          \
  void pstripack_intrsc_##suffix(const Real* p1, const Real* p2, const Real* cn, Real* p,                    \
                                 Int* ier) noexcept {                                                        \
    Vector<Real> point;                                                                                      \
    *ier = code_of("INTRSC", 0, [&] { return intersection(vector(p1), vector(p2), vector(cn), point); });    \
    if (*ier != 0) return;                                                                                   \
    p[0] = point.x;                                                                                          \
    p[1] = point.y;                                                                                          \
    p[2] = point.z;                                                                                          \
  }                                                                                                          \
  Int pstripack_jrand_##suffix(Int n, Int* ix, Int* iy, Int* iz) noexcept {                                  \
    Seeds<Int> seeds{*ix, *iy, *iz};                                                                         \
    const Int drawn = in_default_floating_point([&] { return original_rules().random<Real>(n, seeds); });    \
    *ix = seeds.x;                                                                                           \
    *iy = seeds.y;                                                                                           \
    *iz = seeds.z;                                                                                           \
    return drawn;                                                                                            \
  }

LIST_CALLS(int32_t, i4)
LIST_CALLS(int64_t, i8)
NODE_CALLS(float, int32_t, r4)
NODE_CALLS(double, int32_t, r8)
NODE_CALLS(double, int64_t, i8)

}  // extern "C"
#pragma GCC visibility pop
