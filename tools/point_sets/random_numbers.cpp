#include <cmath>
#include <utility>

#include "base/splitmix64.h"
#include "shapes.h"

namespace point_sets {

std::uint64_t Random::bits() { return pstripack::splitmix64(state_ += 0x9e3779b97f4a7c15); }

Point Random::direction() {
  const auto [u, v] = in_disc(*this);
  const double s = u * u + v * v, r = 2 * std::sqrt(1 - s);  // Marsaglia 1972
  return {r * u, r * v, 1 - 2 * s};
}

}  // namespace point_sets
