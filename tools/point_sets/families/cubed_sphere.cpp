#include "shapes.h"

namespace point_sets {
namespace {

Points cubed_sphere_nodes(std::size_t n, double, Random&) {
  const std::size_t m = nearest(n, 1, [](std::size_t k) { return 6 * k * k; });
  const Points face[6] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},   {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
                          {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                          {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},  {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}};
  const auto tangent = [m](std::size_t i) {
    const double angle = 90 * (static_cast<double>(2 * i + 1) / static_cast<double>(2 * m)) - 45;
    return sin_degrees(angle) / cos_degrees(angle);
  };
  Points p;
  for (const Points& f : face)
    for (std::size_t j = 0; j < m; ++j)
      for (std::size_t i = 0; i < m; ++i)
        p.push_back(normalized(f[0] + tangent(i) * f[1] + tangent(j) * f[2]));
  return p;
}

}  // namespace

Family cubed_sphere_family() {
  return {"cubed-sphere", "", "6 m^2", "equiangular cell centres, panel after panel", cubed_sphere_nodes};
}

}  // namespace point_sets
