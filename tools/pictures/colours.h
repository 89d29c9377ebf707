#pragma once
// Colours, as "#rrggbb".

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace pictures {

/// Colours of a scale from its low to its high end: eleven samples of red, green and blue, linear in between.
struct Palette {
  const char* name;
  const char* lines;    ///< colour of lines that are seen on all of it
  const char* samples;  ///< rrggbb, separated by blanks

  std::string operator()(double t) const;  ///< t: 0 to 1
};

/// The first is the default, Viridis (van der Walt & Smith 2015): its lightness grows in equal steps, as that
/// of magma and cividis does. coolwarm (Moreland 2009) is lightest in its middle.
const std::vector<Palette>& palettes();

/// White for six neighbours, blue for fewer, red for more; all below 4 or above 8 look like 4 and 8.
std::string colour_of_degree(int degree);

/// Colours of Okabe & Ito, which colour-blind readers can distinguish.
constexpr const char* kVermilion = "#d55e00";

/// Colours for categories, lighter than those of Okabe & Ito, so that lines and numbers on them remain
/// visible.
constexpr std::array<const char*, 7> kCategories{"#5aa5d6", "#f0b849", "#4cbf99", "#e58a4f",
                                                 "#d9a6c2", "#f2e86d", "#a8d4f0"};
constexpr const char* kOtherWords = "#c4c4c4";  ///< for all further categories

/// A colour for each of n things; neighbours get different colours if possible.
std::vector<std::string> distinct_colours(const std::vector<std::vector<std::size_t>>& beside);

}  // namespace pictures
