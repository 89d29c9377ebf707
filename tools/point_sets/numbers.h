#pragma once

#include <string>

namespace point_sets {

/// The whole of `text` as a finite number, decimal or hexadecimal; also 1.5D-3, as Fortran programs write it.
bool parse(std::string text, double& value);

}  // namespace point_sets
