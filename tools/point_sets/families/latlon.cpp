#include "shapes.h"

namespace point_sets {
namespace {

Points latlon_nodes(std::size_t n, double, Random&) {
  const std::size_t rows = nearest(n, 2, [](std::size_t k) { return 2 * k * k + 2; });
  Points p{{0, 0, -1}};
  for (std::size_t j = 1; j <= rows; ++j)
    for (std::size_t i = 0; i < 2 * rows; ++i)
      p.push_back(from_degrees(360 * static_cast<double>(i) / static_cast<double>(2 * rows),
                               -90 + 180 * static_cast<double>(j) / static_cast<double>(rows + 1)));
  p.push_back({0, 0, 1});
  return p;
}

}  // namespace

Family latlon_family() {
  return {"latlon", "", "2 m^2 + 2", "m rows of 2 m, south to north, and the poles (first, last)",
          latlon_nodes};
}

}  // namespace point_sets
