// Along curves.

#include "shapes.h"

namespace point_sets {
namespace {

Points small_circle_nodes(std::size_t n, double radius, Random& random) {
  const Frame f = frame(centre());
  const double z = cos_degrees(radius * degrees_per_radian), r = sin_degrees(radius * degrees_per_radian);
  return distinct(n, [&] {
    const double angle = random.uniform(0, 360);
    return normalized(z * f.c + (r * cos_degrees(angle)) * f.e1 + (r * sin_degrees(angle)) * f.e2);
  });
}

Points two_curves_nodes(std::size_t n, double width, Random& random) {
  std::size_t i = 0;
  return distinct(n, [&] {
    const double t = random.uniform();
    return normalized(i++ % 2 == 0 ? Point{1, t, width} : Point{1, t * t, -width});
  });
}

Points crossing_nodes(std::size_t n, double length, Random& random) {
  const Frame f = frame(centre());
  std::size_t i = 0;
  return distinct(n, [&] {
    const double t = length * random.uniform(-0.5, 0.5);
    return i++ % 2 == 0 ? at(f, t, 0.3 * t) : at(f, -0.4 * t, t);
  });
}

Points ellipse_nodes(std::size_t n, double ratio, Random& random) {
  const Frame f = frame(centre());
  return distinct(n, [&] {
    const double angle = random.uniform(0, 360);
    return at(f, 0.5 * cos_degrees(angle), 0.5 * ratio * sin_degrees(angle));
  });
}

Points spiral_nodes(std::size_t n, double turns, Random& random) {
  const Frame f = frame(centre());
  return distinct(n, [&] {
    const double t = random.uniform(), angle = 360 * turns * t;
    return at(f, t * cos_degrees(angle), t * sin_degrees(angle));
  });
}

Points comb_nodes(std::size_t n, double width, Random& random) {
  constexpr std::size_t lines = 1000;
  const Frame f = frame(centre());
  return distinct(n, [&] {
    const double line = static_cast<double>(random.below(lines)) / lines, beside = width * random.uniform();
    return at(f, line + beside - 0.5, random.uniform(-0.5, 0.5));
  });
}

Points falling_tee_nodes(std::size_t n, double decades, Random& random) {
  const Frame f = frame(centre());
  const double bar = ten_to_minus(decades);
  std::size_t i = 0;
  return distinct(n, [&] {
    return i++ % 2 == 0 ? at(f, bar * random.uniform(-1, 1), 0)
                        : at(f, 0, ten_to_minus(decades * random.uniform()));
  });
}

Points moment_nodes(std::size_t n, double decades, Random& random) {
  return distinct(n, [&] {
    const double t = ten_to_minus(decades * random.uniform());
    return Point{1, t, t * t};
  });
}

}  // namespace

std::vector<Family> curves_families() {
  return {
      {"small-circle", "1", "n", "on one circle of that radius, tilted, so that rounding moves each off it",
       small_circle_nodes},
      {"two-curves", "1e-3", "n", "along (1, t, w) and (1, t^2, minus w), t uniform; the parameter is w",
       two_curves_nodes},
      {"crossing", "1e-3", "n", "along two arcs of that length that cross", crossing_nodes},
      {"ellipse", "1e-9", "n", "along an ellipse of that ratio of its axes", ellipse_nodes},
      {"spiral", "20", "n", "along a spiral of that many turns", spiral_nodes},
      {"comb", "1e-9", "n", "along 1,000 parallel lines, in strips of that width", comb_nodes},
      {"falling-tee", "6", "n",
       "half on a bar 10^-d long, half on a stem, 10^(-d u) from it; the parameter is d", falling_tee_nodes},
      {"moment", "6", "n", "(1, t, t^2), t over that many decades; lengths are not 1", moment_nodes},
  };
}

}  // namespace point_sets
