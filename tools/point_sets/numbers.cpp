#include "numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace point_sets {

std::from_chars_result parse_beginning(const char* begin, const char* end, double& value) {
#if defined(__cpp_lib_to_chars) && !defined(PSTRIPACK_ONLY_POSIX)
  return std::from_chars(begin, end, value);
#else
  const auto is_part = [](char c) { return c != '\0' && std::strchr("0123456789+-.eE", c) != nullptr; };
  const std::string text(begin, std::find_if_not(begin, end, is_part));
  char* stop = nullptr;
  value = std::strtod(text.c_str(), &stop);
  if (stop == text.c_str() || text[0] == '+') return {begin, std::errc::invalid_argument};
  return {begin + (stop - text.c_str()), std::errc()};
#endif
}

bool parse(std::string text, double& value) {
  const bool hexadecimal = text.find_first_of("xX") != std::string::npos;
  if (!hexadecimal)
    for (char& c : text)
      if (c == 'd' || c == 'D') c = 'e';
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' && std::isfinite(value);
}

}  // namespace point_sets
