// Of uneven density.
#include <algorithm>
#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

// Density 1/(b - z)^2 along the axis z: its integral is elementary, and so is the inverse of that.
Points variable_nodes(std::size_t n, double ratio, Random& random) {
  const double root = std::sqrt(ratio), b = (root + 1) / (root - 1), low = 1 / (b + 1), high = 1 / (b - 1);
  Points p(n);
  for (Point& q : p) {
    const double z = std::clamp(b - 1 / (low + random.uniform() * (high - low)), -1.0, 1.0);
    const auto [u, v] = in_disc(random);
    const double r = std::sqrt((1 - z) * (1 + z) / (u * u + v * v));
    q = {z, r * u, r * v};
  }
  return p;
}

Points clusters_nodes(std::size_t n, double radius, Random& random) {
  Random of_centres(8);
  return half_in_caps(n, uniform(8, of_centres), radius, random);
}

Points dense_cap_node(std::size_t n, double radius, Random& random) {
  return half_in_caps(n, {centre()}, radius, random);
}

Points antipodal_nodes(std::size_t n, double radius, Random& random) {
  return caps(n, {centre(), -1.0 * centre()}, radius, random);
}

Point cap_node(double radius, Random& random, std::size_t) { return in_cap(random, centre(), radius); }

Points box_nodes(std::size_t n, double width, Random&) {
  const std::size_t m = nearest(n, 2, [](std::size_t k) { return k * k; });
  const double step = width * degrees_per_radian / static_cast<double>(m - 1);
  Points p;
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < m; ++i)
      p.push_back(from_degrees(10 + step * static_cast<double>(i), 50 + step * static_cast<double>(j)));
  return p;
}

Points strip_nodes(std::size_t n, double width, Random& random) {
  const Point e1 = normalized(cross(centre(), {1, 0, 0})), e2 = cross(centre(), e1);
  Points p;
  for (std::size_t i = 0; i < n; ++i) {
    const double longitude = random.uniform(0, 360), height = width * (random.uniform() - 0.5);
    p.push_back(normalized(cos_degrees(longitude) * e1 + sin_degrees(longitude) * e2 + height * centre()));
  }
  return p;
}

// Each node of the stem sees the whole bar until a nearer node has been inserted. The stem runs along an edge
// of the face -x of the cube around the sphere, as the curve of insertion_order.h does; the bar lies beyond
// it.
Points tee_nodes(std::size_t n, double width, Random& random) {
  const std::size_t bar = n / 2, stem = n - bar;
  const auto jitter = [&] { return width * random.uniform(); };
  Points p;
  for (std::size_t i = 0; i < stem; ++i) {
    const double along = 1.9 * (static_cast<double>(i) + 0.5) / static_cast<double>(stem);
    p.push_back(normalized({-1, 0.95 - along, 0.99 + jitter()}));
    if (i < bar)
      p.push_back(normalized(
          {-1, -1.05 - jitter(), 0.49 + (static_cast<double>(i) + 0.5) / static_cast<double>(bar)}));
  }
  return p;
}

Points pairs_nodes(std::size_t n, double distance, Random& random) {
  Points p;
  for (std::size_t i = 0; i < (n + 1) / 2; ++i) {
    const Point q = random.direction();
    p.push_back(q);
    p.push_back(normalized(q + distance * normalized(cross(q, random.direction()))));
  }
  return p;
}

Point hemisphere_node(double, Random& random, std::size_t) {
  Point p = random.direction();
  while (!(p.z > 0)) p = random.direction();
  return p;
}

Point hemisphere_rim_node(double, Random& random, std::size_t i) {
  if (i % 2 == 1) return hemisphere_node(0, random, i);
  random.direction();
  const double longitude = random.uniform(0, 360);
  return {cos_degrees(longitude), sin_degrees(longitude), 0};
}

}  // namespace

std::vector<Family> uneven_families() {
  return {
      {"variable", "1e4", "n", "smooth density, its largest over its smallest value", variable_nodes},
      {"clusters", "1e-3", "n", "half uniform, half in eight caps of that radius", clusters_nodes},
      {"dense-cap", "1e-5", "n", "half uniform, half in one cap of that radius", dense_cap_node},
      {"antipodal", "0.1", "n", "two caps of that radius, opposite each other", antipodal_nodes},
      drawn("cap", "0.0175", "uniform in a cap of that radius", cap_node),
      {"box", "0.00175", "m^2", "regional box of that width, row after row", box_nodes},
      {"strip", "1e-9", "n", "along a tilted great circle, in a strip of that width", strip_nodes},
      {"tee", "1e-8", "n", "half along an arc, half towards its middle, in strips of that width", tee_nodes},
      {"pairs", "1e-10", "2 m", "uniform, each node with a neighbour at that distance", pairs_nodes},
      drawn("hemisphere", "", "uniform in the open hemisphere z > 0", hemisphere_node),
      drawn("hemisphere-rim", "", "half of them exactly on the equator, half north of it",
            hemisphere_rim_node),
  };
}

}  // namespace point_sets
