// First generators from an advancing front: their number, their evenness, and the tessellation that they lead
// to.

#include "scvt/front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "scvt/errors.h"
#include "scvt/evaluator.h"
#include "scvt/first_generators.h"
#include "scvt/minimize.h"
#include "support/formula_density.h"

namespace {

using namespace pstripack;
using namespace pstripack::scvt;

const Point kCentre{0.36, 0.48, 0.8};
double distance(const Point& p, const Point& q) {
  const Point d = minus(p, q);
  return std::sqrt(dot(d, d));
}
const ConstantDensity kConstant;
const BumpDensity kBump(kCentre, 0.5, 0.17, 3);

/// Measures of a tessellation's generators and their neighbours.
struct Measures {
  double hexagons = 0;   ///< share of cells with six sides
  double most_even = 0;  ///< least distance of neighbours, times density^(1/4), over the median of these
};

Measures measures_of(const std::vector<Point>& generators, const Density& density) {
  std::vector<std::int32_t> list, lptr, lend;
  const NeighbourLists stars = triangulate(generators, list, lptr, lend);
  Measures m;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < stars.count; ++i) {
    m.hexagons += stars.end_of(i) - stars.begin_of(i) == 6;
    for (std::size_t j = stars.begin_of(i); j < stars.end_of(i); ++j) {
      const Point &p = generators[i], &q = generators[static_cast<std::size_t>(stars.neighbour[j]) - 1];
      lengths.push_back(distance(p, q) * std::pow(std::max(density.at(p), density.at(q)), 0.25));
    }
  }
  m.hexagons /= static_cast<double>(stars.count);
  std::sort(lengths.begin(), lengths.end());
  m.most_even = lengths.front() / lengths[lengths.size() / 2];
  return m;
}

void expect_distinct_unit_vectors(std::vector<Point> points, std::size_t n) {
  ASSERT_EQ(points.size(), n);
  for (const Point& p : points) ASSERT_NEAR(dot(p, p), 1, 1e-15);
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  });
  EXPECT_EQ(std::adjacent_find(points.begin(), points.end()), points.end());
}

/// The energy times the number of generators at this gradient, and the evaluations until then.
Progress converged(std::vector<Point> generators, double tolerance) {
  LocalEvaluator evaluator(kConstant);
  State state(std::move(generators));
  Options options;
  options.tolerance = tolerance;
  options.most_evaluations = 1000;
  Progress progress = minimize(evaluator, state, options).progress;
  progress.energy *= static_cast<double>(state.generators.size());
  return progress;
}

TEST(Front, GivesAsManyAsAskedFor) {
  for (const std::size_t n : {4, 5, 12, 13, 100, 999, 1000, 1001, 1234, 2562, 7919})
    for (const Density* density : std::initializer_list<const Density*>{&kConstant, &kBump}) {
      SCOPED_TRACE(n);
      expect_distinct_unit_vectors(front_generators(n, *density), n);
    }
}

TEST(Front, IsMadeOfHexagonsAlmostEverywhere) {
  const Measures even = measures_of(front_generators(20000, kConstant), kConstant);
  EXPECT_GT(even.hexagons, 0.97);
  EXPECT_GT(even.most_even, 0.7);
  const Measures bump = measures_of(front_generators(20000, kBump), kBump);
  EXPECT_GT(bump.hexagons, 0.95);
  EXPECT_GT(bump.most_even, 0.65);
}

TEST(Front, LeadsToLessEnergyInFewerEvaluationsThanRandomGenerators) {
  constexpr std::size_t n = 10000;
  const Progress front = converged(front_generators(n, kConstant), 1e-4);
  EXPECT_LT(front.energy, 25.40);  // regular hexagons: 25.3255
  EXPECT_LT(front.evaluations, 120);
  const Progress random = converged(random_generators(n, kConstant, 1), 1e-3);
  EXPECT_GT(random.energy, 25.45);
}

TEST(Front, HasNoPreferredNumbers) {
  for (std::size_t n = 6000; n < 6600; n += 143) {
    SCOPED_TRACE(n);
    EXPECT_LT(converged(front_generators(n, kConstant), 1e-3).energy, 25.47);
  }
}

TEST(Front, HasTheNumberOfNodesEverywhereThatTheDensityAsksFor) {
  constexpr std::size_t n = 20000;
  const std::vector<Point> points = front_generators(n, kBump);
  // Within 0.5 of the centre, and in all: the integral over the height, which is uniform on the sphere.
  double inside = 0, all = 0;
  for (int i = 0; i < 10000; ++i) {
    const double d = std::sqrt(4 * (i + 0.5) / 10000);  // chord
    const double angle = 2 * std::asin(d / 2);
    const double finer = 1 + (1 + std::tanh((0.5 - angle) / 0.17));
    all += finer * finer;
    if (d < 0.5) inside += finer * finer;
  }
  const auto found =
      std::count_if(points.begin(), points.end(), [](const Point& p) { return distance(p, kCentre) < 0.5; });
  EXPECT_NEAR(static_cast<double>(found) / n, inside / all, 0.02 * inside / all);
}

TEST(Front, FindsASmallFinePlace) {
  // Radius 0.02, where the cells are 100 times narrower: outside they are 0.12 wide.
  const FormulaDensity spot([](const Point& p) { return distance(p, kCentre) < 0.02 ? 1e8 : 1; });
  constexpr std::size_t n = 10000;
  const std::vector<Point> points = front_generators(n, spot);
  expect_distinct_unit_vectors(points, n);
  const double inside = 1e4 * 1e-4, outside = 1 - 1e-4;  // of the sphere, weighted
  const auto found =
      std::count_if(points.begin(), points.end(), [](const Point& p) { return distance(p, kCentre) < 0.02; });
  EXPECT_NEAR(static_cast<double>(found) / n, inside / (inside + outside), 0.05);
  const Measures measures = measures_of(points, spot);
  EXPECT_GT(measures.hexagons, 0.85);
  EXPECT_GT(measures.most_even, 0.5 / 100);  // along the jump either size is right
}

TEST(Front, EndsWhateverTheDensity) {
  const std::function<double(const Point&)> formulas[] = {
      [](const Point& p) { return dot(p, kCentre) > 0.95 ? 1e8 : 1; },
      [](const Point& p) { return std::sin(1000 * p.x) > 0 ? 1e8 : 1; },
      [](const Point& p) { return std::fabs(p.x) < 1e-3 ? 1e16 : 1; },
      [](const Point& p) { return std::exp(100 * p.z); },
      [](const Point& p) { return p.z > 0 ? 1e300 : 1e-300; },
  };
  for (std::size_t i = 0; i < std::size(formulas); ++i) {
    SCOPED_TRACE(i);
    expect_distinct_unit_vectors(front_generators(3000, FormulaDensity(formulas[i])), 3000);
  }
}

TEST(Front, DoesNotDependOnTheUnitOfTheDensity) {
  EXPECT_EQ(front_generators(3000, ConstantDensity(0x1p-400)), front_generators(3000, kConstant));
}

TEST(Front, TellsWhereTheDensityIsBad) {
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const FormulaDensity density([&](const Point& p) { return distance(p, kCentre) < 0.1 ? bad : 1; });
    try {
      front_generators(5000, density);
      ADD_FAILURE() << bad;
    } catch (const BadDensity& error) {
      EXPECT_LT(distance(error.place, kCentre), 0.1);
    }
  }
}

TEST(Front, TellsOfABadDensityThatItMeetsOnItsWay) {
  // A density breaks its promise: it is bad wherever few places are asked for at once.
  class Deceptive final : public Density {
   public:
    void at(std::size_t n, const Point*, double* value) const override {
      std::fill_n(value, n, n < 20 ? -1 : 1);
    }
  };
  EXPECT_THROW(front_generators(1000, Deceptive()), BadDensity);
}

}  // namespace
