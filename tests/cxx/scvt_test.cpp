// Centroidal Voronoi tessellations: integrals over cells, and how their energy is minimized.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "point_sets.h"
#include "scvt/errors.h"
#include "scvt/exact_sum.h"
#include "scvt/run.h"

namespace {

using namespace pstripack;
using namespace pstripack::scvt;

TEST(ExactSum, DoesNotDependOnTheOrder) {
  point_sets::Random random(1);
  std::vector<double> terms;
  for (int k = 0; k < 1000; ++k)
    terms.push_back(std::ldexp(random.uniform(-1, 1), static_cast<int>(random.below(2000)) - 1000));
  ExactSum forward, backward;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    forward.add(terms[k]);
    backward.add(terms[terms.size() - 1 - k]);
  }
  EXPECT_EQ(forward.words(), backward.words());
  EXPECT_EQ(forward.value(), backward.value());
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

TEST(Scvt, TwelveRandomGeneratorsFindTheIcosahedron) {
  RunOptions options;
  options.tolerance = 1e-8;
  const Tessellation found = run(12, ConstantDensity(), options);
  EXPECT_EQ(found.result.end, End::converged);
  double least = 4;
  for (const Point& p : found.state.generators)
    for (const Point& q : found.state.generators)
      if (p != q) least = std::min(least, dot(minus(p, q), minus(p, q)));
  EXPECT_NEAR(least, 2 - 2 / std::sqrt(5), 1e-6);
}

TEST(Scvt, GeneratorsInAHemisphereHaveNoTessellation) {
  std::vector<Point> generators = point_sets::make("random", 100, 1);
  for (Point& p : generators) p.z = std::fabs(p.z);
  EXPECT_THROW(run(generators, ConstantDensity(), {}), GeneratorsInHemisphere);
}

}  // namespace
