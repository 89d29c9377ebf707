#include "pictures/sheet.h"

#include <fmt/format.h>

#include <cmath>

namespace pictures {

void Sheet::text(const Place& at, double size, Anchor anchor, const std::string& words, const char* colour) {
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  body_ += fmt::format(
      "<text x=\"{:.4g}\" y=\"{:.4g}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n", at.x,
      at.y, size, kAnchors[static_cast<int>(anchor)], colour, escaped_for_xml(words));
}

void Sheet::rectangle(double x, double y, double width, double height, const std::string& fill,
                      const char* stroke) {
  body_ += fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" stroke=\"{}\"/>\n", x,
      y, width, height, fill, stroke);
}

void Sheet::path(const Path& path, const std::string& style) {
  if (!path.empty()) body_ += fmt::format("<path {} d=\"{}\"/>\n", style, path.data());
}

double Sheet::title(const std::string& words) {
  if (words.empty()) return 14;
  text({kWidth / 2, 30}, 18, Anchor::middle, words);
  return 48;
}

std::string Sheet::svg(double height, double width) const {
  height = std::ceil(height);
  return fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{}" height="{}" viewBox="0 0 {} {}"
 font-family="DejaVu Sans, Verdana, sans-serif">
<rect width="100%" height="100%" fill="#ffffff"/>
{}</svg>
)",
                     width, std::round(width * height / kWidth), kWidth, height, body_);
}

}  // namespace pictures
