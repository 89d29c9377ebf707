// The routines of STRIPACK that print, as C functions; see stripack_calls.cpp. Only a Fortran procedure can
// write to a Fortran unit. So each function composes the whole text that its routine prints, and returns a
// handle of the text or NULL. The caller takes the text record by record and frees it. A text may be used
// by one thread at a time.

#include <stdint.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <string_view>

#include "base/floating_point.h"
#include "base/system.h"
#include "capi/pstripack.h"
#include "stripack/listing.h"
#include "stripack/postscript.h"

namespace {

using namespace pstripack;

/// A handle points to this.
struct Text {
  FormattedText records;
  std::size_t taken = 0;  ///< number of characters taken so far
};

/// The one catch-all: calls compose(records) in the default floating-point environment and returns a handle
/// of the text. Null, with one line on stderr, if it throws, which only the allocator does.
template <class Compose>
void* composed(const char* routine, const Compose& compose) {
  try {
    auto text = std::make_unique<Text>();
    in_default_floating_point([&] { compose(text->records); });
    return text.release();
  } catch (...) {
    std::fprintf(stderr, "pstripack: %s: out of memory\n", routine);
    return nullptr;
  }
}

/// The same for a picture, which has an IER; null unless IER is 0.
template <class Int, class Compose>
void* picture(const char* routine, Int& ier, const Compose& compose) {
  PlotStatus status = PlotStatus::done;
  void* text = composed(routine, [&](FormattedText& out) { status = compose(out); });
  ier = text == nullptr ? Int{PSTRIPACK_OUT_OF_MEMORY} : static_cast<Int>(status);
  if (text != nullptr && ier < 0)
    std::fprintf(stderr, "pstripack: %s: IER = %d: %s\n", routine, static_cast<int>(ier),
                 ier == PSTRIPACK_BAD_COORDINATE ? "a point is not finite, or far from the unit sphere"
                                                 : pstripack_strerror(static_cast<int>(ier)));
  if (ier == 0) return text;
  delete static_cast<Text*>(text);
  return nullptr;
}

/// The number at `address`, for an argument that the caller may not have passed. -1 if the address cannot
/// be read, or is that of another argument. It is read by a system call, which fails where a load would end
/// the program.
template <class Int>
Int number_at(const Int* address, std::initializer_list<const Int*> other_arguments) {
  Int number = -1;
  int ends[2];
  if (std::count(other_arguments.begin(), other_arguments.end(), address) > 0 || !open_stream(ends))
    return -1;
  const bool readable = write_unchecked(ends[1], address, sizeof number) == ssize_t{sizeof number} &&
                        read(ends[0], &number, sizeof number) == ssize_t{sizeof number};
  for (const int end : ends) close(end);
  return readable ? number : -1;
}

ListingForm form(bool f90) { return f90 ? ListingForm::f90 : ListingForm::f77; }

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

int32_t pstripack_next_record(void* handle, char* record, int32_t capacity) noexcept {
  if (handle == nullptr) return -1;
  Text& text = *static_cast<Text*>(handle);
  const std::string_view rest = std::string_view(text.records.text()).substr(text.taken);
  if (rest.empty()) return -1;
  const std::size_t length = rest.find('\n');
  const std::size_t copied = std::min(length, static_cast<std::size_t>(capacity));
  rest.copy(record, copied);
  text.taken += length + 1;
  return static_cast<int32_t>(copied);
}

void pstripack_free_text(void* text) noexcept { delete static_cast<Text*>(text); }

#define PRINT_CALLS(Real, Int, suffix)                                                                      \
  void* pstripack_trprnt_##suffix(Int n, const Real* x, const Real* y, const Real* z, Int iflag,            \
                                  const Int* list, const Int* lptr, const Int* lend, Int f90) noexcept {    \
    return composed("TRPRNT", [&](FormattedText& out) {                                                     \
      const ListsView<Int> lists{static_cast<std::size_t>(n), list, lptr, lend, 0};                         \
      list_neighbours(form(f90 != 0), iflag, lists, Nodes<Real>{x, y, z}, out);                             \
    });                                                                                                     \
  }                                                                                                         \
  void* pstripack_trlprt_##suffix(Int n, const Real* x, const Real* y, const Real* z, Int iflag, Int nrow,  \
                                  Int nt, const Int* ltri, Int f90) noexcept {                              \
    return composed("TRLPRT", [&](FormattedText& out) {                                                     \
      list_triangles(form(f90 != 0), n, iflag, Nodes<Real>{x, y, z}, nrow, nt, ltri, out);                  \
    });                                                                                                     \
  }                                                                                                         \
  void* pstripack_trplot_##suffix(Int lun, Real pltsiz, Real elat, Real elon, Real a, Int n, const Real* x, \
                                  const Real* y, const Real* z, const Int* list, const Int* lptr,           \
                                  const Int* lend, const char* title, Int title_length, Int numbr,          \
                                  Int* ier) noexcept {                                                      \
    const PlotFrame<Real, Int> frame{                                                                       \
        lun, pltsiz, elat, elon, a, {title, static_cast<std::size_t>(title_length)}, numbr != 0};           \
    return picture("TRPLOT", *ier, [&](FormattedText& out) {                                                \
      const ListsView<Int> lists{static_cast<std::size_t>(n), list, lptr, lend, 0};                         \
      return plot_triangulation(frame, lists, Nodes<Real>{x, y, z}, out);                                   \
    });                                                                                                     \
  }                                                                                                         \
  void* pstripack_vrplot_##suffix(Int lun, Real pltsiz, Real elat, Real elon, Real a, Int n, const Real* x, \
                                  const Real* y, const Real* z, Int nt, const Int* listc, const Int* lptr,  \
                                  const Int* lend, const Real* xc, const Real* yc, const Real* zc,          \
                                  const char* title, Int title_length, Int numbr, Int* ier) noexcept {      \
    const PlotFrame<Real, Int> frame{                                                                       \
        lun, pltsiz, elat, elon, a, {title, static_cast<std::size_t>(title_length)}, numbr != 0};           \
    return picture("VRPLOT", *ier, [&](FormattedText& out) {                                                \
      return plot_voronoi(frame, n, Nodes<Real>{x, y, z}, nt, listc, lptr, lend, Nodes<Real>{xc, yc, zc},   \
                          out);                                                                             \
    });                                                                                                     \
  }

#define COUNT_CALLS(Int, suffix)                                                                         \
  Int pstripack_number_at_##suffix(const Int* address, const Int* n, const Int* fifth, const Int* sixth, \
                                   const Int* seventh, const Int* eighth) noexcept {                     \
    return number_at(address, {n, fifth, sixth, seventh, eighth});                                       \
  }                                                                                                      \
  void* pstripack_voronoi_poly_count_##suffix(Int n, const Int* lend, const Int* lptr,                   \
                                              const Int* listc) noexcept {                               \
    return composed("VORONOI_POLY_COUNT",                                                                \
                    [&](FormattedText& out) { count_polygons(n, lend, lptr, listc, out); });             \
  }

PRINT_CALLS(float, int32_t, r4)
PRINT_CALLS(double, int32_t, r8)
PRINT_CALLS(double, int64_t, i8)
COUNT_CALLS(int32_t, i4)
COUNT_CALLS(int64_t, i8)

}  // extern "C"
#pragma GCC visibility pop
