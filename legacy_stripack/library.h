#pragma once
// The routines of an original with any ABI, loaded by path and called as REAL*8 with the 12-argument TRMESH.
// They run in this process and can hang or crash: original.h runs them in a process of their own.

#include <string>

namespace legacy_stripack {

/// How an original is called. The default is the ABI of stripack_original.
struct Abi {
  int real_bytes = 8;
  int integer_bytes = 4;
  int arguments = 12;  ///< of TRMESH; 8 are N, X, Y, Z, LIST, LPTR, LEND, IER

  bool operator==(const Abi& other) const {
    return real_bytes == other.real_bytes && integer_bytes == other.integer_bytes &&
           arguments == other.arguments;
  }
};

/// The ABI of a name: r8 is the default; r4, i8 and 8arg, joined by `-`, name differences from it. Throws
/// std::invalid_argument for other names.
Abi abi_named(const std::string& name);
std::string name_of(const Abi& abi);

/// "REAL*4, INTEGER*4, TRMESH with 12 arguments"
std::string describe(const Abi& abi);

class Library {
 public:
  /// Throws std::runtime_error if the file cannot be loaded or is not STRIPACK.
  explicit Library(const std::string& file, Abi abi = {});

  void trmesh(const int* n, const double* x, const double* y, const double* z, int* list, int* lptr,
              int* lend, int* lnew, int* near, int* next, double* dist, int* ier) const;
  /// TRLIST and CRLIST have the same arguments in every ABI. Throw std::runtime_error if missing.
  void trlist(const int* n, const int* list, const int* lptr, const int* lend, const int* nrow, int* nt,
              int* ltri, int* ier) const;
  void crlist(const int* n, const int* ncol, const double* x, const double* y, const double* z,
              const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
              double* xc, double* yc, double* zc, double* rc, int* ier) const;

  Abi abi() const { return abi_; }
  const std::string& file() const { return file_; }
  void* trmesh_address() const { return trmesh_; }

  /// The address of a symbol of the library; null if there is no such symbol.
  void* symbol(const char* name) const;

 private:
  void* routine(const std::string& name) const;
  void* handle_;  // never closed: unloading a Fortran library is not safe
  std::string file_;
  Abi abi_;
  void* trmesh_;
  void* trlist_;
  void* crlist_;
};

}  // namespace legacy_stripack
