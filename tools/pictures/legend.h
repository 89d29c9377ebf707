#pragma once
// Legends. Each is drawn below `top`; its function returns its lower end.

#include <string>
#include <vector>

#include "pictures/shading.h"
#include "pictures/sheet.h"

namespace pictures {

/// A Viridis bar with the ticks of the scale.
double draw_colour_bar(Sheet& sheet, double top, const std::string& title, const Scale& scale);

/// A square with label and count for each shade whose count is not 0, in as many rows as needed.
double draw_shades(Sheet& sheet, double top, const std::string& title, const std::vector<Shade>& shades);

/// A remark behind a coloured dot.
double draw_note(Sheet& sheet, double top, const char* colour, const std::string& words);

}  // namespace pictures
