#pragma once
// The interface of engines, which can carry out a call of TRMESH in place of this process's threads: the
// pool, and libpstripack_mpi.

#include <cstdint>

namespace pstripack {
struct CallReport;
}

extern "C" {

/// One call of TRMESH. real_bytes: bytes of a real in x, y, z, 4 or 8.
struct pstripack_trmesh_arguments {
  int32_t real_bytes, n;
  const void *x, *y, *z;
  int32_t *list, *lptr, *lend, *lnew;
  pstripack::CallReport* report;  ///< the engine fills in mode, ranks and cost; null: no report is wanted
};

enum {
  PSTRIPACK_ENGINE_DECLINES = 0,         ///< not carried out: do it on threads
  PSTRIPACK_ENGINE_DID_IT = 1,           ///< carried out; the library prints the line of a new error code
  PSTRIPACK_ENGINE_DID_IT_SILENTLY = 2,  ///< carried out; another rank prints that line
};

/// An engine: carries the call out and sets *ier, *node and *other (see TrmeshResult), or declines. Must
/// not throw.
typedef int (*pstripack_trmesh_engine)(const pstripack_trmesh_arguments* call, int32_t* ier, int64_t* node,
                                       int64_t* other);
}
