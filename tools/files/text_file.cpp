#include "files/text_file.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace files {

std::string excerpt(std::string_view text) {
  std::size_t end = 0;
  for (int characters = 0; end < text.size(); ++end)
    if ((static_cast<unsigned char>(text[end]) & 0xC0) != 0x80 && ++characters > 60) break;
  const std::string quoted = fmt::format("{:?}", text.substr(0, end));
  return quoted.substr(1, quoted.size() - 2) + (end < text.size() ? "..." : "");
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

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\f\v";
  text.remove_prefix(std::min(text.size(), text.find_first_not_of(kBlanks)));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

}  // namespace files
