// Along curves.

#include "shapes.h"

namespace point_sets {
namespace {

Point small_circle_node(double radius, Random& random, std::size_t) {
  const Frame f = frame(centre());
  const double z = cos_degrees(radius * degrees_per_radian), r = sin_degrees(radius * degrees_per_radian);
  const double angle = random.uniform(0, 360);
  return normalized(z * f.c + (r * cos_degrees(angle)) * f.e1 + (r * sin_degrees(angle)) * f.e2);
}

Point two_curves_node(double width, Random& random, std::size_t i) {
  const double t = random.uniform();
  return normalized(i % 2 == 0 ? Point{1, t, width} : Point{1, t * t, -width});
}

Point crossing_node(double length, Random& random, std::size_t i) {
  const Frame f = frame(centre());
  const double t = length * random.uniform(-0.5, 0.5);
  return i % 2 == 0 ? at(f, t, 0.3 * t) : at(f, -0.4 * t, t);
}

Point ellipse_node(double ratio, Random& random, std::size_t) {
  const Frame f = frame(centre());
  const double angle = random.uniform(0, 360);
  return at(f, 0.5 * cos_degrees(angle), 0.5 * ratio * sin_degrees(angle));
}

Point spiral_node(double turns, Random& random, std::size_t) {
  const Frame f = frame(centre());
  const double t = random.uniform(), angle = 360 * turns * t;
  return at(f, t * cos_degrees(angle), t * sin_degrees(angle));
}

Point comb_node(double width, Random& random, std::size_t) {
  constexpr std::size_t lines = 1000;
  const Frame f = frame(centre());
  const double line = static_cast<double>(random.below(lines)) / lines, beside = width * random.uniform();
  return at(f, line + beside - 0.5, random.uniform(-0.5, 0.5));
}

Point falling_tee_node(double decades, Random& random, std::size_t i) {
  const Frame f = frame(centre());
  const double bar = ten_to_minus(decades);
  return i % 2 == 0 ? at(f, bar * random.uniform(-1, 1), 0)
                    : at(f, 0, ten_to_minus(decades * random.uniform()));
}

Point moment_node(double decades, Random& random, std::size_t) {
  const double t = ten_to_minus(decades * random.uniform());
  return Point{1, t, t * t};
}

}  // namespace

std::vector<Family> curves_families() {
  return {
      drawn("small-circle", "1", "on one circle of that radius, tilted, so that rounding moves each off it",
            small_circle_node),
      drawn("two-curves", "1e-3", "along (1, t, w) and (1, t^2, minus w), t uniform; the parameter is w",
            two_curves_node),
      drawn("crossing", "1e-3", "along two arcs of that length that cross", crossing_node),
      drawn("ellipse", "1e-9", "along an ellipse of that ratio of its axes", ellipse_node),
      drawn("spiral", "20", "along a spiral of that many turns", spiral_node),
      drawn("comb", "1e-9", "along 1,000 parallel lines, in strips of that width", comb_node),
      drawn("falling-tee", "6",
            "half on a bar 10^-d long, half on a stem, 10^(-d u) from it; the parameter is d",
            falling_tee_node),
      drawn("moment", "6", "(1, t, t^2), t over that many decades; lengths are not 1", moment_node),
  };
}

}  // namespace point_sets
