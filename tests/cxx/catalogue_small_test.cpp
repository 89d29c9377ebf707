// Section "Small and special" of tests/catalogue/rows.toml: at least one test per row.

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
    const double coordinate[2] = {1, 1};
    std::int32_t list[6], lptr[6], lend[3], lnew = untouched;
    std::fill(list, list + 6, untouched), std::fill(lptr, lptr + 6, untouched),
        std::fill(lend, lend + 3, untouched);
    EXPECT_EQ(pstripack_trmesh(n, coordinate, coordinate, coordinate, list, lptr, lend, &lnew), -1) << n;
    EXPECT_EQ(pstripack_trmesh(n, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr), -1) << n;
    EXPECT_EQ(pstripack_trmesh_r4(n, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr), -1) << n;
    for (const std::int32_t i : list) EXPECT_EQ(i, untouched);
    for (const std::int32_t i : lptr) EXPECT_EQ(i, untouched);
    for (const std::int32_t i : lend) EXPECT_EQ(i, untouched);
    EXPECT_EQ(lnew, untouched);
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

// ---- All small subsets of the 26 directions of a cube ----

/// The signs of all fours of the 26 nodes, from tests/support/reference_predicates.h.
class CubeDirections {
 public:
  explicit CubeDirections(bool unit) {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (x != 0 || y != 0 || z != 0) {
            const Point p{double(x), double(y), double(z)};
            nodes_.push_back(unit ? normalized(p) : p);
          }
    const exact::On on = unit ? exact::On::coordinates : exact::On::directions;
    for (int a = 0; a < 26; ++a)
      for (int b = 0; b < a; ++b)
        for (int c = 0; c < b; ++c) {
          set_left(a, b, c, exact::left(nodes_[a], nodes_[b], nodes_[c]));
          for (int d = 0; d < c; ++d)
            set_above(a, b, c, d, exact::above(on, nodes_[a], nodes_[b], nodes_[c], nodes_[d]));
        }
  }

  /// Calls trmesh for `count` of the nodes in this order; empty if the result is right.
  std::string check(const int* subset, int count) const {
    double x[6], y[6], z[6];
    std::int32_t list[24], lptr[24], lend[6], lnew = untouched;
    for (int k = 0; k < count; ++k)
      x[k] = nodes_[subset[k]].x, y[k] = nodes_[subset[k]].y, z[k] = nodes_[subset[k]].z;
    const int expected = left_[subset[0]][subset[1]][subset[2]] == 0 ? -2 : 0;
    const int ier = pstripack_trmesh(count, x, y, z, list, lptr, lend, &lnew);
    if (ier != expected) return "IER = " + std::to_string(ier) + ", expected " + std::to_string(expected);
    if (ier != 0) return "";
    // Canonical lists: node k has the slots from the last of k-1 on.
    int faces = 0;
    std::int32_t slot = 1;
    for (std::int32_t k = 1; k <= count; ++k) {
      const std::int32_t first = slot, last = lend[k - 1];
      if (last <= first || last > 6 * count - 12) return "LEND(" + std::to_string(k) + ")";
      for (; slot <= last; ++slot) {
        if (lptr[slot - 1] != (slot == last ? first : slot + 1)) return "LPTR(" + std::to_string(slot) + ")";
        const std::int32_t a = list[slot - 1], b = list[lptr[slot - 1] - 1];
        if (a > count || a == 0 || a < -count || (a < 0 && slot < last))
          return "LIST(" + std::to_string(slot) + ")";
        if (a < 0) continue;  // the end of a boundary node's list
        const int p = subset[k - 1], q = subset[a - 1], r = subset[std::abs(b) - 1];
        if (left_[p][q][r] <= 0) return "a triangle is not counterclockwise";
        for (int d = 0; d < count; ++d)
          if (above_[p][q][r][subset[d]] > 0) return "a node lies in a triangle's cap";
        ++faces;
      }
    }
    if (lnew != slot) return "LNEW";
    return faces == 3 * number_of_faces(subset, count) ? "" : "wrong number of triangles";
  }

 private:
  /// Faces of the hull with a positive determinant.
  int number_of_faces(const int* s, int count) const {
    int faces = 0;
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < count; ++j)
        for (int k = j + 1; k < count; ++k) {
          const int sign = left_[s[i]][s[j]][s[k]];
          bool empty = sign != 0;
          for (int d = 0; empty && d < count; ++d)
            empty = d == i || d == j || d == k || sign * above_[s[i]][s[j]][s[k]][s[d]] <= 0;
          faces += empty;
        }
    return faces;
  }

  void set_left(int a, int b, int c, int sign) {
    left_[a][b][c] = left_[b][c][a] = left_[c][a][b] = static_cast<signed char>(sign);
    left_[b][a][c] = left_[a][c][b] = left_[c][b][a] = static_cast<signed char>(-sign);
  }
  void set_above(int a, int b, int c, int d, int sign) {
    int v[4] = {a, b, c, d}, p[4] = {0, 1, 2, 3};
    do {
      int inversions = 0;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) inversions += p[j] > p[i];
      above_[v[p[0]]][v[p[1]]][v[p[2]]][v[p[3]]] =
          static_cast<signed char>(inversions % 2 == 0 ? sign : -sign);
    } while (std::next_permutation(p, p + 4));
  }

  Nodes nodes_;
  signed char left_[26][26][26] = {}, above_[26][26][26][26] = {};
};

/// Checks every subset of `size` of the 26 nodes, in every `stride`-th of all orders of all subsets, and each
/// subset in at least one order.
void check_subsets(bool unit, int size, std::uint64_t stride) {
  const CubeDirections cube(unit);
  std::uint64_t orders = 0, calls = 0;
  std::string chosen =
      std::string(static_cast<std::size_t>(size), 1) + std::string(static_cast<std::size_t>(26 - size), 0);
  do {
    int subset[6], count = 0;
    for (int k = 0; k < 26; ++k)
      if (chosen[static_cast<std::size_t>(k)]) subset[count++] = k;
    bool first = true;
    do {
      if (orders++ % stride != 0 && !first) continue;
      first = false;
      ++calls;
      ASSERT_EQ(cube.check(subset, size), "")
          << ::testing::PrintToString(std::vector<int>(subset, subset + size));
    } while (std::next_permutation(subset, subset + size));
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  ::testing::Test::RecordProperty("calls", std::to_string(calls));
}

TEST(CubeDirections, OfUnitLengthSubsetsOf3InAllOrders) { check_subsets(true, 3, 1); }
TEST(CubeDirections, OfUnitLengthSubsetsOf4InAllOrders) { check_subsets(true, 4, 1); }
TEST(CubeDirections, OfUnitLengthSubsetsOf5InEverySeventhOrder) { check_subsets(true, 5, 7); }
TEST(CubeDirections, OfUnitLengthSubsetsOf5InAllOrders) { check_subsets(true, 5, 1); }
TEST(CubeDirections, OfUnitLengthSubsetsOf6InOneOrderOrMore) { check_subsets(true, 6, 241); }
TEST(CubeDirections, OfIntegersSubsetsOf3InAllOrders) { check_subsets(false, 3, 1); }
TEST(CubeDirections, OfIntegersSubsetsOf4InAllOrders) { check_subsets(false, 4, 1); }
TEST(CubeDirections, OfIntegersSubsetsOf5InEverySeventhOrder) { check_subsets(false, 5, 7); }
TEST(CubeDirections, OfIntegersSubsetsOf6InOneOrderOrMore) { check_subsets(false, 6, 1009); }

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

TEST(Strip, IsCorrect) {
  for (const char* width : {"1e-3", "1e-6", "1e-9", "1e-12", "1e-15", "1e-18"})
    for (const std::size_t n : {10, 100, 2000}) {
      const Nodes nodes = make(std::string("strip:") + width, n);
      EXPECT_TRUE(is_as_promised(nodes)) << width << " " << n;
    }
}

TEST(Strip, AlongTheEquatorIsCorrect) {
  Random random(1);
  for (const double width : {1e-9, 1e-15, 1e-30, 1e-310}) {
    Nodes nodes;
    for (int i = 0; i < 1000; ++i) {
      nodes.push_back(from_degrees(random.uniform(0, 360), 0));
      nodes.back().z = width * random.uniform(-1, 1);
    }
    EXPECT_TRUE(is_as_promised(nodes)) << width;
  }
}

TEST(Hemisphere, OpenIsCorrect) {
  for (const std::size_t n : {3, 4, 10, 1000, 20000}) EXPECT_TRUE(is_as_promised(make("hemisphere", n))) << n;
}

TEST(Hemisphere, WithNodesOnItsRimIsCorrect) {
  for (const std::size_t n : {5, 10, 1000, 20000}) {
    const Nodes nodes = make("hemisphere-rim", n);
    const Mesh m = trmesh(nodes);
    EXPECT_TRUE(is_as_promised(nodes, m)) << n;
    if (n >= 1000) {
      EXPECT_EQ(boundary_nodes(m), n / 2);
    }
  }
}

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

TEST(Cap, IsCorrect) {
  for (const char* family : {"cap", "cap:1e-6", "cap:1e-8"}) {
    const Nodes nodes = make(family, 1000);
    EXPECT_TRUE(is_as_promised(nodes)) << family;
  }
}

TEST(Cap, TwentyThousandIn1e7IsCorrect) { EXPECT_TRUE(is_as_promised(make("cap:1e-7", 20000))); }

TEST(Cap, AroundAnAxisIsCorrect) {  // where one coordinate is 1 for all nodes, or nearly
  Random random(1);
  for (const double radius : {1e-2, 1e-6, 1e-8, 1e-12, 1e-200}) {
    Nodes nodes;
    for (int i = 0; i < 1000; ++i)
      nodes.push_back(normalized({radius * random.uniform(-1, 1), radius * random.uniform(-1, 1), 1}));
    EXPECT_TRUE(is_as_promised(nodes)) << radius;
  }
}

TEST(Box, SortedAndShuffledIsCorrect) {
  Nodes nodes = make("box", 2500);
  EXPECT_TRUE(is_as_promised(nodes));
  point_sets::shuffle(nodes, 1);
  EXPECT_TRUE(is_as_promised(nodes));
}

TEST(AntipodalClusters, AreCorrect) {
  for (const char* radius : {"0.1", "1e-3", "1e-6", "1e-9"})
    for (const std::size_t n : {6, 50, 2000}) {
      const Nodes nodes = make(std::string("antipodal:") + radius, n);
      EXPECT_TRUE(is_as_promised(nodes)) << radius << " " << n;
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

}  // namespace
