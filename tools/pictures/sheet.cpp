#include "pictures/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pictures/font.h"

namespace pictures {

Box box_of(const Place& at, double size, Anchor anchor, const std::string& words) {
  const double width = text_width(words, size);
  const double left = at.x - (anchor == Anchor::start ? 0 : anchor == Anchor::middle ? width / 2 : width);
  return {left, at.y - kAscent * size, left + width, at.y + kDescent * size};
}

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

void Sheet::text(const Place& at, double size, Anchor anchor, const std::string& words, const char* colour) {
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  body_ += fmt::format(
      "<text x=\"{:.5g}\" y=\"{:.5g}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n", at.x,
      at.y, size, kAnchors[static_cast<int>(anchor)], colour, escaped_for_xml(words));
  texts_.push_back(box_of(at, size, anchor, words));
}

bool Sheet::text_if_free(Place at, double size, Anchor anchor, const std::string& words, const char* colour) {
  constexpr double kBorder = 2, kGap = 3;
  Box box = box_of(at, size, anchor, words);
  at.x += std::max(0.0, kBorder - box.left) - std::max(0.0, box.right - (width_ - kBorder));
  box = box_of(at, size, anchor, words);
  box = {box.left - kGap, box.top, box.right + kGap, box.bottom};
  if (std::any_of(texts_.begin(), texts_.end(), [&](const Box& other) { return overlap(box, other); }))
    return false;
  text(at, size, anchor, words, colour);
  return true;
}

void Sheet::centred(double y, double size, const std::string& words, const char* colour) {
  constexpr double kSmallest = 11;
  const double widest = width_ - 24;
  size = std::clamp(std::floor(size * widest / text_width(words, size)), std::min(kSmallest, size), size);
  text({width_ / 2, y}, size, Anchor::middle, shortened(words, size, widest), colour);
}

void Sheet::rectangle(double x, double y, double width, double height, const std::string& fill,
                      const char* stroke, const char* kind) {
  body_ += fmt::format(
      "<rect {}x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" stroke=\"{}\"/>\n",
      kind == nullptr ? "" : fmt::format("class=\"{}\" ", kind), x, y, width, height, fill, stroke);
}

void Sheet::path(const Path& path, const std::string& style) {
  if (!path.empty()) body_ += fmt::format("<path {} d=\"{}\"/>\n", style, path.data());
}

double Sheet::title(const std::string& words) {
  if (words.empty()) return 14;
  centred(30, 18, words);
  return 48;
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
