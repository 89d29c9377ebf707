#include "shapes.h"

namespace point_sets {
namespace {

/// Two nodes and their mirror images lie exactly on one circle: ties between coordinates of all magnitudes.
/// Few of them are tested, but these need big integers.
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
