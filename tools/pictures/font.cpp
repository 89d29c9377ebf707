#include "pictures/font.h"

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace pictures {
namespace {

/// Advance widths of the characters from blank to ~ in units of 1/2048, from the table `hmtx` of
/// DejaVuSans.ttf.
constexpr std::array<short, 95> kAdvances{
    651,  821,  942,  1716, 1303, 1946, 1597, 563,  799,  799,  1024, 1716, 651,  739,  651,  690,
    1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 690,  690,  1716, 1716, 1716, 1087,
    2048, 1401, 1405, 1430, 1577, 1294, 1178, 1587, 1540, 604,  604,  1343, 1141, 1767, 1532, 1612,
    1235, 1612, 1423, 1300, 1251, 1499, 1401, 2025, 1403, 1251, 1403, 799,  690,  799,  1716, 1024,
    1024, 1255, 1300, 1126, 1300, 1260, 721,  1300, 1298, 569,  569,  1186, 569,  1995, 1298, 1253,
    1300, 1300, 842,  1067, 803,  1298, 1212, 1675, 1212, 1212, 1075, 1303, 690,  1303, 1716};
constexpr double kUnits = 2048;

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

double advance(std::string_view character) {
  const auto code = static_cast<unsigned char>(character[0]);
  if (code >= ' ' && code <= '~') return kAdvances[code - static_cast<std::size_t>(' ')];
  for (const std::string_view digit : {"²", "³", "⁰", "¹", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"})
    if (character == digit) return 821;
  if (character == "°") return 1024;
  if (character == "·") return 651;
  if (character == "⁻") return 1081;
  return character.size() < 3 ? 1650 : 2048;  // Latin, Greek and Cyrillic; all others
}

}  // namespace

double text_width(const std::string& utf8, double size) {
  double sum = 0;
  for (const std::string_view character : characters(utf8)) sum += advance(character);
  return sum / kUnits * size;
}

std::string shortened(const std::string& utf8, double size, double width) {
  if (text_width(utf8, size) <= width) return utf8;
  const std::vector<std::string_view> all = characters(utf8);
  std::string begin, end;
  double left = width - text_width("…", size);
  for (std::size_t i = 0, j = all.size(); i < j;) {  // keep characters from both ends
    const bool front = begin.size() <= end.size();
    const std::string_view next = front ? all[i] : all[j - 1];
    left -= advance(next) / kUnits * size;
    if (left < 0) break;
    if (front)
      begin += next, ++i;
    else
      end = std::string(next) + end, --j;
  }
  return begin + "…" + end;
}

}  // namespace pictures
