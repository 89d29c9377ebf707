#include "shapes.h"

namespace point_sets {
namespace {

Points ellipse_nodes(std::size_t n, double ratio, Random& random) {
  const Frame f = frame(centre());
  return distinct(n, [&] {
    const double angle = random.uniform(0, 360);
    return at(f, 0.5 * cos_degrees(angle), 0.5 * ratio * sin_degrees(angle));
  });
}

}  // namespace

Family ellipse_family() {
  return {"ellipse", "1e-9", "n", "along an ellipse of that ratio of its axes", ellipse_nodes};
}

}  // namespace point_sets
