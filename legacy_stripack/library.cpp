#include "library.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace legacy_stripack {
namespace {

template <class Real>
using Trmesh12 = void(const int*, const Real*, const Real*, const Real*, int*, int*, int*, int*, int*, int*,
                      Real*, int*);
using Trmesh8 = void(const int*, const double*, const double*, const double*, int*, int*, int*, int*);
using Trlist = void(const int*, const int*, const int*, const int*, const int*, int*, int*, int*);
template <class Real>
using Crlist = void(const int*, const int*, const Real*, const Real*, const Real*, const int*, const int*,
                    int*, int*, int*, int*, int*, Real*, Real*, Real*, Real*, int*);

// The original's own calls must find the original, not a replacement that this program is linked with.
// (AddressSanitizer refuses RTLD_DEEPBIND.)
#if defined(__SANITIZE_ADDRESS__)
constexpr int kOpenFlags = RTLD_NOW | RTLD_LOCAL;
#else
constexpr int kOpenFlags = RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND;
#endif

using Floats = std::vector<float>;
Floats rounded(const double* values, int n) { return Floats(values, values + std::max(n, 0)); }

// One past the last slot in use. All slots below LNEW are in use, so the largest one tells.
int first_unused_slot(int n, const int* lptr, const int* lend) {
  int largest = 0;
  for (int k = 0; k < n; ++k) {
    int slot = lend[k];
    do {
      largest = std::max(largest, slot);
      slot = lptr[slot - 1];
    } while (slot != lend[k]);
  }
  return largest + 1;
}

}  // namespace

Abi abi_named(const std::string& name) {
  if (name == "r8") return Abi::r8;
  if (name == "r4") return Abi::r4;
  if (name == "8arg") return Abi::args8;
  throw std::invalid_argument("unknown ABI '" + name + "': r8, r4 or 8arg");
}

const char* name_of(Abi abi) { return abi == Abi::r8 ? "r8" : abi == Abi::r4 ? "r4" : "8arg"; }

Library::Library(const std::string& file, Abi abi)
    : handle_(dlopen(file.c_str(), kOpenFlags)), file_(file), abi_(abi) {
  if (!handle_) throw std::runtime_error("cannot load the original: " + std::string(dlerror()));
  trmesh_ = routine("trmesh", true);
  trlist_ = routine("trlist", false);
  crlist_ = routine("crlist", false);
}

void* Library::symbol(const char* name) const { return dlsym(handle_, name); }

// External procedure, or procedure of a module named stripack.
void* Library::routine(const char* name, bool required) const {
  void* found = symbol((std::string(name) + "_").c_str());
  if (!found) found = symbol(("__stripack_MOD_" + std::string(name)).c_str());
  if (!found && required) throw std::runtime_error(file_ + " is not STRIPACK: it has no " + name + "_");
  return found;
}

void Library::trmesh(const int* n, const double* x, const double* y, const double* z, int* list, int* lptr,
                     int* lend, int* lnew, int* near, int* next, double* dist, int* ier) const {
  switch (abi_) {
    case Abi::r8:
      reinterpret_cast<Trmesh12<double>*>(trmesh_)(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier);
      break;
    case Abi::r4: {
      Floats work(static_cast<std::size_t>(std::max(*n, 0)));
      reinterpret_cast<Trmesh12<float>*>(trmesh_)(n, rounded(x, *n).data(), rounded(y, *n).data(),
                                                  rounded(z, *n).data(), list, lptr, lend, lnew, near, next,
                                                  work.data(), ier);
      break;
    }
    case Abi::args8:
      reinterpret_cast<Trmesh8*>(trmesh_)(n, x, y, z, list, lptr, lend, ier);
      // Where nodes coincide the lists hold fewer nodes than n, and nothing says how many.
      *lnew = *ier == 0 ? first_unused_slot(*n, lptr, lend) : 0;
      break;
  }
}

void Library::trlist(const int* n, const int* list, const int* lptr, const int* lend, const int* nrow,
                     int* nt, int* ltri, int* ier) const {
  if (!trlist_) throw std::runtime_error(file_ + " has no trlist_");
  reinterpret_cast<Trlist*>(trlist_)(n, list, lptr, lend, nrow, nt, ltri, ier);
}

void Library::crlist(const int* n, const int* ncol, const double* x, const double* y, const double* z,
                     const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
                     double* xc, double* yc, double* zc, double* rc, int* ier) const {
  if (!crlist_) throw std::runtime_error(file_ + " has no crlist_");
  if (abi_ != Abi::r4) {
    reinterpret_cast<Crlist<double>*>(crlist_)(n, ncol, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, xc,
                                               yc, zc, rc, ier);
    return;
  }
  const std::size_t centres = *n < 3 ? 0 : 2 * static_cast<std::size_t>(*n) - 4;
  Floats x4(centres), y4(centres), z4(centres), r4(centres);
  reinterpret_cast<Crlist<float>*>(crlist_)(n, ncol, rounded(x, *n).data(), rounded(y, *n).data(),
                                            rounded(z, *n).data(), list, lend, lptr, lnew, ltri, listc, nb,
                                            x4.data(), y4.data(), z4.data(), r4.data(), ier);
  if (*ier != 0) return;
  std::copy(x4.begin(), x4.end(), xc);
  std::copy(y4.begin(), y4.end(), yc);
  std::copy(z4.begin(), z4.end(), zc);
  std::copy(r4.begin(), r4.end(), rc);
}

}  // namespace legacy_stripack
