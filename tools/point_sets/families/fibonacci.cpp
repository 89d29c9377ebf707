#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

Points fibonacci_nodes(std::size_t n, double, Random&) {
  Points p;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
    const double r = std::sqrt((1 - z) * (1 + z));
    const double longitude = std::fmod(static_cast<double>(i) * 137.50776405003785464634873962837, 360);
    p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), z});
  }
  return p;
}

}  // namespace

Family fibonacci_family() { return {"fibonacci", "", "n", "golden-angle spiral", fibonacci_nodes}; }

}  // namespace point_sets
