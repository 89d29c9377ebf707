// Centroidal Voronoi tessellations: integrals over cells, and how their energy is minimized.

#include <gtest/gtest.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "point_sets.h"
#include "scvt/errors.h"
#include "scvt/exact_sum.h"
#include "scvt/first_generators.h"
#include "scvt/front.h"
#include "scvt/metric.h"
#include "scvt/tessellation.h"
#include "support/formula_density.h"

namespace {

using namespace pstripack;
using namespace pstripack::scvt;

constexpr double kPi = 3.14159265358979323846;

const ConstantDensity kConstant;
const BumpDensity kBump(point_sets::from_degrees(30, 20), 0.5, 0.2, 3);
const Density* const kBoth[] = {&kConstant, &kBump};

double length(const Point& p) { return std::sqrt(dot(p, p)); }

// ---- sums ----

TEST(ExactSum, DoesNotDependOnTheOrder) {
  point_sets::Random random(1);
  std::vector<double> terms;
  for (int k = 0; k < 1000; ++k)
    terms.push_back(std::ldexp(random.uniform(-1, 1), static_cast<int>(random.below(2000)) - 1000));
  ExactSum forward, backward, even, odd;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    forward.add(terms[k]);
    backward.add(terms[terms.size() - 1 - k]);
    (k % 2 == 0 ? even : odd).add(terms[k]);
  }
  EXPECT_EQ(forward.words(), backward.words());
  EXPECT_EQ(forward.value(), backward.value());
  ExactSum::Words words = even.words();
  for (std::size_t i = 0; i < words.size(); ++i) words[i] += odd.words()[i];
  EXPECT_EQ(ExactSum::of(words).words(), forward.words());
  even += odd;
  EXPECT_EQ(even.words(), backward.words());
}

TEST(ExactSum, OfTermsThatCancelIsExact) {
  ExactSum sum;
  for (const double x : {1e300, 1.0, -1e300, 0x1p-1074, 0x1p-1074, -3.0}) sum.add(x);
  EXPECT_EQ(sum.value(), -2);
  sum.add(2);
  EXPECT_EQ(sum.value(), 0x1p-1073);
  EXPECT_EQ(ExactSum::of(sum.words()).value(), 0x1p-1073);
  sum.add(NAN);
  EXPECT_TRUE(std::isnan(sum.value()));
}

TEST(ExactSum, IsRoundedToTheNearestDouble) {
  const auto sum = [](std::initializer_list<double> terms) {
    ExactSum s;
    for (const double x : terms) s.add(x);
    return s.value();
  };
  EXPECT_EQ(sum({1, 0x1p-53}), 1);  // a tie, to even
  EXPECT_EQ(sum({1, 0x1p-53, 0x1p-1000}), 1 + 0x1p-52);
  EXPECT_EQ(sum({-1, -0x1p-53, -0x1p-1000}), -1 - 0x1p-52);
  EXPECT_EQ(sum({0x1p1023, 0x1p1023}), std::numeric_limits<double>::infinity());
}

// ---- integrals ----

struct Integrals {
  double mass = 0, energy = 0;
  Point moment{0, 0, 0};
};

/// Points and weights of Gauss on [0,1], exact up to degree 19.
std::vector<std::pair<double, double>> gauss() {
  constexpr int n = 10;
  std::vector<std::pair<double, double>> rule;
  for (int k = 0; k < n; ++k) {
    double x = std::cos(kPi * (k + 0.75) / (n + 0.5)), slope = 0;
    for (int step = 0; step < 20; ++step) {  // Newton's method on the polynomial of Legendre
      double p = 1, before = 0;
      for (int j = 0; j < n; ++j) before = std::exchange(p, ((2 * j + 1) * x * p - j * before) / (j + 1));
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    rule.emplace_back((1 + x) / 2, 1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

/// Over the spherical triangle, cut into 4^cuts: with the points q of the plane triangle the integral of f is
/// det(a,b,c) times that of f(q/|q|)/|q|^3 over the unit triangle.
void add_triangle(Integrals& sum, const Point& g, const Point& a, const Point& b, const Point& c, int cuts,
                  const Density& density) {
  static const auto rule = gauss();
  if (cuts > 0) {
    const Point p = point_sets::normalized(plus(a, b)), q = point_sets::normalized(plus(b, c)),
                r = point_sets::normalized(plus(c, a));
    add_triangle(sum, g, a, p, r, cuts - 1, density);
    add_triangle(sum, g, p, b, q, cuts - 1, density);
    add_triangle(sum, g, r, q, c, cuts - 1, density);
    add_triangle(sum, g, p, q, r, cuts - 1, density);
    return;
  }
  const double volume = dot(a, cross(minus(b, a), minus(c, a)));
  for (const auto& [u, weight_u] : rule)
    for (const auto& [v, weight_v] : rule) {
      const Point q = plus(a, scaled(u, plus(minus(b, a), scaled(v, minus(c, b)))));
      const double size = length(q);
      const Point p = scaled(1 / size, q), d = minus(p, g);
      const double mass = volume * weight_u * weight_v * u / (size * size * size) * density.at(p);
      sum.mass += mass;
      sum.energy += mass * dot(d, d);
      sum.moment = plus(sum.moment, scaled(mass, p));
    }
}

Integrals reference(const std::vector<Point>& points, const NeighbourLists& stars, std::size_t i, int cuts,
                    const Density& density) {
  const Point& g = points[i];
  std::vector<Point> ring, corners;
  for (std::size_t j = stars.begin_of(i); j < stars.end_of(i); ++j)
    ring.push_back(points[static_cast<std::size_t>(stars.neighbour[j]) - 1]);
  for (std::size_t j = 0; j < ring.size(); ++j)
    corners.push_back(
        point_sets::normalized(cross(minus(ring[j], g), minus(ring[(j + 1) % ring.size()], g))));
  Integrals sum;
  for (std::size_t j = 0; j < corners.size(); ++j)
    add_triangle(sum, g, g, corners[j], corners[(j + 1) % corners.size()], cuts, density);
  return sum;
}

struct Tessellated {
  explicit Tessellated(std::vector<Point> p) : points(std::move(p)) {
    stars = triangulate(points, list, lptr, lend);
  }
  std::vector<Point> points;
  std::vector<std::int32_t> list, lptr, lend;
  NeighbourLists stars;
};

/// Random generators after some steps of Lloyd's method.
Tessellated relaxed(std::size_t n, const Density& density, int steps = 5) {
  RunOptions options;
  options.method = Method::lloyd;
  options.tolerance = 0;
  options.most_evaluations = steps + 1;
  return Tessellated(run(random_generators(n, density, 1), density, options).state.generators);
}

/// Expects small errors of the first cells: of mass and energy relative to these, of the centroid relative to
/// the radius.
void expect_accurate(std::size_t n, int cuts, const Density& density, double tolerance) {
  SCOPED_TRACE(n);
  const Tessellated t = relaxed(n, density);
  NeighbourLists some{std::min<std::size_t>(n, 20), t.lend.data(), t.list.data()};
  Cells cells;
  integrate(t.points.data(), some, density, cells);
  for (std::size_t i = 0; i < some.count; ++i) {
    const Integrals right = reference(t.points, some, i, cuts, density);
    const double radius = std::sqrt(right.energy / right.mass);
    EXPECT_NEAR(cells.mass[i] / right.mass, 1, tolerance);
    EXPECT_NEAR(cells.energy[i] / right.energy, 1, tolerance);
    EXPECT_LE(length(minus(centroid(cells, i, t.points[i]), point_sets::normalized(right.moment))),
              tolerance * radius);
    EXPECT_NEAR(dot(cells.pull[i], t.points[i]), 0, 1e-15 * right.mass);
  }
}

TEST(Cells, OfASmoothDensityAgreeWithAFineQuadrature) {
  const FormulaDensity density([](const Point& p) { return std::exp(p.x + 0.5 * p.y * p.z); });
  for (const std::size_t n : {5, 12, 50}) expect_accurate(n, 2, density, 1e-6);
  expect_accurate(500, 0, density, 2e-4);  // width^3: an eighth for four times as many
  expect_accurate(2000, 0, density, 2.5e-5);
  expect_accurate(32000, 0, density, 4e-7);
}

TEST(Cells, OfARoughDensityHaveMassAndEnergy) {
  for (const std::size_t n : {100, 5000}) {
    const Tessellated t = relaxed(n, kConstant, 1);
    for (const double contrast : {10.0, 1e8}) {
      const FormulaDensity jump([=](const Point& p) { return p.x + 0.3 * p.y > 0.1 ? contrast : 1.0; });
      const FormulaDensity spikes(
          [=](const Point& p) { return std::fmod(std::fabs(p.z) * 1e4, 1) < 0.01 ? contrast : 1.0; });
      for (const Density* density : std::initializer_list<const Density*>{&jump, &spikes}) {
        Cells cells;
        integrate(t.points.data(), t.stars, *density, cells);
        EXPECT_GT(*std::min_element(cells.mass.begin(), cells.mass.end()), 0);
        EXPECT_GT(*std::min_element(cells.energy.begin(), cells.energy.end()), 0);
      }
    }
  }
}

/// The derivative of the energy of all cells to a generator is -2 pull.
TEST(Cells, PullIsTheGradientOfTheEnergy) {
  for (const Density* density : kBoth)
    for (const std::size_t n : {12, 3000}) {
      SCOPED_TRACE(n);
      const Tessellated t = relaxed(n, *density, 1);
      const auto energy = [&](const std::vector<Point>& points, double sign) {
        Cells cells;
        LocalEvaluator(*density).evaluate(points, cells);
        ExactSum sum;
        for (const double e : cells.energy) sum.add(sign * e);
        return sum;
      };
      Cells cells;
      integrate(t.points.data(), t.stars, *density, cells);
      for (std::size_t i = 0; i < n; i += n / 4) {
        const double width = std::sqrt(cells.energy[i] / cells.mass[i]), step = 1e-4 * width;
        for (const Point& axis : {Point{0, 0, 1}, Point{1, 0, 0}}) {
          const Point g = t.points[i], direction = point_sets::normalized(cross(axis, g));
          std::vector<Point> points = t.points;
          points[i] = point_sets::normalized(plus(g, scaled(step, direction)));
          ExactSum difference = energy(points, 1);
          points[i] = point_sets::normalized(plus(g, scaled(-step, direction)));
          difference += energy(points, -1);
          EXPECT_NEAR(difference.value() / (2 * step), -2 * dot(cells.pull[i], direction),
                      2e-4 * cells.mass[i] * width);
        }
      }
    }
}

// ---- runs ----

std::vector<Point> octahedron() {
  return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}
std::vector<Point> tetrahedron() {
  const double a = 1 / std::sqrt(3);
  return {{a, a, a}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}};
}
std::vector<Point> icosahedron() {
  const double golden = (1 + std::sqrt(5)) / 2;
  std::vector<Point> points;
  for (const double s : {1.0, -1.0})
    for (const double t : {golden, -golden})
      for (const Point& p : {Point{0, s, t}, Point{s, t, 0}, Point{t, 0, s}})
        points.push_back(point_sets::normalized(p));
  return points;
}

RunOptions options_of(double tolerance) {
  RunOptions options;
  options.tolerance = tolerance;
  return options;
}

double least_distance(const std::vector<Point>& points) {
  double least = 4;
  for (const Point& p : points)
    for (const Point& q : points)
      if (p != q) least = std::min(least, length(minus(p, q)));
  return least;
}

TEST(Run, KnownOptimaStay) {
  for (const auto& optimum : {tetrahedron(), octahedron(), icosahedron()}) {
    const Tessellation found = run(optimum, kConstant, options_of(1e-12));
    EXPECT_EQ(found.result.end, End::converged);
    EXPECT_EQ(found.state.steps, 0);
    for (std::size_t i = 0; i < optimum.size(); ++i)
      EXPECT_LE(length(minus(found.state.generators[i], optimum[i])), 1e-15);
  }
}

TEST(Run, FewGeneratorsFindTheKnownOptima) {
  for (const auto& optimum : {tetrahedron(), octahedron(), icosahedron()})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      RunOptions options = options_of(1e-7);
      options.seed = seed;
      const Tessellation found = run(optimum.size(), kConstant, options);
      EXPECT_EQ(found.result.end, End::converged) << optimum.size();
      EXPECT_NEAR(least_distance(found.state.generators), least_distance(optimum), 1e-5) << optimum.size();
    }
}

TEST(Run, AnyNumberConverges) {
  for (const std::size_t n : {5, 7, 13, 47, 48, 49, 50, 51, 200, 801}) {
    const Tessellation found = run(n, kConstant, options_of(1e-5));
    EXPECT_EQ(found.state.generators.size(), n);
    EXPECT_EQ(found.result.end, End::converged) << n;
    EXPECT_LE(found.result.progress.gradient, 1e-5);
    EXPECT_LT(found.result.progress.energy * static_cast<double>(n), 27) << n;
  }
  EXPECT_EQ(run(500, kBump, options_of(1e-4)).result.end, End::converged);
}

/// The required number of evaluations is at most 250.
TEST(Run, TakesFewEvaluations) {
  const Tessellation uniform = run(10242, kConstant, options_of(1e-5));
  EXPECT_EQ(uniform.result.end, End::converged);
  EXPECT_LE(uniform.evaluations, 50);
  EXPECT_LE(uniform.result.progress.energy * 10242, 25.45);
  RunOptions options = options_of(1e-5);
  options.levels = false;
  options.most_evaluations = 150;
  const Tessellation random = run(2562, kConstant, options);
  options.method = Method::lloyd;
  const Tessellation lloyd = run(2562, kConstant, options);
  EXPECT_LT(random.result.progress.energy, lloyd.result.progress.energy);
}

TEST(Run, EnergyNeverRises) {
  const FormulaDensity jump([](const Point& p) { return p.x + 0.3 * p.y > 0.1 ? 100.0 : 1.0; });
  const FormulaDensity contrast([](const Point& p) { return std::pow(10, 8 * p.z * p.z); });
  for (const Density* density : std::initializer_list<const Density*>{&kConstant, &kBump, &jump, &contrast})
    for (const Method method : {Method::newton, Method::lloyd}) {
      RunOptions options = options_of(1e-6);
      options.method = method;
      options.most_evaluations = 40;
      double before = std::numeric_limits<double>::infinity();
      double first = 0;
      options.progress = [&](const Progress& p) {
        if (first == 0) first = p.energy;
        EXPECT_LT(p.energy, before);
        before = p.energy;
        return true;
      };
      const Tessellation found = run(random_generators(200, *density, 1), *density, options);
      EXPECT_EQ(found.result.progress.energy, before);
      EXPECT_LT(before, 0.95 * first);
    }
}

TEST(Run, HasTheSameBitsForAnyNumberOfThreads) {
#ifndef _OPENMP
  GTEST_SKIP() << "without OpenMP";
#else
  const auto result = [](int threads, const Density& density) {
    omp_set_num_threads(threads);
    RunOptions options = options_of(1e-9);
    options.levels = false;
    options.most_evaluations = 6;
    return run(21000, density, options);
  };
  const int threads = omp_get_max_threads();
  for (const Density* density : kBoth) {
    const Tessellation one = result(1, *density), two = result(2, *density);
    EXPECT_EQ(one.state.generators, two.state.generators);
    EXPECT_EQ(one.result.progress.energy, two.result.progress.energy);
    EXPECT_EQ(one.result.progress.gradient, two.result.progress.gradient);
  }
  omp_set_num_threads(threads);
#endif
}

struct Worst {
  std::size_t obtuse = 0;                    ///< triangles with an angle of 90 degrees or more
  double least_cosine = 1, most_cosine = 0;  ///< of an angle
  double least_ratio = 1;                    ///< of an edge of a cell over its arc
  std::int64_t bad = 0;                      ///< triangles with an angle out of bounds
};
Worst worst_of(const std::vector<Point>& generators) {
  std::vector<std::int32_t> list, lptr, lend;
  const NeighbourLists stars = triangulate(generators, list, lptr, lend);
  using Real = long double;
  const auto angle = [&](std::size_t at, std::size_t b, std::size_t c) {  // cosine and cotangent
    const Point &p = generators[at], &q = generators[b], &r = generators[c];
    const Real u[3] = {Real(q.x) - p.x, Real(q.y) - p.y, Real(q.z) - p.z};
    const Real v[3] = {Real(r.x) - p.x, Real(r.y) - p.y, Real(r.z) - p.z};
    const auto product = [](const Real* a, const Real* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const Real square = product(u, u) * product(v, v), cosine = product(u, v) / std::sqrt(square);
    return std::pair(static_cast<double>(cosine),
                     static_cast<double>(cosine / std::sqrt(1 - cosine * cosine)));
  };
  Worst worst;
  for (std::size_t i = 0; i < stars.count; ++i) {
    const std::size_t begin = stars.begin_of(i), count = stars.end_of(i) - begin;
    const auto ring = [&](std::size_t k) {
      return static_cast<std::size_t>(stars.neighbour[begin + k % count]) - 1;
    };
    for (std::size_t k = 0; k < count; ++k) {
      const double cosine = angle(i, ring(k), ring(k + 1)).first;
      worst.least_cosine = std::min(worst.least_cosine, cosine);
      worst.most_cosine = std::max(worst.most_cosine, cosine);
      worst.obtuse += cosine <= 0;
      const auto out_of_bounds = [&](std::size_t at, std::size_t b, std::size_t c) {
        const double other = angle(at, b, c).first;
        return other < std::cos(kMostAngle * kPi / 180) || other > std::cos(kLeastAngle * kPi / 180);
      };
      if (i < ring(k) && i < ring(k + 1))
        worst.bad += out_of_bounds(i, ring(k), ring(k + 1)) || out_of_bounds(ring(k), ring(k + 1), i) ||
                     out_of_bounds(ring(k + 1), i, ring(k));
      worst.least_ratio =
          std::min(worst.least_ratio,
                   (angle(ring(k), i, ring(k + 1)).second + angle(ring(k + 2), i, ring(k + 1)).second) / 2);
    }
  }
  return worst;
}

TEST(WellCentred, FewGeneratorsOfARunMoveALittle) {
  const BumpDensity bump(point_sets::from_degrees(0, 30), kPi / 6, kPi / 18, 4);
  const std::vector<Point> first = front_generators(5000, bump);
  RunOptions options = options_of(1e-3);
  const Tessellation before = run(first, bump, options);
  EXPECT_GT(worst_of(before.state.generators).obtuse, 3U);
  options.well_centred = true;
  const Tessellation after = run(first, bump, options);
  const Worst worst = worst_of(after.state.generators);
  EXPECT_EQ(worst.obtuse, 0U);
  EXPECT_GE(worst.least_cosine, std::cos(kMostAngle * kPi / 180));
  EXPECT_LE(worst.most_cosine, std::cos(kLeastAngle * kPi / 180));
  EXPECT_GT(worst.least_ratio, 0.2);
  EXPECT_EQ(after.repair.obtuse, 0);
  EXPECT_EQ(after.repair.bad, 0);
  std::int64_t moved = 0;
  for (std::size_t i = 0; i < 5000; ++i) {
    const double by = length(minus(before.state.generators[i], after.state.generators[i]));
    moved += by > 0;
    EXPECT_LT(by, 0.3 * std::sqrt(4 * kPi / 5000));
  }
  EXPECT_EQ(moved, after.repair.moved);
  EXPECT_LT(moved, 700);
  // The result is that of the moved generators.
  EXPECT_EQ(after.result.end, End::converged);
  EXPECT_EQ(after.state.evaluations, before.state.evaluations);
  options.most_evaluations = 0;
  options.well_centred = false;
  options.tolerance = 0;
  const Tessellation again = run(after.state.generators, bump, options);
  EXPECT_EQ(again.result.progress.energy, after.result.progress.energy);
  EXPECT_EQ(again.result.progress.gradient, after.result.progress.gradient);
  EXPECT_EQ(again.result.cells.mass, after.result.cells.mass);
}

TEST(WellCentred, WhatCannotBeIsCounted) {
  // Far from centroidal: some have three or four neighbours.
  std::vector<Point> points = random_generators(500, kConstant, 1);
  LocalEvaluator evaluator(kConstant);
  const Repair repair = make_well_centred(evaluator, points);
  const Worst worst = worst_of(points);
  EXPECT_GT(repair.obtuse, 0);
  EXPECT_EQ(static_cast<std::size_t>(repair.obtuse), worst.obtuse);
  EXPECT_EQ(repair.bad, worst.bad);
  // Right angles, exactly: not strictly inside.
  std::vector<Point> cube = {{1, 1, 1},  {1, 1, -1},  {1, -1, 1},  {1, -1, -1},
                             {-1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {-1, -1, -1}};
  EXPECT_EQ(worst_of(cube).obtuse, 12U);
  EXPECT_EQ(make_well_centred(evaluator, cube).obtuse, 0);
  EXPECT_EQ(worst_of(cube).obtuse, 0U);
}

/// An evaluator that finds generators coincident in one of its triangulations.
class Collider final : public LocalEvaluator {
 public:
  Collider(const Density& density, int at) : LocalEvaluator(density), left_(at) {}
  Neighbourhood triangulate(const std::vector<Point>& generators) override {
    if (--left_ == 0) throw CoincidentGenerators(1, 2);
    return LocalEvaluator::triangulate(generators);
  }

 private:
  int left_;
};

TEST(WellCentred, GeneratorsThatAreMovedOntoEachOtherStayWhereTheyWere) {
  const std::vector<Point> given = random_generators(500, kConstant, 1);
  for (const int at : {2, 3}) {
    Collider evaluator(kConstant, at);
    std::vector<Point> points = given;
    const Repair repair = make_well_centred(evaluator, points);
    const Worst worst = worst_of(points);
    EXPECT_EQ(static_cast<std::size_t>(repair.obtuse), worst.obtuse) << at;
    EXPECT_EQ(repair.bad, worst.bad) << at;
  }
  Collider at_once(kConstant, 1);
  std::vector<Point> points = given;
  EXPECT_THROW(make_well_centred(at_once, points), CoincidentGenerators);
}

TEST(WellCentred, HasTheSameBitsForAnyNumberOfThreads) {
#ifndef _OPENMP
  GTEST_SKIP() << "without OpenMP";
#else
  const std::vector<Point> first = run(5000, kBump, options_of(1e-3)).state.generators;
  const int threads = omp_get_max_threads();
  std::vector<std::vector<Point>> results;
  for (const int use : {1, 2, 3}) {
    omp_set_num_threads(use);
    LocalEvaluator evaluator(kBump);
    std::vector<Point> points = first;
    EXPECT_GT(make_well_centred(evaluator, points).moved, 0);
    EXPECT_NE(points, first);
    results.push_back(points);
  }
  EXPECT_EQ(results[1], results[0]);
  EXPECT_EQ(results[2], results[0]);
  omp_set_num_threads(threads);
#endif
}

/// A power of two changes no bit, however far the density is from 1.
TEST(Run, ScalesADensityThatIsVeryLargeOrSmall) {
  const std::vector<Point> first = random_generators(50, kBump, 1);
  const Tessellation expected = run(first, kBump, options_of(1e-3));
  for (const int exponent : {-1060, -1000, -301, -300, 299, 1010}) {
    SCOPED_TRACE(exponent);
    const FormulaDensity density([=](const Point& p) { return std::ldexp(kBump.at(p), exponent); });
    const Tessellation found = run(first, density, options_of(1e-3));
    EXPECT_EQ(found.result.end, End::converged);
    EXPECT_LE(found.result.progress.gradient, 1e-3);
    if (exponent == -1060) continue;  // subnormal: the density itself has other bits
    EXPECT_TRUE(found.state.generators == expected.state.generators);
    EXPECT_EQ(found.result.progress.energy, std::ldexp(expected.result.progress.energy, exponent));
    EXPECT_EQ(found.result.progress.gradient, expected.result.progress.gradient);
  }
  const RunOptions options = options_of(1e-2);
  for (const std::size_t n : {12, 100})  // from random generators, through levels
    for (const double value : {0x1p-1074, 0x1p-1030, 0x1p-670, 0x1p670, 0x1p1021}) {
      const Tessellation found = run(n, ConstantDensity(value), options), of_one = run(n, kConstant, options);
      EXPECT_TRUE(found.state.generators == of_one.state.generators) << value;
      EXPECT_EQ(found.result.progress.energy, of_one.result.progress.energy * value);
    }
}

TEST(Run, GoesOnWithAScaledDensity) {
  const FormulaDensity density([](const Point& p) { return std::ldexp(kBump.at(p), -800); });
  const std::vector<Point> first = random_generators(300, kBump, 1);
  Options options;
  options.tolerance = 1e-9;
  options.most_evaluations = 20;
  LocalEvaluator evaluator(density);
  State whole(first), state(first);
  minimize(evaluator, whole, options);
  options.progress = [&](const Progress&) { return state.steps < 8; };
  minimize(evaluator, state, options);
  ASSERT_FALSE(state.pairs.empty());
  options.progress = nullptr;
  for (const int shift : {0, 20}) {
    State copy = state;
    for (State::Pair& pair : copy.pairs)
      for (SinglePoint& p : pair.change) p = single(scaled(std::ldexp(1, shift), point(p)));
    copy.exponent -= shift;
    LocalEvaluator another(density);
    minimize(another, copy, options);
    EXPECT_EQ(copy.generators, whole.generators);
  }
}

/// Issue 39: it converged to a gradient of NaN. And other generators as near to each other as doubles allow.
TEST(Run, SeparatesGeneratorsThatNearlyCoincide) {
  std::vector<std::vector<Point>> sets;
  std::vector<Point>& grid = sets.emplace_back();
  for (const double lat : {-1.5707963267948966, 0.0, 1.5707963267948966})
    for (const double lon : {0.0, 2.0943951023931953, 4.1887902047863905})
      grid.push_back({std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)});
  for (const double e : {6e-17, 1e-17, 1e-70}) {
    std::vector<Point>& copies = sets.emplace_back(point_sets::make("random", 30, 1));
    for (const Point& p : {Point{0, 0, 1}, Point{e, 0, 1}, Point{-e, 0, 1}, Point{0, e, 1}, Point{0, -e, 1}})
      copies.push_back(p);
  }
  for (const double width : {1e-8, 1e-12}) {
    std::vector<Point>& cluster = sets.emplace_back(point_sets::make("random", 30, 1));
    for (const Point& p : point_sets::make("random", 30, 2))
      cluster.push_back(point_sets::normalized(plus({0.3, -0.5, 0.8}, scaled(width, p))));
  }
  for (const std::vector<Point>& points : sets)
    for (const Method method : {Method::newton, Method::lloyd}) {
      RunOptions options;
      options.tolerance = 1e-2;
      options.method = method;
      const Tessellation found = run(points, kConstant, options);
      EXPECT_EQ(found.result.end, End::converged);
      EXPECT_LE(found.result.progress.gradient, 1e-2);
      EXPECT_GT(found.result.progress.energy, 0);
    }
}

// ---- the metric of the quasi-Newton method ----

double product(const std::vector<Point>& a, const std::vector<Point>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

std::vector<Point> solved(Metric& metric, std::vector<Point> v) {
  metric.solve(v);
  return v;
}

TEST(Metric, IsSymmetricAndPositive) {
  const FormulaDensity contrast([](const Point& p) { return std::exp(9 * p.x); });
  for (const Density* const density : std::initializer_list<const Density*>{&kConstant, &kBump, &contrast})
    for (const std::size_t n : {4, 5, 12, 13, 1000})
      for (unsigned seed = 1; seed < 3; ++seed) {
        const std::vector<Point> generators = random_generators(n, *density, seed);
        LocalEvaluator evaluator(*density);
        Metric metric(evaluator.ranks());
        Cells cells;
        metric.set(evaluator.evaluate(generators, cells), cells);
        point_sets::Random random(seed);
        std::vector<Point> a, b;  // tangential vectors
        for (std::vector<Point>* const field : {&a, &b})
          for (const Point& g : generators) {
            const Point v = random.direction();
            field->push_back(minus(v, scaled(dot(v, g), g)));
          }
        const std::vector<Point> of_a = solved(metric, a), of_b = solved(metric, b);
        const double ab = product(a, of_b), aa = product(a, of_a), bb = product(b, of_b);
        EXPECT_GT(aa, 0);
        EXPECT_GT(bb, 0);
        EXPECT_NEAR(ab, product(b, of_a), 1e-5 * std::sqrt(aa * bb)) << n;
      }
}

// ---- safeguards ----

/// An evaluator that falsifies the results of evaluations.
class Meddler final : public LocalEvaluator {
 public:
  using Meddle = std::function<void(int evaluation, Cells& cells)>;
  Meddler(const Density& density, Meddle meddle) : LocalEvaluator(density), meddle_(std::move(meddle)) {}
  Neighbourhood evaluate(const std::vector<Point>& generators, Cells& cells) override {
    const Neighbourhood here = LocalEvaluator::evaluate(generators, cells);
    meddle_(++evaluations_, cells);
    return here;
  }

 private:
  Meddle meddle_;
  int evaluations_ = 0;
};

/// Without first steps of Lloyd's method.
Options newton_at_once(double tolerance) {
  Options options;
  options.tolerance = tolerance;
  options.first_lloyd_steps = 0;
  return options;
}

class Safeguards : public ::testing::Test {
 protected:
  State state{random_generators(300, kConstant, 1)};
};

TEST_F(Safeguards, ADirectionThatDoesNotDescendGivesWayToLloyd) {
  LocalEvaluator evaluator(kConstant);
  Cells cells;
  evaluator.evaluate(state.generators, cells);
  State::Pair pair;  // of a concave energy, as no run keeps one
  for (const Point& pull : cells.pull) {
    pair.step.push_back(single(pull));
    pair.change.push_back(single(scaled(-1e-6, pull)));
  }
  state.pairs.push_back(pair);
  state.steps = state.evaluations = 1;
  EXPECT_EQ(minimize(evaluator, state, newton_at_once(1e-5)).end, End::converged);
  EXPECT_EQ(state.no_descent, 1);
}

TEST_F(Safeguards, ASearchWithoutDecreaseGivesWayToLloyd) {
  Meddler evaluator(kConstant, [](int evaluation, Cells& cells) {
    if (evaluation >= 10 && evaluation < 16)
      for (double& energy : cells.energy) energy *= 2;
  });
  EXPECT_EQ(minimize(evaluator, state, newton_at_once(1e-5)).end, End::converged);
  EXPECT_EQ(state.no_decrease, 1);
}

TEST_F(Safeguards, GeneratorsThatMeetOnATrialAreATrialTooFar) {
  int thrown = 0;
  Meddler evaluator(kConstant, [&](int evaluation, Cells&) {
    if (evaluation == 10 || evaluation == 11) {
      ++thrown;
      throw CoincidentGenerators(1, 2);
    }
  });
  EXPECT_EQ(minimize(evaluator, state, newton_at_once(1e-5)).end, End::converged);
  EXPECT_EQ(thrown, 2);
  EXPECT_EQ(state.no_decrease, 0);
}

TEST_F(Safeguards, WithoutAnyDecreaseTheRunEnds) {
  Meddler evaluator(kConstant, [](int evaluation, Cells& cells) {
    for (double& energy : cells.energy) energy *= evaluation < 10 ? 1 : 2;
  });
  const Result result = minimize(evaluator, state, newton_at_once(1e-5));
  EXPECT_EQ(result.end, End::stalled);
  EXPECT_EQ(state.no_decrease, 1);
  EXPECT_GT(result.progress.gradient, 1e-5);
  Cells cells;  // those of the generators in the state
  LocalEvaluator(kConstant).evaluate(state.generators, cells);
  EXPECT_EQ(result.cells.mass, cells.mass);
}

TEST_F(Safeguards, NotANumberIsNeverConverged) {
  const auto falsified = [](int first, int last) {
    return [=](int evaluation, Cells& cells) {
      if (evaluation >= first && evaluation <= last) cells.pull[17] = {NAN, 0, 0}, cells.mass[17] = NAN;
    };
  };
  Meddler at_first(kConstant, falsified(1, 1));
  try {
    minimize(at_first, state, {});
    ADD_FAILURE() << "no error";
  } catch (const GeneratorsTooNear& e) {
    EXPECT_EQ(e.first, 18);
  }
  Meddler on_the_way(kConstant, falsified(5, 6));  // trials too far
  const Result result = minimize(on_the_way, state, {});
  EXPECT_EQ(result.end, End::converged);
  EXPECT_LE(result.progress.gradient, 1e-5);
}

TEST_F(Safeguards, CellsThatAreNotTheSphereAreAnError) {
  Meddler evaluator(kConstant, [](int, Cells& cells) { cells.mass[0] *= 1.01; });
  EXPECT_THROW(minimize(evaluator, state, {}), NoTessellation);
}

// ---- bad input ----

template <class Error>
Error error_of(const std::vector<Point>& generators, const Density& density) {
  try {
    run(generators, density, {});
  } catch (const Error& e) {
    return e;
  }
  ADD_FAILURE() << "no error";
  throw;
}

/// A mesh with three boundary nodes has as many arcs as a mesh of the whole sphere.
TEST(BadInput, GeneratorsInATriangle) {
  const std::vector<Point> generators{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, point_sets::normalized({1, 1, 1})};
  EXPECT_THROW(run(generators, kConstant, {}), GeneratorsInHemisphere);
}

TEST(BadInput, GeneratorsOfWhichTheFirstThreeLieOnAGreatCircle) {
  std::vector<Point> circle;
  for (int k = 0; k < 8; ++k)
    circle.push_back(point_sets::normalized({std::cos(k * 0.75), std::sin(k * 0.75), 0}));
  EXPECT_THROW(run(circle, kConstant, {}), GeneratorsInHemisphere);
  circle.push_back({0, 0, 1});
  EXPECT_THROW(run(circle, kConstant, {}), GeneratorsInHemisphere);
  circle.push_back({0, 0, -1});
  circle.push_back(circle[3]);
  const auto error = error_of<CoincidentGenerators>(circle, kConstant);
  EXPECT_EQ(error.first, 4);
  EXPECT_EQ(error.second, 11);
}

TEST(BadInput, GeneratorsThatAreTooFewOrNoDirections) {
  const auto said = [](const std::vector<Point>& generators) {
    return std::string(error_of<BadGenerators>(generators, kConstant).what());
  };
  std::vector<Point> generators = octahedron();
  EXPECT_EQ(said({generators.begin(), generators.begin() + 3}),
            "a tessellation needs at least 4 generators, here are 3");
  EXPECT_THROW(run(3, kConstant, {}), BadGenerators);
  for (const Point& none : {Point{0, 0, 0}, Point{1, NAN, 0}}) {
    generators[4] = none;
    EXPECT_EQ(said(generators), "generator 5 is zero or not finite");
    EXPECT_THROW(LocalEvaluator(kConstant).triangulate(generators), BadGenerators);
  }
}

TEST(BadInput, Densities) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, static_cast<double>(NAN), infinity}) {
    for (const std::size_t n : {20, 5000}) {  // large and small cells
      const FormulaDensity density([=](const Point& p) { return p.z > 0.9 ? bad : 1.0; });
      const auto error = error_of<BadDensity>(point_sets::make("random", n, 1), density);
      EXPECT_GT(error.place.z, 0.9);
      EXPECT_FALSE(error.value > 0 && error.value < infinity);
      EXPECT_THROW(run(n, density, {}), BadDensity);
    }
    EXPECT_THROW(run(100, ConstantDensity(bad), {}), BadDensity);
  }
  const FormulaDensity density([](const Point& p) { return p.x > 0 ? -2.0 : 1.0; });
  EXPECT_NE(std::string(error_of<BadDensity>(octahedron(), density).what()).find("the density is -2 at lon "),
            std::string::npos);
}

TEST(BadInput, DensitiesThatVaryTooMuch) {
  for (const double least : {1e-250, 0x1p-1074}) {
    const FormulaDensity density([=](const Point& p) { return p.z > -0.5 ? 1.0 : least; });
    const auto error = error_of<BadDensity>(point_sets::make("random", 100, 1), density);
    EXPECT_LE(error.place.z, -0.5);
    EXPECT_EQ(error.value, least);
    EXPECT_EQ(error.elsewhere, 1);
    EXPECT_NE(std::string(error.what()).find(" and 1 elsewhere: the ratio is too large"), std::string::npos);
  }
  // Not at the generators, from which the scale is taken: between them.
  const std::vector<Point> generators = point_sets::make("random", 100, 1);
  const FormulaDensity between([&](const Point& p) {
    return std::find(generators.begin(), generators.end(), p) != generators.end() ? 1.0 : 1e250;
  });
  EXPECT_EQ(error_of<BadDensity>(generators, between).value, 1e250);
  const FormulaDensity both([=](const Point& p) { return p.z > -0.5 ? 1e300 : 1e-300; });
  EXPECT_EQ(error_of<BadDensity>(point_sets::make("random", 100, 1), both).value, 1e-300);
  const FormulaDensity much([](const Point& p) { return p.z > 0 ? 1e100 : 1e-100; });
  EXPECT_TRUE(std::isfinite(run(100, much, options_of(1e-2)).result.progress.gradient));
}

TEST(BadInput, AnEnergyBeyondTheLargestDouble) {
  const ConstantDensity density(1.7e308);
  EXPECT_NE(std::string(error_of<DensityOutOfRange>(octahedron(), density).what()).find("reaches 1.7e+308"),
            std::string::npos);
}

TEST(BadInput, GeneratorsWhoseCellsAreBelowAllDoubles) {
  std::vector<Point> points = point_sets::make("random", 30, 1);
  constexpr double e = 1e-100;
  for (const Point& p : {Point{e, 0, 1}, Point{-e, 0, 1}, Point{0, e, 1}, Point{0, -e, 1}, Point{0, 0, 1}})
    points.push_back(p);
  const auto error = error_of<GeneratorsTooNear>(points, kConstant);
  EXPECT_EQ(error.first, 35);
  EXPECT_GE(error.second, 31);
}

// ---- first generators, levels, lists ----

TEST(Triangulate, GeneratorsWhoseFirstThreeAreOnAGreatCircle) {
  std::vector<Point> points = point_sets::make("random", 200, 1);
  for (const Point& p : octahedron()) points.insert(points.begin(), p);
  ASSERT_EQ(points[2].x, 0);
  ASSERT_EQ(points[3].x, 0);
  std::swap(points[4], points[60]);
  points[4] = {0, 0.6, 0.8};
  std::rotate(points.begin(), points.begin() + 2, points.begin() + 6);
  const Tessellated t(points);
  std::vector<Point> mirrored = points;  // another order, another way to the same stars
  std::swap(mirrored[1], mirrored[100]);
  const Tessellated u(mirrored);
  const auto renamed = [](std::int32_t node) { return node == 2 ? 101 : node == 101 ? 2 : node; };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto j = static_cast<std::size_t>(renamed(static_cast<std::int32_t>(i) + 1)) - 1;
    std::vector<std::int32_t> star, other;
    for (std::size_t k = t.stars.begin_of(i); k < t.stars.end_of(i); ++k)
      star.push_back(t.stars.neighbour[k]);
    for (std::size_t k = u.stars.begin_of(j); k < u.stars.end_of(j); ++k)
      other.push_back(renamed(u.stars.neighbour[k]));
    EXPECT_EQ(star[0], *std::min_element(star.begin(), star.end()));
    std::rotate(other.begin(), std::min_element(other.begin(), other.end()), other.end());
    EXPECT_EQ(star, other);
  }
}

TEST(Levels, LeadFromFewGeneratorsToAnyNumber) {
  for (const std::size_t n : {4u, 11u, 12u, 42u, 43u, 100u, 10242u, 123457u}) {
    const std::vector<std::size_t> sizes = level_sizes(n);
    EXPECT_EQ(sizes.back(), n);
    EXPECT_LE(sizes.front(), 42u);
    for (std::size_t k = 0; k + 1 < sizes.size(); ++k) {
      EXPECT_LE(sizes[k + 1], 4 * sizes[k] - 6);
      EXPECT_GE(sizes[k + 1] + 3, 4 * sizes[k] - 6);
    }
  }
  EXPECT_EQ(level_sizes(642), (std::vector<std::size_t>{12, 42, 162, 642}));
}

TEST(Levels, RefinedGeneratorsAreTheOldOnesAndMidpoints) {
  const Tessellated t(icosahedron());
  for (const std::size_t n : {12, 30, 42}) {
    LocalEvaluator evaluator(kConstant);
    const std::vector<Point> fine =
        refined(evaluator.ranks(), evaluator.triangulate(t.points), kConstant, n).points;
    EXPECT_EQ(fine.size(), n);
    for (const Point& p : t.points) EXPECT_EQ(std::count(fine.begin(), fine.end(), p), 1);
    EXPECT_NEAR(least_distance(fine), n == 12 ? least_distance(t.points) : 0.5465, 1e-3);
  }
}

TEST(RandomGenerators, HaveTheSquareRootOfTheDensity) {
  const FormulaDensity density(
      [](const Point& p) { return p.z > 0.5 ? 16.0 : 1.0; });  // a quarter of the sphere
  const std::vector<Point> points = random_generators(20000, density, 1);
  const auto inside = std::count_if(points.begin(), points.end(), [](const Point& p) { return p.z > 0.5; });
  EXPECT_NEAR(static_cast<double>(inside), 20000 * 4.0 / 7, 400);
  EXPECT_EQ(points, random_generators(20000, density, 1));
  EXPECT_NE(points, random_generators(20000, density, 2));
}

TEST(RandomGenerators, SurroundTheSphereThoughTheDensityIsInACap) {
  const FormulaDensity density([](const Point& p) { return p.z > 0.9 ? 1e16 : 1.0; });
  for (const std::size_t n : {4, 12}) EXPECT_NO_THROW(Tessellated(random_generators(n, density, 1)));
}

}  // namespace
