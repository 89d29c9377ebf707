// The routines that query and measure; each test is named after its routine. Both sides get the same calls in
// the same order, in processes that have drawn no random numbers, so their random seeds agree.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <thread>

#include "capi/plain_calls.h"
#include "child_process.h"
#include "differential/differential.h"
#include "differential/routines.h"
#include "support/cases.h"

using namespace differential;

namespace {

constexpr double kMark = -77.5;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Vec {
  double v[3];
  double& operator[](int i) { return v[i]; }
  const double* data() const { return v; }
  double* data() { return v; }
};

bool same(const Vec& a, const Vec& b) {
  return same_bits(a.v[0], b.v[0]) && same_bits(a.v[1], b.v[1]) && same_bits(a.v[2], b.v[2]);
}

Vec scaled(const Vec& a, double factor) { return {{factor * a.v[0], factor * a.v[1], factor * a.v[2]}}; }
Vec sum(const Vec& a, const Vec& b) { return {{a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2]}}; }
double dot(const Vec& a, const Vec& b) { return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2]; }
Vec unit(const Vec& a) { return scaled(a, 1 / std::sqrt(dot(a, a))); }

class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double signed_uniform() { return 2 * uniform() - 1; }
  int below(int n) { return static_cast<int>(uniform() * n); }
  Vec direction() {
    for (;;) {
      const Vec a{{signed_uniform(), signed_uniform(), signed_uniform()}};
      if (dot(a, a) > 0.01 && dot(a, a) <= 1) return unit(a);
    }
  }
  /// A vector with components -2..2: exact zeros, coincident vectors, the zero vector.
  Vec lattice() { return {{below(5) - 2.0, below(5) - 2.0, below(5) - 2.0}}; }

 private:
  std::mt19937_64 bits_;
};

/// A triangulation in the original's order.
struct Mesh {
  explicit Mesh(const NodeSet& set) : nodes(set), n(set.n()), lists(triangulated_by_original(set, ier)) {}
  Vec node(int k) const {
    const auto i = static_cast<std::size_t>(k - 1);
    return {{nodes.x[i], nodes.y[i], nodes.z[i]}};
  }
  int neighbour(int slot) const { return std::abs(lists.list[static_cast<std::size_t>(slot - 1)]); }
  int next(int slot) const { return lists.lptr[static_cast<std::size_t>(slot - 1)]; }
  int last_slot(int k) const { return lists.lend[static_cast<std::size_t>(k - 1)]; }
  const double* x() const { return nodes.x.data(); }
  const double* y() const { return nodes.y.data(); }
  const double* z() const { return nodes.z.data(); }
  const int* list() const { return lists.list.data(); }
  const int* lptr() const { return lists.lptr.data(); }
  const int* lend() const { return lists.lend.data(); }

  const NodeSet& nodes;
  int n, ier;
  Lists lists;
};

/// compare_all for the sets that the original triangulates with IER = 0.
Result compare_meshes(const std::function<std::string(const Mesh&, Random&)>& compare, double limit = 0.5) {
  return compare_all(
      node_sets(),
      [&](const NodeSet& set) -> std::string {
        const Mesh mesh(set);
        Random random(static_cast<unsigned>(set.n()));
        return mesh.ier == 0 ? compare(mesh, random) : "";
      },
      limit);
}

/// At most `most` of the numbers 1..n, increasing and evenly spread.
std::vector<int> some_of(int n, int most) {
  std::vector<int> numbers;
  const int count = std::min(n, most);
  for (int i = 0; i < count; ++i)
    numbers.push_back(1 + static_cast<int>(static_cast<long long>(i) * n / count));
  return numbers;
}

// ---- points to look for ----

struct Kind {
  const char* name;
  std::vector<Vec> (*points)(const Mesh&, Random&);
  int most_lost;  ///< sets on which the original hangs
};

std::vector<Vec> random_points(const Mesh&, Random& random) {
  std::vector<Vec> points;
  for (int i = 0; i < 12; ++i) points.push_back(random.direction());
  return points;
}

std::vector<Vec> at_nodes(const Mesh& mesh, Random&) {
  std::vector<Vec> points;
  for (const int k : some_of(mesh.n, 20)) points.push_back(mesh.node(k));
  return points;
}

std::vector<Vec> near_nodes(const Mesh& mesh, Random& random) {
  std::vector<Vec> points;
  for (const int k : some_of(mesh.n, 20))
    points.push_back(sum(mesh.node(k), scaled(random.direction(), 1e-14 * random.uniform())));
  return points;
}

std::vector<Vec> middles(const Mesh& mesh, Random&) {
  std::vector<Vec> points;
  for (const int k : some_of(mesh.n, 12)) {
    int slot = mesh.last_slot(k);
    do {
      const Vec middle = sum(mesh.node(k), mesh.node(mesh.neighbour(slot)));
      if (dot(middle, middle) > 0) points.push_back(unit(middle));
      slot = mesh.next(slot);
    } while (slot != mesh.last_slot(k));
  }
  return points;
}

std::vector<Vec> antipodes(const Mesh& mesh, Random&) {
  std::vector<Vec> points;
  for (const int k : some_of(mesh.n, 20)) points.push_back(scaled(mesh.node(k), -1));
  return points;
}

std::vector<Vec> odd_lengths(const Mesh&, Random& random) {
  std::vector<Vec> points{{{0, 0, 0}}};
  for (int i = 0; i < 12; ++i)
    points.push_back(scaled(random.direction(), std::pow(10, 6 * random.signed_uniform())));
  return points;
}

const Kind kKinds[] = {{"random", random_points, 0},  {"nodes", at_nodes, 0},
                       {"near nodes", near_nodes, 0}, {"middles", middles, 0},
                       {"antipodes", antipodes, 0},   {"odd lengths", odd_lengths, 0}};

std::vector<int> starts(const Mesh& mesh, Random& random) {
  std::vector<int> numbers = some_of(mesh.n, mesh.n <= 12 ? 12 : 4);
  numbers.push_back(1 + random.below(mesh.n));
  numbers.push_back(0);
  numbers.push_back(mesh.n + 1);
  return numbers;
}

template <class Call>
void compare_searches(const Call& differs) {
  for (const Kind& kind : kKinds) {
    SCOPED_TRACE(kind.name);
    const Result result = compare_meshes(
        [&](const Mesh& mesh, Random& random) -> std::string {
          for (const Vec& p : kind.points(mesh, random))
            for (const int start : starts(mesh, random))
              if (const char* what = differs(mesh, p, start)) {
                char text[200];
                std::snprintf(text, sizeof text, "%s from %d to (%.17g, %.17g, %.17g)", what, start, p.v[0],
                              p.v[1], p.v[2]);
                return text;
              }
          return "";
        },
        0.5);
    expect_equal(result, kind.most_lost);
  }
}

}  // namespace

TEST(Differential, TRFIND) {
  compare_searches([](const Mesh& mesh, const Vec& p, int start) -> const char* {
    Vec b{{kMark, kMark, kMark}}, original_b = b;
    int i[3] = {Lists::mark, Lists::mark, Lists::mark}, original_i[3] = {i[0], i[1], i[2]};
    cstrfind_(&start, p.data(), &mesh.n, mesh.x(), mesh.y(), mesh.z(), mesh.list(), mesh.lptr(), mesh.lend(),
              &original_b[0], &original_b[1], &original_b[2], original_i, original_i + 1, original_i + 2);
    trfind_(&start, p.data(), &mesh.n, mesh.x(), mesh.y(), mesh.z(), mesh.list(), mesh.lptr(), mesh.lend(),
            &b[0], &b[1], &b[2], i, i + 1, i + 2);
    if (!std::equal(i, i + 3, original_i)) return "I1, I2, I3";
    return same(b, original_b) ? nullptr : "B1, B2, B3";
  });
}

TEST(Differential, NEARND) {
  compare_searches([](const Mesh& mesh, const Vec& p, int start) -> const char* {
    double al = kMark, original_al = kMark;
    const int theirs = csnearnd_(p.data(), &start, &mesh.n, mesh.x(), mesh.y(), mesh.z(), mesh.list(),
                                 mesh.lptr(), mesh.lend(), &original_al);
    const int ours = nearnd_(p.data(), &start, &mesh.n, mesh.x(), mesh.y(), mesh.z(), mesh.list(),
                             mesh.lptr(), mesh.lend(), &al);
    if (ours != theirs) return "the node";
    return same_bits(al, original_al) ? nullptr : "AL";
  });
}

TEST(Differential, GETNP) {
  const Result result = compare_meshes([](const Mesh& mesh, Random& random) -> std::string {
    std::vector<int> lend = mesh.lists.lend;
    const auto differs = [&](int l, std::vector<int>& npts) {
      std::vector<int> original_npts = npts;
      double df = kMark, original_df = kMark;
      int ier = Lists::mark, original_ier = Lists::mark;
      getnp_(mesh.x(), mesh.y(), mesh.z(), mesh.list(), mesh.lptr(), const_cast<int*>(mesh.lend()), &l,
             npts.data(), &df, &ier);
      csgetnp_(mesh.x(), mesh.y(), mesh.z(), mesh.list(), mesh.lptr(), lend.data(), &l, original_npts.data(),
               &original_df, &original_ier);
      return npts != original_npts || !same_bits(df, original_df) || ier != original_ier ||
             lend != mesh.lists.lend;
    };
    std::vector<int> npts(mesh.nodes.x.size() + 1, Lists::mark);
    npts[0] = 1 + random.below(mesh.n);
    for (const int l : {-1, 0, 1})
      if (differs(l, npts)) return "L = " + std::to_string(l);
    for (int l = 2; l <= mesh.n; ++l)  // in order of distance
      if (differs(l, npts)) return "L = " + std::to_string(l);
    std::shuffle(npts.begin(), npts.end() - 1, std::mt19937(1));
    for (int l = 2; l <= std::min(mesh.n, 20); ++l)  // any other nodes
      if (differs(l, npts)) return "shuffled, L = " + std::to_string(l);
    return "";
  });
  expect_equal(result);
}

namespace {

/// The original's INSIDE uses an uninitialized crossing if the first edge it crosses joins opposite points.
/// With zeros on the stack it is zero, as in ours.
__attribute__((noinline)) void clear_the_stack() {
  volatile char below[4096];
  for (volatile char& byte : below) byte = 0;
}

/// The answer of INSIDE as a number: IER, or 10 if IER is 0 and the value is true.
template <class Inside>
int answer(Inside inside, const Vec& p, const Mesh& mesh, int lv, const std::vector<int>& listv, int nv) {
  int ier = Lists::mark;
  clear_the_stack();
  const bool is_inside = inside(p.data(), &lv, mesh.x(), mesh.y(), mesh.z(), &nv, listv.data(), &ier) != 0;
  return ier == 0 && is_inside ? 10 : ier;
}

/// Polygons of all kinds whose vertices are nodes of the mesh.
std::vector<std::vector<int>> polygons_of(const Mesh& mesh, Random& random) {
  std::vector<std::vector<int>> polygons;
  std::vector<int> boundary(mesh.nodes.x.size());
  int nb, na, nt;
  csbnodes_(&mesh.n, mesh.list(), mesh.lptr(), mesh.lend(), boundary.data(), &nb, &na, &nt);
  boundary.resize(static_cast<std::size_t>(nb));
  if (nb > 0) {
    polygons.push_back(boundary);
    polygons.emplace_back(boundary.rbegin(), boundary.rend());
  }
  std::vector<int> ring;  // the neighbours of a node, counterclockwise
  const int last = mesh.last_slot(1 + random.below(mesh.n));
  int slot = last;
  do {
    ring.push_back(mesh.neighbour(slot));
    slot = mesh.next(slot);
  } while (slot != last);
  if (ring.size() > 2) polygons.push_back(ring);
  for (const int size : {3, 4, 5, 9, 20}) {  // most cross themselves; nodes occur twice
    std::vector<int> any;
    for (int i = 0; i < size; ++i) any.push_back(1 + random.below(mesh.n));
    polygons.push_back(any);
  }
  return polygons;
}

}  // namespace

TEST(Differential, INSIDE) {
  const legacy_stripack::Shared<int> seen(20);  // which answers occurred
  const Result result = compare_meshes([&](const Mesh& mesh, Random& random) -> std::string {
    std::vector<Vec> points{{{0, 0, 0}}};
    for (int i = 0; i < 8; ++i) points.push_back(random.direction());
    for (const int k : some_of(mesh.n, 8)) {
      points.push_back(mesh.node(k));
      points.push_back(scaled(mesh.node(k), -1));
      points.push_back(scaled(sum(mesh.node(k), mesh.node(1 + random.below(mesh.n))), 0.5));
    }
    for (const std::vector<int>& polygon : polygons_of(mesh, random)) {
      const int nv = static_cast<int>(polygon.size());
      for (const Vec& p : points) {
        const int ours = answer(inside_, p, mesh, std::max(mesh.n, nv), polygon, nv);
        const int theirs = answer(csinside_, p, mesh, std::max(mesh.n, nv), polygon, nv);
        if (ours != theirs) return "IER or value " + std::to_string(ours) + " and " + std::to_string(theirs);
        ++seen[static_cast<std::size_t>(ours)];
      }
      std::vector<int> bad = polygon;
      bad[static_cast<std::size_t>(random.below(nv))] = random.below(2) == 0 ? 0 : std::max(mesh.n, nv) + 1;
      for (const Vec& p : points) {
        if (answer(inside_, p, mesh, std::max(mesh.n, nv), bad, nv) != 2) return "IER of a bad vertex";
        if (answer(csinside_, p, mesh, std::max(mesh.n, nv), bad, nv) != 2) return "the original's IER 2";
      }
      for (const auto& [lv, count] : {std::pair{mesh.n, 2}, {mesh.n, -1}, {nv - 1, nv}}) {
        if (answer(inside_, points[1], mesh, lv, polygon, count) != 1) return "IER of a bad NV";
        if (answer(csinside_, points[1], mesh, lv, polygon, count) != 1) return "the original's IER 1";
      }
    }
    return "";
  });
  expect_equal(result);
  for (const std::size_t each : {0, 3, 4, 10}) EXPECT_GT(seen[each], 100) << each;
}

TEST(Differential, INSIDE_opposite_vertices) {
  // An edge between opposite points has no crossing: the previous crossing is used again.
  NodeSet set;
  set.x = {1, 0, 0, 0, -1, 0};
  set.y = {0, 1, 0, -1, 0, 0};
  set.z = {0, 0, 1, 0, 0, -1};
  const Mesh mesh(set);
  Random random(1);
  int opposite = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<int> polygon;
    for (int i = 3 + random.below(6); i > 0; --i) polygon.push_back(1 + random.below(6));
    const int nv = static_cast<int>(polygon.size());
    const Vec p = random.direction();
    ASSERT_EQ(answer(inside_, p, mesh, 9, polygon, nv), answer(csinside_, p, mesh, 9, polygon, nv)) << trial;
    for (std::size_t i = 1; i < polygon.size(); ++i) opposite += polygon[i] + polygon[i - 1] == 7;
  }
  EXPECT_GT(opposite, 1000);
}

TEST(Differential, INTRSC) {
  Random random(1);
  int seen[3] = {};
  for (int trial = 0; trial < 200000; ++trial) {
    const bool lattice = trial % 4 == 0;
    Vec p1 = lattice ? random.lattice() : random.direction(),
        p2 = lattice ? random.lattice() : random.direction(),
        normal = lattice ? random.lattice()
                         : scaled(random.direction(), std::pow(10, 6 * random.signed_uniform()));
    if (trial % 16 == 1) p2 = p1;
    if (trial % 16 == 3) p2 = scaled(p1, -1);
    if (trial % 16 == 5) normal = {{0, 0, 0}};
    if (trial % 16 == 7) p2 = sum(p1, scaled(p2, 1e-9));
    Vec p{{kMark, kMark, kMark}}, original_p = p;
    int ier = Lists::mark, original_ier = Lists::mark;
    intrsc_(p1.data(), p2.data(), normal.data(), p.data(), &ier);
    csintrsc_(p1.data(), p2.data(), normal.data(), original_p.data(), &original_ier);
    ASSERT_EQ(ier, original_ier);
    ASSERT_TRUE(same(p, original_p)) << trial;
    ++seen[ier];
  }
  for (const int count : seen) EXPECT_GT(count, 100);
}

TEST(Differential, JRAND) {
  const auto expect_same = [](int n, int ix, int iy, int iz, int draws) {
    int seeds[3] = {ix, iy, iz}, original_seeds[3] = {ix, iy, iz};
    for (int i = 0; i < draws; ++i) {
      const int ours = jrand_(&n, seeds, seeds + 1, seeds + 2);
      const int theirs = csjrand_(&n, original_seeds, original_seeds + 1, original_seeds + 2);
      ASSERT_EQ(ours, theirs) << "draw " << i << " for N = " << n;
      ASSERT_TRUE(std::equal(seeds, seeds + 3, original_seeds)) << "draw " << i << " for N = " << n;
    }
  };
  expect_same(1000, 1, 2, 3, 1000000);
  expect_same(12345, 30000, 1, 17, 1000000);
  for (const int n : {0, 1, 2, 16777217, 1000000007, -5})
    for (const int seed : {0, 1, 30000, 30322, 1000000, 100000000, -1, -30000, -2000000000})
      expect_same(n, seed, seed / 2 + 1, seed / 3 + 2, 100);
  int n = 4, ix = 1, iy = 2, iz = 3;
  for (int draw = 1; draw < 7997334; ++draw) ASSERT_LE(jrand_(&n, &ix, &iy, &iz), 4);
  EXPECT_EQ(jrand_(&n, &ix, &iy, &iz), 5);  // N+1
}

TEST(Differential, STORE) {
  Random random(1);
  for (const double x : {0.0, -0.0, 1.0 / 3, 5e-324, kInfinity, kNaN, 1e300 * random.uniform()}) {
    EXPECT_TRUE(same_bits(store_(&x), x));
    EXPECT_TRUE(same_bits(csstore_(&x), x));
  }
}

namespace {

/// Three vectors, of each of the kinds that triangle routines treat differently.
void triple(Random& random, int trial, Vec& a, Vec& b, Vec& c) {
  a = random.direction(), b = random.direction(), c = random.direction();
  switch (trial % 10) {
    case 1:
      a = random.lattice(), b = random.lattice(), c = random.lattice();
      break;
    case 2:
      a = unit(sum(random.lattice(), {{0, 0, 2.5}})), b = unit(sum(random.lattice(), {{0, 2.5, 0}}));
      break;
    case 3:
      c = a;
      break;
    case 4:
      c = sum(scaled(a, 0.25), scaled(b, 0.75));
      break;
    case 5:
      b = sum(a, scaled(b, 1e-9));
      break;
    case 6:
      b = sum(a, scaled(b, 1e-9)), c = sum(a, scaled(c, 1e-9));
      break;
    case 7:
      a = scaled(a, 1e-170), b = scaled(b, 1e-170), c = scaled(c, 1e-170);
      break;
    case 8:
      c = scaled(a, -1);
      break;
    case 9:
      a = scaled(a, 1e5 * random.uniform());
      break;
    default:
      break;
  }
}

}  // namespace

TEST(Differential, LEFT) {
  Random random(1);
  int seen[2] = {};
  for (int trial = 0; trial < 200000; ++trial) {
    Vec p[3];
    triple(random, trial, p[0], p[1], p[2]);
    if (trial % 1000 == 0) p[random.below(3)][random.below(3)] = kNaN;
    int order[3] = {0, 1, 2};
    do {
      Vec &a = p[order[0]], &b = p[order[1]], &c = p[order[2]];
      const bool ours = left_(&a[0], &a[1], &a[2], &b[0], &b[1], &b[2], &c[0], &c[1], &c[2]) != 0;
      const bool theirs = csleft_(&a[0], &a[1], &a[2], &b[0], &b[1], &b[2], &c[0], &c[1], &c[2]) != 0;
      ASSERT_EQ(ours, theirs) << trial;
      ++seen[ours];
    } while (std::next_permutation(order, order + 3));
  }
  EXPECT_GT(std::min(seen[0], seen[1]), 100000);
}

TEST(Differential, AREAS) {
  Random random(1);
  int seen[2] = {};
  for (int trial = 0; trial < 200000; ++trial) {
    Vec a, b, c;
    triple(random, trial, a, b, c);
    const double ours = areas_(a.data(), b.data(), c.data()), theirs = csareas_(a.data(), b.data(), c.data());
    ASSERT_TRUE(same_bits(ours, theirs)) << trial;
    ++seen[ours > 0];
  }
  EXPECT_GT(std::min(seen[0], seen[1]), 10000);
}

TEST(Differential, CIRCUM) {
  Random random(1);
  int seen[2] = {};
  for (int trial = 0; trial < 200000; ++trial) {
    Vec a, b, c;
    triple(random, trial, a, b, c);
    Vec centre{{kMark, kMark, kMark}}, original_centre = centre;
    int ier = Lists::mark, original_ier = Lists::mark;
    circum_(a.data(), b.data(), c.data(), centre.data(), &ier);
    cscircum_(a.data(), b.data(), c.data(), original_centre.data(), &original_ier);
    ASSERT_EQ(ier, original_ier) << trial;
    ASSERT_TRUE(same(centre, original_centre)) << trial;
    ++seen[ier];
  }
  EXPECT_GT(std::min(seen[0], seen[1]), 1000);
}

TEST(Differential, LSTPTR) {
  const Result result = compare_meshes([](const Mesh& mesh, Random&) -> std::string {
    for (const int k : some_of(mesh.n, 60))
      for (int other = 0; other <= mesh.n + 1; ++other)
        for (const int wanted : {other, -other}) {
          const int last = mesh.last_slot(k);
          if (lstptr_(&last, &wanted, mesh.list(), mesh.lptr()) !=
              cslstptr_(&last, &wanted, mesh.list(), mesh.lptr()))
            return "neighbour " + std::to_string(wanted) + " of " + std::to_string(k);
        }
    return "";
  });
  expect_equal(result);
}

TEST(Differential, NBCNT) {
  const Result result = compare_meshes([](const Mesh& mesh, Random&) -> std::string {
    for (int slot = 1; slot < mesh.lists.lnew; ++slot)  // from any slot of a list
      if (nbcnt_(&slot, mesh.lptr()) != csnbcnt_(&slot, mesh.lptr())) return "slot " + std::to_string(slot);
    return "";
  });
  expect_equal(result);
}

namespace {

/// Compares TRLIST; returns what differs, or "".
std::string compare_trlist(int n, const Lists& lists, int nrow, int& ier, std::vector<int>& ltri, int& nt) {
  ltri.assign(static_cast<std::size_t>(9 * 2 * std::max(n, 1)), Lists::mark);
  std::vector<int> original_ltri = ltri;
  int original_nt = Lists::mark, original_ier = Lists::mark;
  nt = ier = Lists::mark;
  trlist_(&n, lists.list.data(), lists.lptr.data(), lists.lend.data(), &nrow, &nt, ltri.data(), &ier);
  cstrlist_(&n, lists.list.data(), lists.lptr.data(), lists.lend.data(), &nrow, &original_nt,
            original_ltri.data(), &original_ier);
  if (nt != original_nt || ier != original_ier) return "NT or IER, NROW = " + std::to_string(nrow);
  // If IER = 2, the original stops at the first missing entry; ours may have written further columns.
  return ier == 2 || ltri == original_ltri ? "" : "LTRI, NROW = " + std::to_string(nrow);
}

/// True if LTRI(9,nt) is consistent: rows 4-6 are symmetric, and the number of each arc occurs once if it is
/// a boundary arc, else twice.
bool is_consistent(const std::vector<int>& ltri, int nt) {
  std::vector<int> seen(static_cast<std::size_t>(3 * nt + 1));
  int boundary_arcs = 0;
  const auto row = [&](int i, int t) { return ltri[static_cast<std::size_t>(9 * (t - 1) + i)]; };
  for (int t = 1; t <= nt; ++t)
    for (int i = 0; i < 3; ++i) {
      const int beyond = row(3 + i, t), arc = row(6 + i, t);
      if (beyond < 0 || beyond > nt || arc < 1 || arc > 3 * nt) return false;
      seen[static_cast<std::size_t>(arc)] += beyond == 0 ? 2 : 1;
      boundary_arcs += beyond == 0;
      bool back = beyond == 0;
      for (int j = 0; !back && j < 3; ++j) back = row(3 + j, beyond) == t && row(6 + j, beyond) == arc;
      if (!back) return false;
    }
  const int arcs = (3 * nt + boundary_arcs) / 2;
  return std::all_of(seen.begin() + 1, seen.begin() + 1 + arcs, [](int times) { return times == 2; });
}

}  // namespace

TEST(Differential, TRLIST) {
  const legacy_stripack::Shared<int> seen(4);  // boundaries, forced edges, arcs removed, damaged lists
  const Result result = compare_meshes(
      [&](const Mesh& mesh, Random& random) -> std::string {
        std::vector<int> ltri;
        int nt, ier;
        const auto differs = [&](const Lists& lists, const char* when) -> std::string {
          for (const int nrow : {6, 9}) {
            const std::string what = compare_trlist(mesh.n, lists, nrow, ier, ltri, nt);
            if (!what.empty()) return what + when;
            if (ier != 0) return *when == '\0' ? "IER" : "";  // EDGE did not leave a triangulation
          }
          if (!is_consistent(ltri, nt)) return std::string("LTRI is not consistent") + when;
          std::vector<int> corners(ltri.size(), Lists::mark);
          int nt2;
          pstripack_trlist2_i4(mesh.n, lists.list.data(), lists.lptr.data(), lists.lend.data(), &nt2,
                               corners.data(), &ier);
          for (int t = 0; t < nt; ++t)
            if (!std::equal(&ltri[static_cast<std::size_t>(9 * t)],
                            &ltri[static_cast<std::size_t>(9 * t)] + 3,
                            &corners[static_cast<std::size_t>(3 * t)]))
              return std::string("TRLIST2") + when;
          return nt2 == nt && ier == 0 && corners[static_cast<std::size_t>(3 * nt)] == Lists::mark
                     ? ""
                     : std::string("NT or IER of TRLIST2") + when;
        };
        std::string what = differs(mesh.lists, "");
        if (!what.empty()) return what;
        for (const int nrow : {7, 0, -6}) {
          what = compare_trlist(mesh.n, mesh.lists, nrow, ier, ltri, nt);
          if (!what.empty()) return what;
        }
        for (const int n : {2, -1}) {
          what = compare_trlist(n, mesh.lists, 6, ier, ltri, nt);
          if (!what.empty() || ier != 1) return "N = " + std::to_string(n);
        }

        Lists edited = mesh.lists;  // no longer Delaunay, nor convex
        for (int i = 0; i < 5; ++i) {
          const int in1 = 1 + random.below(mesh.n), in2 = 1 + random.below(mesh.n);
          std::vector<int> iwk(2 * mesh.nodes.x.size());
          int lwk = mesh.n;
          Lists before = edited;
          csedge_(&in1, &in2, mesh.x(), mesh.y(), mesh.z(), &lwk, iwk.data(), edited.list.data(),
                  edited.lptr.data(), edited.lend.data(), &ier);
          if (ier != 0) edited = before;
          if (ier == 0 && lwk > 0) ++seen[1];
        }
        what = differs(edited, " after EDGE");
        if (!what.empty()) return what;
        std::vector<int> boundary(mesh.nodes.x.size());
        int nb, na;
        csbnodes_(&mesh.n, edited.list.data(), edited.lptr.data(), edited.lend.data(), boundary.data(), &nb,
                  &na, &nt);
        if (nb > 0) ++seen[0];
        for (int i = 0; i + 1 < nb; ++i) {
          csdelarc_(&mesh.n, &boundary[static_cast<std::size_t>(i)],
                    &boundary[static_cast<std::size_t>(i) + 1], edited.list.data(), edited.lptr.data(),
                    edited.lend.data(), &edited.lnew, &ier);
          if (ier == 0) ++seen[2];
        }
        what = differs(edited, " after DELARC");
        if (!what.empty()) return what;

        // A neighbour that does not list the node.
        const int last = mesh.last_slot(1);
        for (int stranger = 2; stranger <= mesh.n; ++stranger) {
          if (mesh.neighbour(cslstptr_(&last, &stranger, mesh.list(), mesh.lptr())) == stranger) continue;
          Lists damaged = mesh.lists;
          damaged.list[static_cast<std::size_t>(mesh.next(last) - 1)] = stranger;
          what = compare_trlist(mesh.n, damaged, 6, ier, ltri, nt);
          if (!what.empty() || ier != 2) return "damaged lists: " + what;
          ++seen[3];
          break;
        }
        return "";
      },
      0.1);
  expect_equal(result, 20);  // the original's EDGE can hang
  for (std::size_t each = 0; each < 4; ++each) EXPECT_GT(seen[each], 300) << each;
}

namespace {

struct Voronoi {
  explicit Voronoi(const Mesh& mesh)
      : lptr(mesh.lists.lptr),
        lnew(mesh.lists.lnew),
        ltri(12 * mesh.nodes.x.size(), Lists::mark),
        listc(lptr.size(), Lists::mark),
        real(8 * mesh.nodes.x.size(), kMark) {}
  std::vector<int> lptr;
  int lnew;
  std::vector<int> ltri, listc;
  int nb = Lists::mark, ier = Lists::mark;
  std::vector<double> real;  // XC, YC, ZC, RC
};

/// True if the diagram of n nodes is consistent: LNEW is right, every triangle occurs three times in LISTC,
/// and consecutive triangles around a node share a side.
bool is_consistent(const Voronoi& v, const Mesh& mesh) {
  const int nt = 2 * mesh.n - 4;
  if (v.nb > 0 && v.lnew != 6 * mesh.n - 11) return false;
  std::vector<std::set<int>> cells(static_cast<std::size_t>(nt + 1));  // the nodes that a triangle belongs to
  std::vector<int> times(static_cast<std::size_t>(nt + 1));
  std::vector<std::vector<int>> rings;
  for (int k = 1; k <= mesh.n; ++k) {
    rings.emplace_back();
    const int last = mesh.last_slot(k);
    int slot = last;
    do {
      const int t = v.listc[static_cast<std::size_t>(slot - 1)];
      if (t < 1 || t > nt) return false;
      ++times[static_cast<std::size_t>(t)];
      cells[static_cast<std::size_t>(t)].insert(k);
      rings.back().push_back(t);
      slot = v.lptr[static_cast<std::size_t>(slot - 1)];
    } while (slot != last);
  }
  for (int t = 1; t <= nt; ++t)
    if (times[static_cast<std::size_t>(t)] != 3 || cells[static_cast<std::size_t>(t)].size() != 3)
      return false;
  for (const std::vector<int>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto &a = cells[static_cast<std::size_t>(ring[i])],
                 &b = cells[static_cast<std::size_t>(ring[(i + 1) % ring.size()])];
      std::vector<int> shared;
      std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(shared));
      if (shared.size() < 2) return false;
    }
  return true;
}

}  // namespace

TEST(Differential, CRLIST) {
  const legacy_stripack::Shared<int> seen(5);  // IER; 4: no boundary
  const Result result = compare_meshes([&](const Mesh& mesh, Random&) -> std::string {
    for (const int n : {mesh.n, 2})
      for (const int ncol : {mesh.n, 0, 1}) {
        Voronoi ours(mesh), theirs(mesh);
        const std::size_t stride = 2 * mesh.nodes.x.size();
        double *r = ours.real.data(), *original_r = theirs.real.data();
        second_original().crlist(&n, &ncol, mesh.x(), mesh.y(), mesh.z(), mesh.list(), mesh.lend(),
                                 theirs.lptr.data(), &theirs.lnew, theirs.ltri.data(), theirs.listc.data(),
                                 &theirs.nb, original_r, original_r + stride, original_r + 2 * stride,
                                 original_r + 3 * stride, &theirs.ier);
        crlist_(&n, &ncol, mesh.x(), mesh.y(), mesh.z(), mesh.list(), mesh.lend(), ours.lptr.data(),
                &ours.lnew, ours.ltri.data(), ours.listc.data(), &ours.nb, r, r + stride, r + 2 * stride,
                r + 3 * stride, &ours.ier);
        if (ours.ier != theirs.ier || ours.nb != theirs.nb || ours.lnew != theirs.lnew)
          return "IER, NB or LNEW";
        if (ours.lptr != theirs.lptr) return "LPTR";
        if (ours.ltri != theirs.ltri) return "LTRI";
        ++seen[static_cast<std::size_t>(ours.ier)];
        if (ours.ier == 0 && ours.nb == 0) ++seen[4];
        if (ours.ier == 3) continue;  // the original stops filling arrays here; ours continues
        if (ours.listc != theirs.listc) return "LISTC";
        for (std::size_t i = 0; i < ours.real.size(); ++i)
          if (!same_bits(ours.real[i], theirs.real[i])) return "XC, YC, ZC or RC";
        if (ours.ier == 0 && !is_consistent(ours, mesh)) return "the diagram is not consistent";
      }
    return "";
  });
  expect_equal(result, 60);  // rings: the original's swaps undo each other forever
  for (std::size_t each = 0; each < 5; ++each) EXPECT_GT(seen[each], cases(20)) << each;
}

TEST(Differential, TRANS) {
  Random random(1);
  for (int trial = 0; trial < 100000; ++trial) {
    double rlat[4], rlon[4];
    for (double* angle : {rlat, rlon})
      for (int i = 0; i < 4; ++i) {
        const double special[] = {0.0, -0.0, std::acos(0.0), -std::acos(0.0), std::acos(-1.0), 1e-300, 1e10};
        angle[i] = random.below(4) == 0 ? special[random.below(7)] : 7 * random.signed_uniform();
      }
    for (int n : {4, 0, -1}) {
      double ours[12], theirs[12];
      std::fill(ours, ours + 12, kMark);
      std::fill(theirs, theirs + 12, kMark);
      trans_(&n, rlat, rlon, ours, ours + 4, ours + 8);
      cstransd_(&n, rlat, rlon, theirs, theirs + 4, theirs + 8);
      ASSERT_EQ(std::memcmp(ours, theirs, sizeof ours), 0) << trial;
      for (const bool crossed : {false, true}) {  // X and Y overwrite the angles, in either order
        double lat[4], lon[4], z[4];
        std::copy(rlat, rlat + 4, lat);
        std::copy(rlon, rlon + 4, lon);
        std::fill(z, z + 4, kMark);
        trans_(&n, lat, lon, crossed ? lon : lat, crossed ? lat : lon, z);
        for (int i = 0; i < n; ++i)
          ASSERT_TRUE(same_bits(crossed ? lon[i] : lat[i], theirs[i]) &&
                      same_bits(crossed ? lat[i] : lon[i], theirs[4 + i]) && same_bits(z[i], theirs[8 + i]));
      }
    }
  }
}

TEST(Differential, SCOORD) {
  Random random(1);
  for (int trial = 0; trial < 200000; ++trial) {
    Vec p = trial % 3 == 0 ? random.lattice() : random.direction();
    if (trial % 5 == 0) p = scaled(p, std::pow(10, 170 * random.signed_uniform()));
    if (trial % 7 == 0) p[random.below(3)] = random.below(2) == 0 ? 0.0 : -0.0;
    if (trial % 1001 == 0) p[random.below(3)] = random.below(2) == 0 ? kNaN : kInfinity;
    Vec ours, theirs;
    scoord_(&p[0], &p[1], &p[2], &ours[0], &ours[1], &ours[2]);
    csscoordd_(&p[0], &p[1], &p[2], &theirs[0], &theirs[1], &theirs[2]);
    ASSERT_TRUE(same(ours, theirs)) << p[0] << " " << p[1] << " " << p[2];
  }
}

// Not in libngmath: the sum of AREAS.
TEST(Differential, TRIAREAS) {
  const Result result = compare_meshes([](const Mesh& mesh, Random&) -> std::string {
    std::vector<int> ltri;
    int nt, ier;
    compare_trlist(mesh.n, mesh.lists, 6, ier, ltri, nt);
    std::vector<int> triangles;
    for (int t = 0; t < nt; ++t)
      for (int i = 0; i < 3; ++i) triangles.push_back(ltri[static_cast<std::size_t>(6 * t + i)]);
    std::vector<double> areas(static_cast<std::size_t>(nt) + 1, kMark);
    pstripack_triareas_r8(mesh.n, mesh.x(), mesh.y(), mesh.z(), nt, triangles.data(), areas.data());
    double total = 0;
    for (int t = 0; t < nt; ++t) {
      const auto corner = [&](int i) { return mesh.node(triangles[static_cast<std::size_t>(3 * t + i)]); };
      const Vec a = corner(0), b = corner(1), c = corner(2);
      const double area = areas[static_cast<std::size_t>(t)];
      if (!same_bits(area, csareas_(a.data(), b.data(), c.data()))) return "the area of a triangle";
      total += area;
    }
    if (areas.back() != kMark) return "writes too much";
    return nt < 2 * mesh.n - 4 || mesh.nodes.name.compare(0, 7, "random ") != 0 ||
                   std::abs(total - 4 * std::acos(-1.0)) < 1e-12
               ? ""
               : "the sum is not 4 pi";
  });
  expect_equal(result);
}

namespace {

NodeSet nodes_at(std::initializer_list<Vec> points) {
  NodeSet set;
  for (const Vec& p : points) {
    set.x.push_back(p.v[0]);
    set.y.push_back(p.v[1]);
    set.z.push_back(p.v[2]);
  }
  return set;
}

}  // namespace

// Points for which the original searches forever.
TEST(Differential, TRFIND_ends) {
  const NodeSet sliver = nodes_at({{{0.452695204446832, 0.5590320207484465, 0.6946583704589973}},
                                   {{0.4602557974987226, 0.5683685756099448, 0.6819983600624985}},
                                   {{0.467676192176097, 0.5775319998974023, 0.6691306063588582}}});
  const NodeSet covered = nodes_at({{{-0.41562693777745341, 0.41562693777745346, 0.80901699437494745}},
                                    {{-1.079743991708995e-16, -0.58778525229247314, -0.80901699437494745}},
                                    {{3.5991466390299832e-17, 0.58778525229247314, -0.80901699437494745}},
                                    {{3.5991466390299832e-17, 0.58778525229247314, 0.80901699437494745}}});
  const struct {
    const NodeSet& nodes;
    Vec p;
    int found[3];  // outside, beyond nodes 1 and 3; nowhere, in lists that leave out half of the sphere
  } cases[] = {{sliver, {{0.47495412815485366, 0.5865195023430131, 0.6560590289905072}}, {1, 3, 0}},
               {covered, {{0.67249851196395738, 0.67249851196395727, 0.3090169943749474}}, {0, 0, 0}}};
  for (const auto& [nodes, p, found] : cases) {
    const Mesh mesh(nodes);
    ASSERT_EQ(mesh.ier, 0);
    const int start = 1;
    const auto search = [&, &p = p](auto trfind, int i[3]) {
      Vec b;
      trfind(&start, p.data(), &mesh.n, mesh.x(), mesh.y(), mesh.z(), mesh.list(), mesh.lptr(), mesh.lend(),
             &b[0], &b[1], &b[2], i, i + 1, i + 2);
    };
    int i[3];
    const auto original = legacy_stripack::run_in_child([&] { search(cstrfind_, i); }, 0.3);
    EXPECT_NE(original.outcome, legacy_stripack::Outcome::returned);
    search(trfind_, i);
    EXPECT_TRUE(std::equal(i, i + 3, found)) << i[0] << " " << i[1] << " " << i[2];
  }
}

// Enough draws to distinguish JRAND in single and in double precision: for N = 500 they differ once in 30000.
TEST(Differential, TRFIND_random_starts) {
  const NodeSet* largest = &node_sets()[0];  // the largest set that covers the sphere
  for (const NodeSet& set : node_sets())
    if (set.name.compare(0, 7, "random ") == 0 && set.n() > largest->n()) largest = &set;
  const Result result = compare_all(
      {*largest},
      [](const NodeSet& set) -> std::string {
        const Mesh mesh(set);
        Random random(1);
        const int start = 0;
        for (int k = 0; k < 300000; ++k) {
          const Vec p = random.direction();
          Vec b;
          int i[3], original_i[3];
          trfind_(&start, p.data(), &mesh.n, mesh.x(), mesh.y(), mesh.z(), mesh.list(), mesh.lptr(),
                  mesh.lend(), &b[0], &b[1], &b[2], i, i + 1, i + 2);
          cstrfind_(&start, p.data(), &mesh.n, mesh.x(), mesh.y(), mesh.z(), mesh.list(), mesh.lptr(),
                    mesh.lend(), &b[0], &b[1], &b[2], original_i, original_i + 1, original_i + 2);
          if (!std::equal(i, i + 3, original_i)) return "search " + std::to_string(k);
        }
        return "";
      },
      60);
  expect_equal(result);
}

TEST(Differential, TRFIND_on_threads) {
  const NodeSet& set = node_sets()[0];
  const Mesh mesh(set);
  ASSERT_EQ(mesh.ier, 0);
  const auto random_starts = [&mesh] {
    std::vector<int> found;
    const int start = 0;
    const Vec p = mesh.node(1);
    for (int k = 0; k < 2000; ++k) {
      int i[3];
      Vec b;
      trfind_(&start, p.data(), &mesh.n, mesh.x(), mesh.y(), mesh.z(), mesh.list(), mesh.lptr(), mesh.lend(),
              &b[0], &b[1], &b[2], i, i + 1, i + 2);
      found.insert(found.end(), i, i + 3);
    }
    return found;
  };
  std::vector<int> at_once[2], later;
  std::thread one([&] { at_once[0] = random_starts(); }), two([&] { at_once[1] = random_starts(); });
  one.join();
  two.join();
  std::thread([&] { later = random_starts(); }).join();
  EXPECT_EQ(at_once[0], later);  // each thread has its own seeds
  EXPECT_EQ(at_once[1], later);
  EXPECT_NE(std::vector<int>(later.begin(), later.begin() + 3000),
            std::vector<int>(later.begin() + 3000, later.end()));
}

TEST(Differential, BNODES) {
  const Result result = compare_all(node_sets(), [](const NodeSet& nodes) -> std::string {
    int ier;
    const Lists lists = triangulated_by_original(nodes, ier);
    if (ier != 0) return "";
    const int n = nodes.n();
    std::vector<int> ours(nodes.x.size(), Lists::mark), theirs = ours;
    int counts[3], original_counts[3];
    bnodes_(&n, lists.list.data(), lists.lptr.data(), lists.lend.data(), ours.data(), counts, counts + 1,
            counts + 2);
    csbnodes_(&n, lists.list.data(), lists.lptr.data(), lists.lend.data(), theirs.data(), original_counts,
              original_counts + 1, original_counts + 2);
    if (ours != theirs) return "NODES";
    for (int i = 0; i < 3; ++i)
      if (counts[i] != original_counts[i]) return "NB, NA or NT";
    return "";
  });
  expect_equal(result, 60);
}
