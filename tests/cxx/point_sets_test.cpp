// The point sets: lengths, numbers of nodes, no duplicates; files.

#include "point_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "support/names.h"

namespace {

using point_sets::make;

/// 0 if the family does not promise unit length.
double tolerance_of_length(const std::string& family) {
  for (const char* other : {"moment", "axis-cap", "nest", "mirrored-nest", "rays", "lattice", "earth"})
    if (family == other) return 0;
  return family == "single" ? 2e-7 : 1e-15;
}

class Family : public ::testing::TestWithParam<std::string> {};

TEST_P(Family, HasNodesOfItsLengthAndNoneTwice) {
  for (const std::size_t n : {3, 10, 1000, 20000}) {
    const auto points = make(GetParam(), n);
    std::vector<std::array<double, 3>> sorted;
    const double tolerance = tolerance_of_length(GetParam());
    for (const auto& p : points) {
      if (tolerance > 0)
        ASSERT_NEAR(std::hypot(p.x, p.y, p.z), 1, tolerance);
      else
        ASSERT_TRUE(pstripack::has_direction(p));
      sorted.push_back({p.x, p.y, p.z});
    }
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end()) << n;
    if (n >= 1000) {
      EXPECT_NEAR(static_cast<double>(points.size()) / static_cast<double>(n), 1, 0.05);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Family, ::testing::ValuesIn(point_sets::families()), name_of_case);
INSTANTIATE_TEST_SUITE_P(Hard, Family, ::testing::ValuesIn(point_sets::hard_families()), name_of_case);

TEST(Families, HaveTheirNaturalCounts) {
  EXPECT_EQ(make("icosahedral", 10242).size(), 10242u);
  EXPECT_EQ(make("icosahedral", 11).size(), 12u);
  EXPECT_EQ(make("healpix", 12 * 64).size(), 12u * 64);
  EXPECT_EQ(make("cubed-sphere", 6 * 81).size(), 6u * 81);
  EXPECT_EQ(make("reduced-gaussian", 4 * 32 * 41).size(), 4u * 32 * 41);
  EXPECT_EQ(make("latlon", 2 * 18 * 18 + 2).size(), 2u * 18 * 18 + 2);
  for (const char* any : {"random", "fibonacci", "ring", "variable", "clusters", "hemisphere-rim"})
    for (std::size_t n = 0; n < 20; ++n) EXPECT_EQ(make(any, n).size(), n) << any;
}

std::uint64_t fingerprint(const std::vector<std::string>& families) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::string& family : families)
    for (const auto& p : make(family, 300, 5))
      for (const double v : {p.x, p.y, p.z}) {
        char text[40];
        std::snprintf(text, sizeof text, "%a", v);
        for (const char* c = text; *c != '\0'; ++c)
          hash = (hash ^ static_cast<unsigned char>(*c)) * 0x100000001b3;
      }
  return hash;
}

/// The bits on x86-64: fails if they change, or if another machine differs.
TEST(Families, AreTheSameOnEveryMachine) {
  const std::uint64_t usual = fingerprint(point_sets::families()),
                      hard = fingerprint(point_sets::hard_families());
  EXPECT_EQ(usual, 0x82b9f4535536415fu) << std::hex << usual;
  EXPECT_EQ(hard, 0xcd2f1e870134447au) << std::hex << hard;
}

TEST(Families, GiveFewerNodesWhereThereAreNoMore) {
  EXPECT_LT(make("cap:1e-16", 1000).size(), 100u);
  EXPECT_EQ(make("nest:150", 1000).size(), 1000u);
}

TEST(Families, UnknownOnesAreRefusedByName) {
  try {
    make("no-such-family", 10);
    FAIL() << "no exception";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("no-such-family"), std::string::npos);
    for (const std::string& family : point_sets::families())
      EXPECT_NE(std::string(e.what()).find(family), std::string::npos);
  }
  for (const char* bad : {"random:2", "cap:", "cap:wide", "cap:-1", "variable:1", "lattice:2"})
    EXPECT_THROW(make(bad, 10), std::invalid_argument) << bad;
}

TEST(Angles, AreExactWhereTheyCanBeAndAccurateElsewhere) {
  EXPECT_EQ(point_sets::cos_degrees(90), 0);
  EXPECT_EQ(point_sets::sin_degrees(180), 0);
  EXPECT_EQ(point_sets::sin_degrees(270), -1);
  EXPECT_EQ(point_sets::cos_degrees(-360), 1);
  for (double a = -800; a < 800; a += 0.37) {
    EXPECT_NEAR(point_sets::sin_degrees(a), std::sin(a * 0.017453292519943295), 2e-15) << a;
    EXPECT_NEAR(point_sets::cos_degrees(a), std::cos(a * 0.017453292519943295), 2e-15) << a;
    EXPECT_EQ(point_sets::sin_degrees(-a), -point_sets::sin_degrees(a));
  }
}

TEST(Angles, InRadiansNearestToARightAngleMeanIt) {
  const double pi = std::acos(-1.0);
  for (int k = -8; k <= 8; ++k) {
    const double angle = k * pi / 2, degrees = 90. * k;
    for (const double same : {angle, degrees * pi / 180, degrees / 57.29577951308232}) {
      EXPECT_EQ(point_sets::sin_radians(same), point_sets::sin_degrees(degrees)) << k;
      EXPECT_EQ(point_sets::cos_radians(same), point_sets::cos_degrees(degrees)) << k;
    }
    EXPECT_EQ(point_sets::radians_of_single(static_cast<float>(angle)), angle) << k;
    for (const double other : {std::nextafter(angle, 99), std::nextafter(angle, -99)}) {
      EXPECT_DOUBLE_EQ(point_sets::sin_radians(other), std::sin(other)) << k;
      EXPECT_DOUBLE_EQ(point_sets::cos_radians(other), std::cos(other)) << k;
    }
    const float beside = std::nextafter(static_cast<float>(angle), 99.f);
    EXPECT_EQ(point_sets::radians_of_single(beside), beside) << k;
  }
  EXPECT_DOUBLE_EQ(point_sets::sin_radians(0.7), std::sin(0.7));
  EXPECT_TRUE(std::isnan(point_sets::sin_radians(std::nan(""))));
  EXPECT_DOUBLE_EQ(point_sets::cos_radians(1e17), std::cos(1e17));
}

}  // namespace
