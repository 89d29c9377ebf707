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

Nodes data(const std::string& file) { return nodes_in(TEST_DATA_DIR "/" + file); }

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
  Mesh m = trmesh({ex, ey, ez});
  EXPECT_EQ(m.ier, 0);
  EXPECT_EQ(m.list, (std::vector<std::int32_t>{2, -3, 3, -1, 1, -2}));
  EXPECT_EQ(m.lptr, (std::vector<std::int32_t>{2, 1, 4, 3, 6, 5}));
  EXPECT_EQ(m.lend, (std::vector<std::int32_t>{2, 4, 6}));
  EXPECT_EQ(m.lnew, 7);
  m = trmesh({ex, ez, ey});
  EXPECT_EQ(m.ier, 0);
  EXPECT_EQ(m.list, (std::vector<std::int32_t>{3, -2, 1, -3, 2, -1}));
  EXPECT_EQ(m.lptr, (std::vector<std::int32_t>{2, 1, 4, 3, 6, 5}));
  EXPECT_EQ(m.lend, (std::vector<std::int32_t>{2, 4, 6}));
  EXPECT_EQ(m.lnew, 7);
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

TEST(FewNodes, FourAroundTheCentreCoverTheSphere) {
  const Nodes nodes = {ex, ey, ez, normalized({-1, -1, -1})};
  const Mesh m = trmesh(nodes);
  EXPECT_TRUE(is_correct(nodes, m));
  EXPECT_EQ(m.lnew, 13);
  EXPECT_EQ(boundary_nodes(m), 0u);
}

TEST(FewNodes, FourOnOneSideHaveABoundary) {
  const Nodes inner = {ex, ey, ez, normalized({1, 1, 1})}, outer = {ex, ey, ez, normalized({1, 1, -0.25})};
  Mesh m = trmesh(inner);
  EXPECT_TRUE(is_correct(inner, m));
  EXPECT_EQ(boundary_nodes(m), 3u);
  m = trmesh(outer);
  EXPECT_TRUE(is_correct(outer, m));
  EXPECT_EQ(boundary_nodes(m), 4u);
}

// ---- The Platonic solids ----

Nodes rotated(const Nodes& nodes, Random& random) {
  const Point a = random.direction();
  Point b = random.direction();
  const double along = a.x * b.x + a.y * b.y + a.z * b.z;
  b = normalized({b.x - along * a.x, b.y - along * a.y, b.z - along * a.z});
  const Point c{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  Nodes result;
  for (const Point& p : nodes)
    result.push_back(normalized({p.x * a.x + p.y * b.x + p.z * c.x, p.x * a.y + p.y * b.y + p.z * c.y,
                                 p.x * a.z + p.y * b.z + p.z * c.z}));
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
  int zeros = 0;
  for (int longitude = 1; longitude < 360; ++longitude) {
    const Nodes nodes =
        behind({from_degrees(longitude, -20), from_degrees(longitude, 10), from_degrees(longitude, 50)}, 30);
    zeros += expected_ier(nodes) == -2;
    ASSERT_TRUE(is_as_promised(nodes)) << "longitude " << longitude;
  }
  RecordProperty("exactly_collinear", zeros);
  EXPECT_TRUE(is_as_promised(data("first_three_meridian_37.txt")));
  EXPECT_EQ(ier_of(data("first_three_meridian_37.txt")), 0);
}

TEST(GreatCircle, AllOnTheEquatorAreCollinear) {
  Nodes nodes;
  for (int i = 0; i < 100; ++i) nodes.push_back(from_degrees(3.6 * i, 0));
  const Mesh m = trmesh(nodes);
  EXPECT_EQ(m.ier, -2);
  EXPECT_TRUE(is_untouched(m));
}

TEST(GreatCircle, AllOnARoundedMeridianAreCorrect) {
  for (const double longitude : {37.0, 1.0, 45.0, 89.0, 123.456})
    for (const int n : {5, 10, 36, 100, 1000}) {
      Nodes nodes;
      for (int i = 0; i < n; ++i) {
        const double angle = 360.0 * i / n;  // all round: up one side, down the other
        const Point p = from_degrees(0, angle);
        nodes.push_back(
            {p.x * point_sets::cos_degrees(longitude), p.x * point_sets::sin_degrees(longitude), p.z});
      }
      EXPECT_TRUE(is_as_promised(nodes)) << longitude << " degrees, " << n << " nodes";
      point_sets::shuffle(nodes, 3);
      EXPECT_TRUE(is_as_promised(nodes)) << longitude << " degrees, " << n << " nodes, shuffled";
    }
  EXPECT_TRUE(is_as_promised(data("meridian_37.txt")));
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
    EXPECT_TRUE(is_as_promised(nodes)) << n;
    point_sets::shuffle(nodes, 5);
    EXPECT_TRUE(is_as_promised(nodes)) << n;
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

TEST(SmallCircle, At60DegreesHas100BoundaryNodes) {
  Nodes nodes;
  for (int i = 0; i < 100; ++i) nodes.push_back(from_degrees(3.6 * i, 60));
  const Mesh m = trmesh(nodes);
  EXPECT_TRUE(is_correct(nodes, m));
  EXPECT_EQ(boundary_nodes(m), 100u);
  EXPECT_EQ(faces_of(*rings_of(m)).size(), 98u);
}

// ---- Strips, hemispheres, caps ----

TEST(Hemisphere, WithASymmetricRimIsCorrect) {
  // Opposite pairs on the rim: every arc of the boundary is exactly on the equator.
  for (const int n : {4, 6, 36}) {
    Nodes nodes = {ez};
    for (int i = 0; i < n; ++i) nodes.push_back(from_degrees(360.0 * i / n, 0));
    nodes.push_back(normalized({1, 2, 3}));
    const Mesh m = trmesh(nodes);
    EXPECT_TRUE(is_correct(nodes, m)) << n;
    EXPECT_EQ(boundary_nodes(m), static_cast<std::size_t>(n));
  }
}

TEST(AntipodalClusters, PointByPointOppositeAreCorrect) {
  for (const char* family : {"random", "cap:1e-3", "cap:1e-8"}) {
    const Nodes half = make(family, 500);
    Nodes nodes = half;
    for (const Point& p : half) nodes.push_back({-p.x, -p.y, -p.z});
    EXPECT_TRUE(is_as_promised(nodes)) << family;
  }
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

// ---- Grids and rings ----

constexpr double radians = 0.017453292519943295;

/// rows x columns from pole to pole, row after row, a node at each pole; with the machine's own cosines.
Nodes grid(int rows, int columns) {
  Nodes nodes = {{0, 0, -1}};
  for (int j = 1; j < rows - 1; ++j)
    for (int i = 0; i < columns; ++i) {
      const double latitude = (-90 + 180.0 * j / (rows - 1)) * radians,
                   longitude = 360.0 * i / columns * radians;
      nodes.push_back({std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                       std::sin(latitude)});
    }
  nodes.push_back({0, 0, 1});
  return nodes;
}

TEST(LatitudeLongitude, GridsAreCorrect) {
  for (const auto& [rows, columns] :
       {std::pair{19, 36}, {181, 360}, {4, 3}, {3, 4}, {37, 5}, {12, 9}, {12, 36}, {3, 1000}}) {
    Nodes nodes = grid(rows, columns);
    EXPECT_TRUE(is_as_promised(nodes)) << rows << " x " << columns;
    std::reverse(nodes.begin(), nodes.end());
    EXPECT_TRUE(is_as_promised(nodes)) << rows << " x " << columns << ", reversed";
  }
}

TEST(LatitudeLongitude, RegionsAreCorrect) {  // Europe in degrees: rows are small circles, columns great ones
  Nodes nodes;
  for (int latitude = 35; latitude <= 70; ++latitude)
    for (int longitude = -10; longitude <= 40; ++longitude)
      nodes.push_back(from_degrees(longitude, latitude));
  EXPECT_TRUE(is_as_promised(nodes));
}

TEST(CubedSphere, CornersOfCellsAreCorrect) {  // nodes on the edges of the cube, lattice symmetric to the bit
  for (const int m : {2, 3, 4, 8, 16}) {
    Nodes nodes;
    for (int i = 0; i <= m; ++i)
      for (int j = 0; j <= m; ++j)
        for (int k = 0; k <= m; ++k)
          if (i % m == 0 || j % m == 0 || k % m == 0)
            nodes.push_back(point_sets::normalized({2. * i - m, 2. * j - m, 2. * k - m}));
    EXPECT_TRUE(is_as_promised(nodes)) << m;
    Nodes lattice;  // the same on exact integer directions: as many ties as there can be
    for (int i = 0; i <= m; ++i)
      for (int j = 0; j <= m; ++j)
        for (int k = 0; k <= m; ++k)
          if (i % m == 0 || j % m == 0 || k % m == 0) lattice.push_back({2. * i - m, 2. * j - m, 2. * k - m});
    point_sets::shuffle(lattice, 1);
    EXPECT_TRUE(is_as_promised(lattice, trmesh(lattice))) << m << " on integers";
  }
}

TEST(Ring, OnEveryParallelIsCorrect) {
  for (const double latitude : {-89.999, -60., -1e-6, 1e-9, 30., 89.9}) {
    Nodes nodes;
    for (int i = 0; i < 500; ++i) nodes.push_back(from_degrees(0.72 * i, latitude));
    EXPECT_TRUE(is_as_promised(nodes)) << latitude;
  }
}

}  // namespace
