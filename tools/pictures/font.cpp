#include "pictures/font.h"

#include <cstddef>
#include <cstring>
#include <vector>

namespace pictures {
namespace {

/// Splits a text into its characters.
std::vector<std::string> characters(const std::string& utf8) {
  std::vector<std::string> result;
  for (const char byte : utf8)
    if (result.empty() || (static_cast<unsigned char>(byte) & 0xc0) != 0x80)
      result.emplace_back(1, byte);
    else
      result.back() += byte;
  return result;
}

/// Of a character, in parts of the size.
double width_of(const std::string& character) {
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
  for (const std::string& character : characters(utf8)) sum += width_of(character);
  return sum * size;
}

std::string shortened(const std::string& utf8, double size, double width) {
  if (text_width(utf8, size) <= width) return utf8;
  const std::vector<std::string> all = characters(utf8);
  std::string begin, end, text = "…";
  for (std::size_t k = 0; 2 * k < all.size(); ++k) {
    begin += all[k];
    end = all[all.size() - 1 - k] + end;
    const std::string longer = begin + "…" + end;
    if (text_width(longer, size) > width) break;
    text = longer;
  }
  return text;
}

}  // namespace pictures
