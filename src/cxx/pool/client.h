#pragma once

#include "trmesh/engine.h"

namespace pstripack {

/// The engine a program starts with: TRMESH by the pool of pstripack-run, if this program was started by it
/// and the call is worth it; declines otherwise. No MPI here: the pool's rank 0 is a process of its own.
int pool_trmesh(const pstripack_trmesh_arguments* call, int32_t* ier, int64_t* node, int64_t* other);

}  // namespace pstripack
