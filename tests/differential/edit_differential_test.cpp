// The routines that change a triangulation. Tests are named after the routine that is compared.

#include <gtest/gtest.h>
#include <setjmp.h>
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "child_process.h"
#include "differential/differential.h"
#include "differential/routines.h"
#include "support/cases.h"

using namespace differential;

namespace {

/// The routines of one side.
struct Routines {
  decltype(&addnod_) addnod;
  decltype(&bdyadd_) bdyadd;
  decltype(&covsph_) covsph;
  decltype(&delarc_) delarc;
  decltype(&delnb_) delnb;
  decltype(&delnod_) delnod;
  decltype(&edge_) edge;
  decltype(&insert_) insert;
  decltype(&intadd_) intadd;
  decltype(&optim_) optim;
  decltype(&swap_) swap;
};
constexpr Routines ours{addnod_, bdyadd_, covsph_, delarc_, delnb_, delnod_,
                        edge_,   insert_, intadd_, optim_,  swap_};
constexpr Routines original{csaddnod_, csbdyadd_, cscovsph_, csdelarc_, csdelnb_, csdelnod_,
                            csedge_,   csinsert_, csintadd_, csoptim_,  csswap_};

/// All that a call can change: nodes, lists, IWK, scalar results.
struct Mesh {
  int n;
  std::vector<double> x, y, z;
  Lists lists;
  std::vector<int> iwk, results;

  Mesh(const NodeSet& nodes, const Lists& triangulation)
      : n(nodes.n()),
        x(nodes.x),
        y(nodes.y),
        z(nodes.z),
        lists(triangulation),
        iwk(2 * lists.lend.size(), Lists::mark) {
    for (auto* c : {&x, &y, &z}) c->resize(lists.lend.size(), 77);
  }
  bool operator==(const Mesh& m) const {
    return n == m.n && x == m.x && y == m.y && z == m.z && lists == m.lists && iwk == m.iwk &&
           results == m.results;
  }
  int* list() { return lists.list.data(); }
  int* lptr() { return lists.lptr.data(); }
  int* lend() { return lists.lend.data(); }
  int entry(int slot) const { return lists.list[static_cast<std::size_t>(slot - 1)]; }
  int next(int slot) const { return lists.lptr[static_cast<std::size_t>(slot - 1)]; }
  int last(int node) const { return lists.lend[static_cast<std::size_t>(node - 1)]; }
  bool on_boundary(int node) const { return entry(last(node)) < 0; }
  bool same_place(int a, int b) const {
    const auto i = static_cast<std::size_t>(a - 1), j = static_cast<std::size_t>(b - 1);
    return x[i] == x[j] && y[i] == y[j] && z[i] == z[j];
  }
  /// The neighbours of a node, from the first to the last, without signs.
  std::vector<int> neighbours(int node) const {
    std::vector<int> result;
    int slot = last(node);
    do result.push_back(std::abs(entry(slot = next(slot))));
    while (slot != last(node));
    return result;
  }
  /// True if each slot in use is in one list, all neighbours list each other, and the boundary is closed.
  /// Edits that fail may leave lists for which this is false.
  bool is_linked() const {
    std::vector<int> times(static_cast<std::size_t>(lists.lnew), 0);
    for (int slot = 1; slot < lists.lnew; ++slot) {
      if (next(slot) < 1 || next(slot) >= lists.lnew) return false;
      if (++times[static_cast<std::size_t>(next(slot))] > 1) return false;
    }
    for (int a = 1; a <= n; ++a)
      for (int b : neighbours(a)) {
        const std::vector<int> ring = neighbours(b);
        if (std::count(ring.begin(), ring.end(), a) != 1) return false;
        if (entry(last(a)) == -b && (!on_boundary(b) || ring.front() != a)) return false;
      }
    return true;
  }
  /// True if, in addition, all triangles are closed and their number satisfies Euler's formula.
  bool is_triangulation() const {
    if (!is_linked()) return false;
    int arcs = 0, corners = 0, boundary = 0;
    for (int a = 1; a <= n; ++a) {
      const std::vector<int> ring = neighbours(a);
      arcs += static_cast<int>(ring.size());
      boundary += on_boundary(a);
      for (std::size_t i = on_boundary(a) ? 1 : 0; i < ring.size(); ++i, ++corners)
        if (opposite(ring[i == 0 ? ring.size() - 1 : i - 1], ring[i])[0] != a) return false;
    }
    return n - arcs / 2 + corners / 3 == (boundary > 0 ? 1 : 2);
  }
  /// The corners left and right of the arc a-b: a,b,left and b,a,right are triangles. 0: none.
  std::array<int, 2> opposite(int a, int b) const {
    const std::vector<int> ring = neighbours(a);
    const auto i = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), b) - ring.begin());
    const std::size_t m = ring.size();
    return {on_boundary(a) && i + 1 == m ? 0 : ring[(i + 1) % m],
            on_boundary(a) && i == 0 ? 0 : ring[(i + m - 1) % m]};
  }
  bool left(int a, int b, int c) const {
    const auto i = static_cast<std::size_t>(a - 1), j = static_cast<std::size_t>(b - 1),
               k = static_cast<std::size_t>(c - 1);
    return csleft_(&x[i], &y[i], &z[i], &x[j], &y[j], &z[j], &x[k], &y[k], &z[k]) != 0;
  }
};

using Calls = std::function<void(const Routines&, Mesh&)>;

/// Codes that occurred in a test, in all its children.
class Codes {
 public:
  void note(int code) { ++count_[static_cast<std::size_t>(std::clamp(code, -20, 20) + 20)]; }
  int count(int code) const { return count_[static_cast<std::size_t>(code + 20)]; }
  void expect(std::initializer_list<int> codes) const {
    for (int code : codes) EXPECT_GT(count(code), 0) << "code " << code;
    std::printf("codes:");
    for (int i = 0; i <= 40; ++i)
      if (count_[static_cast<std::size_t>(i)] > 0)
        std::printf("  %d: %d", i - 20, count_[static_cast<std::size_t>(i)]);
    std::printf("\n");
  }

 private:
  legacy_stripack::Shared<int> count_{41};
};

sigjmp_buf out_of_call;
volatile sig_atomic_t ticks_left = 0;  // 0 outside calls
void tick(int) {
  if (ticks_left > 0 && --ticks_left == 0) siglongjmp(out_of_call, 1);
}

/// In a child: discards the messages of both sides, and starts to tick every 2 ms of processor time, a
/// thousand times that of a call of EDGE.
bool prepare_child() {
  for (FILE* stream : {stdout, stderr})
    if (std::freopen("/dev/null", "w", stream) == nullptr) return false;
  struct sigaction action = {};
  action.sa_handler = tick;
  action.sa_flags = SA_NODEFER;  // the next tick must arrive although tick() has not returned
  sigaction(SIGVTALRM, &action, nullptr);
  const itimerval period{{0, 2000}, {0, 2000}};
  return setitimer(ITIMER_VIRTUAL, &period, nullptr) == 0;
}

/// Makes calls that may not return. False if they do not return within this number of ticks.
bool returns(const Calls& calls, const Routines& routines, Mesh& mesh, int ticks = 2) {
  if (sigsetjmp(out_of_call, 0) != 0) return false;
  ticks_left = ticks;
  calls(routines, mesh);
  ticks_left = 0;
  return true;
}

std::string difference(const Mesh& a, const Mesh& b) {
  if (a == b) return "";
  std::string what;
  if (a.results != b.results) {
    what += " results";
    for (int r : a.results) what += " " + std::to_string(r);
    what += " instead of";
    for (int r : b.results) what += " " + std::to_string(r);
  }
  if (a.n != b.n) what += " N";
  if (a.x != b.x || a.y != b.y || a.z != b.z) what += " X, Y, Z";
  if (a.lists.lnew != b.lists.lnew) what += " LNEW";
  if (a.lists.list != b.lists.list) what += " LIST";
  if (a.lists.lptr != b.lists.lptr) what += " LPTR";
  if (a.lists.lend != b.lists.lend) what += " LEND";
  if (a.iwk != b.iwk) what += " IWK";
  return what;
}

/// Makes the same calls on both sides from the state `mesh`, which becomes the state after the calls. Returns
/// what differs, or "".
std::string compare(Mesh& mesh, const Calls& calls) {
  Mesh theirs = mesh;
  mesh.results.clear();
  theirs.results.clear();
  calls(ours, mesh);
  calls(original, theirs);
  return difference(mesh, theirs);
}

class Dice {
 public:
  explicit Dice(const NodeSet& nodes) {
    std::seed_seq seed(nodes.name.begin(), nodes.name.end());
    bits_.seed(seed);
  }
  int below(int n) { return static_cast<int>(bits_() % static_cast<unsigned>(n)); }
  int node(const Mesh& mesh) { return 1 + below(mesh.n); }
  double uniform() { return bits_() * 0x1p-32; }

 private:
  std::mt19937 bits_;
};

std::vector<NodeSet> sets_up_to(int n) {
  std::vector<NodeSet> sets;
  for (const NodeSet& nodes : node_sets())
    if (nodes.n() <= n) sets.push_back(nodes);
  return sets;
}

/// Calls test(mesh, dice) for the original's triangulation of each set in a child process.
Result compare_meshes(const std::vector<NodeSet>& sets, const std::function<std::string(Mesh&, Dice&)>& test,
                      double limit = 0.5) {
  return compare_all(
      sets,
      [&](const NodeSet& nodes) -> std::string {
        static const bool prepared = prepare_child();  // once in each child
        if (!prepared) return "no /dev/null or no timer";
        int ier;
        const Lists lists = triangulated_by_original(nodes, ier);
        if (ier != 0) return "";
        Mesh mesh(nodes, lists);
        Dice dice(nodes);
        return test(mesh, dice);
      },
      limit);
}

/// Nodes from integers, each divided by its rounded length.
NodeSet lattice(const std::string& name, std::initializer_list<std::array<int, 3>> directions) {
  NodeSet set;
  set.name = name;
  for (const auto& d : directions) {
    const double length = std::sqrt(static_cast<double>(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
    set.x.push_back(d[0] / length);
    set.y.push_back(d[1] / length);
    set.z.push_back(d[2] / length);
  }
  return set;
}

}  // namespace

#define COMPARE(mesh, what, calls) \
  if (std::string d = compare(mesh, calls); !d.empty()) return std::string(what) + d

// ---- nodes added by hand ----

namespace {

/// Replaces the triangulation by that of the first three nodes.
void keep_three(Mesh& mesh) {
  NodeSet three;
  three.x.assign(mesh.x.begin(), mesh.x.begin() + 3);
  three.y.assign(mesh.y.begin(), mesh.y.begin() + 3);
  three.z.assign(mesh.z.begin(), mesh.z.begin() + 3);
  int ier;
  const Lists lists = triangulated_by_original(three, ier);
  mesh.lists = Lists(static_cast<int>(mesh.x.size()));
  std::copy(lists.list.begin(), lists.list.begin() + 6, mesh.lists.list.begin());
  std::copy(lists.lptr.begin(), lists.lptr.begin() + 6, mesh.lists.lptr.begin());
  std::copy(lists.lend.begin(), lists.lend.begin() + 3, mesh.lists.lend.begin());
  mesh.lists.lnew = lists.lnew;
  mesh.n = 3;
}

/// Builds each set node by node; add(mesh, k, i1, i2, i3) compares a routine at the place where the search
/// found k.
using Add = std::function<std::string(const Mesh& mesh, int k, int i1, int i2, int i3)>;
Result compare_insertions(const Add& add) {
  return compare_meshes(sets_up_to(120), [&](Mesh& mesh, Dice&) -> std::string {
    const int n = mesh.n, start = 0;
    keep_three(mesh);
    const double* const c[3] = {mesh.x.data(), mesh.y.data(), mesh.z.data()};
    for (int k = 4; k <= n; ++k) {
      const double p[3] = {c[0][k - 1], c[1][k - 1], c[2][k - 1]};
      double b[3];
      int i[3], ier;
      cstrfind_(&start, p, &mesh.n, c[0], c[1], c[2], mesh.list(), mesh.lptr(), mesh.lend(), b, b + 1, b + 2,
                i, i + 1, i + 2);
      if (i[0] == 0) return "";
      if (const std::string d = add(mesh, k, i[0], i[1], i[2]); !d.empty())
        return "node " + std::to_string(k) + ": " + d;
      csaddnod_(&start, &k, c[0], c[1], c[2], mesh.list(), mesh.lptr(), mesh.lend(), &mesh.lists.lnew, &ier);
      if (ier != 0) return "";
      mesh.n = k;
    }
    return "";
  });
}

/// INTADD, BDYADD or COVSPH, wherever `is_case(i1, i2, i3)` holds.
template <class IsCase, class Call>
void expect_equal_insertions(const IsCase& is_case, const Call& call) {
  Codes calls;
  expect_equal(compare_insertions([&](Mesh mesh, int k, int i1, int i2, int i3) {
    if (!is_case(i1, i2, i3)) return std::string();
    calls.note(1);
    return compare(mesh, [&](const Routines& r, Mesh& m) { call(r, m, k, i1, i2, i3); });
  }));
  calls.expect({1});
}

}  // namespace

TEST(Differential, INTADD) {
  expect_equal_insertions([](int, int, int i3) { return i3 != 0; },
                          [](const Routines& r, Mesh& m, int k, int i1, int i2, int i3) {
                            r.intadd(&k, &i1, &i2, &i3, m.list(), m.lptr(), m.lend(), &m.lists.lnew);
                          });
}

TEST(Differential, BDYADD) {
  expect_equal_insertions([](int i1, int i2, int i3) { return i3 == 0 && i1 != i2; },
                          [](const Routines& r, Mesh& m, int k, int i1, int i2, int) {
                            r.bdyadd(&k, &i1, &i2, m.list(), m.lptr(), m.lend(), &m.lists.lnew);
                          });
}

TEST(Differential, COVSPH) {
  expect_equal_insertions([](int i1, int i2, int i3) { return i3 == 0 && i1 == i2; },
                          [](const Routines& r, Mesh& m, int k, int i1, int, int) {
                            r.covsph(&k, &i1, m.list(), m.lptr(), m.lend(), &m.lists.lnew);
                          });
}

TEST(Differential, INSERT) {
  const auto test = [](Mesh& mesh, Dice& dice) -> std::string {
    for (int i = 0; i < 20; ++i) {
      const int k = dice.node(mesh) * (dice.below(4) == 0 ? -1 : 1), lp = 1 + dice.below(mesh.lists.lnew - 1);
      COMPARE(mesh, "INSERT",
              ([&](const Routines& r, Mesh& m) { r.insert(&k, &lp, m.list(), m.lptr(), &m.lists.lnew); }));
    }
    return "";
  };
  expect_equal(compare_meshes(node_sets(), test));
}

// ---- arcs ----

TEST(Differential, SWPTST) {
  const auto test = [](Mesh& mesh, Dice& dice) -> std::string {
    for (int i = 0; i < 300; ++i) {
      int c[4] = {dice.node(mesh), dice.node(mesh), dice.node(mesh), dice.node(mesh)};
      do {
        const bool a = swptst_(c, c + 1, c + 2, c + 3, mesh.x.data(), mesh.y.data(), mesh.z.data()) != 0;
        const bool b = csswptst_(c, c + 1, c + 2, c + 3, mesh.x.data(), mesh.y.data(), mesh.z.data()) != 0;
        if (a != b) return "SWPTST";
      } while (std::next_permutation(c, c + 4));
    }
    return "";
  };
  expect_equal(compare_meshes(node_sets(), test));
}

TEST(Differential, SWAP) {
  Codes codes;
  const auto test = [&](Mesh& mesh, Dice& dice) -> std::string {
    const auto swap = [&](int in1, int in2, int io1, int io2) {
      return compare(mesh, [&](const Routines& r, Mesh& m) {
        m.results = {Lists::mark};
        r.swap(&in1, &in2, &io1, &io2, m.list(), m.lptr(), m.lend(), m.results.data());
      });
    };
    // Each interior arc is swapped and, in most cases, swapped back.
    for (int a = 1; a <= mesh.n; ++a)
      for (int b : mesh.neighbours(a)) {
        const std::vector<int> ring = mesh.neighbours(a);
        if (a > b || std::find(ring.begin(), ring.end(), b) == ring.end()) continue;
        const auto [l, r] = mesh.opposite(a, b);
        if (l == 0 || r == 0) continue;
        if (const std::string d = swap(l, r, a, b); !d.empty()) return "SWAP:" + d;
        codes.note(mesh.results[0] > 0);
        if (mesh.results[0] == 0 || dice.below(10) == 0) continue;
        if (const std::string d = swap(b, a, l, r); !d.empty()) return "SWAP back:" + d;
      }
    return "";
  };
  expect_equal(compare_meshes(node_sets(), test));
  codes.expect({0, 1});
}

namespace {

/// OPTIM on na columns; nit as given.
std::string compare_optim(Mesh& mesh, int na, int nit) {
  return compare(mesh, [&](const Routines& r, Mesh& m) {
    m.results = {nit, Lists::mark};
    r.optim(m.x.data(), m.y.data(), m.z.data(), &na, m.list(), m.lptr(), m.lend(), m.results.data(),
            m.iwk.data(), m.results.data() + 1);
  });
}

/// Swaps an arc for the other diagonal of its quadrilateral on both sides. If convex_only, the quadrilateral
/// must be convex. Returns the new arc, or {0,0}.
std::array<int, 2> exchange(Mesh& mesh, int a, int b, bool convex_only) {
  auto [l, r] = mesh.opposite(a, b);
  if (l == 0 || r == 0) return {0, 0};
  if (convex_only && !(mesh.left(r, l, a) == false && mesh.left(l, r, b) == false)) return {0, 0};
  int slot;
  csswap_(&l, &r, &a, &b, mesh.list(), mesh.lptr(), mesh.lend(), &slot);
  return slot == 0 ? std::array<int, 2>{0, 0} : std::array<int, 2>{l, r};
}

}  // namespace

TEST(Differential, OPTIM) {
  Codes codes;
  const auto test = [&](Mesh& mesh, Dice& dice) -> std::string {
    const auto optim = [&](int na, int nit) {
      const std::string d = compare_optim(mesh, na, nit);
      codes.note(mesh.results[1]);
      return d.empty() ? d : "OPTIM:" + d;
    };
    for (const auto& [na, nit] : {std::array<int, 2>{0, 5}, {-1, 5}, {1, 0}, {0, 0}, {-1, -1}})
      if (const std::string d = optim(na, nit); !d.empty()) return d;
    for (int times = 0; times < 12; ++times) {
      // Arcs that were swapped at random, others that were not, and sometimes columns that are not arcs.
      const Mesh before = mesh;
      int na = 0;
      const int most = 1 + dice.below(std::min(mesh.n, 40));
      for (int i = 0; i < most; ++i) {
        const int a = dice.node(mesh);
        const std::vector<int> ring = mesh.neighbours(a);
        int b = ring[static_cast<std::size_t>(dice.below(static_cast<int>(ring.size())))];
        std::array<int, 2> arc{a, b};
        if (dice.below(3) > 0) {
          const auto made = exchange(mesh, a, b, times % 3 != 0);
          if (made[0] != 0) arc = made;
        } else if (times % 4 == 3 && dice.below(6) == 0) {
          arc[1] = dice.node(mesh);
        }
        mesh.iwk[static_cast<std::size_t>(2 * na)] = arc[0];
        mesh.iwk[static_cast<std::size_t>(2 * na + 1)] = arc[1];
        ++na;
      }
      if (const std::string d = optim(na, times % 2 == 0 ? 4 * na : 1); !d.empty()) return d;
      if (times % 2 == 1) mesh = before;
    }
    return "";
  };
  expect_equal(compare_meshes(node_sets(), test));
  codes.expect({0, 1, 2, 3, 4});
}

TEST(Differential, DELNB) {
  Codes codes;
  const auto test = [&](Mesh& mesh, Dice& dice) -> std::string {
    const auto delnb = [&](Mesh m, int n0, int nb) {
      const std::string d = compare(m, [&](const Routines& r, Mesh& o) {
        o.results = {Lists::mark};
        r.delnb(&n0, &nb, &o.n, o.list(), o.lptr(), o.lend(), &o.lists.lnew, o.results.data());
      });
      codes.note(std::min(m.results[0], 1));
      return d.empty() ? d : "DELNB " + std::to_string(n0) + " " + std::to_string(nb) + d;
    };
    const bool all = mesh.n <= 40;
    for (int i = 1; i <= (all ? mesh.n : 20); ++i) {
      const int a = all ? i : dice.node(mesh);
      for (int b : mesh.neighbours(a))
        if (const std::string d = delnb(mesh, a, b); !d.empty()) return d;
      for (int b : {0, -a, mesh.n + 1, dice.node(mesh), a})
        for (const auto& [n0, nb] : {std::array<int, 2>{a, b}, {b, a}})
          if (const std::string d = delnb(mesh, n0, nb); !d.empty()) return d;
    }
    // Repeatedly on one mesh, each time also with the reverse entry.
    for (int i = 0; i < 10 && mesh.n > 4; ++i) {
      const int a = dice.node(mesh);
      const std::vector<int> ring = mesh.neighbours(a);
      const int b = ring[static_cast<std::size_t>(dice.below(static_cast<int>(ring.size())))];
      if (ring.size() < 3 || mesh.neighbours(b).size() < 3) continue;
      for (const auto& [n0, nb] : {std::array<int, 2>{a, b}, {b, a}})
        COMPARE(mesh, "DELNB in turn", ([&, n0 = n0, nb = nb](const Routines& r, Mesh& o) {
                  o.results = {Lists::mark};
                  r.delnb(&n0, &nb, &o.n, o.list(), o.lptr(), o.lend(), &o.lists.lnew, o.results.data());
                }));
    }
    mesh.n = 2;
    return delnb(mesh, 1, 2);
  };
  expect_equal(compare_meshes(node_sets(), test));
  codes.expect({1, -1, -2});
}

namespace {

std::string compare_delarc(Mesh& mesh, int io1, int io2) {
  const std::string d = compare(mesh, [&](const Routines& r, Mesh& m) {
    m.results = {Lists::mark};
    r.delarc(&m.n, &io1, &io2, m.list(), m.lptr(), m.lend(), &m.lists.lnew, m.results.data());
  });
  return d.empty() ? d : "DELARC " + std::to_string(io1) + " " + std::to_string(io2) + d;
}

}  // namespace

TEST(Differential, DELARC) {
  Codes codes;
  const auto test = [&](Mesh& mesh, Dice& dice) -> std::string {
    const auto on_a_copy = [&](const Mesh& from, int io1, int io2) {
      Mesh m = from;
      const std::string d = compare_delarc(m, io1, io2);
      codes.note(m.results[0]);
      return d;
    };
    for (int a = 1; a <= mesh.n; ++a) {
      for (int b : {0, a, mesh.n + 1, dice.node(mesh)})
        for (const auto& [io1, io2] : {std::array<int, 2>{a, b}, {b, a}})
          if (const std::string d = on_a_copy(mesh, io1, io2); !d.empty()) return d;
      if (!mesh.on_boundary(a)) continue;
      const int b = -mesh.entry(mesh.last(a));
      for (const auto& [io1, io2] : {std::array<int, 2>{a, b}, {b, a}})
        if (const std::string d = on_a_copy(mesh, io1, io2); !d.empty()) return d;
      // Lists in which one of the two nodes does not list the other.
      for (const auto& [owner, missing] : {std::array<int, 2>{a, b}, {b, a}}) {
        Mesh damaged = mesh;
        const int first = mesh.next(mesh.last(owner));
        if (mesh.entry(first) == missing) damaged.list()[first - 1] = owner;
        if (const std::string d = on_a_copy(damaged, a, b); !d.empty()) return "damaged " + d;
      }
    }
    // Delete arcs as long as possible.
    for (int i = 0; i < 60; ++i) {
      const int a = dice.node(mesh);
      if (!mesh.on_boundary(a)) continue;
      if (const std::string d = compare_delarc(mesh, a, -mesh.entry(mesh.last(a))); !d.empty())
        return "in turn " + d;
    }
    return "";
  };
  expect_equal(compare_meshes(node_sets(), test));
  codes.expect({0, 1, 2, 3, 4});
}

// ---- nodes deleted ----

namespace {

std::string compare_delnod(Mesh& mesh, int k, int lwk) {
  const std::string d = compare(mesh, [&](const Routines& r, Mesh& m) {
    m.results = {lwk, Lists::mark};
    r.delnod(&k, &m.n, m.x.data(), m.y.data(), m.z.data(), m.list(), m.lptr(), m.lend(), &m.lists.lnew,
             m.results.data(), m.iwk.data(), m.results.data() + 1);
  });
  return d.empty() ? d : "DELNOD " + std::to_string(k) + d;
}

}  // namespace

TEST(Differential, DELNOD) {
  Codes codes;
  const auto test = [&](Mesh& mesh, Dice& dice) -> std::string {
    const auto delnod = [&](Mesh& m, int k, int lwk) {
      const std::string d = compare_delnod(m, k, lwk);
      codes.note(m.results[1]);
      return d;
    };
    for (int k : {0, -1, mesh.n + 1})
      if (const std::string d = delnod(mesh, k, mesh.n); !d.empty()) return d;
    if (const std::string d = delnod(mesh, 1, -1); !d.empty()) return d;
    if (mesh.n > 3) {
      // A node that a neighbour does not list, and a node with one neighbour.
      Mesh damaged = mesh;
      const int a = dice.node(mesh), b = mesh.neighbours(a).front();
      int slot = mesh.last(b);
      while (std::abs(mesh.entry(slot)) != a) slot = mesh.next(slot);
      damaged.list()[slot - 1] = mesh.entry(slot) > 0 ? b : -b;
      if (const std::string d = delnod(damaged, a, mesh.n); !d.empty()) return "damaged " + d;
      damaged = mesh;
      damaged.lptr()[mesh.last(a) - 1] = mesh.last(a);
      if (const std::string d = delnod(damaged, a, mesh.n); !d.empty()) return "single " + d;
    }
    while (mesh.n > 3) {
      const int choice = dice.below(8);
      const int k = choice == 0 ? mesh.n : choice == 1 ? 1 : dice.node(mesh);
      if (const std::string d = delnod(mesh, k, dice.below(4)); !d.empty()) return d;
      if (mesh.results[1] == 2)
        if (const std::string d = delnod(mesh, k, mesh.results[0]); !d.empty()) return d;
      if (mesh.results[1] == 3 || mesh.results[1] == 4) return "";
    }
    return delnod(mesh, 1, 5);
  };
  expect_equal(compare_meshes(node_sets(), test));
  // Deletions in which OPTIM fails in the end.
  const auto deletes = [&](int k) {
    return [&, k](Mesh& mesh, Dice&) {
      const std::string d = compare_delnod(mesh, k, mesh.n);
      codes.note(mesh.results[1]);
      return d;
    };
  };
  expect_equal(compare_meshes(
      {lattice(
          "DELNOD 5",
          {{0, 1, 0}, {0, 1, -1}, {-1, -1, -1}, {1, 1, 0}, {1, 0, 0}, {0, -1, 0}, {-1, -1, 0}, {1, -1, 1}})},
      deletes(1)));
  expect_equal(compare_meshes(
      {lattice(
          "DELNOD 6",
          {{0, 0, 1}, {1, -1, -1}, {0, -1, -1}, {1, 0, 0}, {1, 0, -1}, {0, -1, 0}, {-1, 0, 1}, {0, 0, -1}})},
      deletes(2)));
  codes.expect({0, 1, 2, 3, 4, 5, 6});
}

// ---- nodes added ----

namespace {

Calls addnod(int start, int k) {
  return [start, k](const Routines& r, Mesh& m) {
    m.results.assign(1, Lists::mark);
    r.addnod(&start, &k, m.x.data(), m.y.data(), m.z.data(), m.list(), m.lptr(), m.lend(), &m.lists.lnew,
             m.results.data());
  };
}

/// True if node k is a copy of one of 1..k-1.
bool is_copy(const Mesh& mesh, int k) {
  for (int i = 1; i < k; ++i)
    if (mesh.same_place(i, k)) return true;
  return false;
}

/// "" if the call reported that node k is a copy and changed nothing.
std::string found_copy(const Mesh& before, Mesh after, int k) {
  const int l = after.results[0];
  if (l < 1 || l >= k || !before.same_place(l, k))
    return "copy " + std::to_string(k) + " not found: " + std::to_string(l);
  after.results = before.results;
  return after == before ? "" : "copy found, but lists changed";
}

}  // namespace

TEST(Differential, ADDNOD) {
  // From three nodes to all nodes, one by one. A copy, which the original may add, must be found and is left
  // out.
  Codes codes;
  const auto test = [&](Mesh& mesh, Dice& dice) -> std::string {
    const int n = mesh.n;
    keep_three(mesh);
    COMPARE(mesh, "ADDNOD of node 3", addnod(1, 3));
    codes.note(mesh.results[0]);
    int k = 4;
    for (int i = 4; i <= n; ++i) {
      for (auto* c : {&mesh.x, &mesh.y, &mesh.z})
        (*c)[static_cast<std::size_t>(k - 1)] = (*c)[static_cast<std::size_t>(i - 1)];
      const int start = std::array<int, 4>{0, 1, k - 1, k + 5}[static_cast<std::size_t>(dice.below(4))];
      Mesh theirs = mesh;
      const Mesh before = mesh;
      addnod(start, k)(ours, mesh);
      addnod(start, k)(original, theirs);
      codes.note(mesh.results[0]);
      if (is_copy(before, k)) {
        if (theirs.results[0] == 0) codes.note(-19);  // the original did not find the copy
        if (const std::string d = found_copy(before, mesh, k); !d.empty()) return d;
        continue;
      }
      if (const std::string d = difference(mesh, theirs); !d.empty())
        return "node " + std::to_string(k) + " from " + std::to_string(start) + ":" + d;
      if (mesh.results[0] != 0) return "";
      ++k;
    }
    return "";
  };
  expect_equal(compare_meshes(node_sets(), test));

  // Node 4 is attached to the hull by a null triangle; the search for node 5 from there meets only one great
  // circle.
  const auto add_pole = [&](Mesh& mesh, Dice&) -> std::string {
    mesh.x[4] = mesh.y[4] = 0;
    mesh.z[4] = 1;
    COMPARE(mesh, "ADDNOD", addnod(0, 5));
    codes.note(mesh.results[0]);
    return mesh.results[0] == -2 ? "" : "IER " + std::to_string(mesh.results[0]);
  };
  NodeSet four;
  four.name = "null triangle";
  four.x = {-0.5773502691896258, -0.7071067811865475, 1, -0.5773502691896258};
  four.y = {0.5773502691896258, 0.7071067811865475, 0, 0.5773502691896258};
  four.z = {-0.5773502691896258, 0, 0, 0.5773502691896258};
  expect_equal(compare_meshes({four}, add_pole));
  codes.expect({0, -1, -2, 1, 2, -19});
  if (cases(100) >= 100) codes.expect({3});  // is rarer
}

TEST(Differential, ADDNODFindsEveryCopy) {
  const auto test = [](Mesh& mesh, Dice& dice) -> std::string {
    const int k = mesh.n + 1;
    for (int i = 1; i <= mesh.n; ++i)
      for (int start : {0, i, dice.node(mesh)}) {
        for (auto* c : {&mesh.x, &mesh.y, &mesh.z})
          (*c)[static_cast<std::size_t>(k - 1)] = (*c)[static_cast<std::size_t>(i - 1)];
        const Mesh before = mesh;
        addnod(start, k)(ours, mesh);
        if (const std::string d = found_copy(before, mesh, k); !d.empty()) return d;
      }
    return "";
  };
  expect_equal(compare_meshes(node_sets(), test), 20);
}

// ---- arcs forced ----

namespace {

Calls edge(int in1, int in2, int lwk) {
  return [in1, in2, lwk](const Routines& r, Mesh& m) {
    m.results.assign({lwk, Lists::mark});
    r.edge(&in1, &in2, m.x.data(), m.y.data(), m.z.data(), m.results.data(), m.iwk.data(), m.list(), m.lptr(),
           m.lend(), m.results.data() + 1);
  };
}

/// The original may not return. Then ours either reports an error and has changed nothing, or has made the
/// arc. If SWAP refuses, the original continues and seldom returns a triangulation; ours changes nothing.
constexpr int kRefusedForNothing = -17, kRefused = -15;
std::string compare_edge(Mesh& mesh, int in1, int in2, int lwk, Codes& codes) {
  Mesh before = mesh, theirs = mesh;
  edge(in1, in2, lwk)(ours, mesh);
  const int ier = mesh.results[1];
  codes.note(ier);
  std::string d;
  bool returned = returns(edge(in1, in2, lwk), original, theirs);
  if (!returned && ier != -16 && ier != 0) {  // a busy machine counts its own work in two ticks
    theirs = before;
    returned = returns(edge(in1, in2, lwk), original, theirs, 250);
  }
  if (returned && ier != -16) {
    d = difference(mesh, theirs);
  } else if (ier == -16) {
    if (returned) codes.note(theirs.is_triangulation() ? kRefusedForNothing : kRefused);
    before.iwk = mesh.iwk;  // working space
    before.results = {lwk, -16};
    d = difference(mesh, before);
  } else {
    codes.note(-18);
    const std::vector<int> ring = mesh.neighbours(in1);
    if (ier != 0 || std::find(ring.begin(), ring.end(), in2) == ring.end())
      d = " where there is no return: " + std::to_string(ier);
  }
  if (ier == -16) mesh.iwk.assign(mesh.iwk.size(), Lists::mark);
  return d.empty() ? d : "EDGE " + std::to_string(in1) + " " + std::to_string(in2) + d;
}

}  // namespace

TEST(Differential, EDGE) {
  Codes codes;
  const auto test = [&](Mesh& mesh, Dice& dice) -> std::string {
    const auto on_a_copy = [&](int in1, int in2, int lwk) {
      Mesh m = mesh;
      return compare_edge(m, in1, in2, lwk, codes);
    };
    for (const auto& [in1, in2, lwk] :
         {std::array<int, 3>{0, 1, 5}, {1, 0, 5}, {2, 2, 5}, {1, 2, -1}, {-1, 2, 5}})
      if (const std::string d = on_a_copy(in1, in2, lwk); !d.empty()) return d;
    const bool all = mesh.n <= 25;
    for (int i = 0; i < (all ? mesh.n * mesh.n : cases(150)); ++i) {
      const int in1 = all ? 1 + i / mesh.n : dice.node(mesh), in2 = all ? 1 + i % mesh.n : dice.node(mesh);
      for (int lwk : {mesh.n, i % 3})
        if (const std::string d = on_a_copy(in1, in2, lwk); !d.empty()) return d;
    }
    // On one mesh, one after another.
    for (int i = 0; i < 20; ++i)
      if (const std::string d = compare_edge(mesh, dice.node(mesh), dice.node(mesh), mesh.n, codes);
          !d.empty())
        return "in turn " + d;
    return "";
  };
  expect_equal(compare_meshes(node_sets(), test, 20));

  // Nodes 1, 2, 4 and 5 of the first set lie on one meridian; in the other sets OPTIM meets null triangles.
  NodeSet meridian;
  meridian.name = "meridian";
  meridian.x = {0.617887107815421, 0.5777336766211344, 0.5513570579570638, 0.63097779085165395,
                0.60009393079827622};
  meridian.y = {0.73636918055667389, 0.68851618467589837, 0.78741948332457712, 0.75197004909461662,
                0.71516409792282687};
  meridian.z = {-0.27563735581699916, -0.4383711467890774, -0.27563735581699916, -0.1908089953765448,
                -0.36836795454530027};
  const auto forces = [&](int in1, int in2, int ier) {
    return [&, in1, in2, ier](Mesh& mesh, Dice&) -> std::string {
      const std::string d = compare_edge(mesh, in1, in2, mesh.n, codes);
      return d.empty() && mesh.results[1] != ier ? "IER " + std::to_string(mesh.results[1]) : d;
    };
  };
  expect_equal(compare_meshes({meridian}, forces(5, 3, -16)));
  expect_equal(compare_meshes(
      {lattice("refused SWAP",
               {{1, -2, 0}, {0, 0, 1}, {0, -2, 1}, {1, -1, 0}, {-1, 1, 1}, {-1, -1, 2}, {0, 1, 1}})},
      forces(5, 1, -16)));
  expect_equal(compare_meshes(
      {lattice("no way", {{1, 1, 1}, {0, 1, 1}, {0, -1, 0}, {-1, 1, 1}, {0, 1, 0}, {0, 0, 1}, {0, -1, 1}})},
      forces(7, 4, 3)));
  expect_equal(compare_meshes(
      {lattice(
          "not optimal",
          {{1, 0, 1}, {1, -1, 0}, {0, -1, 0}, {0, -1, -1}, {0, -1, 1}, {1, 0, -1}, {1, 0, 0}, {-1, 1, -1}})},
      forces(3, 7, 5)));
  codes.expect({0, 1, 2, 3, 4, 5, -16, kRefused});
  EXPECT_LT(100 * codes.count(kRefusedForNothing), codes.count(kRefused));
}

// ---- sequences ----

namespace {

/// Random edits on both sides, one after another.
class Edits {
 public:
  Edits(Mesh& mesh, Dice& dice, Codes& kinds) : mesh_(mesh), dice_(dice), kinds_(kinds) {}

  /// Makes the next edit; returns what differs, or "".
  std::string next() {
    a_ = dice_.node(mesh_);
    b_ = dice_.node(mesh_);
    const std::vector<int> ring = mesh_.neighbours(a_);
    neighbour_ = ring[static_cast<std::size_t>(dice_.below(static_cast<int>(ring.size())))];
    const int kind = dice_.below(8);
    kinds_.note(kind);
    switch (kind) {
      case 0:
      case 1:
        return add();
      case 2:
        return mesh_.n > 3 ? compare_delnod(mesh_, a_, mesh_.n) : "";
      case 3:
        return mesh_.on_boundary(a_) ? compare_delarc(mesh_, a_, -mesh_.entry(mesh_.last(a_))) : "";
      case 4:
      case 5:
        return compare_edge(mesh_, a_, b_, mesh_.n, codes_of_edge_);
      case 6:
        return optimize();
      default:
        return swap();
    }
  }
  /// False after a search from which the original did not return: the state of its random numbers is then
  /// unknown.
  bool go_on() const { return go_on_; }

 private:
  double& at(std::vector<double>& axis, int node) { return axis[static_cast<std::size_t>(node - 1)]; }

  /// ADDNOD of a node halfway between two nodes, anywhere, or at the place of a node.
  std::string add() {
    const int k = mesh_.n + 1, where = dice_.below(10), start = dice_.below(k + 2);
    if (k > static_cast<int>(mesh_.x.size())) return "";
    for (auto* axis : {&mesh_.x, &mesh_.y, &mesh_.z})
      at(*axis, k) = where == 0  ? at(*axis, a_)
                     : where < 7 ? at(*axis, a_) + at(*axis, b_)
                                 : 2 * dice_.uniform() - 1;
    double &x = at(mesh_.x, k), &y = at(mesh_.y, k), &z = at(mesh_.z, k);
    const double length = std::sqrt(x * x + y * y + z * z);
    if (where > 0 && length > 0) x /= length, y /= length, z /= length;
    const Mesh before = mesh_;
    Mesh theirs = mesh_;
    addnod(start, k)(ours, mesh_);
    if (!returns(addnod(start, k), original, theirs)) {
      go_on_ = false;
      return "";
    }
    if (is_copy(before, k)) return found_copy(before, mesh_, k);
    if (mesh_.results[0] == 0) mesh_.n = theirs.n = k;
    const std::string d = difference(mesh_, theirs);
    return d.empty() ? d : "ADDNOD " + std::to_string(k) + " from " + std::to_string(start) + d;
  }

  /// OPTIM of some arcs.
  std::string optimize() {
    int na = 0;
    for (const int node : mesh_.neighbours(a_)) {
      mesh_.iwk[static_cast<std::size_t>(2 * na)] = a_;
      mesh_.iwk[static_cast<std::size_t>(2 * na + 1)] = node;
      ++na;
    }
    return compare_optim(mesh_, na, 1 + dice_.below(4));
  }

  /// SWAP of an arc whose quadrilateral is convex, so that the result is a triangulation.
  std::string swap() {
    const auto [l, r] = mesh_.opposite(a_, neighbour_);
    if (l == 0 || r == 0 || mesh_.left(l, r, a_) == mesh_.left(l, r, neighbour_)) return "";
    const std::string d = compare(mesh_, [&, l = l, r = r](const Routines& side, Mesh& m) {
      m.results.assign(1, Lists::mark);
      side.swap(&l, &r, &a_, &neighbour_, m.list(), m.lptr(), m.lend(), m.results.data());
    });
    return d.empty() ? d : "SWAP" + d;
  }

  Mesh& mesh_;
  Dice& dice_;
  Codes& kinds_;
  Codes codes_of_edge_;
  int a_ = 0, b_ = 0, neighbour_ = 0;
  bool go_on_ = true;
};

}  // namespace

TEST(Differential, SequencesOfEdits) {
  Codes kinds, sequences;
  const auto test = [&](Mesh& mesh, Dice& dice) -> std::string {
    Edits edits(mesh, dice, kinds);
    for (int i = 1; i <= 50; ++i) {
      const Mesh before = mesh;
      if (const std::string d = edits.next(); !d.empty()) return "edit " + std::to_string(i) + ": " + d;
      if (!edits.go_on()) _exit(1);  // the next set needs seeds that both sides share
      if (!mesh.is_linked()) mesh = before;
    }
    sequences.note(1);
    return "";
  };
  expect_equal(compare_meshes(node_sets(), test), 20);
  kinds.expect({0, 1, 2, 3, 4, 5, 6, 7});
  sequences.expect({1});
}
