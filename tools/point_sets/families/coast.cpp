#include <algorithm>

#include "shapes.h"

namespace point_sets {
namespace {

// The longest segment is divided at a point beside its middle until there are n segments.
Points coast_nodes(std::size_t n, double roughness, Random& random) {
  const Frame f = frame(centre());
  Points coast;
  for (std::size_t i = 0; i < std::min<std::size_t>(n, 8); ++i) {
    const double angle = 45 * static_cast<double>(i) + random.uniform(0, 30);
    coast.push_back(at(f, 0.5 * cos_degrees(angle), 0.5 * sin_degrees(angle)));
  }
  while (coast.size() < n) {
    Points finer;
    for (std::size_t i = 0; i < coast.size(); ++i) {
      const Point &a = coast[i], &b = coast[(i + 1) % coast.size()];
      finer.push_back(a);
      if (finer.size() + coast.size() - i - 1 < n) {
        const Point middle = 0.5 * (a + b);
        finer.push_back(
            normalized(middle + (roughness * random.uniform(-1, 1)) * cross(middle, b + -1.0 * a)));
      }
    }
    coast.swap(finer);
  }
  std::size_t i = 0;
  return distinct(n, [&] { return coast[i++ % n]; });
}

}  // namespace

Family coast_family() {
  return {"coast", "0.3", "n", "along a closed fractal curve of that roughness", coast_nodes};
}

}  // namespace point_sets
