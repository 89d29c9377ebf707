#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace files {

/// Throws the error "WHERE: what".
template <class... Values>
[[noreturn]] void fail(const std::string& where, fmt::format_string<Values...> what, Values&&... values) {
  throw std::runtime_error(where + ": " + fmt::format(what, std::forward<Values>(values)...));
}
/// The place of a line in messages.
inline std::string line_of(const std::string& file, std::size_t line) {
  return fmt::format("{}:{}", file, line);
}

/// The bytes of a file, or of stdin if `file` is `-`. Throws std::runtime_error.
std::string contents_of(const std::string& file);

/// Text of a file for a message: at most 60 characters and "...". Control characters, quotes, backslashes and
/// bytes that are no UTF-8 are escaped, as in \n or \x1b.
std::string excerpt(std::string_view text);

/// Without blanks (spaces, tabs, \r, \f, \v) at its ends.
std::string_view trimmed(std::string_view text);
/// With a..z in place of A..Z; other bytes stay.
std::string lower(std::string_view text);

}  // namespace files
