#include "shapes.h"

namespace point_sets {
namespace {

Points falling_nodes(std::size_t n, double decades, Random& random) {
  const Frame f = frame(centre());
  return distinct(n, [&] {
    const double s = ten_to_minus(decades * random.uniform()), angle = random.uniform(0, 360);
    return at(f, s * cos_degrees(angle), s * sin_degrees(angle));
  });
}

}  // namespace

Family falling_family() {
  return {"falling", "14", "n", "density that falls with the distance from a place over that many decades",
          falling_nodes};
}

}  // namespace point_sets
