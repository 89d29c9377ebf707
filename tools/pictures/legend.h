#pragma once
// Legends. Each is drawn below `top`; its function returns its lower end.

#include <string>
#include <vector>

#include "pictures/colours.h"
#include "pictures/shading.h"
#include "pictures/sheet.h"

namespace pictures {

/// The width of a colour bar, in units of the sheet.
inline double bar_width(const Sheet& sheet) { return std::min(400.0, sheet.width() - 60); }

/// A bar of the palette with the ticks of the scale. An end beyond which values lie is pointed.
double draw_colour_bar(Sheet& sheet, double top, const Shading& shading, const Palette& palette);

/// A square with label and count for each shade whose count is not 0, in as many rows as needed.
double draw_shades(Sheet& sheet, double top, const Shading& shading);

/// A remark behind a coloured dot.
double draw_note(Sheet& sheet, double top, const char* colour, const std::string& words);

}  // namespace pictures
