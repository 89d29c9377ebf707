// The routines that change a triangulation, on canonical lists, judged by the validator and not by the
// original. For all kinds of numbers. For invalid lists see edit_broken_lists_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lists/adjacency_lists.h"
#include "point_sets.h"
#include "stripack/node_edit.h"
#include "support/kinds.h"
#include "support/plain_lists.h"

using namespace pstripack;

namespace {

using point_sets::Random;

int below(Random& random, int n) { return static_cast<int>(random.below(static_cast<std::size_t>(n))); }
int any_node(Random& random, std::int64_t n) { return 1 + below(random, static_cast<int>(n)); }

/// A mesh in arrays for `most` nodes.
template <class Real, class Int>
struct Mesh {
  Int n = 0, lnew = 0;
  std::vector<Real> x, y, z;
  std::vector<Int> list, lptr, lend, iwk;

  explicit Mesh(std::size_t most)
      : x(most), y(most), z(most), list(6 * most - 12), lptr(6 * most - 12), lend(most), iwk(2 * most) {}

  /// The canonical triangulation of the nodes.
  Mesh(const std::vector<Point>& nodes, std::size_t most) : Mesh(most) {
    for (const Point& p : nodes) place(++n, p);
    const PlainLists lists = plain_lists(nodes.size(), x.data(), y.data(), z.data());
    std::copy(lists.list.begin(), lists.list.end(), list.begin());
    std::copy(lists.lptr.begin(), lists.lptr.end(), lptr.begin());
    std::copy(lists.lend.begin(), lists.lend.end(), lend.begin());
    lnew = static_cast<Int>(lists.slots + 1);
  }

  void place(Int node, const Point& p) {
    const auto i = static_cast<std::size_t>(node - 1);
    x[i] = static_cast<Real>(p.x), y[i] = static_cast<Real>(p.y), z[i] = static_cast<Real>(p.z);
  }
  Nodes<Real> nodes() const { return {x.data(), y.data(), z.data()}; }
  EditedLists<Int> lists(Int count) { return {count, list.data(), lptr.data(), lend.data(), &lnew}; }
  EditedLists<Int> lists() { return lists(n); }
  EditedLists<Int> unbounded() { return EditedLists<Int>::unbounded(list.data(), lptr.data(), lend.data()); }

  /// ADDNOD of node n+1.
  Int add(const Point& p, Int start = 0) {
    place(n + 1, p);
    const Int ier = addnod(start, nodes(), lists(n + 1));
    if (ier == 0) ++n;
    return ier;
  }
  DelnodStatus remove(Int k) {
    Int lwk = n;
    OptimFailure<Int> failure;
    return delnod(k, n, x.data(), y.data(), z.data(), lists(), lwk, iwk.data(), failure);
  }
  EdgeStatus connect(Int a, Int b) {
    Int lwk = n;
    OptimFailure<Int> failure;
    return edge(a, b, nodes(), lwk, iwk.data(), unbounded(), failure);
  }

  bool operator==(const Mesh& m) const {
    return n == m.n && lnew == m.lnew && x == m.x && y == m.y && z == m.z && list == m.list &&
           lptr == m.lptr && lend == m.lend;
  }

  /// Empty if the lists are well formed and, if requested, a Delaunay triangulation by exact signs.
  std::string fault(bool delaunay) const {
    const std::vector<std::int32_t> a(list.begin(), list.end()), b(lptr.begin(), lptr.end()),
        c(lend.begin(), lend.end());
    std::vector<Point> p;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
      p.push_back({static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])});
    const ListsView<std::int32_t> view{p.size(), a.data(), b.data(), c.data(),
                                       static_cast<std::int32_t>(lnew)};
    return (delaunay ? is_valid(p.data(), view) : check_lists(view)).message;
  }
};

/// Anywhere, or north of latitude 17 degrees.
Point direction(Random& random, bool anywhere) {
  for (;;) {
    const Point p = random.direction();
    if (anywhere || p.z > 0.3) return p;
  }
}
std::vector<Point> directions(Random& random, int n, bool anywhere) {
  std::vector<Point> p;
  while (static_cast<int>(p.size()) < n) p.push_back(direction(random, anywhere));
  return p;
}

template <class K>
class Edit : public testing::Test {};
TYPED_TEST_SUITE(Edit, AllKinds);

template <class K>
using MeshOf = Mesh<typename K::Real, typename K::Int>;

}  // namespace

TYPED_TEST(Edit, ADDNODAndDELNODKeepTheDelaunayTriangulation) {
  int opened = 0, covered = 0;
  for (int set = 0; set < 40; ++set) {
    Random random(static_cast<std::uint64_t>(set));
    const bool anywhere = set % 2 == 0;
    MeshOf<TypeParam> mesh(directions(random, 4 + below(random, 40), anywhere), 120);
    for (int i = 0; i < 50; ++i) {
      const bool was_covered = mesh.lnew == 6 * mesh.n - 11;
      if (mesh.n == 4 || below(random, set % 4 == 0 ? 4 : 2) > 0) {
        ASSERT_EQ(mesh.add(direction(random, anywhere || i % 10 == 0), below(random, 9)), 0);
      } else {
        const DelnodStatus status = mesh.remove(any_node(random, mesh.n));
        ASSERT_TRUE(status == DelnodStatus::done || status == DelnodStatus::not_optimal);
      }
      ASSERT_EQ(mesh.fault(true), "") << "set " << set << ", edit " << i;
      opened += was_covered && mesh.lnew < 6 * mesh.n - 11;
      covered += !was_covered && mesh.lnew == 6 * mesh.n - 11;
    }
  }
  EXPECT_GT(opened, 0);
  EXPECT_GT(covered, 0);
}

TYPED_TEST(Edit, EDGEAndDELARCKeepTheListsWellFormed) {
  for (int set = 0; set < 20; ++set) {
    Random random(static_cast<std::uint64_t>(100 + set));
    MeshOf<TypeParam> mesh(directions(random, 20 + below(random, 40), set % 2 == 0), 80);
    using Int = typename TypeParam::Int;
    for (int i = 0; i < 25; ++i) {
      const Int a = any_node(random, mesh.n), b = any_node(random, mesh.n);
      if (a == b) continue;
      ASSERT_EQ(mesh.connect(a, b), EdgeStatus::done) << a << " " << b;
      ASSERT_EQ(mesh.fault(false), "") << "set " << set << ", EDGE " << a << " " << b;
      EXPECT_TRUE(CheckedEditor<Int>({mesh.lists(), mesh.lnew}).are_neighbours(a, b));
    }
    int removed = 0;
    for (Int a = 1; a <= mesh.n; ++a) {
      const Int before = -mesh.list[static_cast<std::size_t>(mesh.lend[static_cast<std::size_t>(a - 1)] - 1)];
      if (before <= 0 || delarc(a, before, mesh.lists()) != DelarcStatus::done) continue;
      ++removed;
      ASSERT_EQ(mesh.fault(false), "") << "set " << set << ", DELARC " << a << " " << before;
    }
    EXPECT_EQ(removed > 0, set % 2 == 1);
  }
}

TYPED_TEST(Edit, ADDNODFindsEveryCopyAmongManyNodes) {
  for (const char* family : {"random", "hemisphere", "latlon", "icosahedral", "cubed-sphere", "clusters"}) {
    const std::vector<Point> nodes = point_sets::make(family, 3000);
    MeshOf<TypeParam> mesh(nodes, nodes.size() + 1);
    const MeshOf<TypeParam> before = mesh;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      ASSERT_EQ(mesh.add(nodes[i], i % 3 == 0 ? 1 : 0), static_cast<typename TypeParam::Int>(i + 1));
      ASSERT_EQ(mesh.lnew, before.lnew);
    }
    EXPECT_EQ(mesh.list, before.list);
    EXPECT_EQ(mesh.lptr, before.lptr);
    EXPECT_EQ(mesh.lend, before.lend);
  }
}

TYPED_TEST(Edit, RefusedNodes) {
  using Int = typename TypeParam::Int;
  Random random(3);
  MeshOf<TypeParam> mesh(directions(random, 10, true), 11);
  const MeshOf<TypeParam> before = mesh;
  const auto unchanged = [&] {
    return mesh.list == before.list && mesh.lptr == before.lptr && mesh.lnew == before.lnew;
  };
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const Point& p : {Point{nan, 0, 0}, {0, infinity, 0}, {0, 0, -infinity}}) EXPECT_EQ(mesh.add(p), -5);
  EXPECT_EQ(mesh.add({0, 0, 0}), -2);
  EXPECT_EQ(addnod<typename TypeParam::Real>(Int(1), mesh.nodes(), mesh.lists(3)), -1);
  EXPECT_EQ(
      addnod<typename TypeParam::Real>(Int(1), mesh.nodes(), mesh.lists(std::numeric_limits<Int>::max())),
      -4);
  EXPECT_TRUE(unchanged());
  mesh.lnew = 6 * 11;  // does not leave room for another node
  EXPECT_EQ(mesh.add({1, 0, 0}), -13);
  mesh.lnew = before.lnew;
  EXPECT_TRUE(unchanged());
}

TYPED_TEST(Edit, ColumnsAndArcsThatAreNone) {
  using Int = typename TypeParam::Int;
  Random random(4);
  MeshOf<TypeParam> mesh(directions(random, 12, false), 12);
  const auto optim_of = [&](Int a, Int b) {
    Int nit = 3, iwk[2] = {a, b};
    return optim(mesh.nodes(), Int(1), mesh.unbounded(), nit, iwk);
  };
  EXPECT_EQ(optim_of(0, 2), OptimStatus::no_arc);
  EXPECT_EQ(optim_of(2, -1), OptimStatus::no_arc);
  // A boundary arc that one end does not list.
  Int a = 1;
  const auto last = [&](Int k) -> Int& {
    return mesh.list[static_cast<std::size_t>(mesh.lend[static_cast<std::size_t>(k - 1)] - 1)];
  };
  while (last(a) > 0) ++a;
  const Int b = -last(a);  // the boundary runs from b to a
  const Int first_of_b = mesh.lptr[static_cast<std::size_t>(mesh.lend[static_cast<std::size_t>(b - 1)] - 1)];
  mesh.list[static_cast<std::size_t>(first_of_b - 1)] =
      mesh.list[static_cast<std::size_t>(mesh.lptr[static_cast<std::size_t>(first_of_b - 1)] - 1)];
  const DelarcStatus status = delarc(b, a, mesh.lists());
  EXPECT_TRUE(status == DelarcStatus::no_neighbours || status == DelarcStatus::cuts_off)
      << static_cast<int>(status);
}

TYPED_TEST(Edit, ArgumentsOutOfRangeAndTooLittleWorkSpace) {
  using Int = typename TypeParam::Int;
  Random random(5);
  const MeshOf<TypeParam> good(directions(random, 12, false), 12);
  MeshOf<TypeParam> mesh = good;
  for (const auto& [na, most] : {std::pair<Int, Int>(-1, 3), {1, 0}, {1, -7}, {0, 3}}) {
    Int nit = most, iwk[2] = {1, 2};
    EXPECT_EQ(optim(mesh.nodes(), na, mesh.unbounded(), nit, iwk),
              na == 0 ? OptimStatus::done : OptimStatus::bad_argument);
    EXPECT_EQ(nit, 0);
  }
  OptimFailure<Int> failure;
  const auto edge_of = [&](Int a, Int b, Int lwk) {
    return edge(a, b, mesh.nodes(), lwk, mesh.iwk.data(), mesh.unbounded(), failure);
  };
  const auto delnb_of = [&](Int n0, Int nb, Int n) {
    Int slot = 7;
    EXPECT_EQ(delnb(n0, nb, mesh.lists(n), slot), 0);
    return slot;
  };
  for (const auto& [a, b] : {std::pair<Int, Int>(0, 1), {13, 1}, {1, 0}, {1, 13}, {1, 1}}) {
    EXPECT_EQ(delarc(a, b, mesh.lists()), DelarcStatus::bad_argument) << a << " " << b;
    if (a != b) {
      EXPECT_EQ(delnb_of(a, b, 12), no_such_node) << a << " " << b;
    }
    if (a < 13 && b < 13) {  // EDGE is not told N
      EXPECT_EQ(edge_of(a, b, 12), EdgeStatus::bad_argument) << a << " " << b;
    }
  }
  EXPECT_EQ(delarc(Int(1), Int(2), mesh.lists(3)), DelarcStatus::bad_argument);
  EXPECT_EQ(delnb_of(1, 2, 2), no_such_node);
  EXPECT_EQ(edge_of(1, 2, -1), EdgeStatus::bad_argument);
  const auto delnod_of = [&](Int k, Int& lwk) {
    return delnod(k, mesh.n, mesh.x.data(), mesh.y.data(), mesh.z.data(), mesh.lists(), lwk, mesh.iwk.data(),
                  failure);
  };
  for (const auto& [k, work, n] : {std::array<Int, 3>{0, 9, 12}, {13, 9, 12}, {1, -1, 12}, {1, 9, 3}}) {
    Int lwk = work;
    mesh.n = n;
    EXPECT_EQ(delnod_of(k, lwk), DelnodStatus::bad_argument) << k;
    EXPECT_EQ(lwk, work);
  }
  mesh.n = 12;
  EXPECT_TRUE(mesh == good);
  int without_work = 0;
  for (Int k = 1; k <= good.n; ++k) {
    Int lwk = 0;
    const DelnodStatus status = delnod_of(k, lwk);
    ASSERT_EQ(status, lwk > 0 ? DelnodStatus::too_few_columns : DelnodStatus::done) << k;
    if (status == DelnodStatus::done) {
      ++without_work;
    } else {
      ASSERT_TRUE(mesh == good) << k;
      Int one_less = lwk - 1;
      ASSERT_EQ(delnod_of(k, one_less), DelnodStatus::too_few_columns);
      ASSERT_EQ(one_less, lwk);
    }
    mesh = good;
  }
  EXPECT_LT(without_work, 12);

  // An arc that EDGE has made of another, and that one iteration swaps back: a second would have to look.
  int swapped_back = 0;
  for (Int a = 1; a <= good.n; ++a)
    for (Int b = a + 1; b <= good.n; ++b) {
      mesh = good;
      ASSERT_EQ(mesh.connect(a, b), EdgeStatus::done);
      Int nit = 1, iwk[2] = {a, b};
      const OptimStatus status = optim(mesh.nodes(), Int(1), mesh.unbounded(), nit, iwk);
      EXPECT_EQ(status, iwk[0] == a ? OptimStatus::done : OptimStatus::not_all) << a << " " << b;
      EXPECT_EQ(nit, 1);
      swapped_back += status == OptimStatus::not_all;
    }
  EXPECT_GT(swapped_back, 0);
}

/// Triangles that do not cover their hull: an arc may leave them on its way.
TYPED_TEST(Edit, EDGEBetweenDentsAsksWhetherTheArcIsInside) {
  using Int = typename TypeParam::Int;
  Random random(6);
  int done = 0, refused = 0;
  for (int set = 0; set < 20; ++set) {
    MeshOf<TypeParam> dented(directions(random, 12, false), 12);
    for (Int a = 1; a <= dented.n; ++a) {
      const Int b = -dented.list[static_cast<std::size_t>(dented.lend[static_cast<std::size_t>(a - 1)] - 1)];
      if (b > 0) delarc(a, b, dented.lists());
    }
    for (Int a = 1; a <= dented.n; ++a)
      for (Int b = 1; b <= dented.n; ++b) {
        if (a == b) continue;
        MeshOf<TypeParam> mesh = dented;
        const EdgeStatus status = mesh.connect(a, b);
        if (status == EdgeStatus::done) {
          ++done;
          ASSERT_EQ(mesh.fault(false), "") << "set " << set << ": " << a << " " << b;
          continue;
        }
        ++refused;
        ASSERT_TRUE(status == EdgeStatus::not_found || status == EdgeStatus::not_possible)
            << static_cast<int>(status);
        ASSERT_TRUE(mesh == dented) << "set " << set << ": " << a << " " << b;
      }
  }
  EXPECT_GT(done, 0);
  EXPECT_GT(refused, 0);
}
