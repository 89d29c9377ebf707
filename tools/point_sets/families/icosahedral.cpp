#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

Points icosahedral_nodes(std::size_t n, double, Random&) {
  const std::size_t m = nearest(n, 1, [](std::size_t k) { return 10 * k * k + 2; });
  const double g = (1 + std::sqrt(5.0)) / 2;
  const Points corner = {{-1, g, 0},  {-g, 0, 1}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                         {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {1, g, 0}};
  const std::size_t face[20][3] = {{0, 1, 5},  {0, 5, 11}, {0, 11, 7}, {0, 7, 10}, {0, 10, 1},
                                   {11, 5, 9}, {5, 1, 4},  {1, 10, 2}, {10, 7, 6}, {7, 11, 8},
                                   {3, 9, 4},  {3, 4, 2},  {3, 2, 6},  {3, 6, 8},  {3, 8, 9},
                                   {4, 9, 5},  {2, 4, 1},  {6, 2, 10}, {8, 6, 7},  {9, 8, 11}};
  Points p;
  for (const Point& c : corner) p.push_back(normalized(c));
  const auto at = [m](std::size_t i) { return static_cast<double>(i) / static_cast<double>(m); };
  for (const auto& f : face)
    for (int k = 0; k < 3; ++k) {
      const std::size_t a = f[k], b = f[(k + 1) % 3];
      if (a < b)  // each edge once
        for (std::size_t i = 1; i < m; ++i)
          p.push_back(normalized(at(m - i) * corner[a] + at(i) * corner[b]));
    }
  for (const auto& f : face)
    for (std::size_t i = 1; i < m; ++i)
      for (std::size_t j = 1; i + j < m; ++j)
        p.push_back(normalized(at(m - i - j) * corner[f[0]] + at(i) * corner[f[1]] + at(j) * corner[f[2]]));
  return p;
}

}  // namespace

Family icosahedral_family() {
  return {"icosahedral", "", "10 m^2 + 2", "geodesic subdivision of the icosahedron: corners, edges, faces",
          icosahedral_nodes};
}

}  // namespace point_sets
