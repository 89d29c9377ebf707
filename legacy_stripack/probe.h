#pragma once
// Detects the ABI of a library by calling it.

#include <optional>
#include <string>

#include "library.h"

namespace legacy_stripack {

struct Probe {
  std::optional<Abi> abi;  ///< none: the library's TRMESH gives the right triangles in no ABI
  std::string why_not;     ///< if none: the outcomes, "with REAL*8 it crashed ..."
};

/// Calls TRMESH for the six corners of an octahedron, with reals of `first_real_bytes` (4 or 8) first, then
/// with the others. Each call runs in a child process, with a time limit in seconds and space for what a
/// wrong ABI might overwrite. Its output is discarded.
Probe probe_abi(const Library& library, int first_real_bytes, double time_limit = 2);

}  // namespace legacy_stripack
