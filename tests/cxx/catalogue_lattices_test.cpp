// Section "Lattices, orders, densities" of tests/catalogue/rows.toml, except what concerns ranks.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "point_sets.h"
#include "support/expect.h"

namespace {

using point_sets::from_degrees;
using point_sets::make;
using pstripack::Point;

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

Faces renumbered(const Mesh& m, const Nodes& nodes, const Nodes& as) {
  std::map<std::array<double, 3>, std::int32_t> number;
  for (std::size_t k = 0; k < as.size(); ++k)
    number[{as[k].x, as[k].y, as[k].z}] = static_cast<std::int32_t>(k);
  const auto rings = rings_of(m);
  Faces faces = rings ? faces_of(*rings) : Faces{};
  for (auto& f : faces)
    for (auto& k : f) k = number.at({nodes[k].x, nodes[k].y, nodes[k].z});
  sort_faces(faces);
  return faces;
}

TEST(LatitudeLongitude, GridsAreCorrect) {
  for (const auto& [rows, columns] : {std::pair{19, 36}, {181, 360}, {4, 3}, {3, 4}, {37, 5}, {3, 1000}}) {
    const Nodes nodes = grid(rows, columns);
    const Mesh m = trmesh(nodes);
    EXPECT_TRUE(is_as_promised(nodes, m)) << rows << " x " << columns;
    if (m.ier == 0) {
      EXPECT_EQ(boundary_nodes(m), 0u) << rows << " x " << columns;
    }
  }
}

TEST(LatitudeLongitude, SortedAndShuffledAreTheSame) {
  const Nodes nodes = grid(181, 360);
  Nodes other = nodes;
  point_sets::shuffle(other, 1);
  EXPECT_EQ(renumbered(trmesh(nodes), nodes, nodes), renumbered(trmesh(other), other, nodes));
}

TEST(LatitudeLongitude, TenRowsReversedHaveNoBoundary) {
  for (const int columns : {9, 10, 18, 20, 36}) {
    Nodes nodes = grid(12, columns);
    std::reverse(nodes.begin(), nodes.end());
    const Mesh m = trmesh(nodes);
    EXPECT_TRUE(is_as_promised(nodes, m)) << columns;
    if (m.ier == 0) {
      EXPECT_EQ(boundary_nodes(m), 0u) << columns;
    }
  }
}

TEST(LatitudeLongitude, RegionsAreCorrect) {  // Europe in degrees: rows are small circles, columns great ones
  Nodes nodes;
  for (int latitude = 35; latitude <= 70; ++latitude)
    for (int longitude = -10; longitude <= 40; ++longitude)
      nodes.push_back(from_degrees(longitude, latitude));
  EXPECT_TRUE(is_as_promised(nodes));
}

class CubedSphere : public ::testing::TestWithParam<int> {};

TEST_P(CubedSphere, InPanelOrderIsCorrect) {
  const std::size_t m = static_cast<std::size_t>(GetParam());
  const Nodes nodes = make("cubed-sphere", 6 * m * m);
  ASSERT_EQ(nodes.size(), 6 * m * m);
  EXPECT_TRUE(is_as_promised(nodes));
}

INSTANTIATE_TEST_SUITE_P(M, CubedSphere, ::testing::Range(2, 65));

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

TEST(Grid, OfEveryKindIsCorrectAtManySizes) {
  for (const char* family : {"fibonacci", "healpix", "reduced-gaussian", "tripolar", "icosahedral", "latlon"})
    for (std::size_t n = 12; n < 3000; n = n * 3 / 2 + 1) {
      const Nodes nodes = make(family, n);
      const Mesh m = trmesh(nodes);
      EXPECT_TRUE(is_as_promised(nodes, m)) << family << " " << n;
    }
}

TEST(Ring, Of500AndItsCentreIsCorrectAndTheSameInAnyOrder) {
  Nodes nodes = make("ring", 501), other = nodes;
  const Mesh m = trmesh(nodes);
  EXPECT_TRUE(is_correct(nodes, m));
  EXPECT_EQ(boundary_nodes(m), 500u);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    point_sets::shuffle(other, seed);
    EXPECT_EQ(renumbered(trmesh(other), other, nodes), renumbered(m, nodes, nodes)) << seed;
  }
  nodes.pop_back();  // without the centre the ring is one great tie
  EXPECT_TRUE(is_correct(nodes, trmesh(nodes)));
  for (const Point& p : make("random", 200)) nodes.push_back(p);  // and among others
  EXPECT_TRUE(is_correct(nodes, trmesh(nodes)));
}

TEST(Ring, OnEveryParallelIsCorrect) {
  for (const double latitude : {-89.999, -60., -1e-6, 1e-9, 30., 89.9}) {
    Nodes nodes;
    for (int i = 0; i < 500; ++i) nodes.push_back(from_degrees(0.72 * i, latitude));
    EXPECT_TRUE(is_as_promised(nodes)) << latitude;
  }
}

/// Moves nodes to the normalized mean of the centroids of their triangles: approximately Lloyd's method.
Nodes lloyd_step(const Nodes& nodes, const Rings& rings) {
  Nodes moved = nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    Point sum{0, 0, 0};
    for (const std::int32_t j : rings.neighbours[k])
      sum = {sum.x + nodes[j].x, sum.y + nodes[j].y, sum.z + nodes[j].z};
    moved[k] = point_sets::normalized(sum);
  }
  return moved;
}

TEST(Lloyd, StepsAreCorrectOnTheWayAndAtTheEnd) {
  Nodes nodes = make("random", 642);
  for (int step = 0; step < 100; ++step) {
    const Mesh m = trmesh(nodes);
    const auto rings = rings_of(m);
    ASSERT_TRUE(rings) << step;
    if (step % 5 == 0) {
      ASSERT_TRUE(is_correct(nodes, m)) << step;
    }
    nodes = lloyd_step(nodes, *rings);
  }
  nodes = make("icosahedral", 2562);  // converged, all the symmetries of the icosahedron
  for (int step = 0; step < 10; ++step) {
    const Mesh m = trmesh(nodes);
    ASSERT_TRUE(is_correct(nodes, m)) << step;
    nodes = lloyd_step(nodes, *rings_of(m));
  }
}

/// Bits of x, y, z interleaved.
std::uint64_t morton(const Point& p) {
  std::uint64_t key = 0;
  const std::uint64_t v[3] = {static_cast<std::uint64_t>((p.x + 1) * 0x1p19),
                              static_cast<std::uint64_t>((p.y + 1) * 0x1p19),
                              static_cast<std::uint64_t>((p.z + 1) * 0x1p19)};
  for (int bit = 20; bit >= 0; --bit)
    for (const std::uint64_t c : v) key = 2 * key + (c >> bit & 1);
  return key;
}

/// The position along Hilbert's curve through the cube, 20 bits per axis (Skilling, AIP Conf. Proc. 707,
/// 2004).
std::uint64_t hilbert(const Point& p) {
  std::uint32_t v[3] = {static_cast<std::uint32_t>((p.x + 1) * 0x1p18),
                        static_cast<std::uint32_t>((p.y + 1) * 0x1p18),
                        static_cast<std::uint32_t>((p.z + 1) * 0x1p18)};
  for (std::uint32_t bit = 1u << 19; bit > 1; bit >>= 1)  // undo the turns of each level
    for (std::uint32_t& c : v) {
      const std::uint32_t below = bit - 1, exchange = (v[0] ^ c) & below;
      if ((c & bit) != 0)
        v[0] ^= below;
      else
        v[0] ^= exchange, c ^= exchange;
    }
  v[1] ^= v[0], v[2] ^= v[1];  // Gray code
  std::uint32_t turn = 0;
  for (std::uint32_t bit = 1u << 19; bit > 1; bit >>= 1)
    if ((v[2] & bit) != 0) turn ^= bit - 1;
  std::uint64_t key = 0;
  for (int bit = 19; bit >= 0; --bit)
    for (const std::uint32_t c : v) key = 2 * key + ((c ^ turn) >> bit & 1);
  return key;
}

class Order : public ::testing::TestWithParam<const char*> {};

TEST_P(Order, DoesNotChangeTheTriangles) {
  const Nodes nodes = make(GetParam(), 20000);
  const Faces faces = renumbered(trmesh(nodes), nodes, nodes);
  const auto check = [&](const char* what, auto less) {
    Nodes sorted = nodes;
    std::stable_sort(sorted.begin(), sorted.end(), less);
    for (const bool reversed : {false, true}) {
      if (reversed) std::reverse(sorted.begin(), sorted.end());
      const Mesh m = trmesh(sorted);
      if (expected_ier(sorted) == -2) {
        EXPECT_EQ(m.ier, -2) << what;
        continue;
      }
      EXPECT_EQ(m.ier, 0) << what;
      EXPECT_TRUE(renumbered(m, sorted, nodes) == faces) << what << (reversed ? " reversed" : "");
    }
  };
  check("as it is", [](const Point&, const Point&) { return false; });
  check("by x", [](const Point& a, const Point& b) { return a.x < b.x; });
  check("by z", [](const Point& a, const Point& b) { return a.z < b.z; });
  check("Morton", [](const Point& a, const Point& b) { return morton(a) < morton(b); });
  check("Hilbert", [](const Point& a, const Point& b) { return hilbert(a) < hilbert(b); });
}

INSTANTIATE_TEST_SUITE_P(Of, Order,
                         ::testing::Values("random", "latlon", "fibonacci", "healpix", "clusters"));

TEST(Density, HalfInASmallCapIsCorrect) {
  for (const char* radius : {"1e-5", "1e-6", "1e-7", "1e-9"})
    EXPECT_TRUE(is_as_promised(make(std::string("dense-cap:") + radius, 4000),
                               trmesh(make(std::string("dense-cap:") + radius, 4000))))
        << radius;
}

TEST(Density, SmoothIsCorrect) {
  for (const char* family : {"variable:1e2", "variable:1e4", "variable:1e6", "variable:1e10"}) {
    const Nodes nodes = make(family, 20000);
    EXPECT_TRUE(is_as_promised(nodes)) << family;
  }
}

}  // namespace
