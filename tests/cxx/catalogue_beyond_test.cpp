// TRMESH on great circles, antipodes, ties, symmetries, hidden nodes and clusters within clusters: judged
// exactly.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "point_sets.h"
#include "support/expect.h"

namespace {

using point_sets::from_degrees;
using point_sets::make;
using point_sets::normalized;
using point_sets::Random;
using pstripack::Point;

constexpr double tiny = std::numeric_limits<double>::denorm_min();

/// p with each component increased or decreased by one ulp, or unchanged.
Point shaken(const Point& p, Random& random) {
  const auto one = [&random](double v) {
    const std::size_t way = random.below(3);
    return way == 2 ? v : std::nextafter(v, way == 0 ? 2 : -2);
  };
  return {one(p.x), one(p.y), one(p.z)};
}

TEST(GreatCircle, ThroughThePolesShakenByUlpsIsCorrect) {
  Random random(1);
  for (int longitude = 0; longitude < 180; longitude += 3)
    for (const int step : {4, 10, 30}) {
      Nodes nodes;
      for (int angle = 0; angle < 360; angle += step) {
        const Point p = from_degrees(0, angle);
        nodes.push_back(
            shaken({p.x * point_sets::cos_degrees(longitude), p.x * point_sets::sin_degrees(longitude), p.z},
                   random));
      }
      expect_as_promised_in_any_order(nodes, std::to_string(longitude) + " degrees");
    }
}

TEST(GreatCircle, TheEquatorAtDenormalHeightsIsCorrect) {
  Random random(2);
  for (const double height : {tiny, 3 * tiny, 1e-310, 0x1p-1022, 1e-300})
    for (const int n : {5, 36, 200}) {
      Nodes nodes;
      for (int i = 0; i < n; ++i) {
        nodes.push_back(from_degrees(360.0 * i / n, 0));
        nodes.back().z = height * (static_cast<double>(random.below(3)) - 1);
      }
      expect_as_promised_in_any_order(nodes, std::to_string(height) + " of " + std::to_string(n));
    }
}

TEST(Plane, AllNodesInOneBesideTheCentreAreOneTie) {
  // The 36 integer points of the circle x^2 + y^2 = 65^2: cocircular without rounding, and still so in any
  // plane.
  for (const double z : {0.25, 1.0, 0x1p-40}) {
    Nodes nodes;
    for (int x = -65; x <= 65; ++x)
      for (int y = -65; y <= 65; ++y)
        if (x * x + y * y == 65 * 65) nodes.push_back({double(x), double(y), 65 * z});
    ASSERT_EQ(nodes.size(), 36u);
    expect_as_promised_in_any_order(nodes, "z = " + std::to_string(z));
    const Mesh m = trmesh(nodes);
    EXPECT_EQ(boundary_nodes(m), nodes.size());
    for (Point& p : nodes) p = {p.x + p.z, p.y + p.z, p.z - p.x - p.y};  // in another plane
    expect_as_promised_in_any_order(nodes, "tilted, z = " + std::to_string(z));
  }
}

TEST(SmallCircles, TwoParallelOnesAreCorrect) {
  for (const auto& [low, high] :
       {std::pair{10., 20.}, {-30., 30.}, {-1e-9, 1e-9}, {60., 60.000001}, {-89.9, 89.9}})
    for (const double turn : {0., 1.8}) {
      Nodes nodes;
      for (int i = 0; i < 100; ++i) {
        nodes.push_back(from_degrees(3.6 * i, low));
        nodes.push_back(from_degrees(3.6 * i + turn, high));
      }
      expect_as_promised_in_any_order(nodes, std::to_string(low) + " and " + std::to_string(high));
    }
}

TEST(Lattice, OfPowersOfTwoIsCorrectInBothPrecisions) {
  // Directions on a grid of 2^-k: exact in float too, with ties everywhere and coinciding directions.
  for (const int steps : {2, 4, 8}) {
    Nodes nodes;
    for (int x = -steps; x <= steps; ++x)
      for (int y = -steps; y <= steps; ++y)
        for (int z = -steps; z <= steps; ++z)
          if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == steps)
            nodes.push_back({double(x) / steps, double(y) / steps, double(z) / steps});
    point_sets::shuffle(nodes, 1);
    expect_as_promised_in_any_order(nodes, std::to_string(steps));
    const Mesh expected = trmesh(nodes), m = trmesh_r4(nodes);
    EXPECT_EQ(m.ier, expected.ier);
    EXPECT_TRUE(m == expected) << steps;
    for (Point& p : nodes) p = normalized(p);
    expect_as_promised_in_any_order(nodes, std::to_string(steps) + ", of length 1");
  }
}

TEST(Symmetry, OfSignsAndAxesToTheBitIsCorrect) {
  // 48 images of each of some directions: a geodesic grid that is symmetric without rounding.
  Random random(4);
  for (const std::size_t orbits : {1, 5, 40}) {
    Nodes nodes;
    for (std::size_t k = 0; k < orbits; ++k) {
      const Point d = random.direction();
      double v[3] = {std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)};
      std::sort(v, v + 3);
      do
        for (int signs = 0; signs < 8; ++signs)
          nodes.push_back({signs & 1 ? -v[0] : v[0], signs & 2 ? -v[1] : v[1], signs & 4 ? -v[2] : v[2]});
      while (std::next_permutation(v, v + 3));
    }
    ASSERT_EQ(nodes.size(), 48 * orbits);
    expect_as_promised_in_any_order(nodes, std::to_string(orbits) + " orbits");
  }
}

/// True if lengths hide a node: the mesh is then wrong on coordinates, since directions decided.
bool is_decided_by_directions(const Nodes& nodes) {
  return !fault(nodes, *rings_of(trmesh(nodes)), exact::On::coordinates).empty();
}

TEST(HiddenNodes, AmongLengthsWithin1em7OfOneAreCorrect) {
  Random random(6);
  for (const char* family : {"random", "cap:1e-3", "latlon", "ring"}) {
    Nodes nodes = make(family, 3000);
    for (Point& p : nodes) {
      const double length = 1 + 1e-7 * random.uniform(-1, 1);
      p = scaled(length, p);
    }
    EXPECT_EQ(is_decided_by_directions(nodes), std::string(family) == "cap:1e-3") << family;
    expect_as_promised_in_any_order(nodes, family);
  }
}

TEST(HiddenNodes, AndTiesTogetherAreCorrect) {
  // A lattice with many cocircular fours; then one node among them, shorter by an ulp or more.
  for (const double shorter : {0x1p-53, 0x1p-40, 1e-8, 0.9e-6})
    for (const int which : {0, 13, 25}) {
      Nodes nodes;
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z)
            if (x != 0 || y != 0 || z != 0) nodes.push_back(normalized({double(x), double(y), double(z)}));
      Point& p = nodes[static_cast<std::size_t>(which)];
      p = scaled(1 - shorter, p);
      for (const Point& q : make("cap:1e-4", 50)) nodes.push_back(q);
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        point_sets::shuffle(nodes, seed);
        EXPECT_TRUE(is_as_promised(nodes)) << shorter << " at " << which << ", seed " << seed;
      }
    }
}

TEST(Clusters, WithinClustersAreCorrect) {
  // Distances from 1 down to 1e-16 in one set: each node near an earlier one, at a scale of its own.
  Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    Nodes nodes = make("random", 4, 11);
    while (nodes.size() < 1000) {
      const Point& near = nodes[random.below(nodes.size())];
      const double scale = std::pow(10, random.uniform(-16, 0));
      nodes.push_back(
          normalized({near.x + scale * random.uniform(-1, 1), near.y + scale * random.uniform(-1, 1),
                      near.z + scale * random.uniform(-1, 1)}));
    }
    ASSERT_TRUE(is_as_promised(nodes)) << trial;
  }
}

}  // namespace
