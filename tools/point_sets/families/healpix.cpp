#include <algorithm>
#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

Points healpix_nodes(std::size_t n, double, Random&) {
  const std::size_t m = nearest(n, 1, [](std::size_t k) { return 12 * k * k; });
  Points p;
  for (std::size_t ring = 1; ring < 4 * m; ++ring) {
    const std::size_t from_pole = std::min(ring, 4 * m - ring);
    const double mm = static_cast<double>(m), i = static_cast<double>(from_pole);
    double z, shift;
    std::size_t count;
    if (from_pole < m) {
      z = 1 - i * i / (3 * mm * mm), shift = 0.5, count = 4 * from_pole;
    } else {
      z = 4.0 / 3 - 2 * i / (3 * mm), shift = (ring - m) % 2 == 0 ? 0.5 : 0, count = 4 * m;
    }
    const double r = std::sqrt((1 - z) * (1 + z));
    for (std::size_t j = 0; j < count; ++j) {
      const double longitude = 360 * (static_cast<double>(j) + shift) / static_cast<double>(count);
      p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), ring <= 2 * m ? z : -z});
    }
  }
  return p;
}

}  // namespace

Family healpix_family() { return {"healpix", "", "12 m^2", "HEALPix centres, ring order", healpix_nodes}; }

}  // namespace point_sets
