#include <algorithm>
#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

Points rounded_nodes(std::size_t n, double digits, Random& random) {
  double steps = 1;  // of a degree
  for (int d = static_cast<int>(std::min(digits, 12.0)); d > 0; --d) steps *= 10;
  return distinct(n, [&] {
    for (;;) {
      const double longitude = std::floor(random.uniform(0, 360) * steps) / steps;
      const double latitude = std::floor(random.uniform(-90, 90) * steps) / steps;
      if (latitude > -90 && random.uniform() < cos_degrees(latitude))
        return from_degrees(longitude, latitude);
    }
  });
}

}  // namespace

Family rounded_family() {
  return {"rounded", "3", "n", "uniform, longitude and latitude in degrees with that many decimals",
          rounded_nodes};
}

}  // namespace point_sets
