#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

// In the cap north of 65 N, as the disc |w| < 1 of a stereographic map, the two poles sit at w = +-1; with
// zeta = (1+w)/(1-w) the grid lines are the rays and the circles around 0 of the half plane Re zeta > 0.
Points tripolar_nodes(std::size_t n, double, Random&) {
  const auto southern = [](std::size_t m) { return (m * 145 + 180) / 360 + 1; };  // rows 80 S .. 65 N
  const auto northern = [](std::size_t m) { return m / 8; };                      // rows up to the seam
  const std::size_t m =
      2 * nearest(n, 2, [&](std::size_t k) { return 2 * k * southern(2 * k) + 2 * k * northern(2 * k) + k; });
  const auto column = [m](std::size_t i) {
    return 360 * (static_cast<double>(i) + 0.5) / static_cast<double>(m);
  };
  Points p;
  for (std::size_t j = 0; j < southern(m); ++j)
    for (std::size_t i = 0; i < m; ++i)
      p.push_back(
          from_degrees(column(i), -80 + 145 * static_cast<double>(j) / static_cast<double>(southern(m) - 1)));
  const double edge = cos_degrees(65) / (1 + sin_degrees(65));  // stereographic radius of 65 N
  for (std::size_t j = 1; j <= northern(m) + 1; ++j) {
    const bool seam = j == northern(m) + 1;
    const double ray = 90 * (1 - static_cast<double>(j) / static_cast<double>(northern(m) + 1));
    for (std::size_t i = 0; i < (seam ? m / 2 : m); ++i) {
      const double half = 0.5 * column(i), radius = std::fabs(cos_degrees(half) / sin_degrees(half));
      const double a = radius * cos_degrees(ray), b = (i < m / 2 ? 1 : -1) * radius * sin_degrees(ray);
      const double scale = edge / ((a + 1) * (a + 1) + b * b);  // w = (zeta - 1)/(zeta + 1)
      const double u = scale * (a * a + b * b - 1), v = scale * 2 * b, s = u * u + v * v;
      p.push_back({2 * u / (1 + s), 2 * v / (1 + s), (1 - s) / (1 + s)});
    }
  }
  return p;
}

}  // namespace

Family tripolar_family() {
  return {"tripolar", "", "about n", "ocean grid: rows 80 S to 65 N, then a bipolar cap", tripolar_nodes};
}

}  // namespace point_sets
