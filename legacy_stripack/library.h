#pragma once
// The original's routines in this process, whatever its ABI: loaded by path, called as REAL*8 with the
// 12-argument TRMESH. It can hang or crash: original.h runs it in a process of its own.

#include <string>

namespace legacy_stripack {

enum class Abi {
  r8,    ///< REAL*8, 12-argument TRMESH
  r4,    ///< REAL*4, 12-argument TRMESH, as Algorithm 772 was published
  args8  ///< REAL*8, TRMESH(N,X,Y,Z,LIST,LPTR,LEND,IER)
};

/// "r8", "r4", "8arg"; throws std::invalid_argument for anything else.
Abi abi_named(const std::string& name);
const char* name_of(Abi abi);

class Library {
 public:
  /// Throws std::runtime_error if the file cannot be loaded or is not STRIPACK.
  Library(const std::string& file, Abi abi);

  void trmesh(const int* n, const double* x, const double* y, const double* z, int* list, int* lptr,
              int* lend, int* lnew, int* near, int* next, double* dist, int* ier) const;
  void trlist(const int* n, const int* list, const int* lptr, const int* lend, const int* nrow, int* nt,
              int* ltri, int* ier) const;
  void crlist(const int* n, const int* ncol, const double* x, const double* y, const double* z,
              const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
              double* xc, double* yc, double* zc, double* rc, int* ier) const;

  Abi abi() const { return abi_; }
  const std::string& file() const { return file_; }
  void* trmesh_address() const { return trmesh_; }

  /// The address of any symbol of the library, null if it has none of that name.
  void* symbol(const char* name) const;

 private:
  void* routine(const char* name, bool required) const;
  void* handle_;  // never closed: Fortran libraries do not like to be unloaded
  std::string file_;
  Abi abi_;
  void* trmesh_;
  void* trlist_;
  void* crlist_;
};

}  // namespace legacy_stripack
