#include "shapes.h"

namespace point_sets {
namespace {

Points spiral_nodes(std::size_t n, double turns, Random& random) {
  const Frame f = frame(centre());
  return distinct(n, [&] {
    const double t = random.uniform(), angle = 360 * turns * t;
    return at(f, t * cos_degrees(angle), t * sin_degrees(angle));
  });
}

}  // namespace

Family spiral_family() { return {"spiral", "20", "n", "along a spiral of that many turns", spiral_nodes}; }

}  // namespace point_sets
