#include "shapes.h"

#include <cmath>

namespace point_sets {

std::pair<double, double> in_disc(Random& random) {
  for (;;) {
    const double u = random.uniform(-1, 1), v = random.uniform(-1, 1), s = u * u + v * v;
    if (s > 0 && s < 1) return {u, v};
  }
}

Point in_cap(Random& random, const Point& c, double radius) {
  const Point axis = std::fabs(c.x) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point e1 = normalized(cross(c, axis)), e2 = cross(c, e1);
  const double half = sin_degrees(0.5 * radius * degrees_per_radian);
  const auto [u, v] = in_disc(random);
  const double s = u * u + v * v;
  const double drop = s * 2 * half * half;  // 1 - cos of the distance from c
  const double r = std::sqrt(drop * (2 - drop) / s);
  return normalized((1 - drop) * c + (r * u) * e1 + (r * v) * e2);
}

Point centre() { return normalized({0.3, -0.5, 0.8}); }

Points uniform(std::size_t n, Random& random) {
  Points p(n);
  for (Point& q : p) q = random.direction();
  return p;
}

Points caps(std::size_t n, const Points& centres, double radius, Random& random) {
  Points p;
  for (std::size_t i = 0; i < n; ++i) p.push_back(in_cap(random, centres[i % centres.size()], radius));
  return p;
}

Points half_in_caps(std::size_t n, const Points& centres, double radius, Random& random) {
  Points p;
  for (std::size_t i = 0; i < n; ++i)
    p.push_back(i % 2 == 0 ? random.direction() : in_cap(random, centres[i / 2 % centres.size()], radius));
  return p;
}

}  // namespace point_sets
