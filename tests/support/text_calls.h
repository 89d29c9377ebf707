/* The routines of STRIPACK that print, as C functions: what the libraries libstripack* call. Internal to
 * PSTRIPACK, not installed; see stripack_calls.h for names and kinds.
 *
 * Only a Fortran procedure can write to a Fortran unit. So each function composes the whole text that its
 * routine prints and returns a handle of it, or NULL; the caller takes it record by record and frees it.
 * Nothing is written here but one line on stderr where memory runs out (the handle is then NULL) and for a
 * negative ier.
 *
 *   trprnt, trlprt      f90: 1 for the layout of the Fortran 90 text, 0 for that of Algorithm 772
 *   trplot, vrplot      ier: 0; 1 bad lun, pltsiz, n or nt; 2 bad elat, elon or a; -5 a point that is not
 *                       finite or far from unit length; -6 out of memory; -13 not the lists of a triangulation
 *                       or Voronoi diagram. NULL unless 0. title[title_length]; numbr: 0 or not
 *   voronoi_poly_count  needs no reals: _i4, _i8
 *
 *   pstripack_number_at     what `address` points to, for an argument that may not have been passed; -1 if it
 *                           cannot be read, or is the address of another argument: n and the 5th to 8th
 *   pstripack_next_record   copies the next record, without its end, to record[capacity]: the number of its
 *                           characters, at most capacity; -1 after the last one, or if text is NULL
 *   pstripack_free_text     text may be NULL
 *
 * A text belongs to one thread; different ones may be used at once.
 */
#ifndef PSTRIPACK_TEXT_CALLS_H
#define PSTRIPACK_TEXT_CALLS_H

#include "support/stripack_calls.h"

#ifdef __cplusplus
extern "C" {
#endif

PSTRIPACK_CALL(int32_t) pstripack_next_record(void* text, char* record, int32_t capacity) PSTRIPACK_NOEXCEPT;
PSTRIPACK_CALL(void) pstripack_free_text(void* text) PSTRIPACK_NOEXCEPT;

#define PSTRIPACK_PRINT_CALLS(Real, Int, suffix)                                                             \
  PSTRIPACK_CALL(void*)                                                                                      \
  pstripack_trprnt_##suffix(Int n, const Real* x, const Real* y, const Real* z, Int iflag, const Int* list,  \
                            const Int* lptr, const Int* lend, Int f90) PSTRIPACK_NOEXCEPT;                   \
  PSTRIPACK_CALL(void*)                                                                                      \
  pstripack_trlprt_##suffix(Int n, const Real* x, const Real* y, const Real* z, Int iflag, Int nrow, Int nt, \
                            const Int* ltri, Int f90) PSTRIPACK_NOEXCEPT;                                    \
  PSTRIPACK_CALL(void*)                                                                                      \
  pstripack_trplot_##suffix(Int lun, Real pltsiz, Real elat, Real elon, Real a, Int n, const Real* x,        \
                            const Real* y, const Real* z, const Int* list, const Int* lptr, const Int* lend, \
                            const char* title, Int title_length, Int numbr, Int* ier) PSTRIPACK_NOEXCEPT;    \
  PSTRIPACK_CALL(void*)                                                                                      \
  pstripack_vrplot_##suffix(Int lun, Real pltsiz, Real elat, Real elon, Real a, Int n, const Real* x,        \
                            const Real* y, const Real* z, Int nt, const Int* listc, const Int* lptr,         \
                            const Int* lend, const Real* xc, const Real* yc, const Real* zc,                 \
                            const char* title, Int title_length, Int numbr, Int* ier) PSTRIPACK_NOEXCEPT;

#define PSTRIPACK_COUNT_CALLS(Int, suffix)                                                           \
  PSTRIPACK_CALL(Int)                                                                                \
  pstripack_number_at_##suffix(const Int* address, const Int* n, const Int* fifth, const Int* sixth, \
                               const Int* seventh, const Int* eighth) PSTRIPACK_NOEXCEPT;            \
  PSTRIPACK_CALL(void*)                                                                              \
  pstripack_voronoi_poly_count_##suffix(Int n, const Int* lend, const Int* lptr, const Int* listc)   \
      PSTRIPACK_NOEXCEPT;

PSTRIPACK_PRINT_CALLS(float, int32_t, r4)
PSTRIPACK_PRINT_CALLS(double, int32_t, r8)
PSTRIPACK_PRINT_CALLS(double, int64_t, i8)
PSTRIPACK_COUNT_CALLS(int32_t, i4)
PSTRIPACK_COUNT_CALLS(int64_t, i8)

#ifdef __cplusplus
}
#endif
#endif
