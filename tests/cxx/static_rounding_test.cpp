// In every floating-point environment StaticallyRounded gives the sums, products and comparisons of the
// default environment and leaves the environment as it was.

#include "base/static_rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "support/environment.h"

namespace pstripack {
namespace {

template <class Real>
class StaticRounding : public ::testing::Test {};
using Kinds = ::testing::Types<float, double>;
TYPED_TEST_SUITE(StaticRounding, Kinds);

/// Numbers of all sizes and signs: 0, denormals, the largest, infinity, NaN.
template <class Real>
std::vector<Real> spread_of_numbers() {
  using Limits = std::numeric_limits<Real>;
  std::vector<Real> numbers = {
      0, Limits::denorm_min(), Limits::min(),        Limits::max(), Limits::infinity(),
      1, Limits::quiet_NaN(),  1 + Limits::epsilon()};
  std::mt19937_64 random(14);
  std::uniform_real_distribution<Real> fraction(1, 2);
  std::uniform_int_distribution<int> exponent(Limits::min_exponent - Limits::digits,
                                              Limits::max_exponent - 1);
  for (int i = 0; i < 60; ++i) {
    numbers.push_back(std::ldexp(fraction(random), exponent(random)));
    numbers.push_back(fraction(random));
  }
  for (std::size_t i = 0, n = numbers.size(); i < n; ++i) numbers.push_back(-numbers[i]);
  return numbers;
}

/// All results for all pairs, as bytes. NaN stands for any NaN.
template <class Number, class Real>
std::vector<Real> results(const std::vector<Real>& numbers) {
  std::vector<Real> all;
  const auto keep = [&](Number number) { all.push_back(Real(number)); };
  for (const Real a : numbers)
    for (const Real b : numbers) {
      keep(Number(a) + Number(b));
      keep(Number(a) * Number(b));
      keep(larger(Number(a), Number(b)));
      all.push_back(is_larger(Number(a), Number(b)));
    }
  return all;
}

template <class Real>
void expect_same(const std::vector<Real>& one, const std::vector<Real>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (std::isnan(one[i]) && std::isnan(other[i])) continue;
    ASSERT_EQ(std::memcmp(&one[i], &other[i], sizeof(Real)), 0)
        << "result " << i << ": " << one[i] << " and " << other[i];
  }
}

TYPED_TEST(StaticRounding, GivesTheBitsOfTheDefaultEnvironmentInEveryOneWithDenormals) {
  using Number = StaticallyRounded<TypeParam>;
  if (!Number::is_available()) GTEST_SKIP() << "this processor has no AVX-512";
  const std::vector<TypeParam> numbers = spread_of_numbers<TypeParam>();
  const std::vector<TypeParam> expected = results<TypeParam>(numbers);
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, FE_TONEAREST})
    for (const bool traps : {false, true}) {
      fenv_t usual;
      fegetenv(&usual);
      feclearexcept(FE_ALL_EXCEPT);
      if (traps) trap_all();
      fesetround(rounding);
      const Environment before;
      const bool available = Number::is_available();
      const std::vector<TypeParam> found = results<Number>(numbers);
      const Environment after;
      fesetenv(&usual);
      EXPECT_TRUE(available);
      EXPECT_TRUE(after == before) << "rounding " << rounding << " changes the environment";
      expect_same(found, expected);
    }
}

TYPED_TEST(StaticRounding, IsNotAvailableWhereDenormalsAreZero) {
  for (const bool results_are_zero : {false, true}) {
    fenv_t usual;
    fegetenv(&usual);
    flush_denormals(results_are_zero, !results_are_zero);
    const bool available = StaticallyRounded<TypeParam>::is_available();
    fesetenv(&usual);
    EXPECT_FALSE(available);
  }
}

}  // namespace
}  // namespace pstripack
