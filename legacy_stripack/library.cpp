#include "library.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace legacy_stripack {
namespace {

template <class Real, class Int>
using Trmesh12 = void(const Int*, const Real*, const Real*, const Real*, Int*, Int*, Int*, Int*, Int*, Int*,
                      Real*, Int*);
template <class Real, class Int>
using Trmesh8 = void(const Int*, const Real*, const Real*, const Real*, Int*, Int*, Int*, Int*);
template <class Int>
using Trlist = void(const Int*, const Int*, const Int*, const Int*, const Int*, Int*, Int*, Int*);
template <class Real, class Int>
using Crlist = void(const Int*, const Int*, const Real*, const Real*, const Real*, const Int*, const Int*,
                    Int*, Int*, Int*, Int*, Int*, Real*, Real*, Real*, Real*, Int*);

// RTLD_DEEPBIND: the original's own calls must find the original, not a replacement that this program is
// linked with. AddressSanitizer refuses this flag.
#if defined(__SANITIZE_ADDRESS__) || !defined(RTLD_DEEPBIND)  // musl and macOS have none
constexpr int kOpenFlags = RTLD_NOW | RTLD_LOCAL;
#else
constexpr int kOpenFlags = RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND;
#endif

/// Calls call(Real{}, Int{}) with the kinds of the ABI.
template <class Call>
void in_kinds_of(const Abi& abi, const Call& call) {
  if (abi.real_bytes == 8)
    abi.integer_bytes == 4 ? call(double{}, std::int32_t{}) : call(double{}, std::int64_t{});
  else
    abi.integer_bytes == 4 ? call(float{}, std::int32_t{}) : call(float{}, std::int64_t{});
}

/// A caller's array in the library's kind: the array itself if the kinds are the same, else a copy, which is
/// copied back at the end unless the array is const.
template <class To, class From>
class Converted {
 public:
  Converted(From* array, std::size_t size) : array_(array) {
    if constexpr (!kIsSame) copy_.assign(array, array + size);
  }
  ~Converted() {
    if constexpr (!kIsSame && !std::is_const_v<From>)
      std::transform(copy_.begin(), copy_.end(), array_, [](To value) { return static_cast<From>(value); });
  }
  Converted(const Converted&) = delete;
  Converted& operator=(const Converted&) = delete;

  auto data() {
    if constexpr (kIsSame)
      return array_;
    else
      return copy_.data();
  }

 private:
  static constexpr bool kIsSame = std::is_same_v<To, std::remove_const_t<From>>;
  From* array_;
  std::vector<To> copy_;
};

std::size_t nodes_of(int n) { return n < 3 ? 0 : static_cast<std::size_t>(n); }
std::size_t slots_of(int n) { return n < 3 ? 0 : 6 * nodes_of(n) - 12; }
std::size_t triangles_of(int n) { return n < 3 ? 0 : 2 * nodes_of(n) - 4; }

// LNEW: one past the largest slot in use.
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
  Abi abi;
  std::istringstream words(name);
  for (std::string word; std::getline(words, word, '-');) {
    if (word == "r4")
      abi.real_bytes = 4;
    else if (word == "i8")
      abi.integer_bytes = 8;
    else if (word == "8arg")
      abi.arguments = 8;
    else if (word != "r8")
      throw std::invalid_argument("unknown ABI '" + name + "': r8, r4, i8, 8arg, or several, as in r4-8arg");
  }
  return abi;
}

std::string name_of(const Abi& abi) {
  std::string name;
  const auto add = [&name](bool differs, const char* word) {
    if (differs) name += (name.empty() ? "" : "-") + std::string(word);
  };
  add(abi.real_bytes == 4, "r4");
  add(abi.integer_bytes == 8, "i8");
  add(abi.arguments == 8, "8arg");
  return name.empty() ? "r8" : name;
}

std::string describe(const Abi& abi) {
  std::ostringstream text;
  text << "REAL*" << abi.real_bytes << ", INTEGER*" << abi.integer_bytes << ", TRMESH with " << abi.arguments
       << " arguments";
  return text.str();
}

/// What to do with a file that dlopen refuses because it is an archive; else nothing.
static std::string advice_for(const std::string& file) {
  std::string begin(8, ' ');
  std::ifstream(file).read(&begin[0], 8);
  return begin != "!<arch>\n" ? ""
                              : "; it is an archive: make a shared library, as by `gfortran -shared -fPIC -o "
                                "libstripack.so stripack.f`, with the options of your model";
}

Library::Library(const std::string& file, Abi abi)
    : handle_(dlopen(file.c_str(), kOpenFlags)), file_(file), abi_(abi) {
  if (!handle_)
    throw std::runtime_error("cannot load the original: " + std::string(dlerror()) + advice_for(file));
  // CRLIST of NCAR Graphics has other arguments (ngmath_crlist.c).
  trmesh_ = routine("trmesh");
  if (!trmesh_) trmesh_ = symbol("cstrmesh_");
  trlist_ = routine("trlist");
  if (!trlist_) trlist_ = symbol("cstrlist_");
  crlist_ = routine("crlist");
  if (!trmesh_)
    throw std::runtime_error(
        file_ + " is not STRIPACK: it has no symbol trmesh_, __stripack_MOD_trmesh or cstrmesh_");
}

void* Library::symbol(const char* name) const { return dlsym(handle_, name); }

// External procedure, or procedure of a module named stripack.
void* Library::routine(const std::string& name) const {
  void* const external = symbol((name + "_").c_str());
  return external ? external : symbol(("__stripack_MOD_" + name).c_str());
}

void Library::trmesh(const int* n, const double* x, const double* y, const double* z, int* list, int* lptr,
                     int* lend, int* lnew, int* near, int* next, double* dist, int* ier) const {
  in_kinds_of(abi_, [&](auto real, auto integer) {
    using Real = decltype(real);
    using Int = decltype(integer);
    const Int count = *n;
    const std::size_t nodes = nodes_of(*n), slots = slots_of(*n);
    Converted<Real, const double> x_(x, nodes), y_(y, nodes), z_(z, nodes);
    Converted<Real, double> dist_(dist, nodes);
    Converted<Int, int> list_(list, slots), lptr_(lptr, slots), lend_(lend, nodes), near_(near, nodes),
        next_(next, nodes), lnew_(lnew, 1), ier_(ier, 1);
    if (abi_.arguments == 12)
      reinterpret_cast<Trmesh12<Real, Int>*>(trmesh_)(&count, x_.data(), y_.data(), z_.data(), list_.data(),
                                                      lptr_.data(), lend_.data(), lnew_.data(), near_.data(),
                                                      next_.data(), dist_.data(), ier_.data());
    else
      reinterpret_cast<Trmesh8<Real, Int>*>(trmesh_)(&count, x_.data(), y_.data(), z_.data(), list_.data(),
                                                     lptr_.data(), lend_.data(), ier_.data());
  });
  // If nodes coincide, the lists have fewer than n nodes; their number is unknown.
  if (abi_.arguments == 8) *lnew = *ier == 0 ? first_unused_slot(*n, lptr, lend) : 0;
}

void Library::trlist(const int* n, const int* list, const int* lptr, const int* lend, const int* nrow,
                     int* nt, int* ltri, int* ier) const {
  if (!trlist_) throw std::runtime_error(file_ + " has no trlist_");
  in_kinds_of(abi_, [&](auto, auto integer) {
    using Int = decltype(integer);
    const Int count = *n, rows = *nrow;
    const std::size_t nodes = nodes_of(*n), slots = slots_of(*n);
    Converted<Int, const int> list_(list, slots), lptr_(lptr, slots), lend_(lend, nodes);
    Converted<Int, int> nt_(nt, 1),
        ltri_(ltri, triangles_of(*n) * static_cast<std::size_t>(std::max(*nrow, 0))), ier_(ier, 1);
    reinterpret_cast<Trlist<Int>*>(trlist_)(&count, list_.data(), lptr_.data(), lend_.data(), &rows,
                                            nt_.data(), ltri_.data(), ier_.data());
  });
}

void Library::crlist(const int* n, const int* ncol, const double* x, const double* y, const double* z,
                     const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
                     double* xc, double* yc, double* zc, double* rc, int* ier) const {
  if (!crlist_) throw std::runtime_error(file_ + " has no crlist_");
  in_kinds_of(abi_, [&](auto real, auto integer) {
    using Real = decltype(real);
    using Int = decltype(integer);
    const Int count = *n, columns = *ncol;
    const std::size_t nodes = nodes_of(*n), slots = slots_of(*n), centres = triangles_of(*n);
    Converted<Real, const double> x_(x, nodes), y_(y, nodes), z_(z, nodes);
    Converted<Real, double> xc_(xc, centres), yc_(yc, centres), zc_(zc, centres), rc_(rc, centres);
    Converted<Int, const int> list_(list, slots), lend_(lend, nodes);
    Converted<Int, int> lptr_(lptr, slots), lnew_(lnew, 1),
        ltri_(ltri, 6 * static_cast<std::size_t>(std::max(*ncol, 0))), listc_(listc, slots), nb_(nb, 1),
        ier_(ier, 1);
    reinterpret_cast<Crlist<Real, Int>*>(crlist_)(&count, &columns, x_.data(), y_.data(), z_.data(),
                                                  list_.data(), lend_.data(), lptr_.data(), lnew_.data(),
                                                  ltri_.data(), listc_.data(), nb_.data(), xc_.data(),
                                                  yc_.data(), zc_.data(), rc_.data(), ier_.data());
  });
}

}  // namespace legacy_stripack
