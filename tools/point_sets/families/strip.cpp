#include "shapes.h"

namespace point_sets {
namespace {

Points strip_nodes(std::size_t n, double width, Random& random) {
  const Point e1 = normalized(cross(centre(), {1, 0, 0})), e2 = cross(centre(), e1);
  Points p;
  for (std::size_t i = 0; i < n; ++i) {
    const double longitude = random.uniform(0, 360), height = width * (random.uniform() - 0.5);
    p.push_back(normalized(cos_degrees(longitude) * e1 + sin_degrees(longitude) * e2 + height * centre()));
  }
  return p;
}

}  // namespace

Family strip_family() {
  return {"strip", "1e-9", "n", "along a tilted great circle, in a strip of that width", strip_nodes};
}

}  // namespace point_sets
