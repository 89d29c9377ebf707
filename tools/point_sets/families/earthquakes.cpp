#include "shapes.h"

namespace point_sets {
namespace {

Points earthquakes_nodes(std::size_t n, double distance, Random& random) {
  Points shocks;
  return distinct(n, [&] {
    const double u = random.uniform(), angle = random.uniform(0, 360);
    if (shocks.empty() || random.below(20) == 0) {
      shocks.push_back(random.direction());
    } else {
      const double s = distance * u / (1 - u);  // P(s > x) = distance / (distance + x)
      const Frame f = frame(shocks[random.below(shocks.size())]);
      shocks.push_back(at(f, s * cos_degrees(angle), s * sin_degrees(angle)));
    }
    return shocks.back();
  });
}

}  // namespace

Family earthquakes_family() {
  return {"earthquakes", "1e-4", "n", "clusters of aftershocks of aftershocks, at about that distance",
          earthquakes_nodes};
}

}  // namespace point_sets
