#include "pictures/shading.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>

namespace pictures {

std::string viridis(double t) {
  // Eleven samples of red, green and blue, linear in between.
  const std::string samples = "440154 482475 414487 355f8d 2a788e 21918c 22a884 44bf70 7ad151 bddf26 fde725";
  const double at = 10 * std::clamp(t, 0.0, 1.0);
  const std::size_t i = std::min(static_cast<std::size_t>(at), std::size_t{9});
  const auto mixed = [&](std::size_t k) {  // of red, green and blue
    const auto sample = [&](std::size_t j) {
      return static_cast<double>(std::stoi(samples.substr(7 * j + 2 * k, 2), nullptr, 16));
    };
    return static_cast<int>(
        std::lround(sample(i) + (at - static_cast<double>(i)) * (sample(i + 1) - sample(i))));
  };
  char text[8];
  std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(mixed(0) << 16 | mixed(1) << 8 | mixed(2)));
  return text;
}

std::vector<std::string> distinct_colours(const std::vector<std::set<std::size_t>>& beside) {
  std::vector<std::string> palette(kCategories.begin(), kCategories.end()), colours(beside.size());
  palette.emplace_back(kOtherWords);
  for (std::size_t i = 0; i < beside.size(); ++i) {
    std::map<std::string, std::size_t> near;
    for (const std::size_t other : beside[i]) ++near[colours[other]];
    colours[i] = *std::min_element(palette.begin(), palette.end(),
                                   [&](const auto& a, const auto& b) { return near[a] < near[b]; });
  }
  return colours;
}

Shading shading_of_numbers(const std::vector<double>& values, const std::string& title,
                           const std::string& unit, const Range& range, double width) {
  constexpr std::size_t kShades = 64;
  Shading shading;
  std::vector<double> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known),
               [](double v) { return std::isfinite(v); });
  for (std::size_t s = 0; s < kShades; ++s)
    shading.shades.push_back({viridis(static_cast<double>(s) / (kShades - 1)), ""});
  shading.shades.push_back({kNoColour, "no value", values.size() - known.size()});
  shading.of_face.assign(values.size(), kShades);
  if (known.empty()) return shading;
  const std::vector<double> ends = range ? std::vector{range->first, range->second} : known;
  const Scale& scale =
      shading.scale.emplace(Scale::fitting(ends, range.has_value(), kSteps, width, kTickLabels));
  shading.title = title;
  if (const std::string unit_there = scale.name_of_factor() + (unit == "1" ? "" : unit); !unit_there.empty())
    shading.title += ", " + unit_there;
  for (std::size_t f = 0; f < values.size(); ++f)
    if (std::isfinite(values[f]))
      shading.of_face[f] = static_cast<std::size_t>(std::lround(scale(values[f]) * (kShades - 1)));
  return shading;
}

}  // namespace pictures
