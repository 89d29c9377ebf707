#include "shapes.h"

namespace point_sets {
namespace {

Points ring_nodes(std::size_t n, double, Random&) {
  Points p;
  const double z = sin_degrees(60), r = 0.5;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double longitude = 360 * static_cast<double>(i) / static_cast<double>(n - 1);
    p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), z});
  }
  if (n > 0) p.push_back({0, 0, 1});
  return p;
}

}  // namespace

Family ring_family() {
  return {"ring", "", "n", "n - 1 nodes on the parallel 60 N, cocircular, and the pole", ring_nodes};
}

}  // namespace point_sets
