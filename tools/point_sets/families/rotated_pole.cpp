#include "shapes.h"

namespace point_sets {
namespace {

Points rotated_pole_nodes(std::size_t n, double width, Random&) {
  const std::size_t m = nearest(n, 2, [](std::size_t k) { return k * k; });
  const double step = width * degrees_per_radian / static_cast<double>(m - 1);
  const double c = sin_degrees(39.25), s = cos_degrees(39.25);  // the pole at 39.25 N, 162 W
  Points p;
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < m; ++i) {
      const auto from_middle = [&](std::size_t k) {
        return step * (static_cast<double>(k) - 0.5 * static_cast<double>(m - 1));
      };
      const Point q = from_degrees(from_middle(i), from_middle(j));
      const Point tilted{c * q.x - s * q.z, q.y, s * q.x + c * q.z};
      p.push_back({cos_degrees(18) * tilted.x - sin_degrees(18) * tilted.y,
                   sin_degrees(18) * tilted.x + cos_degrees(18) * tilted.y, tilted.z});
    }
  return p;
}

}  // namespace

Family rotated_pole_family() {
  return {"rotated-pole", "0.7", "m^2",
          "regional box of that width on the equator of a rotated pole, row after row", rotated_pole_nodes};
}

}  // namespace point_sets
