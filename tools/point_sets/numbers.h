#pragma once

#include <string>

namespace point_sets {

/// Parses all of `text` as a finite decimal or hexadecimal number; also Fortran's 1.5D-3.
bool parse(std::string text, double& value);

}  // namespace point_sets
