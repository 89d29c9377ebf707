#include "shapes.h"

namespace point_sets {
namespace {

Points nest_nodes(std::size_t n, double decades, Random& random) {
  return distinct(n, [&] {
    const double s = ten_to_minus(decades * random.uniform()), angle = random.uniform(0, 360);
    return Point{1, s * cos_degrees(angle), s * sin_degrees(angle)};
  });
}

}  // namespace

Family nest_family() {
  return {"nest", "150", "n",
          "(1, y, z) at distances from (1, 0, 0) over that many decades; lengths are not rounded to 1",
          nest_nodes};
}

}  // namespace point_sets
