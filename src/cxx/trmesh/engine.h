#pragma once
// What can take over a call of TRMESH in place of this process's threads: the pool, or libpstripack_mpi.

#include <cstdint>

namespace pstripack {
struct CallReport;
}

extern "C" {

/// One TRMESH call. real_bytes: 4 or 8, the kind of x, y, z.
struct pstripack_trmesh_arguments {
  int32_t real_bytes, n;
  const void *x, *y, *z;
  int32_t *list, *lptr, *lend, *lnew;
  pstripack::CallReport* report;  ///< the engine fills in mode, ranks and cost; null: nobody asks
};

enum {
  PSTRIPACK_ENGINE_DECLINES = 0,  ///< not mine, do it on threads
  PSTRIPACK_ENGINE_DID_IT = 1,    ///< and the code, if it is one that callers do not know, wants its line
  PSTRIPACK_ENGINE_DID_IT_SILENTLY = 2,  ///< another rank prints that line
};

/// Carries the call out and sets *ier, *node and *other (see TrmeshResult), or declines. Must not throw.
typedef int (*pstripack_trmesh_engine)(const pstripack_trmesh_arguments* call, int32_t* ier, int64_t* node,
                                       int64_t* other);
}
