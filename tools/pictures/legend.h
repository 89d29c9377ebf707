#pragma once
// Legends: each is drawn below `top` and returns where it ends.

#include <string>
#include <vector>

#include "pictures/scale.h"
#include "pictures/sheet.h"

namespace pictures {

/// A colour and what it stands for.
struct Shade {
  std::string colour, label;
  std::size_t count = 0;
};

constexpr int kSteps = 6;           ///< of a colour bar
constexpr double kBarWidth = 400;   ///< pixels
constexpr double kTickLabels = 12;  ///< their size

/// Viridis with the ticks of the scale.
double draw_colour_bar(Sheet& sheet, double top, const std::string& title, const Scale& scale);

/// Squares of those shades that have something, each with its label and count, in as many rows as they need.
double draw_shades(Sheet& sheet, double top, const std::string& title, const std::vector<Shade>& shades);

/// A remark with a dot of a colour before it.
double draw_note(Sheet& sheet, double top, const char* colour, const std::string& words);

}  // namespace pictures
