#pragma once

#include "trmesh/engine.h"

namespace pstripack {

/// The pool, if pstripack-run started this program; else null. It takes large calls. Uses no MPI.
Engine* pool_engine() noexcept;

}  // namespace pstripack
