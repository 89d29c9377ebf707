#include "shapes.h"

namespace point_sets {
namespace {

Points box_nodes(std::size_t n, double width, Random&) {
  const std::size_t m = nearest(n, 2, [](std::size_t k) { return k * k; });
  const double step = width * degrees_per_radian / static_cast<double>(m - 1);
  Points p;
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < m; ++i)
      p.push_back(from_degrees(10 + step * static_cast<double>(i), 50 + step * static_cast<double>(j)));
  return p;
}

}  // namespace

Family box_family() {
  return {"box", "0.00175", "m^2", "regional box of that width, row after row", box_nodes};
}

}  // namespace point_sets
