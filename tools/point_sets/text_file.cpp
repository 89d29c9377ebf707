#include "text_file.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "numbers.h"

namespace point_sets {
namespace {

/// The number of bytes of the UTF-8 character that begins the text; 0: there is none.
std::size_t length_of_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80   ? 1
                             : byte(0) < 0xC2 ? 0
                             : byte(0) < 0xE0 ? 2
                             : byte(0) < 0xF0 ? 3
                             : byte(0) < 0xF5 ? 4
                                              : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  // Longer than necessary, halves of UTF-16, beyond U+10FFFF.
  const bool is_wrong =
      length > 2 && ((byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xED && byte(1) > 0x9F) ||
                     (byte(0) == 0xF0 && byte(1) < 0x90) || (byte(0) == 0xF4 && byte(1) > 0x8F));
  return is_wrong ? 0 : length;
}

}  // namespace

std::string excerpt(std::string_view text) {
  std::string result;
  for (int characters = 0; !text.empty(); ++characters) {
    if (characters == 60) return result + "...";
    const std::size_t length = length_of_character(text);
    const auto first = static_cast<unsigned char>(text[0]);
    const bool is_c1 = length == 2 && first == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0;
    const std::size_t taken = std::max<std::size_t>(length, 1);
    if (first == '\n' || first == '\t')
      result += first == '\n' ? "\\n" : "\\t";
    else if (length == 0 || first < ' ' || first == 0x7F || is_c1)
      for (std::size_t i = 0; i < taken; ++i) {
        constexpr const char* kDigits = "0123456789abcdef";
        const auto byte = static_cast<unsigned char>(text[i]);
        result += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
      }
    else
      result += text.substr(0, length);
    text.remove_prefix(taken);
  }
  return result;
}

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

std::string contents_of(const std::string& file) {
  const bool is_stdin = file == "-";
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(is_stdin ? nullptr : std::fopen(file.c_str(), "rb"),
                                                         std::fclose);
  std::FILE* const in = is_stdin ? stdin : opened.get();
  const std::string name = is_stdin ? "stdin" : file;
  if (in == nullptr) throw std::runtime_error(name + ": cannot be opened: " + std::strerror(errno));
  std::string text;
  struct stat status {};
  const bool is_file = fstat(fileno(in), &status) == 0 && S_ISREG(status.st_mode);
  // One byte more than the file has, so that the end of the file is noticed.
  std::size_t more = is_file ? static_cast<std::size_t>(status.st_size) + 1 : std::size_t{1} << 16;
  for (bool ends = false; !ends;) {
    const std::size_t before = text.size();
    text.resize(before + more);
    const std::size_t got = std::fread(&text[before], 1, more, in);
    text.resize(before + got);
    ends = got < more;
    more = std::max<std::size_t>(text.size(), std::size_t{1} << 16);
  }
  if (std::ferror(in)) throw std::runtime_error(name + ": read error: " + std::strerror(errno));
  return text;
}

}  // namespace point_sets
