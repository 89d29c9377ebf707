#include "shapes.h"

namespace point_sets {
namespace {

Points rays_nodes(std::size_t n, double decades, Random& random) {
  constexpr std::size_t rays = 64;
  bool is_first = true;
  return distinct(n, [&] {
    if (is_first) return is_first = false, Point{1, 0, 0};
    const double s = ten_to_minus(decades * random.uniform()),
                 angle = 360 * static_cast<double>(random.below(rays)) / rays;
    return Point{1, s * cos_degrees(angle), s * sin_degrees(angle)};
  });
}

}  // namespace

Family rays_family() { return {"rays", "100", "n", "nest along 64 rays, and (1, 0, 0)", rays_nodes}; }

}  // namespace point_sets
