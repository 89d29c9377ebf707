#include "shapes.h"

namespace point_sets {
namespace {

Points hemisphere_rim_nodes(std::size_t n, double, Random& random) {
  Points p;
  while (p.size() < n) {
    const Point q = random.direction();
    if (p.size() % 2 == 0) {
      const double longitude = random.uniform(0, 360);
      p.push_back({cos_degrees(longitude), sin_degrees(longitude), 0});
    } else if (q.z > 0) {
      p.push_back(q);
    }
  }
  return p;
}

}  // namespace

Family hemisphere_rim_family() {
  return {"hemisphere-rim", "", "n", "half of them exactly on the equator, half north of it",
          hemisphere_rim_nodes};
}

}  // namespace point_sets
