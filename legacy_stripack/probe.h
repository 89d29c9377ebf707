#pragma once
// Which ABI a library has, found out by calling it.

#include <optional>

#include "library.h"

namespace legacy_stripack {

/// The ABI in which the library's TRMESH triangulates the six corners of an octahedron; none if it does in no
/// ABI. Each call is a child process with a time limit, and room around what a wrong ABI might write.
std::optional<Abi> abi_shown_by(const Library& library);

/// Throws std::runtime_error, which names the right ABI, if the library shows another one than it was opened
/// with. A library that shows none is let through: its results will speak for themselves.
void refuse_other_abi(const Library& library);

}  // namespace legacy_stripack
