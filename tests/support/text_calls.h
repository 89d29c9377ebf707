#pragma once
// The routines of STRIPACK that print, as C functions that the libraries libstripack* call. Internal to
// PSTRIPACK, not installed. The suffix names the kinds: _r4, _r8 reals of 32 and 64 bits, with integers of 32
// bits; _i8 reals and integers of 64 bits; _i4, _i8 without reals.
//
// Only a Fortran procedure can write to a Fortran unit. So each function composes the whole text that its
// routine prints and returns a handle of it, or NULL; the caller takes it record by record and frees it.
// Nothing is written here but one line on stderr where memory runs out (the handle is then NULL) and for a
// negative ier.
//
//   trprnt, trlprt      f90: 1 for the layout of the Fortran 90 text, 0 for that of Algorithm 772
//   trplot, vrplot      ier: 0; 1 bad lun, pltsiz, n or nt; 2 bad elat, elon or a; -5 a point that is not
//                       finite or far from unit length; -6 out of memory; -13 not the lists of a
//                       triangulation or Voronoi diagram. NULL unless 0. title[title_length]; numbr: 0 or not
//   voronoi_poly_count  needs no reals: _i4, _i8
//
//   number_at           the integer at `address`, where the caller may have passed none; -1 if it cannot be
//                       read, or if `address` is that of another argument: _i4, _i8
//
//   pstripack_next_record   copies the next record, without its end, to record[capacity]: the number of its
//                           characters, at most capacity; -1 after the last one, or if text is NULL
//   pstripack_free_text     text may be NULL
//
// A text belongs to one thread; different ones may be used at once.

#include <cstdint>
#include <string>

extern "C" {
std::int32_t pstripack_next_record(void* text, char* record, std::int32_t capacity) noexcept;
void pstripack_free_text(void* text) noexcept;
void* pstripack_voronoi_poly_count_i4(std::int32_t n, const std::int32_t* lend, const std::int32_t* lptr,
                                      const std::int32_t* listc) noexcept;
void* pstripack_voronoi_poly_count_i8(std::int64_t n, const std::int64_t* lend, const std::int64_t* lptr,
                                      const std::int64_t* listc) noexcept;
std::int32_t pstripack_number_at_i4(const std::int32_t* address, const std::int32_t* n,
                                    const std::int32_t* fifth, const std::int32_t* sixth,
                                    const std::int32_t* seventh, const std::int32_t* eighth) noexcept;
std::int64_t pstripack_number_at_i8(const std::int64_t* address, const std::int64_t* n,
                                    const std::int64_t* fifth, const std::int64_t* sixth,
                                    const std::int64_t* seventh, const std::int64_t* eighth) noexcept;

#define PRINT_CALLS(Real, Int, suffix)                                                                      \
  void* pstripack_trprnt_##suffix(Int n, const Real* x, const Real* y, const Real* z, Int iflag,            \
                                  const Int* list, const Int* lptr, const Int* lend, Int f90) noexcept;     \
  void* pstripack_trlprt_##suffix(Int n, const Real* x, const Real* y, const Real* z, Int iflag, Int nrow,  \
                                  Int nt, const Int* ltri, Int f90) noexcept;                               \
  void* pstripack_trplot_##suffix(Int lun, Real pltsiz, Real elat, Real elon, Real a, Int n, const Real* x, \
                                  const Real* y, const Real* z, const Int* list, const Int* lptr,           \
                                  const Int* lend, const char* title, Int title_length, Int numbr,          \
                                  Int* ier) noexcept;                                                       \
  void* pstripack_vrplot_##suffix(Int lun, Real pltsiz, Real elat, Real elon, Real a, Int n, const Real* x, \
                                  const Real* y, const Real* z, Int nt, const Int* listc, const Int* lptr,  \
                                  const Int* lend, const Real* xc, const Real* yc, const Real* zc,          \
                                  const char* title, Int title_length, Int numbr, Int* ier) noexcept;
PRINT_CALLS(float, std::int32_t, r4)
PRINT_CALLS(double, std::int32_t, r8)
PRINT_CALLS(double, std::int64_t, i8)
#undef PRINT_CALLS
}

/// The text of a handle; frees the handle.
inline std::string text_of(void* handle) {
  std::string text;
  char record[400];
  for (int length; (length = pstripack_next_record(handle, record, sizeof record)) >= 0;)
    text.append(record, static_cast<std::size_t>(length)) += '\n';
  pstripack_free_text(handle);
  return text;
}
