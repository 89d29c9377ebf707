// Compares TRMESH under PSTRIPACK_ORDER with the original, and parts of it with each other.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <thread>
#include <utility>

#include "child_process.h"
#include "differential/differential.h"
#include "differential/reference_trmesh.h"
#include "differential/routines.h"
#include "point_sets.h"
#include "stripack/original/original_order.h"
#include "support/lists.h"
#include "trmesh/trmesh.h"

using namespace differential;
using namespace pstripack;

namespace {

constexpr OriginalRules kNgmath{true, 4, true}, kAlgorithm772{true, 100, false};

std::vector<Point> points_of(const NodeSet& nodes) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < nodes.x.size(); ++i) points.push_back({nodes.x[i], nodes.y[i], nodes.z[i]});
  return points;
}

NodeSet node_set(const std::string& name, const std::vector<Point>& points) {
  NodeSet set;
  set.name = name;
  for (const Point& p : points) {
    set.x.push_back(p.x);
    set.y.push_back(p.y);
    set.z.push_back(p.z);
  }
  return set;
}

struct Triangulation {
  int ier;
  differential::Lists lists;
};

Triangulation by_original(const NodeSet& nodes) {
  int ier = 0;
  differential::Lists lists = triangulated_by_original(nodes, ier);
  return {ier, std::move(lists)};
}

Triangulation by_us(const NodeSet& nodes) {
  const int n = nodes.n();
  Triangulation t{0, differential::Lists(n + 60)};
  std::vector<int> near(nodes.x.size()), next = near;
  std::vector<double> dist(nodes.x.size());
  trmesh_(&n, nodes.x.data(), nodes.y.data(), nodes.z.data(), t.lists.list.data(), t.lists.lptr.data(),
          t.lists.lend.data(), &t.lists.lnew, near.data(), next.data(), dist.data(), &t.ier);
  return t;
}

/// The number of nodes before the one that coincides with node IER.
std::size_t nodes_in(const Triangulation& t, std::size_t n) {
  std::size_t count = 0;
  while (count < n && t.lists.lend[count] != differential::Lists::mark) ++count;
  return count;
}

Verdict judged(const NodeSet& nodes, const Triangulation& t) {
  const std::size_t count = nodes_in(t, nodes.x.size());
  return is_valid(
      points_of(nodes).data(),
      ListsView<int>{count, t.lists.list.data(), t.lists.lptr.data(), t.lists.lend.data(), t.lists.lnew},
      Lengths::automatic, Ties::either_way);
}

/// L and M-1 for the first node M in the direction of an earlier node L.
std::pair<int, std::size_t> first_copy(const NodeSet& nodes) {
  const std::vector<Point> p = points_of(nodes);
  const std::size_t most = std::min<std::size_t>(p.size(), 1000);  // larger sets have no copies
  for (std::size_t m = 0; m < most; ++m)
    for (std::size_t l = 0; l < m; ++l)
      if (same_direction(p[l], p[m])) return {static_cast<int>(l) + 1, m};
  return {0, p.size()};
}

/// The fault of our result, regardless of the original's; "" if it is correct.
std::string fault_of_ours(const NodeSet& nodes, const Triangulation& ours) {
  const std::vector<Point> p = points_of(nodes);
  if (left(p[0], p[1], p[2]) == 0) return ours.ier == -2 ? "" : "IER of collinear first nodes";
  const auto [ier, count] = first_copy(nodes);
  if (ours.ier != ier) return "IER " + std::to_string(ours.ier) + " instead of " + std::to_string(ier);
  if (nodes_in(ours, nodes.x.size()) != count) return "not as many nodes as there should be";
  return judged(nodes, ours).message;
}

/// True if the original's result is a triangulation of all nodes that it had to insert.
bool is_right(const NodeSet& nodes, const Triangulation& original) {
  const auto [ier, count] = first_copy(nodes);
  return original.ier == ier && nodes_in(original, nodes.x.size()) == count && judged(nodes, original);
}

/// True if these lists are a triangulation: the triangles that they list have the same lists, all nodes are
/// connected, and Euler's number is that of the sphere or of a part of it with one boundary.
bool is_a_triangulation(const differential::Lists& lists, std::size_t n) {
  ::Lists used{lists.list,
               lists.lptr,
               {lists.lend.begin(), lists.lend.begin() + static_cast<std::ptrdiff_t>(n)},
               lists.lnew};
  const auto rings = rings_of(used);
  if (!rings) return false;
  const Faces faces = faces_of(*rings);
  if (!(rings_of(n, faces) == rings)) return false;
  std::size_t arcs = 0;  // counted once per end
  for (const auto& ring : rings->neighbours) arcs += ring.size();
  std::set<std::int32_t> reached{0};
  for (std::vector<std::int32_t> waiting{0}; !waiting.empty();) {
    const auto node = static_cast<std::size_t>(waiting.back());
    waiting.pop_back();
    for (const std::int32_t other : rings->neighbours[node])
      if (reached.insert(other).second) waiting.push_back(other);
  }
  const bool has_boundary = std::count(rings->boundary.begin(), rings->boundary.end(), 1) > 0;
  return reached.size() == n && n - arcs / 2 + faces.size() == (has_boundary ? 1 : 2);
}

/// Nodes for which the original does not return, or returns IER = -2.
const NodeSet kOneMeridian{"one meridian",
                           {0.452695204446832, 0.4602557974987226, 0.467676192176097, 0.47495412815485366},
                           {0.5590320207484465, 0.5683685756099448, 0.5775319998974023, 0.5865195023430131},
                           {0.6946583704589973, 0.6819983600624985, 0.6691306063588582, 0.6560590289905072}};
const NodeSet kHalfACircle{"half a circle",
                           {-0.41562693777745341, -1.079743991708995e-16, 3.5991466390299832e-17,
                            3.5991466390299832e-17, 0.67249851196395738},
                           {0.41562693777745346, -0.58778525229247314, 0.58778525229247314,
                            0.58778525229247314, 0.67249851196395727},
                           {0.80901699437494745, -0.80901699437494745, -0.80901699437494745,
                            0.80901699437494745, 0.3090169943749474}};
const NodeSet kLateCollinear{"late IER -2",
                             {-0.5773502691896258, -0.7071067811865475, 1, -0.5773502691896258, 0},
                             {0.5773502691896258, 0.7071067811865475, 0, 0.5773502691896258, 0},
                             {-0.5773502691896258, 0, 0, 0.5773502691896258, 1}};

std::string difference(const Triangulation& a, const Triangulation& b) {
  if (a.ier != b.ier) return "IER " + std::to_string(a.ier) + ", " + std::to_string(b.ier);
  if (a.lists.list != b.lists.list) return "LIST";
  if (a.lists.lptr != b.lists.lptr) return "LPTR";
  if (a.lists.lend != b.lists.lend) return "LEND";
  return a.lists.lnew != b.lists.lnew ? "LNEW" : "";
}

/// The same for the lists that insert_in_order makes.
template <class Int>
bool is_prefix(const BlockArray<Int>& ours, const std::vector<int>& theirs, std::size_t first = 0) {
  return theirs.size() >= first + ours.size() &&
         std::equal(ours.data(), ours.data() + ours.size(),
                    theirs.begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace

TEST(Differential, TRMESH) {
  const legacy_stripack::Shared<int> equal, canonical;
  const Result result = compare_all(node_sets(), [&](const NodeSet& nodes) -> std::string {
    const Triangulation ours = by_us(nodes);
    if (const std::string fault = fault_of_ours(nodes, ours); !fault.empty()) return fault;
    const Triangulation original = by_original(nodes);
    if (original.ier < 0 || !is_right(nodes, original)) {
      ++*canonical.data();
      return "";
    }
    ++*equal.data();
    return difference(ours, original);
  });
  std::printf("%d as the original's, %d where that is wrong\n", *equal.data(), *canonical.data());
  EXPECT_GT(*equal.data(), 1000);
  EXPECT_GT(*canonical.data(), 100);
  expect_equal(result, 60);
}

TEST(Differential, TRMESH_ends) {
  std::vector<NodeSet> sets = node_sets();
  sets.insert(sets.end(), {kOneMeridian, kHalfACircle, kLateCollinear});
  for (const NodeSet& nodes : sets) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(fault_of_ours(nodes, by_us(nodes)), "") << nodes.name;
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 2)
        << nodes.name;
  }
}

TEST(Differential, TRMESH_large) {
  for (const auto& [family, n] : std::vector<std::pair<std::string, std::size_t>>{{"random", 10000},
                                                                                  {"random", 100000},
                                                                                  {"hemisphere", 10000},
                                                                                  {"cap", 5000},
                                                                                  {"variable", 20000},
                                                                                  {"fibonacci", 20000},
                                                                                  {"latlon", 20000},
                                                                                  {"icosahedral", 10242},
                                                                                  {"clusters", 20000}}) {
    const NodeSet nodes = node_set(family, point_sets::make(family, n));
    const Triangulation original = by_original(nodes), ours = by_us(nodes);
    EXPECT_EQ(fault_of_ours(nodes, ours), "") << family;
    if (is_right(nodes, original))
      EXPECT_EQ(difference(ours, original), "") << family;
    else
      EXPECT_NE(family, "random");
  }
}

/// The same steps make the same lists, even if the result is wrong.
TEST(Differential, TRMESH_steps) {
  const Result result = compare_all(node_sets(), [](const NodeSet& nodes) -> std::string {
    const InsertedNodes<int> ours =
        insert_in_order(nodes.n(), nodes.x.data(), nodes.y.data(), nodes.z.data(), kNgmath);
    const Triangulation original = by_original(nodes);
    switch (ours.outcome.end) {
      case InsertionEnd::complete:
        if (original.ier != 0) return "IER";
        break;
      case InsertionEnd::coincident:
        if (original.ier != ours.outcome.other) return "L";
        break;
      case InsertionEnd::collinear:
        return original.ier == -2 ? "" : "IER -2";
      default:
        return "the original returned";
    }
    if (!is_prefix(ours.list, original.lists.list)) return "LIST";
    if (!is_prefix(ours.lptr, original.lists.lptr)) return "LPTR";
    if (!is_prefix(ours.lend, original.lists.lend)) return "LEND";
    return original.lists.lnew == ours.lnew ? "" : "LNEW";
  });
  expect_equal(result, 60);
}

TEST(Differential, TRMESH_reference) {
  const Result result = compare_all(node_sets(), [](const NodeSet& nodes) -> std::string {
    ReferenceTrmesh<double> reference(nodes.x, nodes.y, nodes.z, {4, true});
    const int ier = reference.run();
    const Triangulation original = by_original(nodes);
    if (ier != original.ier) return "IER";
    if (ier == -2 && original.lists.lnew == differential::Lists::mark) return "";
    const auto slots = static_cast<std::size_t>(original.lists.lnew) - 1;
    if (reference.lnew != original.lists.lnew) return "LNEW";
    if (!std::equal(reference.list.begin() + 1, reference.list.begin() + 1 + slots,
                    original.lists.list.begin()))
      return "LIST";
    return std::equal(reference.lptr.begin() + 1, reference.lptr.begin() + 1 + slots,
                      original.lists.lptr.begin())
               ? ""
               : "LPTR";
  });
  expect_equal(result, 60);
}

template <class Real>
void compare_with_reference(const OriginalRules& rules) {
  int complete = 0;
  for (const NodeSet& nodes : node_sets()) {
    const std::vector<Real> x(nodes.x.begin(), nodes.x.end()), y(nodes.y.begin(), nodes.y.end()),
        z(nodes.z.begin(), nodes.z.end());
    ReferenceTrmesh<Real> reference(x, y, z, {rules.tolerance_in_epsilons, rules.single_precision_random});
    const int ier = reference.run();
    if (ier == -99) continue;
    seeds_of_thread() = {};
    const InsertedNodes<int> ours = insert_in_order(nodes.n(), x.data(), y.data(), z.data(), rules);
    const auto [end, node, other] = ours.outcome;
    ASSERT_EQ(ier, end == InsertionEnd::complete     ? 0
                   : end == InsertionEnd::coincident ? static_cast<int>(other)
                   : end == InsertionEnd::collinear  ? -2
                                                     : -98)
        << nodes.name;
    if (ier < 0) continue;
    ++complete;
    ASSERT_EQ(ours.lnew, reference.lnew) << nodes.name;
    ASSERT_TRUE(is_prefix(ours.list, reference.list, 1)) << nodes.name;
    ASSERT_TRUE(is_prefix(ours.lptr, reference.lptr, 1)) << nodes.name;
    ASSERT_TRUE(is_prefix(ours.lend, reference.lend, 1)) << nodes.name;
  }
  EXPECT_GT(complete, 1500);
}
TEST(Differential, TRMESH_r4) { compare_with_reference<float>(kAlgorithm772); }
TEST(Differential, TRMESH_r8_rules_of_Algorithm_772) { compare_with_reference<double>(kAlgorithm772); }

TEST(Differential, TRMESH_on_threads) {
  const NodeSet& meridian = kOneMeridian;  // draws random numbers
  std::vector<const NodeSet*> sets{&meridian};
  for (std::size_t i = 0; i < node_sets().size(); i += 40) sets.push_back(&node_sets()[i]);
  const auto all = [&] {
    std::vector<Triangulation> results;
    for (const NodeSet* nodes : sets) results.push_back(by_us(*nodes));
    return results;
  };
  std::vector<Triangulation> results[3];
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = all(); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (int thread = 1; thread < 3; ++thread)
      EXPECT_EQ(difference(results[thread][i], results[0][i]), "") << sets[i]->name;
}

// PSTRIPACK_ORDER=bitwise-ngmath: if the original's lists are a triangulation, correct or not, our lists and
// IER equal them. If not, or if the original gives up or does not return, ours are correct.

void expect_bits_of_original(const std::vector<NodeSet>& sets, int least_wrong) {
  const legacy_stripack::Shared<int> wrong;
  const Result result = compare_all(
      sets,
      [&](const NodeSet& nodes) -> std::string {
        const Triangulation ours = by_us(nodes), original = by_original(nodes);
        if (original.ier < 0 || !is_a_triangulation(original.lists, nodes_in(original, nodes.x.size())))
          return fault_of_ours(nodes, ours);
        if (!is_right(nodes, original)) ++*wrong.data();
        return difference(ours, original);
      },
      1);
  std::printf("%d as the original's although that is wrong\n", *wrong.data());
  EXPECT_GT(*wrong.data(), least_wrong);
  expect_equal(result, 60);
  for (const NodeSet& nodes : sets)
    if (std::count(result.not_returned.begin(), result.not_returned.end(), nodes.name) > 0) {
      EXPECT_EQ(fault_of_ours(nodes, by_us(nodes)), "") << nodes.name;
    }
}

TEST(Bitwise, TRMESH) { expect_bits_of_original(node_sets(), 100); }

TEST(Bitwise, TRMESH_of_grids) {
  std::vector<NodeSet> sets{kOneMeridian, kHalfACircle, kLateCollinear};
  const auto add = [&](const std::string& family, std::size_t n) {
    std::vector<Point> points = point_sets::make(family, n);
    const std::string name = family + " " + std::to_string(n);
    sets.push_back(node_set(name, points));
    point_sets::shuffle(points, 1);
    sets.push_back(node_set(name + " shuffled", points));
  };
  for (const std::size_t n : {10, 50, 200, 1000, 3000, 10000}) add("latlon", n);
  for (const char* family : {"tripolar", "cubed-sphere", "healpix", "reduced-gaussian"})
    for (const std::size_t n : {200, 2000}) add(family, n);
  expect_bits_of_original(sets, 10);
}

/// In single precision, compared with the reference: there is no original here.
TEST(Bitwise, TRMESH_r4) {
  int wrong = 0, right = 0;
  for (const NodeSet& nodes : node_sets()) {
    const std::vector<float> x(nodes.x.begin(), nodes.x.end()), y(nodes.y.begin(), nodes.y.end()),
        z(nodes.z.begin(), nodes.z.end());
    ReferenceTrmesh<float> reference(x, y, z, {4, true});
    const int ier = reference.run();
    if (ier < 0) continue;
    Triangulation ours{0, differential::Lists(nodes.n())};
    seeds_of_thread() = {};
    const TrmeshResult result =
        trmesh({nodes.n(),
                {x.data(), y.data(), z.data()},
                {ours.lists.list.data(), ours.lists.lptr.data(), ours.lists.lend.data(), &ours.lists.lnew}});
    ASSERT_EQ(result.ier, ier) << nodes.name;
    const auto slots = static_cast<std::size_t>(reference.lnew) - 1;
    const auto are_equal = [](const std::vector<int>& a, const std::vector<int>& b, std::size_t count) {
      return std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(count), b.begin() + 1);
    };
    ASSERT_EQ(ours.lists.lnew, reference.lnew) << nodes.name;
    ASSERT_TRUE(are_equal(ours.lists.list, reference.list, slots)) << nodes.name;
    ASSERT_TRUE(are_equal(ours.lists.lptr, reference.lptr, slots)) << nodes.name;
    ASSERT_TRUE(are_equal(ours.lists.lend, reference.lend, static_cast<std::size_t>(reference.nodes)))
        << nodes.name;
    ++(result.order == OriginalOrder::inexact ? wrong : right);
  }
  std::printf("%d wrong, %d right\n", wrong, right);
  EXPECT_GT(wrong, 100);
  EXPECT_GT(right, 500);
}
