#include <algorithm>
#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

// Density 1/(b - z)^2 along the axis z: its integral is elementary, and so is the inverse of that.
Points variable_nodes(std::size_t n, double ratio, Random& random) {
  const double root = std::sqrt(ratio), b = (root + 1) / (root - 1), low = 1 / (b + 1), high = 1 / (b - 1);
  Points p(n);
  for (Point& q : p) {
    const double z = std::clamp(b - 1 / (low + random.uniform() * (high - low)), -1.0, 1.0);
    const auto [u, v] = in_disc(random);
    const double r = std::sqrt((1 - z) * (1 + z) / (u * u + v * v));
    q = {z, r * u, r * v};
  }
  return p;
}

}  // namespace

Family variable_family() {
  return {"variable", "1e4", "n", "smooth density, its largest over its smallest value", variable_nodes};
}

}  // namespace point_sets
