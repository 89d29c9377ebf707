// GETNP compared with a search of all nodes; TRFIND and NEARND by exact signs; on lists in two orders of the
// slots. For all kinds of numbers. The lists, including LEND, and the nodes lie in read-only memory.

#include "stripack/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "point_sets.h"
#include "support/data_file.h"
#include "support/guarded.h"
#include "support/kinds.h"
#include "support/plain_lists.h"
#include "support/reference_predicates.h"

using namespace pstripack;

namespace {

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
    const PlainLists lists = plain_lists(n, x.data(), y.data(), z.data(), slots);
    std::copy(lists.list.begin(), lists.list.end(), list.data());
    std::copy(lists.lptr.begin(), lists.lptr.end(), lptr.data());
    std::copy(lists.lend.begin(), lists.lend.end(), lend.data());
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
        // Nodes at the same distance up to rounding come in the exact order of their directions.
        ASSERT_NEAR(distance, distances[static_cast<std::size_t>(l - 2)],
                    4 * std::numeric_limits<Real>::epsilon())
            << set << ", L = " << l;
        ASSERT_EQ(distance, mesh.distance(17, npts[static_cast<std::size_t>(l - 1)]));
      }
      ASSERT_EQ(std::set<Int>(npts.begin(), npts.end() - 1).size(), mesh.n);
      distance = 5;
      EXPECT_EQ(mesh.next(static_cast<Int>(mesh.n) + 1, npts.data(), distance), NextNearestStatus::none_left);
      EXPECT_EQ(npts.back(), -7);
      EXPECT_EQ(distance, 5);
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

namespace {

/// What TRFIND and NEARND must answer, by exact signs and 100 digits, from the lists and from all nodes.
template <class Kind>
class Judge {
 public:
  using Real = typename Kind::Real;
  using Int = typename Kind::Int;
  using Digits = boost::multiprecision::cpp_bin_float_100;

  explicit Judge(Mesh<Kind>& mesh) : mesh_(mesh) {
    for (std::size_t k = 0; k < mesh.n; ++k) {
      const Int last = mesh.lend[k];
      if (mesh.list[index(last)] > 0) continue;
      next_[static_cast<Int>(k + 1)] = mesh.list[index(mesh.lptr[index(last)])];
    }
  }

  std::string of_trfind(const Vector<Real>& p, const Location<Int>& at) const {
    std::set<Int> rightmost, leftmost;  // ends of the visible part of the boundary
    std::size_t visible = 0;
    for (const auto& [r, l] : next_) {
      const bool seen = sees(p, r, l);
      visible += seen;
      if (seen && !sees(p, l, next_.at(l))) rightmost.insert(l);
      if (!seen && sees(p, l, next_.at(l))) leftmost.insert(l);
    }
    if (visible == 0) {
      if (at.i3 == 0) return "it is not outside";
      const bool inside =
          side(p, at.i1, at.i2) >= 0 && side(p, at.i2, at.i3) >= 0 && side(p, at.i3, at.i1) >= 0;
      return inside ? "" : "another triangle contains it";
    }
    if (at.i3 != 0) return "it is outside";
    if (visible == next_.size()) return at.i1 == at.i2 ? "" : "all of the boundary is visible";
    return rightmost.count(at.i1) == 1 && leftmost.count(at.i2) == 1 ? "" : "other nodes are the ends";
  }

  /// The largest error of the weights of p, of which the sum is 1.
  double error_of_weights(const Vector<Real>& p, const Location<Int>& at, const Real (&b)[3]) const {
    const Int node[3] = {at.i1, at.i2, at.i3};
    Digits right[3], sum = 0, all = 0;
    for (int k = 0; k < 3; ++k) {
      const Vector<Real> v = mesh_.nodes()[node[(k + 1) % 3]], w = mesh_.nodes()[node[(k + 2) % 3]];
      const Digits vx = v.x, vy = v.y, vz = v.z, wx = w.x, wy = w.y, wz = w.z;
      right[k] = (vy * wz - vz * wy) * p.x + (vz * wx - vx * wz) * p.y + (vx * wy - vy * wx) * p.z;
      sum += right[k], all += b[k];
    }
    double worst = all > 0 ? 0 : 1;
    for (int k = 0; k < 3 && all > 0; ++k)
      worst = std::max(worst, std::abs(static_cast<double>(b[k] / all - right[k] / sum)));
    return worst;
  }

  /// The cosines of the distances of all nodes.
  std::vector<Digits> cosines(const Vector<Real>& p) const {
    std::vector<Digits> all;
    for (Int k = 1; k <= static_cast<Int>(mesh_.n); ++k) all.push_back(cosine(p, k));
    return all;
  }
  /// The angle in radians.
  double distance(const Vector<Real>& p, Int node) const {
    return static_cast<double>(acos(cosine(p, node)));
  }

 private:
  static std::size_t index(Int slot) { return static_cast<std::size_t>(slot - 1); }
  int side(const Vector<Real>& p, Int a, Int b) const {
    return ::exact::left(as_point(mesh_.nodes()[a]), as_point(mesh_.nodes()[b]), as_point(p));
  }
  bool sees(const Vector<Real>& p, Int a, Int b) const { return side(p, a, b) < 0; }
  Digits cosine(const Vector<Real>& p, Int k) const {
    const Vector<Real> q = mesh_.nodes()[k];
    const Digits x = q.x, y = q.y, z = q.z, u = p.x, v = p.y, w = p.z;
    return (x * u + y * v + z * w) / sqrt((x * x + y * y + z * z) * (u * u + v * v + w * w));
  }

  Mesh<Kind>& mesh_;
  std::map<Int, Int> next_;  ///< of a boundary node, counterclockwise
};

/// Six nodes far from each other and a cluster of this width.
std::vector<Point> with_cluster(double width, std::size_t count) {
  std::vector<Point> points = point_sets::make("random", 6);
  point_sets::Random random(7);
  for (std::size_t k = 0; k < count; ++k) {
    const double x = width * (random.uniform() - 0.5), y = width * (random.uniform() - 0.5);
    const double l = std::sqrt(1 + x * x + y * y);
    points.push_back({x / l, y / l, 1 / l});
  }
  return points;
}

}  // namespace

/// Places opposite clusters, on nodes, opposite nodes, in the middle of arcs, and anywhere: from every start.
TYPED_TEST(NextNearest, TrfindAndNearndAreExact) {
  using Real = typename TypeParam::Real;
  using Int = typename TypeParam::Int;
  std::vector<std::pair<std::string, std::vector<Point>>> sets;
  for (const double width : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    if (std::is_same_v<Real, float> && width < 1e-6) continue;
    sets.emplace_back("cluster of " + std::to_string(width), with_cluster(width, 9));
    std::vector<Point> alone = with_cluster(width, 15);
    alone.erase(alone.begin(), alone.begin() + 6);
    sets.emplace_back("cluster alone of " + std::to_string(width), alone);
  }
  for (const char* const family : {"random", "latlon", "hemisphere", "cubed-sphere", "ring"})
    sets.emplace_back(family, point_sets::make(family, 26));
  std::vector<Point> long_and_short = point_sets::make("random", 26);
  point_sets::Random lengths(5);
  for (Point& p : long_and_short) {
    const double length = lengths.uniform(0.5, 2);
    p = scaled(length, p);
  }
  sets.emplace_back("long and short", long_and_short);
  sets.emplace_back("three", std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  sets.emplace_back("from a file", nodes_in(TEST_DATA_DIR "/search_opposite_a_cluster.txt"));
  for (std::size_t k = 0; k < 2 * sets.size(); ++k) {
    const auto& [name, points] = sets[k / 2];
    std::vector<Point> unique;
    for (const Point& p : points) {
      const Point rounded{static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)};
      if (std::none_of(unique.begin(), unique.end(),
                       [&](const Point& q) { return ::exact::same_direction(q, rounded); }))
        unique.push_back(rounded);
    }
    if (::exact::left(unique[0], unique[1], unique[2]) == 0) continue;
    Mesh<TypeParam> mesh(unique, k % 2 == 0 ? Slots::canonical : Slots::shuffled);
    mesh.make_read_only();
    const Judge<TypeParam> judge(mesh);
    const auto n = static_cast<Int>(unique.size());
    std::vector<Vector<Real>> places;
    for (Int k = 1; k <= n; ++k) {
      const Vector<Real> a = mesh.nodes()[k], b = mesh.nodes()[k % n + 1];
      const Vector<Real> middle{a.x + b.x, a.y + b.y, a.z + b.z};
      places.insert(places.end(), {a, scaled(-1, a), middle, scaled(-1, middle)});
    }
    for (const Point& p : point_sets::make("random", 10))
      places.push_back({static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)});
    const auto is_unit = [](const Vector<Real>& v) {
      return std::abs(dot(v, v) - 1) < 4 * std::numeric_limits<Real>::epsilon();
    };
    for (const Vector<Real>& p : places) {
      if (p.x == 0 && p.y == 0 && p.z == 0) continue;
      const auto cosines = judge.cosines(p);
      const auto greatest = *std::max_element(cosines.begin(), cosines.end());
      const double distance = static_cast<double>(acos(greatest));
      for (Int start = 1; start <= n; ++start) {
        Real b1, b2, b3, angle = 0;
        const Location<Int> at = trfind(start, p, mesh.lists(), mesh.nodes(), b1, b2, b3);
        const std::string wrong = judge.of_trfind(p, at);
        ASSERT_EQ(wrong, "") << name << ": " << p.x << ' ' << p.y << ' ' << p.z << " from " << start << ": "
                             << at.i1 << ' ' << at.i2 << ' ' << at.i3;
        if (at.i3 != 0 && is_unit(p) && is_unit(mesh.nodes()[at.i1]) && is_unit(mesh.nodes()[at.i2])) {
          ASSERT_LE(judge.error_of_weights(p, at, {b1, b2, b3}), 0x1p-20) << name << " from " << start;
        }
        const Int nearest = nearnd(p, start, mesh.lists(), mesh.nodes(), angle);
        ASSERT_EQ(cosines[static_cast<std::size_t>(nearest - 1)], greatest)
            << name << " from " << start << ": " << nearest;
        // Beyond 0.03 the arc cosine, as the original's: its rounding grows with the inverse of the angle.
        const double rounding = 4 * std::numeric_limits<Real>::epsilon();
        if (is_unit(p) && is_unit(mesh.nodes()[nearest])) {  // as the original asks
          ASSERT_NEAR(angle, distance, rounding * (distance + (distance < 0.03 ? 0 : 1 / std::sin(distance))))
              << name;
        }
      }
    }
  }
}

/// All other nodes of a cluster in the order of their exact distances.
TYPED_TEST(NextNearest, GetnpIsExactInClusters) {
  using Real = typename TypeParam::Real;
  using Int = typename TypeParam::Int;
  if (std::is_same_v<Real, float>) GTEST_SKIP() << "nodes of a narrow cluster coincide";
  for (const double width : {1e-3, 1e-6, 1e-9}) {
    Mesh<TypeParam> mesh(with_cluster(width, 40));
    const Judge<TypeParam> judge(mesh);
    std::vector<Int> npts(mesh.n + 1);
    npts[0] = 20;
    double before = 0;
    for (Int l = 2; l <= 30; ++l) {
      Real distance = 0;
      ASSERT_EQ(mesh.next(l, npts.data(), distance), NextNearestStatus::done);
      const double now = judge.distance(mesh.nodes()[20], npts[static_cast<std::size_t>(l - 1)]);
      ASSERT_GE(now, before) << width << ", L = " << l;
      before = now;
    }
  }
}
