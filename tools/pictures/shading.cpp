#include "pictures/shading.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pictures {

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
