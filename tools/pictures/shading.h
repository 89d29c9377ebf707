#pragma once
// Colours, as "#rrggbb", and those of faces by their values.

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pictures/scale.h"

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

/// A colour and what it stands for.
struct Shade {
  std::string colour, label;
  std::size_t count = 0;
};

struct Shading {
  std::vector<Shade> shades;
  std::vector<std::size_t> of_face;  ///< the shade of each face; empty: faces have no colour
  std::optional<Scale> scale;        ///< of the colour bar; none: each shade stands for a category
  std::string title;                 ///< of the legend
};

constexpr int kSteps = 6;           ///< steps of a colour bar
constexpr double kTickLabels = 12;  ///< font size
constexpr const char* kNoColour = "#e6e6e6";

using Range = std::optional<std::pair<double, double>>;

/// The shades of a colour bar so many pixels wide, and behind them that of NaN. `title` and `unit` are for
/// the legend. `range`: its ends; none: those of the values.
Shading shading_of_numbers(const std::vector<double>& values, const std::string& title,
                           const std::string& unit, const Range& range = {}, double width = 400);

}  // namespace pictures
