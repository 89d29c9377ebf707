// GETNP compared with a search of all nodes; TRFIND and NEARND on lists in two orders of the slots. For all
// kinds of numbers. The lists, including LEND, and the nodes lie in read-only memory.

#include "stripack/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <vector>

#include "point_sets.h"
#include "support/guarded.h"
#include "trmesh/trmesh.h"

using namespace pstripack;

namespace {

template <class RealKind, class IntKind>
struct Kinds {
  using Real = RealKind;
  using Int = IntKind;
};

/// The order of the slots: as TRMESH leaves them, or any other, as after edits.
enum class Slots { canonical, shuffled };

template <class Kind>
struct Mesh {
  using Real = typename Kind::Real;
  using Int = typename Kind::Int;

  explicit Mesh(const std::vector<Point>& points, Slots slots = Slots::canonical)
      : n(points.size()),
        x(n, Edge::end),
        y(n, Edge::end),
        z(n, Edge::end),
        list(6 * n - 12, Edge::end),
        lptr(6 * n - 12, Edge::end),
        lend(n, Edge::end) {
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = static_cast<Real>(points[i].x);
      y[i] = static_cast<Real>(points[i].y);
      z[i] = static_cast<Real>(points[i].z);
    }
    std::vector<std::int32_t> a(list.size()), b(list.size()), c(n);
    std::int32_t end = 0;
    EXPECT_EQ(trmesh({static_cast<std::int32_t>(n),
                      {x.data(), y.data(), z.data()},
                      {a.data(), b.data(), c.data(), &end}})
                  .ier,
              0);
    std::vector<std::size_t> place(static_cast<std::size_t>(end - 1));
    std::iota(place.begin(), place.end(), std::size_t{0});
    point_sets::Random random(1);
    if (slots == Slots::shuffled)
      for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[random.below(i)]);
    const auto placed = [&](std::int32_t slot) {
      return static_cast<Int>(place[static_cast<std::size_t>(slot - 1)] + 1);
    };
    for (std::size_t s = 0; s < place.size(); ++s) {
      list[place[s]] = a[s];
      lptr[place[s]] = placed(b[s]);
    }
    for (std::size_t i = 0; i < n; ++i) lend[i] = placed(c[i]);
  }

  void make_read_only() {
    for (Guarded<Real>* array : {&x, &y, &z}) array->make_read_only();
    for (Guarded<Int>* array : {&list, &lptr, &lend}) array->make_read_only();
  }
  NextNearestStatus next(Int l, Int* npts, Real& distance) {
    ListsView<Int> without_count = lists();
    without_count.n = 0;
    return next_nearest(without_count, nodes(), l, npts, distance);
  }
  ListsView<Int> lists() { return {n, list.data(), lptr.data(), lend.data(), 0}; }
  Nodes<Real> nodes() { return {x.data(), y.data(), z.data()}; }
  Real distance(Int a, Int b) { return -dot(nodes()[b], nodes()[a]); }

  std::size_t n;
  Guarded<Real> x, y, z;
  Guarded<Int> list, lptr, lend;
};

template <class Kind>
class NextNearest : public ::testing::Test {};
using AllKinds =
    ::testing::Types<Kinds<float, std::int32_t>, Kinds<double, std::int32_t>, Kinds<double, std::int64_t>>;
TYPED_TEST_SUITE(NextNearest, AllKinds);

}  // namespace

/// L = 2..N: through the table on the stack and the one on the heap.
TYPED_TEST(NextNearest, GivesAllNodesByDistance) {
  using Real = typename TypeParam::Real;
  using Int = typename TypeParam::Int;
  for (const Slots slots : {Slots::canonical, Slots::shuffled})
    for (const char* const set : {"random", "cap"}) {
      Mesh<TypeParam> mesh(point_sets::make(set, 400), slots);
      mesh.make_read_only();
      std::vector<Int> npts(mesh.n + 1, -7);
      npts[0] = 17;
      std::vector<Real> distances;
      for (Int k = 1; k <= static_cast<Int>(mesh.n); ++k)
        if (k != 17) distances.push_back(mesh.distance(17, k));
      std::sort(distances.begin(), distances.end());
      Real distance = 5;
      for (Int l = 2; l <= static_cast<Int>(mesh.n); ++l) {
        ASSERT_EQ(mesh.next(l, npts.data(), distance), NextNearestStatus::done) << set << ", L = " << l;
        ASSERT_EQ(distance, distances[static_cast<std::size_t>(l - 2)]) << set << ", L = " << l;
        ASSERT_EQ(distance, mesh.distance(17, npts[static_cast<std::size_t>(l - 1)]));
      }
      ASSERT_EQ(std::set<Int>(npts.begin(), npts.end() - 1).size(), mesh.n);
      distance = 5;
      EXPECT_EQ(mesh.next(static_cast<Int>(mesh.n) + 1, npts.data(), distance), NextNearestStatus::none_left);
      EXPECT_EQ(npts.back(), -7);
      EXPECT_EQ(distance, 5);
    }
}

/// Any nodes in any order, also equally spaced numbers, which collide in a table indexed by the last bits.
TYPED_TEST(NextNearest, IsTheNearestNeighbourOfAnyGivenNodes) {
  using Real = typename TypeParam::Real;
  using Int = typename TypeParam::Int;
  Mesh<TypeParam> mesh(point_sets::make("random", 5000));
  mesh.make_read_only();
  const auto neighbours = [&](Int node) {
    std::vector<Int> found;
    const Int last = mesh.lend[static_cast<std::size_t>(node - 1)];
    Int slot = last;
    do {
      const Int k = mesh.list[static_cast<std::size_t>(slot - 1)];
      found.push_back(k < 0 ? -k : k);
      slot = mesh.lptr[static_cast<std::size_t>(slot - 1)];
    } while (slot != last);
    return found;
  };
  for (const Int step : {1, 16, 19, 256})
    for (const Int given : {1, 2, 3, 8, 17, 64, 255, 256, 257, 300}) {
      std::vector<Int> npts;
      for (Int i = 0; i < given; ++i) npts.push_back(1 + i * step % 4999);
      if (std::set<Int>(npts.begin(), npts.end()).size() != npts.size()) continue;
      Int nearest = 0;
      Real least = 2;
      for (const Int from : npts)
        for (const Int k : neighbours(from))
          if (std::find(npts.begin(), npts.end(), k) == npts.end() && mesh.distance(npts[0], k) < least) {
            nearest = k;
            least = mesh.distance(npts[0], k);
          }
      npts.push_back(-7);
      Real distance = 5;
      ASSERT_EQ(mesh.next(given + 1, npts.data(), distance), NextNearestStatus::done);
      EXPECT_EQ(npts.back(), nearest) << "step " << step << ", " << given << " given";
      EXPECT_EQ(distance, least);
    }
}

/// A wrong number at any position is refused: all numbers are checked before any is used.
TYPED_TEST(NextNearest, RefusesWrongNodes) {
  using Real = typename TypeParam::Real;
  using Int = typename TypeParam::Int;
  Mesh<TypeParam> mesh(point_sets::make("random", 400));
  for (const Int given : {1, 2, 5, 64, 256, 300})
    for (const Int wrong : {Int{0}, Int{-3}, std::numeric_limits<Int>::min(), Int{1}, given})
      for (const std::size_t at :
           {std::size_t{0}, static_cast<std::size_t>(given / 2), static_cast<std::size_t>(given - 1)}) {
        std::vector<Int> npts(static_cast<std::size_t>(given) + 1, -7);
        std::iota(npts.begin(), npts.end() - 1, Int{1});
        if (npts[at] == wrong) continue;
        npts[at] = wrong;
        if (wrong < 1 && at > 0) npts[0] = std::numeric_limits<Int>::max() / 2;  // far outside of LEND
        const std::vector<Int> before = npts;
        Real distance = 5;
        EXPECT_EQ(mesh.next(given + 1, npts.data(), distance), NextNearestStatus::bad_nodes)
            << wrong << " at " << at << " of " << given;
        EXPECT_EQ(npts, before);
        EXPECT_EQ(distance, 5);
      }
}

/// A list that never returns to its last slot, with consecutive slots or not.
TYPED_TEST(NextNearest, EndsInListsThatLoop) {
  using Real = typename TypeParam::Real;
  using Int = typename TypeParam::Int;
  for (const Slots slots : {Slots::canonical, Slots::shuffled}) {
    Mesh<TypeParam> mesh(point_sets::make("random", 100), slots);
    const auto next = [&](Int slot) -> Int& { return mesh.lptr[static_cast<std::size_t>(slot - 1)]; };
    const Int first = next(mesh.lend[49]), second = next(first);
    for (const Int to : {first, second}) {
      next(second) = to;
      for (const Int given : {1, 2, 30}) {
        std::vector<Int> npts(static_cast<std::size_t>(given) + 1, -7);
        std::iota(npts.begin(), npts.end() - 1, Int{50});
        const std::vector<Int> before = npts;
        Real distance = 5;
        EXPECT_EQ(mesh.next(given + 1, npts.data(), distance), NextNearestStatus::broken_lists);
        EXPECT_EQ(npts, before);
        EXPECT_EQ(distance, 5);
      }
    }
  }
}

/// The answers of TRFIND and NEARND do not depend on the slots that hold the lists, although neighbours in
/// consecutive slots are read together.
TYPED_TEST(NextNearest, SearchesAnswerAlikeInAnySlots) {
  using Real = typename TypeParam::Real;
  using Int = typename TypeParam::Int;
  for (const char* const set :
       {"random", "cap", "cap:0.001", "latlon", "icosahedral", "cubed-sphere", "ring"}) {
    const std::vector<Point> points = point_sets::make(set, 162);
    Mesh<TypeParam> canonical(points), shuffled(points, Slots::shuffled);
    canonical.make_read_only();
    shuffled.make_read_only();
    const auto n = static_cast<Int>(points.size());
    std::vector<Vector<Real>> places;  // nodes, middles of arcs, far sides, and anywhere
    const auto add = [&](const Vector<Real>& p) { places.push_back(p); };
    for (Int k = 1; k <= n; k += 7) {
      const Vector<Real> a = canonical.nodes()[k], b = canonical.nodes()[n + 1 - k];
      add(a);
      add({a.x + b.x, a.y + b.y, a.z + b.z});
      add({-a.x, -a.y, -a.z});
    }
    for (const Point& p : point_sets::make("random", 40))
      add({static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)});
    for (const Vector<Real>& p : places)
      for (Int start = 1; start <= n; start += 5) {
        Real b[2][3] = {}, angle[2] = {};
        Location<Int> at[2] = {};
        Int nearest[2] = {};
        int k = 0;
        for (Mesh<TypeParam>* const mesh : {&canonical, &shuffled}) {
          at[k] = trfind(start, p, mesh->lists(), mesh->nodes(), b[k][0], b[k][1], b[k][2]);
          nearest[k] = nearnd(p, start, mesh->lists(), mesh->nodes(), angle[k]);
          ++k;
        }
        ASSERT_EQ(at[0].i1, at[1].i1) << set << " from " << start;
        ASSERT_EQ(at[0].i2, at[1].i2) << set << " from " << start;
        ASSERT_EQ(at[0].i3, at[1].i3) << set << " from " << start;
        for (int i = 0; i < 3; ++i) ASSERT_EQ(b[0][i], b[1][i]) << set << " from " << start;
        ASSERT_EQ(nearest[0], nearest[1]) << set << " from " << start;
        ASSERT_EQ(angle[0], angle[1]) << set << " from " << start;
      }
  }
}
