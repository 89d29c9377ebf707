// stripack_original if the user's library has another ABI (r4, 8arg, i8): passes calls of the REAL*8,
// 12-argument symbols on to that library.

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "library.h"

namespace {

using legacy_stripack::Library;

// Calls a routine of the user's library; ends the program if the library cannot be loaded.
template <class Routine, class... Arguments>
void call(Routine routine, Arguments... arguments) {
  try {
    static const Library library(ORIGINAL_LIBRARY, legacy_stripack::abi_named(ORIGINAL_ABI));
    (library.*routine)(arguments...);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    std::exit(1);
  }
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

void trmesh_(const int* n, const double* x, const double* y, const double* z, int* list, int* lptr, int* lend,
             int* lnew, int* near, int* next, double* dist, int* ier) {
  call(&Library::trmesh, n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier);
}

void trlist_(const int* n, const int* list, const int* lptr, const int* lend, const int* nrow, int* nt,
             int* ltri, int* ier) {
  call(&Library::trlist, n, list, lptr, lend, nrow, nt, ltri, ier);
}

void crlist_(const int* n, const int* ncol, const double* x, const double* y, const double* z,
             const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
             double* xc, double* yc, double* zc, double* rc, int* ier) {
  call(&Library::crlist, n, ncol, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier);
}

}  // extern "C"
#pragma GCC visibility pop
