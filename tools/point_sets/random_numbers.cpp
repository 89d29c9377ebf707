#include <cmath>
#include <utility>

#include "shapes.h"

namespace point_sets {

std::uint64_t Random::bits() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

Point Random::direction() {
  const auto [u, v] = in_disc(*this);
  const double s = u * u + v * v, r = 2 * std::sqrt(1 - s);  // Marsaglia 1972
  return {r * u, r * v, 1 - 2 * s};
}

}  // namespace point_sets
