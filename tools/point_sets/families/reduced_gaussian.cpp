#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

/// The root number i = 1, 2, ... (from the north) of the Legendre polynomial of the given degree.
double gaussian_sine(std::size_t i, std::size_t degree) {
  const double d = static_cast<double>(degree);
  double z = cos_degrees(180 * (static_cast<double>(i) - 0.25) / (d + 0.5));
  for (int newton = 0; newton < 6; ++newton) {
    double p0 = 1, p1 = z;
    for (std::size_t k = 2; k <= degree; ++k) {
      const double kk = static_cast<double>(k);
      const double p2 = ((2 * kk - 1) * z * p1 - (kk - 1) * p0) / kk;
      p0 = p1, p1 = p2;
    }
    z -= p1 * (z * z - 1) / (d * (z * p1 - p0));
  }
  return z;
}

Points reduced_gaussian_nodes(std::size_t n, double, Random&) {
  const std::size_t m = nearest(n, 1, [](std::size_t k) { return 4 * k * (k + 9); });
  Points p;
  for (std::size_t row = 1; row <= 2 * m; ++row) {
    const std::size_t from_pole = row <= m ? row : 2 * m + 1 - row, count = 4 * from_pole + 16;
    const double z = (row <= m ? 1 : -1) * gaussian_sine(from_pole, 2 * m), r = std::sqrt((1 - z) * (1 + z));
    for (std::size_t i = 0; i < count; ++i) {
      const double longitude = 360 * static_cast<double>(i) / static_cast<double>(count);
      p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), z});
    }
  }
  return p;
}

}  // namespace

Family reduced_gaussian_family() {
  return {"reduced-gaussian", "", "4 m (m + 9)", "octahedral reduced Gaussian grid, north to south",
          reduced_gaussian_nodes};
}

}  // namespace point_sets
