// Lengths, circumcentres and areas against 400 digits, for triangles and cells of all sizes and shapes.

#include "geometry/measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "mesh/delaunay.h"
#include "point_sets.h"
#include "stripack/coordinates_and_areas.h"
#include "support/many_digits.h"

namespace {

using many_digits::Real;
using many_digits::Vector;
using point_sets::normalized;
using point_sets::Random;
using pstripack::Direction;
using pstripack::Point;

constexpr double kPi = 3.14159265358979323846;

/// A place x, y of the tangent plane at g: a unit vector up to rounding, or any length.
Point near(const Point& g, double x, double y, double length = 1) {
  const Point e = normalized(std::fabs(g.z) < 0.9 ? Point{-g.y, g.x, 0} : Point{0, -g.z, g.y}),
              f = cross(g, e);
  const Point p{g.x + x * e.x + y * f.x, g.y + x * e.y + y * f.y, g.z + x * e.z + y * f.z};
  const Point q = normalized(p);
  return scaled(length, q);
}

struct Errors {
  double centre = 0, radius = 0, area = 0, length = 0;
};

/// False if the directions are so nearly on one great circle that 400 digits cannot tell.
bool has_area(const Point (&p)[3]) {
  const Vector a = many_digits::direction(p[0]), b = many_digits::direction(p[1]),
               c = many_digits::direction(p[2]);
  return abs(many_digits::area(a, b, c)) > Real("1e-350") && many_digits::length(a - b) > Real("1e-350");
}

/// Errors in units of 2^-53: of the centre relative to the radius, beyond the rounding of its coordinates.
void measure(const Point (&p)[3], Errors& worst) {
  const Direction d[3] = {pstripack::direction_of(p[0]), pstripack::direction_of(p[1]),
                          pstripack::direction_of(p[2])};
  const Vector v[3] = {many_digits::direction(p[0]), many_digits::direction(p[1]),
                       many_digits::direction(p[2])};
  const Vector centre = many_digits::circumcentre(v[0], v[1], v[2]);
  const Real radius = many_digits::arc(centre, v[0]);
  const pstripack::Circumcircle circle = circumcircle(d[0], d[1], d[2]);
  const Vector found = many_digits::vector(circle.centre);
  Real beyond =
      many_digits::length(found - centre) - Real(0x1.8p-53);  // sqrt(3) half units in the last place
  if (beyond < 0) beyond = 0;
  worst.centre = std::max(worst.centre, many_digits::error(beyond, 0, radius));
  worst.radius = std::max(worst.radius, many_digits::error(circle.radius, radius, radius));
  const Real area = many_digits::area(v[0], v[1], v[2]);
  worst.area = std::max(worst.area, many_digits::error(triangle_area(d[0], d[1], d[2]), area, area));
  const Real length = many_digits::arc(v[0], v[1]);
  worst.length = std::max(worst.length, many_digits::error(arc_length(d[0], d[1]), length, length));
}

TEST(Measures, OfTrianglesOfAnySize) {
  std::printf("width [rad]   shape      circumcentre  radius    area  length   (units of 2^-53)\n");
  const auto row = [](double width, const char* shape,
                      const std::function<void(Random&, Point(&)[3])>& make) {
    Random random(1);
    Errors worst;
    for (int k = 0; k < (width < 1e-14 ? 5 : 30); ++k) {
      Point p[3];
      do make(random, p);
      while (!has_area(p));
      measure(p, worst);
    }
    std::printf("%-13.0e %-12s %10.1f %7.1f %7.1f %7.1f\n", width, shape, worst.centre, worst.radius,
                worst.area, worst.length);
    EXPECT_LE(worst.centre, 64) << shape << ' ' << width;
    EXPECT_LE(worst.radius, 64) << shape << ' ' << width;
    EXPECT_LE(worst.area, 64) << shape << ' ' << width;
    EXPECT_LE(worst.length, 8) << shape << ' ' << width;
  };
  for (const double width : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-15}) {
    row(width, "any", [&](Random& r, Point(&p)[3]) {
      const Point g = r.direction();
      for (Point& q : p) q = near(g, r.uniform(0, width), r.uniform(0, width));
    });
    row(width, "any length", [&](Random& r, Point(&p)[3]) {
      const Point g = r.direction();
      for (Point& q : p) q = near(g, r.uniform(0, width), r.uniform(0, width), r.uniform(1, 1e7));
    });
    row(width, "needle", [&](Random& r, Point(&p)[3]) {
      const Point g = r.direction();
      p[0] = near(g, 0, 0);
      p[1] = near(g, r.uniform(0, 1e-6 * width), width);
      p[2] = near(g, -r.uniform(0, 1e-6 * width), width);
      std::rotate(p, p + static_cast<int>(r.uniform(0, 3)), p + 3);
    });
    row(width, "flat", [&](Random& r, Point(&p)[3]) {
      const Point g = r.direction();
      p[0] = near(g, 0, 0);
      p[1] = near(g, width, std::pow(10, -r.uniform(1, 8)) * width);
      p[2] = near(g, 2 * width, 0);
      std::rotate(p, p + static_cast<int>(r.uniform(0, 3)), p + 3);
    });
  }
  for (const double width : {1e-17, 1e-30, 1e-100, 1e-150})
    row(width, "at a pole", [&](Random& r, Point(&p)[3]) {
      for (Point& q : p) q = {r.uniform(-width, width), r.uniform(-width, width), 1};
    });
  for (const double width : {1e-155, 1e-200, 1e-300})
    row(width, "pair", [&](Random& r, Point(&p)[3]) {  // whose squares underflow, and a node far away
      for (Point& q : p) q = {r.uniform(-width, width), r.uniform(-width, width), 1};
      p[2] = r.direction();
      std::rotate(p, p + static_cast<int>(r.uniform(0, 3)), p + 3);
    });
  for (const double off : {1e-2, 1e-4, 1e-6, 1e-8})
    row(off, "off an arc", [&](Random& r, Point(&p)[3]) {  // its plane nearly holds the centre
      const Point g = r.direction();
      p[0] = near(g, 0, 0);
      p[1] = near(g, -r.uniform(0.2, 0.31), -off), p[2] = near(g, r.uniform(0.2, 0.31), -off);
      std::rotate(p, p + static_cast<int>(r.uniform(0, 3)), p + 3);
    });
  row(3, "hemisphere", [](Random& r, Point(&p)[3]) {
    const Point g = r.direction();
    for (int k = 0; k < 3; ++k) {
      const double angle = 2 * kPi / 3 * k + r.uniform(-0.5, 0.5), far = r.uniform(1e3, 1e16);
      p[k] = near(g, far * std::cos(angle), far * std::sin(angle));
    }
  });
  row(3, "opposite", [](Random& r, Point(&p)[3]) {
    p[0] = r.direction();
    p[1] = near(scaled(-1, p[0]), r.uniform(0, 1e-6), r.uniform(0, 1e-6));
    p[2] = r.direction();
  });
}

/// Largest error of the areas of cells, in units of 2^-53.
double error_of_cell(const Point& v, const std::vector<Point>& ring) {
  std::vector<Direction> directions;
  std::vector<Vector> vectors;
  for (const Point& p : ring) {
    directions.push_back(pstripack::direction_of(p));
    vectors.push_back(many_digits::direction(p));
  }
  const Real exact = many_digits::cell(many_digits::direction(v), vectors);
  return many_digits::error(cell_area(pstripack::direction_of(v), directions.data(), ring.size()), exact,
                            exact);
}

/// Largest error of the cells of all nodes.
double error_of_cells(const std::vector<Point>& nodes) {
  pstripack::Workspace workspace(pstripack::workspace_bytes(nodes.size()));
  const pstripack::Hull hull =
      pstripack::delaunay(nodes.data(), nodes.size(), workspace, pstripack::Lengths::directions);
  double worst = 0;
  if (!hull.coincident.empty()) return worst;  // by the rounding of their coordinates
  for (std::size_t v = 0; v < nodes.size(); ++v) {
    std::vector<Point> ring;
    const pstripack::HullCorner first = hull.corner[v];
    pstripack::HullCorner corner = first;
    do {
      const auto next =
          hull.faces[pstripack::face_of(corner)].vertex[pstripack::next_edge(pstripack::edge_of(corner))];
      ring.insert(ring.begin(), nodes[hull.order[next]]);
      corner = clockwise(hull, corner);
    } while (corner != first);
    worst = std::max(worst, error_of_cell(nodes[hull.order[v]], ring));
  }
  return worst;
}

TEST(Measures, OfCellsOfAnySize) {
  std::printf("width [rad]   shape             cell area   (units of 2^-53)\n");
  const auto row = [](double width, const char* shape,
                      const std::function<void(Random&, std::vector<Point>&)>& make) {
    Random random(2);
    double worst = 0;
    for (int k = 0; k < 2; ++k) {
      std::vector<Point> nodes;
      make(random, nodes);
      worst = std::max(worst, error_of_cells(nodes));
    }
    std::printf("%-13.0e %-18s %7.1f\n", width, shape, worst);
    EXPECT_LE(worst, 128) << shape << ' ' << width;
  };
  const std::vector<Point> far{{1, 0, 0},     {-0.2, 1, 0.1}, {-1, -0.1, 0},
                               {0, -1, -0.3}, {0.1, 0, -1},   {0, 0.2, 1}};
  for (const double width : {0.3, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    row(width, "alone", [&](Random& r, std::vector<Point>& nodes) {
      const Point g = r.direction();
      for (int k = 0; k < 15; ++k)
        nodes.push_back(near(g, r.uniform(-width, width), r.uniform(-width, width)));
    });
    row(width, "among others", [&](Random& r, std::vector<Point>& nodes) {
      const Point g = r.direction();
      nodes = far;
      for (int k = 0; k < 12; ++k)
        nodes.push_back(near(g, r.uniform(-width, width), r.uniform(-width, width)));
    });
    row(width, "rows", [&](Random& r, std::vector<Point>& nodes) {
      const Point g = r.direction();
      nodes = far;
      for (int k = 0; k < 15; ++k)
        nodes.push_back(near(g, 1e-3 * width * (k % 5 + 0.3 * (k / 5)), width * (k / 5)));
    });
    row(width, "three", [&](Random& r, std::vector<Point>& nodes) {
      const Point g = r.direction();
      for (int k = 0; k < 3; ++k)
        nodes.push_back(near(g, r.uniform(-width, width), r.uniform(-width, width)));
    });
  }
  for (const double width : {1e-17, 1e-150})
    row(width, "at a pole", [&](Random& r, std::vector<Point>& nodes) {
      nodes = far;
      for (int k = 0; k < 8; ++k) nodes.push_back({r.uniform(-width, width), r.uniform(-width, width), 1});
    });
}

TEST(Measures, OfCellsWhoseNodesAreTooClose) {
  for (const double w : {1e-150, 1e-160, 1e-300}) {
    std::vector<Direction> ring;
    for (const Point& p : {Point{w, 0, 1}, Point{0, w, 1}, Point{-w, 0, 1}, Point{0, -w, 1}})
      ring.push_back(pstripack::direction_of(p));
    const double area = cell_area(pstripack::direction_of({0, 0, 1}), ring.data(), ring.size());
    EXPECT_EQ(std::isnan(area), w < 1e-154) << w;
    if (w > 1e-154) {
      EXPECT_NEAR(area / (w * w), 1, 1e-15);
    }
  }
}

TEST(Measures, OfNearCopiesOfAPole) {
  // Four nodes at 6.1e-17 from the pole, and four on the equator: each takes a quarter of the northern half.
  const double w = 6.1e-17;
  const std::vector<Point> pole{{w, 0, 1}, {0, w, 1}, {-w, 0, 1}, {0, -w, 1}},
      equator{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::vector<Point> ring{equator[k], equator[(k + 1) % 4], pole[(k + 1) % 4], pole[(k + 3) % 4],
                                  equator[(k + 3) % 4]};
    EXPECT_LE(error_of_cell(pole[k], ring), 4);
  }
}

/// Areas of needles, flat and tiny triangles, in either orientation.
TEST(Areas, AreRightToTwentyBits) {
  Random random(3);
  for (int k = 0; k < 3000; ++k) {
    const double width = std::pow(10, -random.uniform(0, 14)), thin = std::pow(10, -random.uniform(0, 8)),
                 length = k % 2 == 0 ? 1 : random.uniform(0.1, 1e7);
    const Point g = random.direction(), e = random.direction(), f = random.direction();
    Point v[3];
    for (Point& p : v) {
      const double x = width * random.uniform(-1, 1), y = width * thin * random.uniform(-1, 1);
      p = scaled(length, plus(plus(g, scaled(x, e)), scaled(y, f)));
    }
    const Real area = abs(many_digits::area(many_digits::direction(v[0]), many_digits::direction(v[1]),
                                            many_digits::direction(v[2])));
    ASSERT_LE(abs(Real(pstripack::areas(v[0], v[1], v[2]) - area)), Real(0x1p-20 * area))
        << width << ' ' << thin;
    ASSERT_EQ(pstripack::areas(v[0], v[0], v[2]), 0);
  }
}

}  // namespace
