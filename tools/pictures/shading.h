#pragma once
// Colours of faces by their values.

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pictures/colours.h"
#include "pictures/scale.h"

namespace pictures {

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
