#include "pictures/legend.h"

#include <fmt/format.h>

#include "pictures/colours.h"
#include "pictures/font.h"

namespace pictures {

double draw_colour_bar(Sheet& sheet, double top, const Shading& shading, const Palette& palette) {
  constexpr int kStops = 20;
  constexpr double kHigh = 12;
  const double width = bar_width(sheet), left = (sheet.width() - width) / 2;
  sheet.centred(top + 14, 14, shading.title);
  sheet.add("<defs><linearGradient id=\"palette\">");
  for (int k = 0; k <= kStops; ++k)
    sheet.add(fmt::format("<stop offset=\"{}\" stop-color=\"{}\"/>", k / double{kStops},
                          palette(k / double{kStops})));
  sheet.add("</linearGradient></defs>\n");
  sheet.rectangle(left, top + 22, width, kHigh, "url(#palette)", "none", Sheet::kDrawing);
  const auto point = [&](double x, double out, double t) {
    Path path;
    path.move({x, top + 22});
    path.line({x + out, top + 22 + kHigh / 2});
    path.line({x, top + 22 + kHigh});
    sheet.path(path, fmt::format("fill=\"{}\"", palette(t)));
  };
  if (shading.below) point(left, -kHigh, 0);
  if (shading.above) point(left + width, kHigh, 1);
  for (const Scale::Tick& tick : shading.scale->ticks()) {
    const double x = left + width * (*shading.scale)(tick.value);
    sheet.rectangle(x - 0.5, top + 34, 1, 4, kGrey);
    sheet.text({x, top + 50}, kTickLabels, Anchor::middle, tick.label);
  }
  return top + 58;
}

double draw_shades(Sheet& sheet, double top, const Shading& shading) {
  constexpr double kSquare = 14, kGap = 6, kBetween = 26, kRow = 22, kSize = 13;
  const double widest = sheet.width() - 48;
  struct Item {
    const Shade* shade;
    std::string words;
    double width;
  };
  std::vector<std::vector<Item>> rows(1);
  double room = widest;
  for (const Shade& shade : shading.shades) {
    if (shade.count == 0) continue;
    const std::string count = fmt::format(" ({})", grouped(shade.count));
    const std::string words =
        shortened(shade.label, kSize, widest - kSquare - kGap - text_width(count, kSize)) + count;
    const double width = kSquare + kGap + text_width(words, kSize);
    if (width > room) rows.emplace_back(), room = widest;
    rows.back().push_back({&shade, words, width});
    room -= width + kBetween;
  }
  sheet.centred(top + 14, 14, shading.title);
  top += 24;
  for (const std::vector<Item>& row : rows) {
    double width = -kBetween;
    for (const Item& item : row) width += item.width + kBetween;
    double x = (sheet.width() - width) / 2;
    for (const Item& item : row) {
      sheet.rectangle(x, top, kSquare, kSquare, item.shade->colour, kGrey, Sheet::kDrawing);
      sheet.text({x + kSquare + kGap, top + 12}, kSize, Anchor::start, item.words);
      x += item.width + kBetween;
    }
    top += kRow;
  }
  return top - 4;
}

double draw_note(Sheet& sheet, double top, const char* colour, const std::string& words) {
  constexpr double kSize = 13, kDot = 10, kGap = 6;
  const std::string fitting = shortened(words, kSize, sheet.width() - 60);
  const double left = (sheet.width() - kDot - kGap - text_width(fitting, kSize)) / 2;
  sheet.add(fmt::format("<circle class=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"{}\"/>\n",
                        Sheet::kDrawing, left + kDot / 2, top + 11.5, kDot / 2, colour));
  sheet.text({left + kDot + kGap, top + 16}, kSize, Anchor::start, fitting);
  return top + 22;
}

}  // namespace pictures
