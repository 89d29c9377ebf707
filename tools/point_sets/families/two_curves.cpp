#include "shapes.h"

namespace point_sets {
namespace {

Points two_curves_nodes(std::size_t n, double width, Random& random) {
  std::size_t i = 0;
  return distinct(n, [&] {
    const double t = random.uniform();
    return normalized(i++ % 2 == 0 ? Point{1, t, width} : Point{1, t * t, -width});
  });
}

}  // namespace

Family two_curves_family() {
  return {"two-curves", "1e-3", "n", "along (1, t, w) and (1, t^2, minus w), t uniform; the parameter is w",
          two_curves_nodes};
}

}  // namespace point_sets
