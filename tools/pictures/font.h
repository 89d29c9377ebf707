#pragma once
// The size of texts, so that they can be placed without overlaps.

#include <string>

namespace pictures {

/// Width of a line of DejaVu Sans, the font of all pictures, in the unit of `size`. Viewers without it take
/// another font, which is hardly wider. Letters beyond ASCII count as wide ones.
double text_width(const std::string& utf8, double size);

/// Of the height of a line above and below its baseline, in parts of its size.
constexpr double kAscent = 0.76, kDescent = 0.24;

/// The text, or its beginning and its end with an ellipsis between them that are not wider than `width`.
std::string shortened(const std::string& utf8, double size, double width);

}  // namespace pictures
