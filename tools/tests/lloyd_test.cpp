// Lloyd's method: its quadrature, its fixed points, and where it leads.

#include "methods/lloyd.h"

#include <gtest/gtest.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "methods/sphere.h"
#include "point_sets.h"

namespace methods {
namespace {

using Points = std::vector<Point>;
constexpr double kFullSphere = 12.566370614359173;

/// The integral of the place over each cell, exactly: by Stokes' theorem half the sum over the sides of their
/// length times their normal.
Points moments(const Points& generators) {
  const files::Faces cells = files::voronoi_faces(files::triangulate(generators));
  Points result;
  for (std::size_t f = 0; f < cells.size(); ++f) {
    Point sum{0, 0, 0};
    for (std::size_t k = cells.begin[f]; k < cells.begin[f + 1]; ++k) {
      const auto at = [&](std::size_t i) {
        return cells.points[static_cast<std::size_t>(cells.corner[i]) - 1];
      };
      const Point a = at(k), b = at(k + 1 < cells.begin[f + 1] ? k + 1 : cells.begin[f]), n = cross(a, b);
      const double sine = std::sqrt(dot(n, n));
      if (sine == 0) continue;
      const double part = std::atan2(sine, dot(a, b)) / sine / 2;
      sum = {sum.x + part * n.x, sum.y + part * n.y, sum.z + part * n.z};
    }
    result.push_back(sum);
  }
  return result;
}

/// Of a step with constant density: the largest distance of a generator from the exact centroid, relative to
/// the mean width of a cell, and the relative error of the energy.
struct Errors {
  double centroid = 0, energy = 0;
};

Errors errors(std::size_t n) {
  const std::unique_ptr<Density> constant = density_of("constant");
  const Points generators = point_sets::make("fibonacci", n), exact = moments(generators);
  Lloyd lloyd(generators, *constant);
  const Lloyd::Step step = lloyd.step();
  Errors errors;
  double energy = 2 * kFullSphere;  // the squared distance is 2 - 2 (place, generator)
  for (std::size_t i = 0; i < n; ++i) {
    const Point d = minus(lloyd.generators()[i], files::unit(exact[i]));
    errors.centroid =
        std::max(errors.centroid, std::sqrt(dot(d, d) / (kFullSphere / static_cast<double>(n))));
    energy -= 2 * dot(generators[i], exact[i]);
  }
  errors.energy = std::fabs(step.energy / energy - 1);
  return errors;
}

TEST(quadrature, is_right_to_the_square_of_the_width_of_a_cell) {
  const Errors coarse = errors(200), fine = errors(3200);
  EXPECT_LT(coarse.centroid, 5e-4);
  EXPECT_LT(fine.centroid, coarse.centroid / 8);  // a quarter of the width
  EXPECT_LT(coarse.energy, 2e-3);
  EXPECT_LT(fine.energy, coarse.energy / 8);
}

TEST(lloyd, does_not_move_what_is_centroidal) {
  const std::unique_ptr<Density> constant = density_of("constant");
  for (const Points& generators :
       {Points{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
        point_sets::make("icosahedral", 12)}) {
    Lloyd lloyd(generators, *constant);
    EXPECT_LT(lloyd.step().move, 1e-14);
  }
}

TEST(lloyd, lowers_the_energy_to_nearly_that_of_hexagons) {
  const std::size_t n = 400;
  const std::unique_ptr<Density> constant = density_of("constant");
  Lloyd lloyd(random_generators(n, *constant, 1), *constant);
  double energy = 1e300;
  for (int i = 0; i < 200; ++i) {
    const Lloyd::Step step = lloyd.step();
    EXPECT_LT(step.energy, energy);
    energy = step.energy;
  }
  // The second moment of a regular hexagon is 5/(18 sqrt 3) of its squared area (Fejes Toth).
  const double hexagons = 5 / (18 * std::sqrt(3)) * kFullSphere * kFullSphere / static_cast<double>(n);
  EXPECT_GT(energy, 0.995 * hexagons);
  EXPECT_LT(energy, 1.03 * hexagons);
}

/// The mean distance from a node to its nearest neighbour, within 12 degrees of a place.
double spacing(const Points& nodes, const Point& place) {
  double sum = 0;
  int count = 0;
  for (const Point& a : nodes) {
    if (dot(a, place) < std::cos(0.21)) continue;
    double least = 9;
    for (const Point& b : nodes)
      if (b != a) least = std::min(least, dot(minus(b, a), minus(b, a)));
    sum += std::sqrt(least);
    ++count;
  }
  return sum / count;
}

TEST(lloyd, makes_cells_as_narrow_as_the_density_asks) {
  const std::unique_ptr<Density> bump = density_of("bump:-120,-45,40,8,4");
  Lloyd lloyd(random_generators(1500, *bump, 7), *bump);
  for (int i = 0; i < 100; ++i) lloyd.step();
  const double fine = spacing(lloyd.generators(), point_sets::from_degrees(-120, -45));
  const double coarse = spacing(lloyd.generators(), point_sets::from_degrees(60, 45));
  EXPECT_NEAR(coarse / fine, 4, 0.4);
}

TEST(density, is_as_documented) {
  std::int32_t near = 1;
  const auto at = [&](const char* formula, double lon, double lat) {
    return density_of(formula)->at(point_sets::from_degrees(lon, lat), near);
  };
  EXPECT_EQ(at("constant", 3, 4), 1);
  for (const char* const formula : {"bump", "bump:0,30,30,10,3"}) {
    EXPECT_NEAR(at(formula, 0, 0), 16, 1e-12);  // at RADIUS halfway: (1 + 2/2)^4
    EXPECT_NEAR(at(formula, 0, 40), std::pow(2 + std::tanh(2), 4), 1e-11);
    EXPECT_NEAR(at(formula, 180, -30), 1, 1e-11);
    EXPECT_EQ(density_of(formula)->largest(), 81);
  }
  EXPECT_NEAR(at("bump:90,0,10,5,0.5", 90, 10), 0.31640625, 1e-14);  // coarser there
  for (const char* const formula :
       {"", "potato", "bumpy", "bump:", "bump:1,2,3,4", "bump:1,2,3,4,5,6", "bump:1,2,3,x,5",
        "bump:0,91,3,4,5", "bump:0,0,3,0,5", "bump:0,0,3,4,0", "bump:0,0,3,4,nan"})
    EXPECT_THROW(density_of(formula), std::invalid_argument) << formula;
}

TEST(sampled_density, is_linear_between_its_nodes_and_must_be_known) {
  const Points nodes = point_sets::make("random", 300);
  std::vector<double> values;
  for (const Point& p : nodes) values.push_back(2 + p.z);
  const std::unique_ptr<Density> density = density_between(nodes, values);
  std::int32_t near = 1;
  EXPECT_EQ(density->at(nodes[7], near), values[7]);
  EXPECT_NEAR(density->at(point_sets::from_degrees(20, 30), near), 2.5, 0.05);
  EXPECT_EQ(density->largest(), *std::max_element(values.begin(), values.end()));

  const std::unique_ptr<Density> regional =
      density_between(point_sets::make("hemisphere", 100), std::vector<double>(100, 1));
  EXPECT_THROW(random_generators(100, *regional, 1), files::NoMesh);
  Lloyd lloyd(point_sets::make("fibonacci", 100), *regional);
  EXPECT_THROW(lloyd.step(), files::NoMesh);
}

TEST(random_generators, are_about_as_dense_as_the_cells_will_be) {
  const std::unique_ptr<Density> bump =
      density_of("bump:0,90,60,1,3");  // nearly a step, to nine times as many
  std::size_t in_cap = 0;
  const Points points = random_generators(4000, *bump, 3);
  for (const Point& p : points) in_cap += p.z > 0.5 ? 1 : 0;  // a quarter of the sphere
  EXPECT_NEAR(static_cast<double>(in_cap), 4000 * 9 / 12.0, 150);
}

TEST(lloyd, refuses_a_hemisphere) {
  const std::unique_ptr<Density> constant = density_of("constant");
  Lloyd lloyd(point_sets::make("hemisphere", 50), *constant);
  EXPECT_THROW(lloyd.step(), files::NoMesh);
}

#ifdef _OPENMP
TEST(lloyd, gives_the_same_bits_on_any_number_of_threads) {
  const Points nodes = point_sets::make("latlon", 500);
  std::vector<double> values;
  for (const Point& p : nodes) values.push_back(std::exp(p.x));
  for (const std::unique_ptr<Density>& density : {density_of("bump"), density_between(nodes, values)}) {
    std::vector<Points> all;
    std::vector<double> energy;
    for (const int threads : {1, 2, 3}) {
      omp_set_num_threads(threads);
      Lloyd lloyd(random_generators(700, *density, 1), *density);
      for (int i = 0; i < 3; ++i) energy.push_back(lloyd.step().energy);
      all.push_back(lloyd.generators());
    }
    for (const std::size_t other : {1, 2}) {
      EXPECT_EQ(all[0], all[other]);
      EXPECT_EQ(energy[2], energy[3 * other + 2]);
    }
  }
}
#endif

}  // namespace
}  // namespace methods
