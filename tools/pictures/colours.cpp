#include "pictures/colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace pictures {

std::string viridis(double t) {
  constexpr std::array<std::array<double, 3>, 11> kSamples{{{68, 1, 84},
                                                            {72, 36, 117},
                                                            {65, 68, 135},
                                                            {53, 95, 141},
                                                            {42, 120, 142},
                                                            {33, 145, 140},
                                                            {34, 168, 132},
                                                            {68, 191, 112},
                                                            {122, 209, 81},
                                                            {189, 223, 38},
                                                            {253, 231, 37}}};
  const double at = std::clamp(t, 0.0, 1.0) * (kSamples.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), kSamples.size() - 2);
  const auto mixed = [&](std::size_t k) {
    const double low = kSamples[i][k], high = kSamples[i + 1][k];
    return static_cast<int>(std::lround(low + (at - static_cast<double>(i)) * (high - low)));
  };
  char text[8];
  std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(mixed(0) << 16 | mixed(1) << 8 | mixed(2)));
  return text;
}

std::string colour_of_degree(int degree) {
  constexpr const char* kColours[] = {"#2166ac", "#92c5de", "#f7f7f7", "#f4a582", "#b2182b"};
  return kColours[std::clamp(degree, 4, 8) - 4];
}

std::vector<std::string> distinct_colours(const std::vector<std::vector<std::size_t>>& beside) {
  std::array<const char*, kCategories.size() + 1> kColours{};
  std::copy(kCategories.begin(), kCategories.end(), kColours.begin());
  kColours.back() = kOtherWords;
  // Colour those with the fewest remaining neighbours last (Matula & Beck 1983): on a sphere each then has at
  // most five coloured neighbours, so eight colours suffice.
  const std::size_t n = beside.size();
  std::vector<std::size_t> left(n), order;
  for (std::size_t i = 0; i < n; ++i) left[i] = beside[i].size();
  constexpr std::size_t kTaken = SIZE_MAX;
  while (order.size() < n) {
    const auto next = static_cast<std::size_t>(std::min_element(left.begin(), left.end()) - left.begin());
    order.push_back(next);
    left[next] = kTaken;
    for (const std::size_t other : beside[next])
      if (left[other] != kTaken) --left[other];
  }
  std::reverse(order.begin(), order.end());
  // Choose among the colours that are rarest among the neighbours the one that is rarest overall.
  std::vector<std::size_t> chosen(n, kColours.size());
  std::array<std::size_t, kColours.size()> used{};
  for (const std::size_t i : order) {
    std::array<std::size_t, kColours.size() + 1> near{};
    for (const std::size_t other : beside[i]) ++near[chosen[other]];
    std::size_t best = 0;
    for (std::size_t c = 1; c < kColours.size(); ++c)
      if (std::pair(near[c], used[c]) < std::pair(near[best], used[best])) best = c;
    chosen[i] = best;
    ++used[best];
  }
  std::vector<std::string> colours;
  for (const std::size_t c : chosen) colours.emplace_back(kColours[c]);
  return colours;
}

}  // namespace pictures
