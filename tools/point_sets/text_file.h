#pragma once
// Files as they are.

#include <string>

namespace point_sets {

/// The bytes of a file; `-`: of stdin. Throws std::runtime_error.
std::string contents_of(const std::string& file);

}  // namespace point_sets
