// Compares TRLIST, TRLIST2 and the numbers in CRLIST's LISTC with their definitions, implemented here by a
// search of all triangles. For all kinds of numbers, canonical lists and other orders of slots, with and
// without a boundary, rings of 2 to 3000 arcs. LIST, LPTR and LEND lie in read-only memory between
// inaccessible pages.

#include "stripack/triangle_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "base/parallel_for.h"
#include "point_sets.h"
#include "stripack/voronoi.h"
#include "support/guarded.h"
#include "support/plain_lists.h"

using namespace pstripack;

namespace {

PlainLists plain_lists(const std::vector<Point>& points, Slots order) {
  std::vector<double> x, y, z;
  for (const Point& p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  return plain_lists(points.size(), x.data(), y.data(), z.data(), order);
}

/// The results of TRLIST and CRLIST by definition.
struct Expected {
  std::vector<std::array<int, 9>> columns;
  std::vector<int> listc;  ///< by slot; 0 = no triangle on the left
};

Expected by_definition(const PlainLists& lists) {
  std::map<std::pair<int, int>, std::pair<int, int>> left;  // of an arc: triangle and side
  std::map<std::pair<int, int>, std::size_t> slot_of;
  Expected expected;
  const int n = static_cast<int>(lists.lend.size());
  for (int a = 1; a <= n; ++a) {
    std::vector<std::size_t> ring;
    auto slot = static_cast<std::size_t>(lists.lend[static_cast<std::size_t>(a - 1)]);
    const std::size_t last = slot;
    do {
      slot = static_cast<std::size_t>(lists.lptr[slot - 1]);
      ring.push_back(slot);
      slot_of[{a, std::abs(lists.list[slot - 1])}] = slot;
    } while (slot != last);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int b = lists.list[ring[i] - 1];
      const int c = std::abs(lists.list[ring[(i + 1) % ring.size()] - 1]);
      if (b < a || c < a) continue;
      expected.columns.push_back({a, b, c, 0, 0, 0, 0, 0, 0});
      const int t = static_cast<int>(expected.columns.size());
      left[{b, c}] = {t, 0}, left[{c, a}] = {t, 1}, left[{a, b}] = {t, 2};
    }
  }
  int arcs = 0;
  for (std::size_t t = 0; t < expected.columns.size(); ++t)
    for (std::size_t side = 0; side < 3; ++side) {
      auto& column = expected.columns[t];
      const auto beyond = left.find({column[(side + 2) % 3], column[(side + 1) % 3]});
      const int neighbour = beyond == left.end() ? 0 : beyond->second.first;
      column[3 + side] = neighbour;
      if (neighbour > static_cast<int>(t) + 1) continue;
      column[6 + side] = ++arcs;
      if (neighbour > 0)
        expected.columns[static_cast<std::size_t>(neighbour - 1)]
                        [static_cast<std::size_t>(6 + beyond->second.second)] = arcs;
    }
  expected.listc.resize(lists.slots, 0);
  for (const auto& [arc, triangle] : left) expected.listc[slot_of.at(arc) - 1] = triangle.first;
  return expected;
}

template <class Int>
struct Arrays {
  explicit Arrays(const PlainLists& lists)
      : list(converted(lists.list), Edge::end),
        lptr(converted(lists.lptr), Edge::end),
        lend(converted(lists.lend), Edge::end) {
    for (Guarded<Int>* array : {&list, &lptr, &lend}) array->make_read_only();
  }
  static std::vector<Int> converted(const std::vector<std::int32_t>& values) {
    return {values.begin(), values.end()};
  }
  ListsView<Int> view() { return {lend.size(), list.data(), lptr.data(), lend.data(), 0}; }
  Guarded<Int> list, lptr, lend;
};

template <class Int>
void expect_columns(const PlainLists& lists) {
  const Expected expected = by_definition(lists);
  Arrays<Int> arrays(lists);
  for (const int rows : {3, 6, 9}) {
    Guarded<Int> ltri(static_cast<std::size_t>(rows) * expected.columns.size(), Edge::end);
    Int nt = -1;
    ASSERT_EQ(triangle_list(arrays.view(), rows, nt, ltri.data()), TriangleListStatus::done);
    ASSERT_EQ(nt, static_cast<Int>(expected.columns.size()));
    for (std::size_t i = 0; i < ltri.size(); ++i)
      ASSERT_EQ(ltri[i],
                expected.columns[i / static_cast<std::size_t>(rows)][i % static_cast<std::size_t>(rows)])
          << rows << " rows, triangle " << i / static_cast<std::size_t>(rows) + 1;
  }
}

/// CRLIST's arguments and results.
template <class Real, class Int>
struct Diagram {
  Diagram(const PlainLists& lists, const std::vector<Point>& points)
      : lptr(Arrays<Int>::converted(lists.lptr)), lnew(static_cast<Int>(lists.slots) + 1) {
    for (const Point& p : points) {
      x.push_back(static_cast<Real>(p.x));
      y.push_back(static_cast<Real>(p.y));
      z.push_back(static_cast<Real>(p.z));
    }
    for (auto* const of_triangles : {&xc, &yc, &zc, &rc}) of_triangles->resize(2 * points.size() - 4);
    ltri.resize(6 * points.size());
    listc.resize(lptr.size());
  }
  Nodes<Real> nodes() const { return {x.data(), y.data(), z.data()}; }
  VoronoiStatus make(const Int* list, const Int* lend) {
    return voronoi(ListsView<Int>{x.size(), list, lptr.data(), lend, 0}, nodes(),
                   VoronoiArrays<Real, Int>{static_cast<Int>(x.size()), lptr.data(), &lnew, ltri.data(),
                                            listc.data(), &nb, xc.data(), yc.data(), zc.data(), rc.data()});
  }
  std::vector<Real> x, y, z, xc, yc, zc, rc;
  std::vector<Int> lptr, ltri, listc;
  Int lnew, nb = -1;
};

/// The triangles of the set, without those that close the sphere, and their circumcentres.
template <class Real, class Int>
void expect_voronoi(const PlainLists& lists, const std::vector<Point>& points) {
  const Expected expected = by_definition(lists);
  Arrays<Int> arrays(lists);
  Diagram<Real, Int> made(lists, points);
  ASSERT_EQ(made.make(arrays.list.data(), arrays.lend.data()), VoronoiStatus::done);
  const Nodes<Real> nodes = made.nodes();
  const std::size_t n = points.size();
  // Triangles have other numbers than in TRLIST: compared by their corners, with the number as a name.
  const int far = made.nb > 0 ? static_cast<int>(made.nb) - 2 : 0;
  std::map<int, int> number;
  int largest = 0;
  for (std::size_t s = 0; s < lists.slots; ++s)
    if (expected.listc[s] != 0) {
      ASSERT_GT(made.listc[s], far);
      const auto known = number.emplace(expected.listc[s], static_cast<int>(made.listc[s])).first;
      ASSERT_EQ(known->second, static_cast<int>(made.listc[s])) << "slot " << s + 1;
      largest = std::max(largest, static_cast<int>(made.listc[s]));
    }
  ASSERT_EQ(largest, static_cast<int>(2 * n - 4));
  for (int i = 0; i < 6 * far; ++i)
    ASSERT_TRUE(i % 6 < 3 ? made.ltri[i] >= 1 : made.ltri[i] <= far) << "far side";
  for (const auto& [t, name] : number) {
    const auto& column = expected.columns[static_cast<std::size_t>(t - 1)];
    Vector<Real> centre;
    ASSERT_TRUE(circumcentre(nodes[column[0]], nodes[column[1]], nodes[column[2]], centre));
    const auto i = static_cast<std::size_t>(name - 1);
    ASSERT_EQ(made.xc[i], centre.x) << name;
    ASSERT_EQ(made.yc[i], centre.y);
    ASSERT_EQ(made.zc[i], centre.z);
    ASSERT_EQ(made.rc[i], clamped_acos(dot(nodes[column[0]], centre)));
  }
}

std::vector<std::vector<Point>> sets() {
  std::vector<std::vector<Point>> all;
  for (const std::size_t n : {4, 5, 6, 7, 8, 9, 12, 16, 17, 33, 500})
    for (const char* const set : {"random", "cap", "small-circle:1"}) all.push_back(point_sets::make(set, n));
  // The rounded swap tests of the original's CRLIST never end.
  all.push_back({{-0.47685613077941658, 0.11123049037700214, 0.87191513838708845},
                 {-0.83257100181898913, 0.37940748626865584, -0.40357835211198373},
                 {0.062295641749798597, -0.53161973279928965, -0.84468912193622592},
                 {0.41801051278937118, -0.79979672869094331, 0.43080436856284593}});
  all.push_back(point_sets::make("random", 20000));  // several threads, if there are any
  // Two hubs that see all other nodes, first and last in the order of nodes, or in the middle.
  for (const std::size_t between : {15u, 16u, 17u, 20u, 70u, 3000u}) {
    std::vector<Point> nodes;
    point_sets::Random random(2);
    for (std::size_t k = 0; k < between; ++k) {
      const Point p = random.direction();
      nodes.push_back(point_sets::normalized({p.x, p.y, p.z * 1e-3}));
    }
    nodes.insert(nodes.begin() + 5, Point{0, 0, 1});
    nodes.push_back({0, 0, -1});
    all.push_back(nodes);
  }
  return all;
}

}  // namespace

TEST(TriangleList, IsAsDefined) {
  for (const auto& set : sets())
    for (const Slots order : {Slots::canonical, Slots::shuffled}) {
      SCOPED_TRACE(set.size());
      const PlainLists lists = plain_lists(set, order);
      expect_columns<std::int32_t>(lists);
      expect_columns<std::int64_t>(lists);
    }
}

TEST(TriangleList, NumbersTrianglesOfTheVoronoiDiagram) {
  for (const auto& set : sets())
    for (const Slots order : {Slots::canonical, Slots::shuffled}) {
      SCOPED_TRACE(set.size());
      const PlainLists lists = plain_lists(set, order);
      expect_voronoi<float, std::int32_t>(lists, set);
      expect_voronoi<double, std::int32_t>(lists, set);
      expect_voronoi<double, std::int64_t>(lists, set);
    }
}

/// Where the original needs N*N steps, here hours; and the same for any number of threads.
TEST(TriangleList, OfAHubTakesNoLongerAndIsTheSameOnAnyNumberOfThreads) {
  const std::vector<Point> ring = point_sets::make("ring", 50001);
  const PlainLists lists = plain_lists(ring, Slots::canonical);
  Arrays<std::int32_t> arrays(lists);
  std::vector<std::int32_t> first;
  for (const int threads : {1, 3}) {  // libomp 14 leaks where teams of two other sizes follow each other
    const ChosenThreads chosen(threads);
    std::vector<std::int32_t> ltri(9 * 2 * ring.size());
    std::int32_t nt = -1;
    ASSERT_EQ(triangle_list(arrays.view(), 9, nt, ltri.data()), TriangleListStatus::done);
    EXPECT_EQ(static_cast<std::size_t>(nt), ring.size() - 1);
    if (first.empty()) first = ltri;
    EXPECT_EQ(ltri, first) << threads;
  }
  expect_voronoi<double, std::int32_t>(lists, ring);
}

TEST(CellAreas, NameNodesThatAreTooClose) {
  std::vector<Point> set{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  for (const double w : {1e-150, 1e-160, 1e-300}) {
    set.resize(6);
    for (const Point& p : {Point{w, 0, 1}, Point{0, 2 * w, 1}, Point{-2 * w, 0, 1}, Point{0, -2 * w, 1}})
      set.push_back(p);
    const PlainLists lists = plain_lists(set, Slots::canonical);
    Arrays<std::int32_t> arrays(lists);
    const Directions directions(set.data(), set.size());
    std::vector<double> area(set.size());
    if (w == 1e-150) {
      EXPECT_TRUE(cell_areas(arrays.view(), directions, area.data()));
      EXPECT_GT(area[5], 2e-300);
      continue;
    }
    try {
      cell_areas(arrays.view(), directions, area.data());
      ADD_FAILURE() << w;
    } catch (const NodesTooClose& nodes) {
      EXPECT_EQ(nodes.first, 6);
      EXPECT_EQ(nodes.second, 7);
    }
  }
}

/// Also where one cell has nearly all of the sphere, where the corners of some are one point, and where a
/// cell is the difference of two areas that rounding cannot tell from each other.
TEST(CellAreas, AddUpToTheSphere) {
  point_sets::Random random(5);
  const auto along = [&] { return random.uniform(-1, 1); };
  const double high = std::sqrt(0.75);
  std::vector<std::vector<Point>> all{
      {{0, 0, 1}, {0.5, 0, high}, {0, 0.5, high}, {-0.5, 0, high}, {0, -0.5, high}}};
  for (const double size : {1.0, 0.2, 1e-3, 1e-7})
    for (const double width : {1.0, 1e-3, 0.0})
      for (const std::size_t n : {3u, 4u, 5u, 6u, 12u, 48u}) {
        std::vector<Point>& set = all.emplace_back();
        while (set.size() < n) set.push_back({1, size * along(), size * width * along()});
        if (width == 0) set[0] = {0, 0, 1};  // all others lie on one great circle
      }
  for (const std::vector<Point>& set : all) {
    SCOPED_TRACE(testing::Message() << set.size() << " nodes, the second at " << set[1].y << " " << set[1].z);
    Arrays<std::int32_t> arrays(plain_lists(set, Slots::canonical));
    std::vector<double> area(set.size());
    ASSERT_TRUE(cell_areas(arrays.view(), Directions(set.data(), set.size()), area.data()));
    EXPECT_GE(*std::min_element(area.begin(), area.end()), 0);
    EXPECT_NEAR(std::accumulate(area.begin(), area.end(), 0.0), 4 * std::acos(-1.0), 1e-13);
  }
}

namespace {

using Rings = std::vector<std::vector<std::int32_t>>;  ///< as in LIST: negative where no triangle follows

/// True if each triangle in a ring is in the rings of its other two corners, and each node that a smaller one
/// lists also lists that one.
bool agree(const Rings& rings) {
  std::set<std::array<int, 3>> triangles;
  std::set<std::pair<int, int>> arcs;
  const int n = static_cast<int>(rings.size());
  for (int x = 1; x <= n; ++x) {
    const auto& ring = rings[static_cast<std::size_t>(x - 1)];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      arcs.insert({x, std::abs(ring[i])});
      if (ring[i] > 0 && !triangles.insert({x, ring[i], std::abs(ring[(i + 1) % ring.size()])}).second)
        return false;
    }
  }
  for (const auto& [x, y, z] : triangles)
    if (triangles.count({y, z, x}) == 0 || x == y || y == z) return false;
  for (const auto& [x, y] : arcs)
    if (x <= y && (x == y || arcs.count({y, x}) == 0)) return false;
  return triangles.size() <= 3 * (2 * rings.size() - 4);
}

/// Breaks one or two rings, or only begins a ring at another neighbour.
void change(Rings& rings, point_sets::Random& random) {
  const auto any_of = [&](std::size_t n) { return static_cast<std::size_t>(random.below(n)); };
  auto &ring = rings[any_of(rings.size())], &other = rings[any_of(rings.size())];
  auto &entry = ring[any_of(ring.size())], &second = ring[any_of(ring.size())];
  const std::size_t kind = any_of(6);
  if (kind == 0) std::swap(entry, second);
  if (kind == 1) std::swap(entry, other[any_of(other.size())]);
  if (kind == 2) entry = -entry;
  if (kind == 3) std::reverse(ring.begin(), ring.end());
  if (kind == 4) std::rotate(ring.begin(), ring.begin() + 1, ring.end());
  if (kind < 5) return;
  const auto a = std::abs(entry), b = std::abs(second);  // two nodes change their names in all rings
  for (auto& r : rings)
    for (auto& e : r) {
      const auto name = std::abs(e) == a ? b : std::abs(e) == b ? a : std::abs(e);
      e = e < 0 ? -name : name;
    }
}

}  // namespace

TEST(TriangleList, RefusesWrongArgumentsAndListsThatDoNotClose) {
  PlainLists lists = plain_lists(point_sets::make("random", 12), Slots::canonical);
  std::vector<std::int32_t> ltri(9 * 20, 7);
  const auto status_of = [&](std::size_t n, int rows) {
    std::int32_t nt = -1;
    const ListsView<std::int32_t> view{n, lists.list.data(), lists.lptr.data(), lists.lend.data(), 0};
    const TriangleListStatus status = triangle_list(view, rows, nt, ltri.data());
    EXPECT_EQ(nt, 0);
    return status;
  };
  EXPECT_EQ(status_of(2, 6), TriangleListStatus::bad_argument);
  for (const int rows : {0, 2, 7, 12}) EXPECT_EQ(status_of(12, rows), TriangleListStatus::bad_argument);
  for (const int slot : {0, -1, 61, 1}) {
    lists.lptr[static_cast<std::size_t>(lists.lend[6]) - 1] = slot;
    EXPECT_EQ(status_of(12, 6), TriangleListStatus::broken_lists) << slot;
  }
  EXPECT_EQ(ltri, std::vector<std::int32_t>(9 * 20, 7));
}

/// Also for so few small numbers that wrong ones can have the right sum.
TEST(TriangleList, RefusesTheListsWhoseRingsDisagreeAndNoOthers) {
  point_sets::Random random(3);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::size_t n = 4 + random.below(5);
    const std::vector<Point> nodes = point_sets::make(i % 2 == 0 ? "random" : "cap", n);
    const PlainLists whole = plain_lists(nodes, Slots::canonical);
    Rings rings(n);
    for (std::size_t k = 0, slot = 0; k < n; ++k)
      while (slot < static_cast<std::size_t>(whole.lend[k])) rings[k].push_back(whole.list[slot++]);
    for (std::size_t changes = 1 + random.below(3); changes > 0; --changes) change(rings, random);

    PlainLists lists = whole;
    std::size_t slot = 0;
    for (const auto& ring : rings)
      for (const auto entry : ring) lists.list[slot++] = entry;
    const bool right = agree(rings);
    ++(right ? accepted : refused);
    std::vector<std::int32_t> ltri(9 * (2 * n - 4));
    if (!right) {
      ASSERT_NE((Diagram<double, std::int32_t>(lists, nodes).make(lists.list.data(), lists.lend.data())),
                VoronoiStatus::done)
          << i;
    }
    for (const int rows : {3, 6, 9}) {
      std::int32_t nt = -1;
      const auto status = triangle_list(
          ListsView<std::int32_t>{n, lists.list.data(), lists.lptr.data(), lists.lend.data(), 0}, rows, nt,
          ltri.data());
      ASSERT_EQ(status, right ? TriangleListStatus::done : TriangleListStatus::broken_lists) << i;
      if (!right) continue;
      const Expected expected = by_definition(lists);
      for (std::size_t t = 0; t < expected.columns.size(); ++t)
        for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row)
          ASSERT_EQ(ltri[t * static_cast<std::size_t>(rows) + row], expected.columns[t][row]) << i;
    }
  }
  EXPECT_GT(accepted, 1000);
  EXPECT_GT(refused, 1000);
}
