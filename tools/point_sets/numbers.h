#pragma once

#include <charconv>
#include <string>

namespace point_sets {

/// Parses all of `text` as a finite decimal or hexadecimal number; also Fortran's 1.5D-3.
bool parse(std::string text, double& value);

/// Reads the plain decimal number that [begin, end) begins with, as std::from_chars does, which not every C++
/// library has for double.
std::from_chars_result parse_beginning(const char* begin, const char* end, double& value);

}  // namespace point_sets
