#include "pictures/colours.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <utility>

namespace pictures {

const std::vector<Palette>& palettes() {
  static const std::vector<Palette> all{
      {"viridis", "#ffffff", "440154 482475 414487 355f8d 2a788e 21918c 22a884 44bf70 7ad151 bddf26 fde725"},
      {"magma", "#ffffff", "000004 140e36 3b0f70 641a80 8c2981 b73779 de4968 f7705c fe9f6d fecf92 fcfdbf"},
      {"cividis", "#ffffff", "00224e 083370 35456c 4f576c 666970 7d7c78 948e77 aea371 c8b866 e5cf52 fee838"},
      {"coolwarm", "#555555", "3b4cc0 5977e3 7b9ff9 9ebeff c0d4f5 dddcdc f2cbb7 f7ac8e ee8468 d65244 b40426"},
      {"grey", "#5a6fa0", "000000 191919 333333 4c4c4c 666666 7f7f7f 999999 b2b2b2 cccccc e5e5e5 ffffff"}};
  return all;
}

std::string Palette::operator()(double t) const {
  const double at = 10 * std::clamp(t, 0.0, 1.0);
  const std::size_t i = std::min(static_cast<std::size_t>(at), std::size_t{9});
  const auto mixed = [&](std::size_t k) {  // of red, green and blue
    const auto sample = [&](std::size_t j) {
      return static_cast<double>(std::stoi(std::string(samples + 7 * j + 2 * k, 2), nullptr, 16));
    };
    return static_cast<int>(
        std::lround(sample(i) + (at - static_cast<double>(i)) * (sample(i + 1) - sample(i))));
  };
  char text[8];
  std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(mixed(0) << 16 | mixed(1) << 8 | mixed(2)));
  return text;
}

std::string colour_of_degree(int degree) {
  constexpr const char* kColours[] = {"#2166ac", "#92c5de", "#f7f7f7", "#f4a582", "#b2182b"};
  return kColours[std::clamp(degree, 4, 8) - 4];
}

std::vector<std::string> distinct_colours(const std::vector<std::vector<std::size_t>>& beside) {
  std::vector<std::string> palette(kCategories.begin(), kCategories.end()), colours(beside.size());
  palette.emplace_back(kOtherWords);
  // Those with most neighbours first: of the colours that are rarest among the neighbours the one that is
  // rarest overall.
  std::vector<std::size_t> order(beside.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return beside[i].size() > beside[j].size(); });
  std::map<std::string, std::size_t> used;
  for (const std::size_t i : order) {
    std::map<std::string, std::size_t> near;
    for (const std::size_t other : beside[i]) ++near[colours[other]];
    colours[i] = *std::min_element(palette.begin(), palette.end(), [&](const auto& a, const auto& b) {
      return std::pair(near[a], used[a]) < std::pair(near[b], used[b]);
    });
    ++used[colours[i]];
  }
  return colours;
}

}  // namespace pictures
