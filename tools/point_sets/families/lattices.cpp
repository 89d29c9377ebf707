// Lattices.
#include <algorithm>
#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

std::size_t divisor(std::size_t a, std::size_t b) { return b == 0 ? a : divisor(b, a % b); }
std::size_t size(int i) { return static_cast<std::size_t>(i < 0 ? -i : i); }

/// Shell m: the integer vectors with greatest common divisor 1 whose largest coordinate is +-m.
Points shell(int m) {
  Points p;
  for (int i = -m; i <= m; ++i)
    for (int j = -m; j <= m; ++j)
      for (int k = -m; k <= m; k += size(i) == size(m) || size(j) == size(m) ? 1 : 2 * m)
        if (divisor(divisor(size(i), size(j)), size(k)) == 1)
          p.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
  return p;
}

Points lattice_nodes(std::size_t n, double, Random& random) {
  Points p;
  for (int m = 1; p.size() < n; ++m) {
    Points outer = shell(m);
    shuffle(outer, random.bits());
    outer.resize(std::min(outer.size(), n - p.size()));
    p.insert(p.end(), outer.begin(), outer.end());
  }
  shuffle(p, random.bits());
  return p;
}

Points earth_nodes(std::size_t n, double radius, Random&) {
  Points p = make("latlon", n);
  for (Point& q : p) q = radius * q;
  return p;
}

Points rounded_nodes(std::size_t n, double digits, Random& random) {
  double steps = 1;  // of a degree
  for (int d = static_cast<int>(std::min(digits, 12.0)); d > 0; --d) steps *= 10;
  return distinct(n, [&] {
    for (;;) {
      const double longitude = std::floor(random.uniform(0, 360) * steps) / steps;
      const double latitude = std::floor(random.uniform(-90, 90) * steps) / steps;
      if (latitude > -90 && random.uniform() < cos_degrees(latitude))
        return from_degrees(longitude, latitude);
    }
  });
}

Points rotated_pole_nodes(std::size_t n, double width, Random&) {
  const std::size_t m = nearest(n, 2, [](std::size_t k) { return k * k; });
  const double step = width * degrees_per_radian / static_cast<double>(m - 1);
  const double c = sin_degrees(39.25), s = cos_degrees(39.25);  // the pole at 39.25 N, 162 W
  Points p;
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < m; ++i) {
      const auto from_middle = [&](std::size_t k) {
        return step * (static_cast<double>(k) - 0.5 * static_cast<double>(m - 1));
      };
      const Point q = from_degrees(from_middle(i), from_middle(j));
      const Point tilted{c * q.x - s * q.z, q.y, s * q.x + c * q.z};
      p.push_back({cos_degrees(18) * tilted.x - sin_degrees(18) * tilted.y,
                   sin_degrees(18) * tilted.x + cos_degrees(18) * tilted.y, tilted.z});
    }
  return p;
}

// A square of 4 m x 4 m cells; its inner 2 m x 2 m cells are replaced by the square of the next level, and so
// on.
Points refined_nodes(std::size_t n, double levels, Random&) {
  const std::size_t finest = static_cast<std::size_t>(levels);
  const std::size_t m = nearest(n, 1, [&](std::size_t k) { return 12 * k * k * finest + 16 * k * k; });
  const Frame f = frame(centre());
  double half = 0.5;
  Points p;
  for (std::size_t level = 0; level <= finest; ++level, half /= 2)
    for (std::size_t j = 0; j < 4 * m; ++j)
      for (std::size_t i = 0; i < 4 * m; ++i) {
        const auto is_inner = [m](std::size_t k) { return k >= m && k < 3 * m; };
        if (level < finest && is_inner(i) && is_inner(j)) continue;
        const auto cell = [&](std::size_t k) {
          return half * ((static_cast<double>(k) + 0.5) / static_cast<double>(2 * m) - 1);
        };
        p.push_back(at(f, cell(i), cell(j)));
      }
  return p;
}

}  // namespace

std::vector<Family> lattices_families() {
  return {
      {"lattice", "", "n",
       "directions to the vertices of a cubic lattice, shell after shell, shuffled; lengths are not 1",
       lattice_nodes},
      {"earth", "6371229", "2 m^2 + 2", "latlon on a sphere of that radius", earth_nodes},
      {"rounded", "3", "n", "uniform, longitude and latitude in degrees with that many decimals",
       rounded_nodes},
      {"rotated-pole", "0.7", "m^2",
       "regional box of that width on the equator of a rotated pole, row after row", rotated_pole_nodes},
      {"refined", "20", "(12 k + 16) m^2", "mesh cells that halve k times towards a place", refined_nodes},
  };
}

}  // namespace point_sets
