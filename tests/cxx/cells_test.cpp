// The integrals over Voronoi cells at every scale, against closed forms with 400 digits.

#include "scvt/cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "point_sets.h"
#include "scvt/evaluator.h"
#include "scvt/tessellation.h"
#include "support/formula_density.h"
#include "support/many_digits.h"

namespace {

using namespace pstripack;
using namespace pstripack::scvt;
using many_digits::cross;
using many_digits::direction;
using many_digits::dot;
using many_digits::Real;
using many_digits::unit;
using many_digits::Vector;

Vector operator*(const Real& f, const Vector& p) { return {f * p.x, f * p.y, f * p.z}; }

struct Integrals {
  Real mass = 0, energy = 0;
  Vector pull{0, 0, 0};
};

/// Of density 1 over the cell of direction i. The integral of p over a polygon is half the sum, over its
/// sides, of the side's angle times its unit normal.
Integrals exact(const std::vector<Point>& points, const NeighbourLists& stars, std::size_t i) {
  const Vector g = direction(points[i]);
  std::vector<Vector> ring, corner;
  for (std::size_t s = stars.begin_of(i); s < stars.end_of(i); ++s)
    ring.push_back(direction(points[static_cast<std::size_t>(stars.neighbour[s]) - 1]));
  for (std::size_t k = 0; k < ring.size(); ++k)
    corner.push_back(unit(cross(ring[k] - g, ring[(k + 1) % ring.size()] - g)));
  Integrals sum;
  Vector moment{0, 0, 0};
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const Vector &p = corner[k], &q = corner[(k + 1) % corner.size()], n = cross(p, q);
    if (many_digits::length(n) < 1e-300) continue;  // four generators on a circle
    sum.mass += 2 * atan2(dot(g, n), 1 + dot(g, p) + dot(p, q) + dot(q, g));
    moment = moment + atan2(many_digits::length(n), dot(p, q)) / 2 * unit(n);
  }
  const Real along = dot(moment, g);
  sum.energy = 2 * (sum.mass - along);
  sum.pull = moment - along * g;
  return sum;
}

constexpr double kBound = 1e-7, kOfEnergy = 5e-7, kOfLongCells = 1.5e-5;  // what cells.h says

/// Expects all cells right relative to themselves; the pull relative to mass times radius.
void expect_right(const std::vector<Point>& points, double of_energy = kOfEnergy) {
  std::vector<std::int32_t> list, lptr, lend;
  const NeighbourLists stars = triangulate(points, list, lptr, lend);
  Cells cells;
  integrate(points.data(), stars, ConstantDensity(), cells);
  Real sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Integrals right = exact(points, stars, i);
    const auto error = [](const Real& value, const Real& of) { return static_cast<double>(abs(value / of)); };
    EXPECT_LE(error(cells.mass[i] - right.mass, right.mass), kBound) << "mass " << i;
    EXPECT_LE(error(cells.energy[i] - right.energy, right.energy), of_energy) << "energy " << i;
    const Vector pull{cells.pull[i].x, cells.pull[i].y, cells.pull[i].z};
    EXPECT_LE(error(many_digits::length(pull - right.pull), sqrt(right.mass * right.energy)), kBound)
        << "pull " << i;
    EXPECT_TRUE(is_good(cells, i)) << i;
    sum += cells.mass[i];
  }
  EXPECT_NEAR(static_cast<double>(sum), 12.566370614359172, 12.6 * kBound);
}

/// `near` points within `width` of p, and others all around the sphere.
std::vector<Point> cluster(const Point& p, double width, std::size_t near, unsigned seed) {
  std::vector<Point> points = point_sets::make("random", 20, seed);
  point_sets::Random random(seed);
  for (std::size_t k = 0; k < near; ++k) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
    points.push_back(point_sets::normalized({p.x + width * x, p.y + width * y, p.z + width * z}));
  }
  return points;
}

TEST(Cells, OfClustersAreRightRelativeToTheirOwnSize) {
  for (const double width : {1e-1, 1e-2, 1e-5, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12, 1e-13, 1e-14}) {
    SCOPED_TRACE(width);
    const double of_energy = width == 1e-1 ? kOfLongCells : kOfEnergy;
    expect_right(cluster(point_sets::normalized({0.3, -0.5, 0.8}), width, 20, 1), of_energy);
    expect_right(cluster({0, 0, 1}, width, 20, 2), of_energy);
  }
}

TEST(Cells, OfClustersAtThePoleAreRightTo1em30) {
  for (const double width : {1e-17, 1e-30})
    for (const double z : {1.0, -1.0}) {
      SCOPED_TRACE(width);
      expect_right(cluster({0, 0, z}, width, 20, 3));
    }
}

TEST(Cells, OfNeedlesAreRight) {
  for (const double width : {1e-5, 1e-9, 1e-12, 1e-15, 1e-16}) {
    SCOPED_TRACE(width);
    expect_right(cluster(point_sets::normalized({0.3, -0.5, 0.8}), width, 2, 5));
    expect_right(cluster({0, 0, 1}, width, 2, 5));
  }
}

/// Cells are lunes, with sides of half a turn.
TEST(Cells, OfAGreatCircleUpToRoundingAreRight) {
  std::vector<Point> points;
  for (int k = 0; k < 20; ++k) {
    const double c = std::cos(0.3 * k), s = std::sin(0.3 * k);
    points.push_back({c, 0.6 * s, 0.8 * s});
  }
  expect_right(points);
}

/// The density jumps at each cell of a cluster, so that these are integrated as rough cells.
TEST(Cells, OfARoughDensityInAClusterHavePositiveIntegrals) {
  const FormulaDensity jump([](const Point& p) { return p.x > p.y ? 100 : 1; });
  for (const double width : {1e-7, 1e-12}) {
    const std::vector<Point> points = cluster(point_sets::normalized({0.3, 0.3, 0.8}), width, 20, 1);
    std::vector<std::int32_t> list, lptr, lend;
    const NeighbourLists stars = triangulate(points, list, lptr, lend);
    Cells cells;
    integrate(points.data(), stars, jump, cells);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_TRUE(is_good(cells, i)) << i;
      const double area = static_cast<double>(exact(points, stars, i).mass);
      EXPECT_GT(cells.mass[i], 0.999 * area) << i;
      EXPECT_LT(cells.mass[i], 100.1 * area) << i;
    }
  }
}

/// Poles as cos(pi/2) makes them: issue 39.
std::vector<Point> poles_of_rounded_sines(std::size_t meridians, std::size_t rows) {
  std::vector<Point> points;
  for (std::size_t row = 0; row <= rows; ++row)
    for (std::size_t k = 0; k < meridians; ++k) {
      const double lat = 3.141592653589793 * (static_cast<double>(row) / static_cast<double>(rows) - 0.5);
      const double lon = 2 * 3.141592653589793 * static_cast<double>(k) / static_cast<double>(meridians);
      points.push_back({std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)});
    }
  return points;
}

TEST(Cells, OfCopiesOfPolesAreRight) {
  for (const std::size_t meridians : {3, 4, 7, 18})
    for (const std::size_t rows : {2, 3, 9}) {
      SCOPED_TRACE(std::to_string(meridians) + " x " + std::to_string(rows));
      expect_right(poles_of_rounded_sines(meridians, rows), kOfLongCells);
    }
  const double e = 6.1e-17;
  expect_right({{0, 0, -1},
                {1, 0, 0},
                {0, 1, 0},
                {-1, 0, 0},
                {0, -1, 0},
                {e, 0, 1},
                {0, e, 1},
                {-e, 0, 1},
                {0, -e, 1}});
}

}  // namespace
