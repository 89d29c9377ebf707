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
#include <string_view>
#include <vector>

#include "numbers.h"
#include "point_sets.h"

namespace point_sets {
namespace {

std::string numbers(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " number" : " numbers");
}

[[noreturn]] void fail(const std::string& name, std::size_t line, const std::string& what) {
  throw std::runtime_error(name + ":" + std::to_string(line) + ": " + what);
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r' || c == '\f' || c == '\v'; }

/// Fast path for plain decimal numbers.
bool parse_word(std::string_view word, double& value) {
  const auto [end, error] = parse_beginning(word.data(), word.data() + word.size(), value);
  if (error == std::errc() && end == word.data() + word.size()) return std::isfinite(value);
  return parse(std::string(word), value);
}

/// Rows of equally many finite numbers.
struct Table {
  std::size_t columns = 0;
  std::vector<double> values;      // row after row
  std::vector<std::size_t> lines;  // of each row, from 1

  std::size_t rows() const { return lines.size(); }
  const double* row(std::size_t i) const { return &values[columns * i]; }
};

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

namespace {

Table table_of(std::string_view text, const std::string& name) {
  Table table;
  std::size_t number = 0, line_of_count = 0;
  double count = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t length = std::min(text.size(), text.find('\n'));
    std::string_view line = text.substr(0, length);
    text.remove_prefix(std::min(text.size(), length + 1));
    line = line.substr(0, line.find_first_of("#!"));

    const std::size_t before = table.values.size();
    for (std::size_t begin = 0, end;; begin = end) {
      while (begin < line.size() && is_blank(line[begin])) ++begin;
      if (begin == line.size()) break;
      for (end = begin; end < line.size() && !is_blank(line[end]);) ++end;
      const std::string_view word = line.substr(begin, end - begin);
      double value = 0;
      if (!parse_word(word, value)) fail(name, number, "'" + excerpt(word) + "' is not a finite number");
      table.values.push_back(value);
    }
    const std::size_t columns = table.values.size() - before;
    if (columns == 0) continue;
    if (columns == 1 && table.columns == 0 && line_of_count == 0 && table.values[0] >= 1 &&
        table.values[0] == std::floor(table.values[0])) {
      line_of_count = number;
      count = table.values[0];
      table.values.clear();
      continue;
    }
    if (table.columns == 0) table.columns = columns;
    if (table.columns < 2 || table.columns > 3)
      fail(name, number, "expected 'lon lat' or 'x y z', found " + numbers(columns));
    if (columns != table.columns)
      fail(name, number,
           "found " + numbers(columns) + " where the lines before have " + std::to_string(table.columns));
    table.lines.push_back(number);
  }
  if (table.rows() == 0) throw std::runtime_error(name + ": no points: expected lines 'lon lat' or 'x y z'");
  if (line_of_count > 0 && count != static_cast<double>(table.rows()))
    fail(name, line_of_count,
         "a single number is the count of the points that follow; there are " + std::to_string(table.rows()));
  return table;
}

}  // namespace

std::vector<pstripack::Point> read(const std::string& file) {
  const std::string name = file == "-" ? "stdin" : file;
  const Table table = table_of(contents_of(file), name);
  std::vector<pstripack::Point> points(table.rows());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double* const v = table.row(i);
    if (table.columns == 2 && std::fabs(v[1]) > 90)
      fail(name, table.lines[i], "latitude outside -90..90 degrees");
    points[i] = table.columns == 2 ? from_degrees(v[0], v[1]) : pstripack::Point{v[0], v[1], v[2]};
  }
  return points;
}

}  // namespace point_sets
