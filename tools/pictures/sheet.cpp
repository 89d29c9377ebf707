#include "pictures/sheet.h"

#include <fmt/format.h>

#include <cmath>

#include "pictures/scale.h"

namespace pictures {

void Sheet::text(const Place& at, double size, Anchor anchor, const std::string& words, const char* colour) {
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  body_ += fmt::format(
      "<text x=\"{:.5g}\" y=\"{:.5g}\" font-size=\"{:.3g}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n", at.x,
      at.y, size, kAnchors[static_cast<int>(anchor)], colour, escaped_for_xml(words));
}

void Sheet::centred(double y, double size, const std::string& words) {
  size = std::min(size, size * (width_ - 24) / text_width(words, size));
  text({width_ / 2, y}, size, Anchor::middle, words);
}

void Sheet::rectangle(double x, double y, double width, double height, const std::string& fill,
                      const char* stroke) {
  body_ += fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" stroke=\"{}\"/>\n", x,
      y, width, height, fill, stroke);
}

void Sheet::key(double x, double y, double width, const std::string& colour, const std::string& words) {
  body_ += fmt::format("<svg x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"20\">\n", x, y, width);
  rectangle(1, 3, 14, 14, colour, kGrey);
  text({21, 15}, 13, Anchor::start, words);
  body_ += "</svg>\n";
}

void Sheet::path(const Path& path, const std::string& style) {
  if (!path.empty()) body_ += fmt::format("<path {} d=\"{}\"/>\n", style, path.data());
}

std::string Sheet::svg(double height) const {
  height = std::ceil(height);
  return fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{}" height="{}" viewBox="0 0 {} {}"
 font-family="DejaVu Sans, Verdana, sans-serif">
<rect width="100%" height="100%" fill="#ffffff"/>
{}</svg>
)",
                     pixels_, std::round(pixels_ * height / width_), width_, height, body_);
}

}  // namespace pictures
