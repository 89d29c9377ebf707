#include <algorithm>
#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

Points swaths_nodes(std::size_t n, double pixels, Random&) {
  constexpr double width = 24, orbits_a_day = 14.57;  // degrees
  const std::size_t across =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(n))), 2,
                              std::max<std::size_t>(2, static_cast<std::size_t>(pixels)));
  const double step = width / static_cast<double>(across);
  std::size_t i = 0;
  return distinct(n, [&] {
    const double along = step * static_cast<double>(i / across), pixel = static_cast<double>(i % across);
    ++i;
    return Orbit{98.2}.seen_from_earth(along, step * (pixel + 0.5) - width / 2, along / orbits_a_day);
  });
}

}  // namespace

Family swaths_family() {
  return {"swaths", "200", "n", "scan lines of that many pixels across a ground track, line after line",
          swaths_nodes};
}

}  // namespace point_sets
