#pragma once
// Colours, as "#rrggbb".

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace pictures {

/// Viridis (van der Walt & Smith 2015), whose lightness grows in equal steps. t: 0 to 1.
std::string viridis(double t);

/// Colours of Okabe & Ito, which colour-blind readers can distinguish.
constexpr const char* kVermilion = "#d55e00";

/// Colours for categories, lighter than those of Okabe & Ito, so that lines and numbers on them remain
/// visible.
constexpr std::array<const char*, 7> kCategories{"#5aa5d6", "#f0b849", "#4cbf99", "#e58a4f",
                                                 "#d9a6c2", "#f2e86d", "#a8d4f0"};
constexpr const char* kOtherWords = "#c4c4c4";  ///< for all further categories

/// A colour for each of n things; neighbours get different colours if possible.
std::vector<std::string> distinct_colours(const std::vector<std::set<std::size_t>>& beside);

}  // namespace pictures
