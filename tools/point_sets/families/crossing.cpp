#include "shapes.h"

namespace point_sets {
namespace {

Points crossing_nodes(std::size_t n, double length, Random& random) {
  const Frame f = frame(centre());
  std::size_t i = 0;
  return distinct(n, [&] {
    const double t = length * random.uniform(-0.5, 0.5);
    return i++ % 2 == 0 ? at(f, t, 0.3 * t) : at(f, -0.4 * t, t);
  });
}

}  // namespace

Family crossing_family() {
  return {"crossing", "1e-3", "n", "along two arcs of that length that cross", crossing_nodes};
}

}  // namespace point_sets
