// The routines of STRIPACK that change a triangulation, as C functions: as in stripack_calls.cpp, but
// arguments that the routine changes are passed by pointer. Codes that STRIPACK does not have (below
// -2) print one line on stderr. edge, delnod: if optim failed, *nit and *optim_ier are what it returned;
// else they are not written.

#include <stdint.h>

#include <cstdio>

#include "base/floating_point.h"
#include "capi/plain_calls.h"
#include "capi/pstripack.h"
#include "stripack/arc_edit.h"
#include "stripack/list_edit.h"
#include "stripack/node_edit.h"

namespace {

using namespace pstripack;

/// Returns the code. If STRIPACK does not have it, prints the reason on stderr.
template <class Status>
int said(const char* routine, Status status, const char* why = nullptr) {
  const int ier = static_cast<int>(status);
  if (ier < PSTRIPACK_COLLINEAR)
    std::fprintf(stderr, "pstripack: %s: code %d: %s\n", routine, ier,
                 why != nullptr ? why : pstripack_strerror(ier));
  return ier;
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

#define LIST_EDIT_CALLS(Int, suffix)                                                                       \
  void pstripack_insert_##suffix(Int k, Int lp, Int* list, Int* lptr, Int* lnew) noexcept {                \
    said("INSERT", insert(k, lp, {std::numeric_limits<Int>::max(), list, lptr, nullptr, lnew}));           \
  }                                                                                                        \
  void pstripack_intadd_##suffix(Int kk, Int i1, Int i2, Int i3, Int* list, Int* lptr, Int* lend,          \
                                 Int* lnew) noexcept {                                                     \
    said("INTADD", intadd(i1, i2, i3, {kk, list, lptr, lend, lnew}));                                      \
  }                                                                                                        \
  void pstripack_bdyadd_##suffix(Int kk, Int i1, Int i2, Int* list, Int* lptr, Int* lend,                  \
                                 Int* lnew) noexcept {                                                     \
    said("BDYADD", bdyadd(i1, i2, {kk, list, lptr, lend, lnew}));                                          \
  }                                                                                                        \
  void pstripack_covsph_##suffix(Int kk, Int n0, Int* list, Int* lptr, Int* lend, Int* lnew) noexcept {    \
    said("COVSPH", covsph(n0, {kk, list, lptr, lend, lnew}));                                              \
  }                                                                                                        \
  void pstripack_swap_##suffix(Int in1, Int in2, Int io1, Int io2, Int* list, Int* lptr, Int* lend,        \
                               Int* lp21) noexcept {                                                       \
    const int ier = said(                                                                                  \
        "SWAP", swap(in1, in2, io1, io2, EditedLists<Int>::unbounded(list, lptr, lend), *lp21),            \
        "the lists do not contain triangles (IO1,IO2,IN1) and (IO2,IO1,IN2), in this order of the nodes"); \
    if (ier != 0) *lp21 = ier;                                                                             \
  }                                                                                                        \
  void pstripack_delnb_##suffix(Int n0, Int nb, Int n, Int* list, Int* lptr, Int* lend, Int* lnew,         \
                                Int* lph) noexcept {                                                       \
    const int ier = said("DELNB", delnb(n0, nb, {n, list, lptr, lend, lnew}, *lph));                       \
    if (ier != 0) *lph = ier;                                                                              \
  }                                                                                                        \
  void pstripack_delarc_##suffix(Int n, Int io1, Int io2, Int* list, Int* lptr, Int* lend, Int* lnew,      \
                                 Int* ier) noexcept {                                                      \
    *ier = said("DELARC", delarc(io1, io2, {n, list, lptr, lend, lnew}));                                  \
  }

#define NODE_EDIT_CALLS(Real, Int, suffix)                                                                  \
  Int pstripack_swptst_##suffix(Int n1, Int n2, Int n3, Int n4, const Real* x, const Real* y,               \
                                const Real* z) noexcept {                                                   \
    return in_default_floating_point([&] { return swptst(n1, n2, n3, n4, Nodes<Real>{x, y, z}); }) ? 1 : 0; \
  }                                                                                                         \
  void pstripack_optim_##suffix(const Real* x, const Real* y, const Real* z, Int na, Int* list, Int* lptr,  \
                                Int* lend, Int* nit, Int* iwk, Int* ier) noexcept {                         \
    *ier = said(                                                                                            \
        "OPTIM", in_default_floating_point([&] {                                                            \
          return optim(Nodes<Real>{x, y, z}, na, EditedLists<Int>::unbounded(list, lptr, lend), *nit, iwk); \
        }));                                                                                                \
  }                                                                                                         \
  void pstripack_edge_##suffix(Int in1, Int in2, const Real* x, const Real* y, const Real* z, Int* lwk,     \
                               Int* iwk, Int* list, Int* lptr, Int* lend, Int* ier, Int* nit,               \
                               Int* optim_ier) noexcept {                                                   \
    OptimFailure<Int> failure;                                                                              \
    *ier = said("EDGE", in_default_floating_point([&] {                                                     \
                  return edge(in1, in2, Nodes<Real>{x, y, z}, *lwk, iwk,                                    \
                              EditedLists<Int>::unbounded(list, lptr, lend), failure);                      \
                }));                                                                                        \
    if (failure.ier == 0) return;                                                                           \
    *nit = failure.nit;                                                                                     \
    *optim_ier = failure.ier;                                                                               \
  }                                                                                                         \
  void pstripack_addnod_##suffix(Int nst, Int k, const Real* x, const Real* y, const Real* z, Int* list,    \
                                 Int* lptr, Int* lend, Int* lnew, Int* ier) noexcept {                      \
    *ier = in_default_floating_point([&] {                                                                  \
      return addnod(nst, Nodes<Real>{x, y, z}, EditedLists<Int>{k, list, lptr, lend, lnew});                \
    });                                                                                                     \
    if (*ier < 0) *ier = said("ADDNOD", *ier);                                                              \
  }                                                                                                         \
  void pstripack_delnod_##suffix(Int k, Int* n, Real* x, Real* y, Real* z, Int* list, Int* lptr, Int* lend, \
                                 Int* lnew, Int* lwk, Int* iwk, Int* ier, Int* nit,                         \
                                 Int* optim_ier) noexcept {                                                 \
    OptimFailure<Int> failure;                                                                              \
    *ier = said("DELNOD", in_default_floating_point([&] {                                                   \
                  return delnod(k, *n, x, y, z, {*n, list, lptr, lend, lnew}, *lwk, iwk, failure);          \
                }));                                                                                        \
    if (failure.ier == 0) return;                                                                           \
    *nit = failure.nit;                                                                                     \
    *optim_ier = failure.ier;                                                                               \
  }

LIST_EDIT_CALLS(int32_t, i4)
LIST_EDIT_CALLS(int64_t, i8)
NODE_EDIT_CALLS(float, int32_t, r4)
NODE_EDIT_CALLS(double, int32_t, r8)
NODE_EDIT_CALLS(double, int64_t, i8)

}  // extern "C"
#pragma GCC visibility pop
