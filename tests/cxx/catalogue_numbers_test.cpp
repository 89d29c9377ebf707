// TRMESH of vectors without direction or of extreme length, of numbers of nodes that are too large, and with
// 64-bit integers. The floating-point environment: tests/numerics.

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "point_sets.h"
#include "support/expect.h"

namespace {

using point_sets::make;
using point_sets::Random;
using pstripack::Point;

constexpr double inf = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN(),
                 tiny = std::numeric_limits<double>::denorm_min(), huge = std::numeric_limits<double>::max();

// ---- Refused, with one line on stderr that names the node ----

/// The code, outputs untouched, one line that names node k.
void expect_refused(const Nodes& nodes, std::size_t k) {
  ::testing::internal::CaptureStderr();
  const Mesh m = trmesh(nodes);
  const std::string line = ::testing::internal::GetCapturedStderr();
  ASSERT_EQ(m.ier, -5) << "node " << k;
  ASSERT_TRUE(is_untouched(m)) << "node " << k;
  ASSERT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
  ASSERT_EQ(line.back(), '\n');
  ASSERT_NE((" " + line).find(" " + std::to_string(k)), std::string::npos) << line;
}

TEST(BadCoordinate, NotFiniteAnywhereIsRefused) {
  for (const double bad : {nan, -nan, inf, -inf})
    for (std::size_t k = 0; k < 20; ++k)
      for (double Point::*v : {&Point::x, &Point::y, &Point::z}) {
        Nodes nodes = make("random", 20);
        nodes[k].*v = bad;
        expect_refused(nodes, k + 1);
      }
}

TEST(BadCoordinate, ZeroVectorAnywhereIsRefused) {
  for (std::size_t k = 0; k < 20; ++k)
    for (const double zero : {0.0, -0.0}) {
      Nodes nodes = make("random", 20);
      nodes[k] = {zero, 0, zero};
      expect_refused(nodes, k + 1);
    }
  expect_refused(Nodes(10, Point{0, 0, 0}), 1);
}

TEST(BadCoordinate, ComesBeforeCollinearAndCoinciding) {
  Nodes nodes = make("random", 20);
  nodes[1] = nodes[0], nodes[9].x = nan;
  expect_refused(nodes, 10);
  nodes = make("random", 20);
  nodes[8] = nodes[7], nodes[15].x = inf;
  expect_refused(nodes, 16);
}

TEST(BadCoordinate, InSinglePrecisionIsRefused) {
  for (const double bad : {nan, inf, -inf, 0.0}) {
    ::testing::internal::CaptureStderr();
    const Mesh m = trmesh_r4({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, bad}});
    const std::string line = ::testing::internal::GetCapturedStderr();
    EXPECT_EQ(m.ier, -5);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
    EXPECT_TRUE(is_untouched(m));
  }
}

TEST(TooMany, IsRefusedBeforeAnythingIsTouched) {
  for (const std::int32_t n : {357913944, 400000000, 2147483647}) {
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(pstripack_trmesh(n, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr), -4);
    EXPECT_EQ(pstripack_trmesh_r4(n, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr), -4);
    const std::string lines = ::testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 2) << lines;
  }
}

TEST(TooMany, TheLargestThatFitsIsNot) {
  const std::int32_t n = 357913943;
  const std::size_t bytes = std::size_t{8} * static_cast<std::size_t>(n);
  void* const zeros =
      mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);  // takes no memory
  ASSERT_NE(zeros, MAP_FAILED);
  const double* const x = static_cast<const double*>(zeros);
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(pstripack_trmesh(n, x, x, x, nullptr, nullptr, nullptr, nullptr), -5);
  EXPECT_NE(::testing::internal::GetCapturedStderr().find("node 1 of 357913943 "), std::string::npos);
  munmap(zeros, bytes);
}

// ---- Sizes of vectors ----

Nodes scaled(Nodes nodes, double s) {
  for (Point& p : nodes) p = scaled(s, p);
  return nodes;
}

TEST(Lengths, RadiusDoesNotMatter) {
  for (const double radius : {2.0, 0.5, 6371229.0, 1e-3, 1e300, 1e-300, 0x1p-1022})
    for (const char* family : {"random", "hemisphere", "cap:1e-6"}) {
      EXPECT_TRUE(is_as_promised(scaled(make(family, 500), radius))) << radius << " " << family;
    }
}

TEST(Lengths, APowerOfTwoChangesNoBit) {
  for (const char* family : {"cap:1e-8", "random", "ring"}) {
    const Mesh two = trmesh(scaled(make(family, 500), 2));
    for (const double radius : {0.25, 0x1p40, 0x1p-900, 0x1p1000})
      EXPECT_TRUE(trmesh(scaled(make(family, 500), radius)) == two) << family << " " << radius;
  }
}

TEST(Lengths, NoiseIsCorrect) {
  Random random(1);
  for (const double noise : {1e-15, 1e-10, 0.9e-6, 1.1e-6, 1e-5, 1e-3, 0.5, 0.999})
    for (const std::size_t n : {20, 1000, 20000}) {
      Nodes nodes = make("random", n);
      for (Point& p : nodes) p = scaled({p}, 1 + noise * random.uniform(-1, 1))[0];
      EXPECT_TRUE(is_as_promised(nodes)) << noise << " " << n;
    }
}

TEST(Lengths, OfAllMagnitudesAreCorrect) {
  Random random(2);
  Nodes nodes = make("random", 1000);
  for (Point& p : nodes) p = scaled({p}, std::exp2(random.uniform(-1000, 1000)))[0];
  EXPECT_TRUE(is_as_promised(nodes));
}

TEST(Lengths, AllExtremeAreCorrectOrRefused) {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    Nodes nodes;
    for (int k = 0; k < 12; ++k) {
      const auto any = [&random] {
        const double s[] = {0, tiny, 1e-308, 1e-200, 1, 1e200, 1e308};
        return s[random.below(7)] * random.uniform(-1.5, 1.5);
      };
      Point p;
      do p = {any(), any(), any()};
      while (p == Point{0, 0, 0});
      nodes.push_back(p);
    }
    ::testing::internal::CaptureStderr();
    const Mesh m = trmesh(nodes);
    ::testing::internal::GetCapturedStderr();
    if (m.ier != -5) {
      ASSERT_TRUE(is_as_promised(nodes, m))
          << ::testing::PrintToString(Columns(nodes).x) << ::testing::PrintToString(Columns(nodes).y)
          << ::testing::PrintToString(Columns(nodes).z);
    }
  }
}

TEST(Components, DenormalOnesAreCorrect) {
  Nodes nodes = make("random", 200);
  for (int i = -3; i <= 3; ++i)  // rings around an axis at distances of denormal size
    for (int j = -3; j <= 3; ++j) nodes.push_back({1, i * tiny, j * 1e-310});
  ASSERT_EQ(expected_ier(nodes), 0);
  EXPECT_TRUE(is_as_promised(nodes));
}

class SinglePrecision : public testing::TestWithParam<std::size_t> {};

TEST_P(SinglePrecision, NodesAreCorrectAndAsInDouble) {
  const Nodes nodes = make("single", GetParam());
  const Mesh expected = trmesh(nodes), m = trmesh_r4(nodes);
  EXPECT_TRUE(is_as_promised(nodes, expected));
  EXPECT_EQ(m.ier, expected.ier);
  EXPECT_TRUE(m == expected);
}

INSTANTIATE_TEST_SUITE_P(Of, SinglePrecision, testing::Values(4, 1000, 100000, 1000000),
                         testing::PrintToStringParamName());

// ---- 64-bit integers: what is not in the Fortran tests of libstripack_i8 ----

TEST(WideTrmesh, WritesTheSameAndNothingElse) {
  for (const char* family : {"random", "latlon", "cap:1e-8", "hemisphere-rim", "ring", "hemisphere"})
    for (const std::size_t n : {3, 4, 5, 6, 7, 12, 200, 1000}) {
      const Nodes nodes = make(family, n);
      const Mesh expected = trmesh(nodes);
      for (const Edge edge : {Edge::begin, Edge::end})
        EXPECT_TRUE(trmesh_i8(nodes, edge) == expected && trmesh_i8(nodes, edge).ier == expected.ier)
            << family << ", " << nodes.size() << " nodes";
    }
}

TEST(WideTrmesh, WritesTheSameOnThreads) {
  const Nodes nodes = make("random", 50000);
  EXPECT_TRUE(trmesh_i8(nodes) == trmesh(nodes));
}

TEST(WideTrmesh, TouchesNoArrayIfThereAreTooManyNodes) {
  const auto code_of = [](std::int64_t n) {
    return pstripack_trmesh_i8(n, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
  };
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(code_of(357913944), PSTRIPACK_TOO_MANY_NODES);
  // Numbers whose lower halves are numbers of nodes that could be triangulated.
  EXPECT_EQ(code_of((std::int64_t{1} << 32) + 10), PSTRIPACK_TOO_MANY_NODES);
  EXPECT_EQ(code_of(std::numeric_limits<std::int64_t>::max()), PSTRIPACK_TOO_MANY_NODES);
  EXPECT_EQ(code_of(-(std::int64_t{1} << 32) + 10), PSTRIPACK_TOO_FEW_NODES);
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find(" 4294967306 nodes: too many nodes"), std::string::npos) << text;
}

}  // namespace
