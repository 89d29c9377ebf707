#include "determinant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace comparison {
namespace {

// The expression that the original rounds in its swap test.
template <class Real>
Real computed_swap_test(const Point& p1, const Point& p2, const Point& p3, const Point& p4) {
  const Real x4 = static_cast<Real>(p4.x), y4 = static_cast<Real>(p4.y), z4 = static_cast<Real>(p4.z);
  const auto dx = [&](const Point& p) { return static_cast<Real>(p.x) - x4; };
  const auto dy = [&](const Point& p) { return static_cast<Real>(p.y) - y4; };
  const auto dz = [&](const Point& p) { return static_cast<Real>(p.z) - z4; };
  return (dx(p3) * (dy(p2) * dz(p1) - dy(p1) * dz(p2)) - dy(p3) * (dx(p2) * dz(p1) - dx(p1) * dz(p2))) +
         dz(p3) * (dx(p2) * dy(p1) - dx(p1) * dy(p2));
}

TEST(swap_test, is_positive_where_the_fourth_node_is_above_the_plane) {
  const Point a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1};
  const double s = 1 / std::sqrt(3.0);
  EXPECT_EQ(swap_test(a, b, c, {s, s, s}).sign(), 1);
  EXPECT_EQ(swap_test(a, b, c, {0, 0, 0}).sign(), -1);
  EXPECT_EQ(swap_test(a, b, c, {0.5, 0.25, 0.25}).sign(), 0);
  EXPECT_EQ(left_test(a, b, c).sign(), 1);
  EXPECT_EQ(left_test(b, a, c).sign(), -1);
  EXPECT_EQ(left_test(a, b, {0.5, -3, 0}).sign(), 0);
}

TEST(swap_test, is_exact_far_below_one_rounding) {
  const Point a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1};
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(swap_test(a, b, c, {0.5, 0.5, tiny}).sign(), 1);
  EXPECT_EQ(swap_test(a, b, c, {0.5, 0.5, -tiny}).sign(), -1);
  EXPECT_EQ(swap_test(a, b, c, {0.5, 0.5, tiny}).value(), "4.9407e-324");
  EXPECT_EQ(left_test({1e300, 0, 0}, {0, 1e300, 0}, {0, 0, 1e300}).value(), "1.0000e+900");
}

// If the computed sign is wrong, the exact value is within the bound. The bound must also be small enough not
// to explain everything.
template <class Real>
void rounding_is_bounded() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr double epsilon = std::numeric_limits<Real>::epsilon();
  int wrong_signs = 0, outside_bound = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    // Four nodes near one circle, large or small, around an axis in general position.
    const double r = 0.05 + 0.9 * std::fabs(uniform(random));
    Point p[4];
    for (Point& q : p) {
      const double angle = 3 * uniform(random), u = r * std::cos(angle), v = r * std::sin(angle);
      const double h = std::sqrt(1 - r * r) + (trial % 2 ? 4 : 400) * epsilon * uniform(random);
      q = {static_cast<Real>(0.48 * u - 0.8 * v + 0.36 * h), static_cast<Real>(0.64 * u + 0.6 * v + 0.48 * h),
           static_cast<Real>(-0.6 * u + 0.8 * h)};
    }
    const Determinant exact = swap_test(p[0], p[1], p[2], p[3]);
    const Real computed = computed_swap_test<Real>(p[0], p[1], p[2], p[3]);
    const int sign = (computed > 0) - (computed < 0);
    if (sign != exact.sign()) {
      ++wrong_signs;
      EXPECT_TRUE(exact.within_rounding(epsilon)) << exact.value() << " " << exact.bound(epsilon);
    }
    if (!exact.within_rounding(epsilon)) ++outside_bound;
  }
  EXPECT_GT(wrong_signs, 100);
  EXPECT_GT(outside_bound, 100);
}

TEST(rounding_of_the_swap_test, explains_every_wrong_sign_in_double) { rounding_is_bounded<double>(); }
TEST(rounding_of_the_swap_test, explains_every_wrong_sign_in_single) { rounding_is_bounded<float>(); }

}  // namespace
}  // namespace comparison
