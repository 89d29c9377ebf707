// Over many decades, and as close as doubles can be.
#include <algorithm>
#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

Point falling_node(double decades, Random& random, std::size_t) {
  const Frame f = frame(centre());
  const double s = ten_to_minus(decades * random.uniform()), angle = random.uniform(0, 360);
  return at(f, s * cos_degrees(angle), s * sin_degrees(angle));
}

/// The double `steps` doubles after `value`.
double beyond(double value, std::size_t steps) {
  for (; steps > 0; --steps) value = std::nextafter(value, 2);
  return value;
}

// The nodes of a group fill a cube of doubles: their bits number x, y and z in turn.
Points ulp_groups_nodes(std::size_t n, double size, Random& random) {
  const std::size_t group = std::max<std::size_t>(1, static_cast<std::size_t>(size));
  Point first{};
  std::size_t i = 0;
  return distinct(n, [&] {
    const std::size_t k = i++ % group;
    if (k == 0) first = random.direction();
    return Point{beyond(first.x, k % 2 + 2 * (k / 8)), beyond(first.y, k / 2 % 2),
                 beyond(first.z, k / 4 % 2)};
  });
}

Point axis_cap_node(double radius, Random& random, std::size_t) {
  const auto [u, v] = in_disc(random);
  return Point{1, radius * u, radius * v};
}

Point nest_node(double decades, Random& random, std::size_t) {
  const double s = ten_to_minus(decades * random.uniform()), angle = random.uniform(0, 360);
  return Point{1, s * cos_degrees(angle), s * sin_degrees(angle)};
}

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

Point rays_node(double decades, Random& random, std::size_t i) {
  constexpr std::size_t rays = 64;
  if (i == 0) return {1, 0, 0};
  const double s = ten_to_minus(decades * random.uniform()),
               angle = 360 * static_cast<double>(random.below(rays)) / rays;
  return {1, s * cos_degrees(angle), s * sin_degrees(angle)};
}

}  // namespace

std::vector<Family> close_families() {
  return {
      drawn("falling", "14", "density that falls with the distance from a place over that many decades",
            falling_node),
      {"ulp-groups", "2", "n", "uniform groups of that many nodes, neighbours are one last bit apart",
       ulp_groups_nodes},
      drawn("axis-cap", "1e-150", "(1, y, z) in a disc of that radius; lengths are not rounded to 1",
            axis_cap_node),
      drawn("nest", "150",
            "(1, y, z) at distances from (1, 0, 0) over that many decades; lengths are not rounded to 1",
            nest_node),
      {"mirrored-nest", "150", "n", "nest, every second node with y and z of the one before exchanged",
       mirrored_nest_nodes},
      drawn("rays", "100", "nest along 64 rays, and (1, 0, 0)", rays_node),
  };
}

}  // namespace point_sets
