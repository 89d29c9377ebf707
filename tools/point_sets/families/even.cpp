// Everywhere on the sphere, and grids of models.
#include <algorithm>
#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

Points random_nodes(std::size_t n, double, Random& random) { return uniform(n, random); }

Points single_nodes(std::size_t n, double, Random& random) {
  Points p = uniform(n, random);
  for (Point& q : p) q = rounded_to_single(q);
  return p;
}

Points fibonacci_nodes(std::size_t n, double, Random&) {
  Points p;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
    const double r = std::sqrt((1 - z) * (1 + z));
    const double longitude = std::fmod(static_cast<double>(i) * 137.50776405003785464634873962837, 360);
    p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), z});
  }
  return p;
}

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

Points latlon_nodes(std::size_t n, double, Random&) {
  const std::size_t rows = nearest(n, 2, [](std::size_t k) { return 2 * k * k + 2; });
  Points p{{0, 0, -1}};
  for (std::size_t j = 1; j <= rows; ++j)
    for (std::size_t i = 0; i < 2 * rows; ++i)
      p.push_back(from_degrees(360 * static_cast<double>(i) / static_cast<double>(2 * rows),
                               -90 + 180 * static_cast<double>(j) / static_cast<double>(rows + 1)));
  p.push_back({0, 0, 1});
  return p;
}

/// The root number i = 1, 2, ... (from the north) of the Legendre polynomial of the given degree.
double gaussian_sine(std::size_t i, std::size_t degree) {
  const double d = static_cast<double>(degree);
  double z = cos_degrees(180 * (static_cast<double>(i) - 0.25) / (d + 0.5));
  for (int newton = 0; newton < 6; ++newton) {
    double p0 = 1, p1 = z;
    for (std::size_t k = 2; k <= degree; ++k) {
      const double kk = static_cast<double>(k);
      const double p2 = ((2 * kk - 1) * z * p1 - (kk - 1) * p0) / kk;
      p0 = p1, p1 = p2;
    }
    z -= p1 * (z * z - 1) / (d * (z * p1 - p0));
  }
  return z;
}

Points reduced_gaussian_nodes(std::size_t n, double, Random&) {
  const std::size_t m = nearest(n, 1, [](std::size_t k) { return 4 * k * (k + 9); });
  Points p;
  for (std::size_t row = 1; row <= 2 * m; ++row) {
    const std::size_t from_pole = row <= m ? row : 2 * m + 1 - row, count = 4 * from_pole + 16;
    const double z = (row <= m ? 1 : -1) * gaussian_sine(from_pole, 2 * m), r = std::sqrt((1 - z) * (1 + z));
    for (std::size_t i = 0; i < count; ++i) {
      const double longitude = 360 * static_cast<double>(i) / static_cast<double>(count);
      p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), z});
    }
  }
  return p;
}

Points healpix_nodes(std::size_t n, double, Random&) {
  const std::size_t m = nearest(n, 1, [](std::size_t k) { return 12 * k * k; });
  Points p;
  for (std::size_t ring = 1; ring < 4 * m; ++ring) {
    const std::size_t from_pole = std::min(ring, 4 * m - ring);
    const double mm = static_cast<double>(m), i = static_cast<double>(from_pole);
    double z, shift;
    std::size_t count;
    if (from_pole < m) {
      z = 1 - i * i / (3 * mm * mm), shift = 0.5, count = 4 * from_pole;
    } else {
      z = 4.0 / 3 - 2 * i / (3 * mm), shift = (ring - m) % 2 == 0 ? 0.5 : 0, count = 4 * m;
    }
    const double r = std::sqrt((1 - z) * (1 + z));
    for (std::size_t j = 0; j < count; ++j) {
      const double longitude = 360 * (static_cast<double>(j) + shift) / static_cast<double>(count);
      p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), ring <= 2 * m ? z : -z});
    }
  }
  return p;
}

Points cubed_sphere_nodes(std::size_t n, double, Random&) {
  const std::size_t m = nearest(n, 1, [](std::size_t k) { return 6 * k * k; });
  const Points face[6] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},   {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
                          {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                          {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},  {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}};
  const auto tangent = [m](std::size_t i) {
    const double angle = 90 * (static_cast<double>(2 * i + 1) / static_cast<double>(2 * m)) - 45;
    return sin_degrees(angle) / cos_degrees(angle);
  };
  Points p;
  for (const Points& f : face)
    for (std::size_t j = 0; j < m; ++j)
      for (std::size_t i = 0; i < m; ++i)
        p.push_back(normalized(f[0] + tangent(i) * f[1] + tangent(j) * f[2]));
  return p;
}

// In the cap north of 65 N, as the disc |w| < 1 of a stereographic map, the two poles sit at w = +-1; with
// zeta = (1+w)/(1-w) the grid lines are the rays and the circles around 0 of the half plane Re zeta > 0.
Points tripolar_nodes(std::size_t n, double, Random&) {
  const auto southern = [](std::size_t m) { return (m * 145 + 180) / 360 + 1; };  // rows 80 S .. 65 N
  const auto northern = [](std::size_t m) { return m / 8; };                      // rows up to the seam
  const std::size_t m =
      2 * nearest(n, 2, [&](std::size_t k) { return 2 * k * southern(2 * k) + 2 * k * northern(2 * k) + k; });
  const auto column = [m](std::size_t i) {
    return 360 * (static_cast<double>(i) + 0.5) / static_cast<double>(m);
  };
  Points p;
  for (std::size_t j = 0; j < southern(m); ++j)
    for (std::size_t i = 0; i < m; ++i)
      p.push_back(
          from_degrees(column(i), -80 + 145 * static_cast<double>(j) / static_cast<double>(southern(m) - 1)));
  const double edge = cos_degrees(65) / (1 + sin_degrees(65));  // stereographic radius of 65 N
  for (std::size_t j = 1; j <= northern(m) + 1; ++j) {
    const bool seam = j == northern(m) + 1;
    const double ray = 90 * (1 - static_cast<double>(j) / static_cast<double>(northern(m) + 1));
    for (std::size_t i = 0; i < (seam ? m / 2 : m); ++i) {
      const double half = 0.5 * column(i), radius = std::fabs(cos_degrees(half) / sin_degrees(half));
      const double a = radius * cos_degrees(ray), b = (i < m / 2 ? 1 : -1) * radius * sin_degrees(ray);
      const double scale = edge / ((a + 1) * (a + 1) + b * b);  // w = (zeta - 1)/(zeta + 1)
      const double u = scale * (a * a + b * b - 1), v = scale * 2 * b, s = u * u + v * v;
      p.push_back({2 * u / (1 + s), 2 * v / (1 + s), (1 - s) / (1 + s)});
    }
  }
  return p;
}

Points ring_nodes(std::size_t n, double, Random&) {
  Points p;
  const double z = sin_degrees(60), r = 0.5;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double longitude = 360 * static_cast<double>(i) / static_cast<double>(n - 1);
    p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), z});
  }
  if (n > 0) p.push_back({0, 0, 1});
  return p;
}

}  // namespace

std::vector<Family> even_families() {
  return {
      {"random", "", "n", "uniform on the sphere", random_nodes},
      {"single", "", "n", "uniform, coordinates rounded to single precision", single_nodes},
      {"fibonacci", "", "n", "golden-angle spiral", fibonacci_nodes},
      {"icosahedral", "", "10 m^2 + 2", "geodesic subdivision of the icosahedron: corners, edges, faces",
       icosahedral_nodes},
      {"latlon", "", "2 m^2 + 2", "m rows of 2 m, south to north, and the poles (first, last)", latlon_nodes},
      {"reduced-gaussian", "", "4 m (m + 9)", "octahedral reduced Gaussian grid, north to south",
       reduced_gaussian_nodes},
      {"healpix", "", "12 m^2", "HEALPix centres, ring order", healpix_nodes},
      {"cubed-sphere", "", "6 m^2", "equiangular cell centres, panel after panel", cubed_sphere_nodes},
      {"tripolar", "", "about n", "ocean grid: rows 80 S to 65 N, then a bipolar cap", tripolar_nodes},
      {"ring", "", "n", "n - 1 nodes on the parallel 60 N, cocircular, and the pole", ring_nodes},
  };
}

}  // namespace point_sets
