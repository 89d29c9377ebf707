#pragma once
// Sizes of texts, so that they can be placed without overlaps.

#include <string>

namespace pictures {

/// About the width of a line in DejaVu Sans, the font of all pictures, in the unit of `size`: rather more.
double text_width(const std::string& utf8, double size);

/// Extent of a line above and below its baseline, as fractions of the font size.
constexpr double kAscent = 0.76, kDescent = 0.24;

/// The text, or its beginning and end around an ellipsis if it is wider than `width`.
std::string shortened(const std::string& utf8, double size, double width);

}  // namespace pictures
