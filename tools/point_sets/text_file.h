#pragma once

#include <string>

namespace point_sets {

/// The bytes of a file, or of stdin if `file` is `-`. Throws std::runtime_error.
std::string contents_of(const std::string& file);

}  // namespace point_sets
