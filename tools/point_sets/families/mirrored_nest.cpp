#include "shapes.h"

namespace point_sets {
namespace {

/// Any two nodes and their mirror images lie exactly in one circle: ties between coordinates of all sizes.
/// Few are met, but those take big integers.
Points mirrored_nest_nodes(std::size_t n, double decades, Random& random) {
  Point last;
  bool is_mirrored = true;
  return distinct(n, [&] {
    is_mirrored = !is_mirrored;
    if (is_mirrored) return Point{last.x, last.z, last.y};
    const double s = ten_to_minus(decades * random.uniform()), angle = random.uniform(0, 360);
    return last = {1, s * cos_degrees(angle), s * sin_degrees(angle)};
  });
}

}  // namespace

Family mirrored_nest_family() {
  return {"mirrored-nest", "150", "n", "nest, every second node with y and z of the one before exchanged",
          mirrored_nest_nodes};
}

}  // namespace point_sets
