#pragma once

#include "trmesh/engine.h"

namespace pstripack {

/// The default engine (trmesh/engine.h): carries TRMESH out by the pool, if pstripack-run started this
/// program and the call is large enough; declines otherwise. Uses no MPI.
int pool_trmesh(const pstripack_trmesh_arguments* call, int32_t* ier, int64_t* node, int64_t* other);

}  // namespace pstripack
