#include "pictures/font.h"

#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

namespace pictures {
namespace {

/// Splits a text into its characters.
std::vector<std::string_view> characters(const std::string& utf8) {
  std::vector<std::string_view> result;
  for (std::size_t begin = 0; begin < utf8.size();) {
    std::size_t end = begin + 1;
    while (end < utf8.size() && (static_cast<unsigned char>(utf8[end]) & 0xc0) == 0x80) ++end;
    result.emplace_back(utf8.data() + begin, end - begin);
    begin = end;
  }
  return result;
}

/// Of a character, in parts of the size.
double width_of(std::string_view character) {
  if (character.substr(0, 1) == "\xC2" || character.substr(0, 2) == "\xE2\x81") return 0.53;  // as ° and ⁵
  if (character.size() > 1) return 1;
  const char c = character[0];
  if (std::strchr(" !'(),./:;I[]fijlrt|", c) != nullptr) return 0.42;
  if (std::strchr("%@MWmw", c) != nullptr) return 1;
  return c >= 'A' && c <= 'Z' ? 0.78 : 0.64;
}

}  // namespace

double text_width(const std::string& utf8, double size) {
  double sum = 0;
  for (const std::string_view character : characters(utf8)) sum += width_of(character);
  return sum * size;
}

std::string shortened(const std::string& utf8, double size, double width) {
  if (text_width(utf8, size) <= width) return utf8;
  const std::vector<std::string_view> all = characters(utf8);
  std::string begin, end;
  double left = width / size - width_of("…");
  for (std::size_t i = 0, j = all.size(); i < j;) {  // keep characters from both ends
    const bool front = begin.size() <= end.size();
    const std::string_view next = front ? all[i] : all[j - 1];
    left -= width_of(next);
    if (left < 0) break;
    if (front)
      begin += next, ++i;
    else
      end = std::string(next) + end, --j;
  }
  return begin + "…" + end;
}

}  // namespace pictures
