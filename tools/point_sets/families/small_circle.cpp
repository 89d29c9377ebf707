#include "shapes.h"

namespace point_sets {
namespace {

Points small_circle_nodes(std::size_t n, double radius, Random& random) {
  const Frame f = frame(centre());
  const double z = cos_degrees(radius * degrees_per_radian), r = sin_degrees(radius * degrees_per_radian);
  return distinct(n, [&] {
    const double angle = random.uniform(0, 360);
    return normalized(z * f.c + (r * cos_degrees(angle)) * f.e1 + (r * sin_degrees(angle)) * f.e2);
  });
}

}  // namespace

Family small_circle_family() {
  return {"small-circle", "1", "n",
          "on one circle of that radius, tilted, so that rounding moves each off it", small_circle_nodes};
}

}  // namespace point_sets
