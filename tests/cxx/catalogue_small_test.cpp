// TRMESH of few nodes, Platonic solids, great circles, lattices and rings: judged exactly.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "point_sets.h"
#include "support/data_file.h"
#include "support/expect.h"

namespace {

using point_sets::from_degrees;
using point_sets::make;
using point_sets::normalized;
using point_sets::Random;
using pstripack::Point;

const Point ex{1, 0, 0}, ey{0, 1, 0}, ez{0, 0, 1};

int ier_of(const Nodes& nodes) { return trmesh(nodes).ier; }

// ---- Fewer than five ----

TEST(FewNodes, BelowThreeAreRefusedInSilence) {
  ::testing::internal::CaptureStderr();
  for (const std::int32_t n : {-2147483647 - 1, -5, -1, 0, 1, 2}) {
    EXPECT_EQ(pstripack_trmesh(n, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr), -1) << n;
    EXPECT_EQ(pstripack_trmesh_r4(n, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr), -1) << n;
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(FewNodes, ThreeAreOneTriangleInBothOrders) {
  for (const bool is_left : {true, false}) {
    const Mesh m = is_left ? trmesh({ex, ey, ez}) : trmesh({ex, ez, ey});
    EXPECT_EQ(m.ier, 0);
    EXPECT_EQ(m.list, is_left ? (std::vector<std::int32_t>{2, -3, 3, -1, 1, -2})
                              : (std::vector<std::int32_t>{3, -2, 1, -3, 2, -1}));
    EXPECT_EQ(m.lptr, (std::vector<std::int32_t>{2, 1, 4, 3, 6, 5}));
    EXPECT_EQ(m.lend, (std::vector<std::int32_t>{2, 4, 6}));
    EXPECT_EQ(m.lnew, 7);
  }
}

TEST(FewNodes, ThreeOnAGreatCircleAreCollinear) {
  const Point opposite{-1, 0, 0};
  for (const Nodes& nodes : {Nodes{ex, ex, ey}, Nodes{ex, ey, ey}, Nodes{ey, ex, ey}, Nodes{ex, ex, ex},
                             Nodes{ex, opposite, ey}, Nodes{ex, ey, opposite}, Nodes{ey, ex, opposite}}) {
    ::testing::internal::CaptureStderr();
    const Mesh m = trmesh(nodes);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(m.ier, -2);
    EXPECT_TRUE(is_untouched(m));
  }
}

// ---- The Platonic solids ----

Nodes rotated(const Nodes& nodes, Random& random) {
  const Point a = random.direction(), any = random.direction();
  const Point b = normalized(minus(any, scaled(dot(any, a), a))), c = cross(a, b);
  Nodes result;
  for (const Point& p : nodes)
    result.push_back(normalized(plus(plus(scaled(p.x, a), scaled(p.y, b)), scaled(p.z, c))));
  return result;
}

struct Solid {
  const char* name;
  Nodes nodes;
};
void PrintTo(const Solid& s, std::ostream* out) { *out << s.name; }

std::vector<Solid> solids() {
  Nodes tetrahedron, octahedron, cube, icosahedron, dodecahedron;
  const double g = (1 + std::sqrt(5.0)) / 2;
  for (const double s : {-1., 1.})
    for (const double t : {-1., 1.}) {
      tetrahedron.push_back(normalized({s, t, s * t}));
      icosahedron.push_back(normalized({0, s, t * g}));
      icosahedron.push_back(normalized({s, t * g, 0}));
      icosahedron.push_back(normalized({t * g, 0, s}));
      dodecahedron.push_back(normalized({0, s / g, t * g}));
      dodecahedron.push_back(normalized({s / g, t * g, 0}));
      dodecahedron.push_back(normalized({t * g, 0, s / g}));
      for (const double u : {-1., 1.}) cube.push_back(normalized({s, t, u}));
    }
  for (const double s : {-1., 1.}) octahedron.insert(octahedron.end(), {{s, 0, 0}, {0, s, 0}, {0, 0, s}});
  dodecahedron.insert(dodecahedron.end(), cube.begin(), cube.end());
  return {{"tetrahedron", tetrahedron},
          {"octahedron", octahedron},
          {"cube", cube},
          {"icosahedron", icosahedron},
          {"dodecahedron", dodecahedron}};
}

class Platonic : public ::testing::TestWithParam<Solid> {};

TEST_P(Platonic, IsCorrectUnderAThousandRotations) {
  const Nodes& nodes = GetParam().nodes;
  if (expected_ier(nodes) == 0) {
    EXPECT_EQ(trmesh(nodes).lnew, static_cast<std::int32_t>(6 * nodes.size() - 11));
  }
  EXPECT_TRUE(is_as_promised(nodes));
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    Nodes turned = rotated(nodes, random);
    point_sets::shuffle(turned, random.bits());
    ASSERT_TRUE(is_as_promised(turned)) << "rotation " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Solid, Platonic, ::testing::ValuesIn(solids()),
                         [](const auto& info) { return std::string(info.param.name); });

// ---- Great circles ----

Nodes behind(Nodes first, std::size_t n) {
  const Nodes rest = make("random", n);
  first.insert(first.end(), rest.begin(), rest.end());
  return first;
}

TEST(GreatCircle, FirstThreeExactlyOnOneAreCollinear) {
  EXPECT_EQ(ier_of(behind({ex, normalized({1, 1, 0}), ey}, 50)), -2);
  EXPECT_EQ(ier_of(behind({ez, {0, 0, -1}, ex}, 50)), -2);  // poles first
  // An exact zero that is not an axis: c = b - a up to its length.
  const Point a{0.5, 0.25, 0.125}, b{0.125, 0.5, 0.0625};
  EXPECT_EQ(ier_of(behind({a, b, {b.x - a.x, b.y - a.y, b.z - a.z}}, 50)), -2);
}

TEST(GreatCircle, FirstThreeRoundedAreNotUnlessTheDeterminantIsZero) {
  for (int longitude = 1; longitude < 360; ++longitude) {
    const Nodes nodes =
        behind({from_degrees(longitude, -20), from_degrees(longitude, 10), from_degrees(longitude, 50)}, 30);
    ASSERT_TRUE(is_as_promised(nodes)) << "longitude " << longitude;
  }
  EXPECT_EQ(ier_of(nodes_in(TEST_DATA_DIR "/first_three_meridian_37.txt")), 0);
}

TEST(GreatCircle, AllOnTheEquatorAreCollinear) {
  Nodes nodes;
  for (int i = 0; i < 100; ++i) nodes.push_back(from_degrees(3.6 * i, 0));
  const Mesh m = trmesh(nodes);
  EXPECT_EQ(m.ier, -2);
  EXPECT_TRUE(is_untouched(m));
  for (Point& p : nodes) p = from_degrees(3.6 * static_cast<double>(&p - nodes.data()), 60);
  EXPECT_EQ(boundary_nodes(trmesh(nodes)), 100u);
}

TEST(GreatCircle, AllOnATiltedOneAreCorrect) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    Nodes nodes;
    const std::size_t n = 4 + random.below(60);
    for (std::size_t k = 0; k < n; ++k)
      nodes.push_back(from_degrees(360 * static_cast<double>(k) / static_cast<double>(n), 0));
    nodes = rotated(nodes, random);
    if (i % 2 == 0) point_sets::shuffle(nodes, random.bits());
    ASSERT_TRUE(is_as_promised(nodes)) << i;
  }
}

TEST(GreatCircle, HalfOfOneIsCorrect) {
  for (const int n : {4, 7, 20, 181}) {
    Nodes nodes;
    for (int k = 0; k < n; ++k) nodes.push_back(from_degrees(37, -90 + 180.0 * k / (n - 1)));
    expect_as_promised_in_any_order(nodes, std::to_string(n), 1);
  }
}

TEST(GreatCircle, OneNodeOffIsCorrect) {
  for (const double off : {1e-3, 1e-9, 1e-15, 1e-17, 1e-300}) {
    for (const std::size_t which : {0, 1, 2, 3, 57, 99}) {
      Nodes nodes;
      for (int i = 0; i < 100; ++i) nodes.push_back(from_degrees(3.6 * i, 0));
      nodes[which].z = off;
      EXPECT_TRUE(is_as_promised(nodes)) << off << " at " << which;
      std::swap(nodes[which], nodes[0]);
      EXPECT_TRUE(is_correct(nodes, trmesh(nodes))) << off << " first";
    }
  }
}

TEST(GreatCircle, EquatorAndBothPolesAre200Triangles) {
  Nodes nodes = {ez, {0, 0, -1}};
  for (int i = 0; i < 100; ++i) nodes.push_back(from_degrees(3.6 * i, 0));
  EXPECT_EQ(ier_of(nodes), -2);  // the poles are opposite each other
  std::reverse(nodes.begin(), nodes.end());
  EXPECT_EQ(ier_of(nodes), -2);  // the equator
  std::swap(nodes[0], nodes[100]);
  const Mesh m = trmesh(nodes);
  EXPECT_TRUE(is_correct(nodes, m));
  EXPECT_EQ(faces_of(*rings_of(m)).size(), 200u);
  EXPECT_EQ(boundary_nodes(m), 0u);
}

TEST(Boundary, TwoOppositeNodesAreCorrect) {
  // Hemisphere x >= 0 and two nodes at its poles; with and without a third on the rim between them.
  Nodes nodes = {ez, ex, {0, 0, -1}, normalized({1, 1, 1}), normalized({1, -1, 0.5}), normalized({2, 1, -3})};
  EXPECT_EQ(ier_of(nodes), -2);
  std::swap(nodes[2], nodes[3]);
  Mesh m = trmesh(nodes);
  EXPECT_TRUE(is_correct(nodes, m));
  EXPECT_GE(boundary_nodes(m), 2u);
  nodes.push_back(ey);
  m = trmesh(nodes);
  EXPECT_TRUE(is_correct(nodes, m));
  // A lune: both its corners and nothing but two meridians.
  Nodes lune;
  for (const double latitude : {-30., 0., 30.})
    lune.push_back(from_degrees(0, latitude)),
        lune.push_back({0, point_sets::cos_degrees(latitude), point_sets::sin_degrees(latitude)});
  lune.push_back(ez), lune.push_back({0, 0, -1});
  m = trmesh(lune);
  EXPECT_TRUE(is_correct(lune, m));
  EXPECT_EQ(boundary_nodes(m), 8u);
}

}  // namespace
