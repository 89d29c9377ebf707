// The parallel triangulation on ranks that are threads of this process must give the serial rings for every
// number of ranks and patches, every partition, every distribution of the nodes. The test's name has the
// configuration: ranks, patches per rank, partition, distribution of the nodes.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <numeric>
#include <string>
#include <tuple>
#include <type_traits>

#include "base/workspace.h"
#include "distributions.h"
#include "parallel/agreement.h"
#include "parallel/coincidence.h"
#include "parallel/number_table.h"
#include "parallel/partition.h"
#include "parallel/patch_hull.h"
#include "parallel/sample.h"
#include "parallel/triangulate.h"
#include "point_sets.h"
#include "support/cases.h"
#include "support/judge.h"
#include "support/lists.h"
#include "support/names.h"
#include "support/serial_rings.h"
#include "support/thread_ranks.h"

namespace {

using namespace pstripack;

enum class Brings { slices, every_other, rank_0, home };

struct Configuration {
  int ranks, patches;
  PartitionKind partition;
  Brings brings;
};

std::string name_of(const Configuration& c) {
  static const char* const brings[] = {"slices", "every_other", "rank_0", "home"};
  return "np" + std::to_string(c.ranks) + "_patches" + std::to_string(c.patches) + "_" +
         name_of(c.partition) + "_" + brings[static_cast<int>(c.brings)];
}

std::vector<std::size_t> ranks_that_bring(const Nodes& nodes, const Configuration& c) {
  const std::size_t n = nodes.size(), size = static_cast<std::size_t>(c.ranks);
  const Partition home(PartitionKind::bisection, c.ranks, nodes, n);
  std::vector<std::size_t> rank_of_node;
  for (std::size_t i = 0; i < n; ++i)
    rank_of_node.push_back(c.brings == Brings::slices        ? i * size / n
                           : c.brings == Brings::every_other ? i % size
                           : c.brings == Brings::home        ? static_cast<std::size_t>(home.owner(nodes[i]))
                                                             : 0);
  return rank_of_node;
}

Outcome run(const Nodes& nodes, const Configuration& c, bool with_neighbours = false,
            std::size_t closing_nodes = 256) {
  ParallelOptions options;
  options.partition = c.partition;
  options.patches = c.patches;
  options.with_neighbours = with_neighbours;
  options.closing_nodes = closing_nodes;
  std::vector<std::unique_ptr<Homes>> homes(static_cast<std::size_t>(c.ranks));
  return run(nodes, ranks_that_bring(nodes, c), options, homes);
}

// ---- all families, all configurations ---------------------------------------------------------------

const std::vector<std::string> kFamilies{
    "random",   "single",        "fibonacci", "icosahedral", "latlon",        "reduced-gaussian",
    "healpix",  "cubed-sphere",  "tripolar",  "ring",        "variable",      "variable:1e6",
    "clusters", "clusters:1e-6", "dense-cap", "antipodal",   "cap",           "box",
    "strip",    "tee",           "pairs",     "hemisphere",  "hemisphere-rim"};

class Configurations : public ::testing::TestWithParam<Configuration> {};

TEST_P(Configurations, GiveTheSerialRings) {
  static const std::map<std::pair<std::string, std::size_t>, Set> sets = [] {
    std::map<std::pair<std::string, std::size_t>, Set> all;
    for (const std::string& family : kFamilies)
      for (const std::size_t n : {12u, 30u, 500u})
        all.emplace(std::pair(family, n), Set(point_sets::make(family, n, n)));
    return all;
  }();
  for (const auto& [name, set] : sets)
    EXPECT_TRUE(is_serial(set, run(set.nodes, GetParam()))) << name.first << " " << name.second;
}

std::vector<Configuration> configurations() {
  std::vector<Configuration> all;
  for (const auto& [ranks, patches] : std::vector<std::pair<int, int>>{
           {1, 1}, {1, 2}, {1, 7}, {2, 1}, {3, 1}, {5, 2}, {8, 2}, {16, 1}, {64, 1}})
    for (const NamedPartition& partition : kPartitions)
      for (const Brings brings : {Brings::slices, Brings::every_other, Brings::rank_0, Brings::home}) {
        if (ranks == 1 && brings != Brings::slices) continue;
        if (ranks > 5 && (brings == Brings::rank_0 || brings == Brings::slices)) continue;
        all.push_back({ranks, patches, partition.kind, brings});
      }
  return all;
}
INSTANTIATE_TEST_SUITE_P(All, Configurations, ::testing::ValuesIn(configurations()),
                         [](const auto& info) { return name_of(info.param); });

// ---- larger sets, where patches have an inside ------------------------------------------------------

class Families : public ::testing::TestWithParam<std::string> {};

TEST_P(Families, OfTwentyThousandNodesGiveTheSerialRings) {
  const Set set(point_sets::make(GetParam(), GetParam() == "ring" ? 3000 : 20000, 5));
  for (const Configuration c : {Configuration{1, 9, PartitionKind::bisection, Brings::slices},
                                Configuration{4, 2, PartitionKind::stripes, Brings::every_other},
                                Configuration{6, 1, PartitionKind::stripes, Brings::slices}})
    EXPECT_TRUE(is_serial(set, run(set.nodes, c))) << name_of(c);
}
INSTANTIATE_TEST_SUITE_P(All, Families, ::testing::ValuesIn(kFamilies), name_of_case);

/// The same for every distribution that the benchmark measures. Nests over more than 100 decades have fewer
/// nodes, since nearly every test of them takes big integers.
TEST(Distributions, GiveTheSerialRings) {
  for (const point_sets::Distribution& d : point_sets::distributions()) {
    const Set set(point_sets::make(d.name, d.limit > 4 ? 60 : 600, 5));
    ASSERT_TRUE(set.coincident.empty()) << d.name;
    for (const Configuration c : {Configuration{1, 5, PartitionKind::bisection, Brings::slices},
                                  Configuration{4, 1, PartitionKind::stripes, Brings::every_other}})
      EXPECT_TRUE(is_serial(set, run(set.nodes, c))) << d.name << ", " << name_of(c);
  }
}

// Past failure: a stage of the predicates found a sign for nodes on one circle with their mirror images, and
// patches and one hull took different diagonals.
TEST(Distributions, OfMirrorImagesGiveTheSerialRings) {
  for (const std::uint64_t seed : {1u, 2u, 3u})
    for (const char* family : {"mirrored-nest:12", "mirrored-nest:5"}) {
      const Set set(point_sets::make(family, 300, seed));
      for (const Configuration c : {Configuration{4, 1, PartitionKind::bisection, Brings::home},
                                    Configuration{16, 1, PartitionKind::bisection, Brings::home},
                                    Configuration{1, 3, PartitionKind::stripes, Brings::slices}})
        EXPECT_TRUE(is_serial(set, run(set.nodes, c))) << family << ", " << name_of(c);
    }
}

// ---- nasty sets -------------------------------------------------------------------------------------

/// Within about this distance of p.
Point beside(const Point& p, double distance, point_sets::Random& random) {
  const Point q = random.direction();
  return point_sets::normalized(plus(p, scaled(distance, q)));
}

TEST(Nasty, AVoidAsLargeAsAContinent) {
  Nodes nodes;
  for (const Point& p : point_sets::make("random", 6000, 3))
    if (p.x < 0.6) nodes.push_back(p);
  const Set set(nodes);
  for (const int ranks : {2, 5, 8})
    EXPECT_TRUE(is_serial(set, run(set.nodes, {ranks, 2, PartitionKind::bisection, Brings::every_other})));
}

TEST(Nasty, AllNodesInOnePatch) {
  Nodes nodes;
  for (const Point& p : point_sets::make("random", 30000, 3))
    if (p.x > 0 && std::fabs(p.y) < 0.1 * p.x) nodes.push_back(p);
  const Set set(nodes);
  constexpr std::size_t kRanks = 8;
  ParallelOptions options;
  options.given = std::make_shared<Partition>(
      static_cast<int>(kRanks), Partition::Rule{[](const Point& p) { return p.x > 0 ? 5 : p.y > 0; },
                                                [](PatchNumber, const Point&) { return false; }});
  std::vector<std::unique_ptr<Homes>> homes(kRanks);
  std::vector<std::size_t> rank_of_node;
  for (std::size_t i = 0; i < set.nodes.size(); ++i) rank_of_node.push_back(i * kRanks / set.nodes.size());
  EXPECT_TRUE(is_serial(set, run(set.nodes, rank_of_node, options, homes)));
}

TEST(Nasty, NodesOnBordersOfPatches) {
  Nodes nodes;  // an exact lattice: many nodes on every plane that cuts it
  for (int x = -6; x <= 6; ++x)
    for (int y = -6; y <= 6; ++y)
      for (int z = -6; z <= 6; ++z)
        if (std::gcd(std::gcd(x, y), z) == 1) nodes.push_back({double(x), double(y), double(z)});
  const Set set(nodes);
  EXPECT_EQ(set.lengths, Lengths::directions);
  for (const PartitionKind kind : {PartitionKind::bisection, PartitionKind::stripes})
    EXPECT_TRUE(is_serial(set, run(set.nodes, {5, 2, kind, Brings::slices})));
}

TEST(Nasty, LengthsThatHideANodeInOnePatchMakeAllUseDirections) {
  Nodes nodes = point_sets::make("cap:1e-4", 3000, 1);
  const double shorter = 1 - 5e-7;  // deep below its neighbours, within what counts as length 1
  Point& p = nodes[1234];
  p = scaled(shorter, p);
  const Set set(nodes);
  EXPECT_EQ(set.lengths, Lengths::directions);
  EXPECT_TRUE(is_serial(set, run(set.nodes, {4, 2, PartitionKind::bisection, Brings::every_other})));
}

/// One node a little below the unit sphere. Nodes beside it hide it, or do not, for every order of insertion.
/// If it is inserted last, only the search around it notices.
TEST(Nasty, DirectionsAreUsedExactlyWhereLengthsHideANode) {
  int hidden = 0, shown = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    point_sets::Random random(seed);
    Nodes nodes = point_sets::make(seed % 3 == 0 ? "fibonacci" : "random", 8 + seed % 50, seed);
    const std::size_t k = random.below(nodes.size());
    const Point p = nodes[k];
    const double depth = random.uniform(1e-7, 9e-7), distance = std::pow(10, -random.uniform(3, 6));
    for (std::size_t companions = 1 + random.below(4); companions > 0; --companions)
      nodes.push_back(beside(p, distance, random));
    nodes[k] = scaled(1 - depth, p);
    Nodes others = nodes;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const Set without(others);
    bool is_hidden = false;
    for (const auto& [a, b, c] : faces_of(without.rings)) {
      const Point &u = without.nodes[a], &v = without.nodes[b], &w = without.nodes[c], &x = nodes[k];
      is_hidden =
          is_hidden || (exact::left(u, v, x) >= 0 && exact::left(v, w, x) >= 0 && exact::left(w, u, x) >= 0 &&
                        exact::orientation(exact::On::coordinates, u, v, w, x) <= 0);
    }
    (is_hidden ? hidden : shown) += 1;
    const Set set(nodes);
    ASSERT_EQ(set.lengths, is_hidden ? Lengths::directions : Lengths::as_given) << seed;
    ASSERT_EQ(fault(set.nodes, set.rings, is_hidden ? exact::On::directions : exact::On::coordinates), "")
        << seed;
    for (const Configuration c : {Configuration{1, 3, PartitionKind::bisection, Brings::slices},
                                  Configuration{4, 1, PartitionKind::stripes, Brings::every_other}})
      ASSERT_TRUE(is_serial(set, run(set.nodes, c))) << seed << " " << name_of(c);
  }
  EXPECT_GT(hidden, 50);
  EXPECT_GT(shown, 50);
}

/// In clusters narrower than the differences of lengths, a patch may notice that a node is hidden only when
/// it is asked about a triangle of another patch, or when it gets an answer.
TEST(Nasty, LengthsThatHideANodeInALaterRoundMakeAllUseDirections) {
  int hidden = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    point_sets::Random random(seed);
    const std::size_t clusters = 2 + random.below(4), each = 3 + random.below(30);
    const double apart = std::pow(10, -random.uniform(3, 4)),
                 wide = apart * std::pow(10, -random.uniform(0.5, 2.5));
    const Point middle = random.direction();
    Nodes nodes;
    for (std::size_t k = 0; k < clusters; ++k) {
      const Point centre = beside(middle, apart, random);
      for (std::size_t i = 0; i < each; ++i) nodes.push_back(beside(centre, wide, random));
    }
    for (std::size_t some = 1 + random.below(3); some > 0; --some) {
      Point& p = nodes[random.below(nodes.size())];
      const double length = 1 + random.uniform(-9e-7, 9e-7);
      p = scaled(length, p);
    }
    const Set set(nodes);
    hidden += set.lengths == Lengths::directions;
    for (const int ranks : {2, 4})
      ASSERT_TRUE(is_serial(set, run(set.nodes, {ranks, 1, PartitionKind::bisection, Brings::every_other})))
          << seed << ", " << ranks << " ranks";
  }
  EXPECT_GT(hidden, 300);
  EXPECT_LT(hidden, 500);
}

// ---- numbers and indices ----------------------------------------------------------------------------

// What must not compile: a global number where a local index is wanted, and the other way round.
template <class From, class To>
constexpr bool mixes = std::is_convertible_v<From, To> || std::is_convertible_v<To, From>;
static_assert(!mixes<GlobalNumber, std::int32_t> && !mixes<GlobalNumber, std::int64_t>);
static_assert(!mixes<GlobalNumber, std::uint32_t> && !mixes<GlobalNumber, std::size_t>);
template <class Index, class = void>
constexpr bool indexes_nodes = false;
template <class Index>
constexpr bool indexes_nodes<Index, std::void_t<decltype(LocalNodes().number(Index()))>> = true;
static_assert(indexes_nodes<std::size_t> && !indexes_nodes<GlobalNumber>);
template <class Number, class = void>
constexpr bool finds_in_table = false;
template <class Number>
constexpr bool finds_in_table<Number, std::void_t<decltype(NumberTable<int>().find(Number()))>> = true;
static_assert(finds_in_table<GlobalNumber> && !finds_in_table<std::size_t> && !finds_in_table<std::int64_t>);
static_assert(sizeof(SentNode) == sizeof(Point) + sizeof(std::int64_t), "the type costs nothing");

TEST(GlobalNumber, IsThatWhichARingNames) {
  EXPECT_EQ(named_by(std::int32_t{7}), GlobalNumber{7});
  EXPECT_EQ(named_by(std::int32_t{-7}), GlobalNumber{7});
  EXPECT_EQ(named_by(-(std::int64_t{7} << 40)), GlobalNumber{std::int64_t{7} << 40});
}

// ---- what else comes back ---------------------------------------------------------------------------

TEST(Coincident, SameDirectionOnBothSidesOfABorder) {
  // Multiples of the same vector: their rounded directions may differ by an ulp, across any border.
  for (int seed = 1; seed <= 20; ++seed) {
    Nodes nodes = point_sets::make("random", 400, static_cast<std::uint64_t>(seed));
    const std::size_t n = nodes.size();
    for (std::size_t i = 0; i < n; ++i) nodes.push_back(scaled(3, nodes[i]));
    const Set set(nodes);
    const Outcome out = run(nodes, {8, 4, PartitionKind::bisection, Brings::slices});
    for (const auto& stars : out.stars) {
      const auto expected = first_coincidence(set.coincident), found = first_coincidence(stars.coincident);
      EXPECT_EQ(found.l, expected.l);
      EXPECT_EQ(found.m, expected.m);
    }
  }
}

/// Each rank is told the neighbours of its nodes that it has not brought, and no others.
::testing::AssertionResult has_outside(const Set& set, const std::vector<std::size_t>& rank_of_node,
                                       const Outcome& out) {
  for (std::size_t r = 0; r < out.stars.size(); ++r) {
    std::map<std::int64_t, Point> expected, found;
    for (std::size_t i = 0; i < set.nodes.size(); ++i)
      if (rank_of_node[i] == r)
        for (const std::int32_t b : set.rings.neighbours[i])
          if (rank_of_node[static_cast<std::size_t>(b)] != r)
            expected[b + 1] = set.nodes[static_cast<std::size_t>(b)];
    for (const auto& o : out.stars[r].outside) found[value_of(o.number)] = o.point;
    if (found != expected || found.size() != out.stars[r].outside.size())
      return ::testing::AssertionFailure() << "outside of rank " << r;
  }
  return ::testing::AssertionSuccess();
}

// ---- patches of the last call -----------------------------------------------------------------------

class KeptPatches : public ::testing::Test {
 protected:
  static constexpr std::size_t kRanks = 5;

  std::vector<std::size_t> at_home(const Nodes& nodes) const {
    std::vector<std::size_t> rank_of_node;
    for (const Point& p : nodes) rank_of_node.push_back(static_cast<std::size_t>(homes_[0]->rank(p)));
    return rank_of_node;
  }
  /// True if every rank keeps its patches; in any case the rings must be right.
  bool keeps(const Nodes& nodes, const std::vector<std::size_t>& rank_of_node) {
    std::vector<std::shared_ptr<const Partition>> before;
    for (const auto& h : homes_) before.push_back(h != nullptr ? h->partition() : nullptr);
    EXPECT_TRUE(is_serial(Set(nodes), run(nodes, rank_of_node, options_, homes_)));
    std::size_t kept = 0;
    for (std::size_t r = 0; r < kRanks; ++r)
      kept += homes_[r] != nullptr && homes_[r]->partition() == before[r];
    EXPECT_TRUE(kept == 0 || kept == kRanks) << kept;
    return kept > 0;
  }
  /// Sends nodes home repeatedly until the patches are kept: each new sample balances them better.
  bool keeps_soon(const Nodes& nodes) {
    for (int k = 0; k < 5; ++k)
      if (keeps(nodes, at_home(nodes))) return true;
    return false;
  }
  static Nodes moved(Nodes nodes, double distance) {
    point_sets::Random random(7);
    for (Point& p : nodes) p = beside(p, distance, random);
    return nodes;
  }

  void SetUp() override {
    options_.with_neighbours = true;
    std::vector<std::size_t> slices;
    for (std::size_t i = 0; i < nodes_.size(); ++i) slices.push_back(i * kRanks / nodes_.size());
    EXPECT_FALSE(keeps(nodes_, slices));
    EXPECT_FALSE(keeps(nodes_, slices));  // most are on another rank than where they belong
    EXPECT_TRUE(keeps_soon(nodes_));
  }

  const Nodes nodes_ = Set(point_sets::make("variable", 8000, 3)).nodes;
  ParallelOptions options_;
  std::vector<std::unique_ptr<Homes>> homes_{kRanks};
};

TEST_F(KeptPatches, WhereNodesAreAtHomeAndWhereTheyMoveALittle) {
  EXPECT_TRUE(keeps(nodes_, at_home(nodes_)));
  const Nodes shaken = moved(nodes_, 1e-3);
  EXPECT_TRUE(keeps(shaken, at_home(nodes_)));
  EXPECT_TRUE(keeps(shaken, at_home(shaken)));
}

TEST_F(KeptPatches, NotWhereNodesAreElsewhere) { EXPECT_FALSE(keeps(moved(nodes_, 1), at_home(nodes_))); }

TEST_F(KeptPatches, NotForOtherPredicatesKindsOrNumbersOfPatches) {
  Nodes longer = nodes_;
  for (std::size_t i = 0; i < longer.size(); i += 2) longer[i] = scaled(3, longer[i]);
  EXPECT_FALSE(keeps(longer, at_home(longer)));
  EXPECT_TRUE(keeps_soon(longer));
  options_.partition = PartitionKind::stripes;
  EXPECT_FALSE(keeps(longer, at_home(longer)));
  EXPECT_TRUE(keeps_soon(longer));
  options_.patches = 2;
  EXPECT_FALSE(keeps(longer, at_home(longer)));
  EXPECT_TRUE(keeps_soon(longer));
}

/// Found by walks around others' nodes where these are few, else in one pass over all faces.
TEST(PatchHull, VisitsEachFaceAtTheBorderOnce) {
  for (const std::size_t own : {1u, 500u, 1000u, 1900u, 1990u}) {
    const Set set(point_sets::make("random", 2000, 4));
    std::vector<SentNode> records;
    for (std::size_t i = 0; i < set.nodes.size(); ++i)
      records.push_back({set.nodes[i], GlobalNumber{static_cast<std::int64_t>(i) + 1}});
    const PatchNodes nodes{records.data(), own, records.size() - own};
    Workspace workspace(PatchHull<std::int32_t>::workspace_bytes(nodes.count()));
    PatchHull<std::int32_t> hull(Places(Lengths::as_given, 0));
    hull.set_up(nodes, {}, workspace);
    hull.build();
    std::map<HullFace, int> expected, visits;
    for (HullFace t = 0; t < hull.growing().face_count(); ++t) {
      const auto& v = hull.face(t).vertex;
      const int count = hull.is_own(v[0]) + hull.is_own(v[1]) + hull.is_own(v[2]);
      if (count > 0 && count < 3) expected[t] = 1;
    }
    hull.for_each_face_at_border(0, [&](HullFace t) { ++visits[t]; });
    EXPECT_EQ(visits, expected) << own;
    EXPECT_FALSE(visits.empty());
  }
}

/// Calls that keep patches of the last one: the nodes stay, move, leave, are renumbered or
/// are others; the next call finds them at home, or where they were.
TEST(SequencesOfCalls, GiveTheSerialRings) {
  std::vector<std::string> families = kFamilies;
  for (const point_sets::Distribution& d : point_sets::distributions())
    if (d.limit <= 4) families.push_back(d.name);
  for (int k = 0; k < cases(60); ++k) {
    point_sets::Random random(static_cast<std::uint64_t>(k) + 1);
    const auto any_of = [&](std::size_t count) { return random.below(count); };
    const std::size_t ranks = 2 + any_of(11);
    ParallelOptions options;
    options.partition = any_of(4) == 0 ? PartitionKind::stripes : PartitionKind::bisection;
    options.patches = 1 + static_cast<int>(any_of(2));
    options.with_neighbours = true;
    options.most_questions = any_of(3) == 0 ? 0 : SIZE_MAX;  // 0: one rank, unless all lists match
    std::string family = families[any_of(families.size())];
    const auto nodes_of = [&] {
      return point_sets::make(family, static_cast<std::size_t>(20 * std::pow(100, random.uniform())),
                              random.below(1000));
    };
    Nodes nodes = nodes_of();
    std::vector<std::unique_ptr<Homes>> homes(ranks);
    std::string history = std::to_string(k + 1) + " on " + std::to_string(ranks) + ":";
    for (int call = 0; call < 6; ++call) {
      const std::size_t change = call == 0 ? 0 : any_of(6);
      if (change == 1) nodes.resize(nodes.size() - any_of(nodes.size() / 4));
      if (change == 2) std::reverse(nodes.begin(), nodes.end());
      if (change == 3) {
        const double far = std::pow(10, random.uniform(-9, 0));
        for (Point& p : nodes) p = beside(p, far, random);
      }
      if (change == 4) {
        family = families[any_of(families.size())];
        nodes = nodes_of();
      }
      history += " " + family + " " + std::to_string(nodes.size()) + " " + std::to_string(change) + ",";
      const Set set(nodes);
      if (!set.coincident.empty()) break;
      nodes = set.nodes;
      std::vector<std::size_t> rank_of_node;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        rank_of_node.push_back(homes[0] != nullptr && change < 5
                                   ? static_cast<std::size_t>(homes[0]->rank(nodes[i]))
                                   : i * ranks / nodes.size());
      const Outcome out = run(nodes, rank_of_node, options, homes);
      ASSERT_TRUE(is_serial(set, out)) << history;
      ASSERT_TRUE(has_outside(set, rank_of_node, out)) << history;
    }
  }
}

/// Then one rank triangulates all. Homes stay those of the many patches.
TEST(GivingUp, OfRanksLeavesAllToOne) {
  const Set set(point_sets::make("ring", 3000, 1));
  ParallelOptions options;
  options.most_questions = 0;
  options.threads = 2;
  const auto by_thirds = [](const Point& p) { return p.x < 0 ? 0 : 1 + (p.y > 0); };
  for (const bool is_given : {false, true}) {
    if (is_given)
      options.given = std::make_shared<Partition>(
          3, Partition::Rule{by_thirds, [](PatchNumber, const Point&) { return false; }});
    std::vector<std::unique_ptr<Homes>> homes(3);
    std::vector<std::size_t> rank_of_node;
    for (std::size_t i = 0; i < set.nodes.size(); ++i) rank_of_node.push_back(i % 3);
    const Outcome out = run(set.nodes, rank_of_node, options, homes);
    EXPECT_TRUE(is_serial(set, out));
    EXPECT_EQ(out.cost[2].in_one_patch, 1) << is_given;
    EXPECT_EQ(homes[0]->partition()->patches(), 3);
  }
}

TEST(Ranks, MayHaveNoPatch) {
  const Set set(point_sets::make("random", 3000, 1));
  std::vector<std::size_t> rank_of_node;
  for (std::size_t i = 0; i < set.nodes.size(); ++i) rank_of_node.push_back(i % 3);
  for (const auto& patches : {std::vector{2, 2, 0}, std::vector{0, 2, 2}, std::vector{2, 0, 2}}) {
    std::vector<std::unique_ptr<Homes>> homes(3);
    const Outcome out = run(set.nodes, rank_of_node, {}, homes, patches);
    EXPECT_TRUE(is_serial(set, out));
    EXPECT_EQ(out.cost[0].in_one_patch, 0);
  }
}

/// Nodes of the sample that close the far side: those that were not delivered, even if by now the partition
/// says that they are in the halo.
TEST(ClosingNodes, AreThoseThatWereNotDelivered) {
  const Set set(point_sets::make("random", 300, 1));
  const std::vector<std::size_t> rank_of_node(set.nodes.size(), 0);
  std::atomic<std::size_t> asked = 0;
  ParallelOptions options;
  options.patches = 2;
  options.given = std::make_shared<Partition>(
      2, Partition::Rule{[](const Point& p) { return p.x < 0 ? 0 : 1; },
                         [&](PatchNumber, const Point&) { return ++asked > set.nodes.size(); }});
  std::vector<std::unique_ptr<Homes>> homes(1);
  const Outcome out = run(set.nodes, rank_of_node, options, homes);
  EXPECT_TRUE(is_serial(set, out));
  EXPECT_EQ(out.cost[0].in_one_patch, 0);
}

template <class Thrown>
void expect_agreed(const Thrown& thrown, std::int32_t code) {
  ThreadRanks::run(2, [&](Communicator& ranks) {
    const auto body = [&] {
      if (ranks.rank() == 1) throw thrown;
      return Parcels{{}, {0, 0, 0}};
    };
    const auto expect = [&](const auto& collective) {
      try {
        collective();
        ADD_FAILURE() << "no exception";
      } catch (const AgreedFailure& failure) {
        EXPECT_EQ(failure.code, code);
      } catch (const Thrown&) {
        EXPECT_EQ(code, 0);
      }
    };
    expect([&] { in_agreement(ranks, body); });
    expect([&] { exchange_in_agreement(ranks, body); });
  });
}

TEST(Agreement, TellsFailuresOfAnyCodeFromVotes) {
  for (const std::int32_t code : {-1, -2, -6, -100}) expect_agreed(Failure(code), code);
  expect_agreed(std::bad_alloc(), -6);
  expect_agreed(HiddenNode(), 0);
  expect_agreed(PatchesDoNotPay(), 0);
}

TEST(Agreement, PassesOnTheCodeOfACommunicatorThatFails) {
  const auto code_of_exchange = [](Communicator& ranks, const auto& body) {
    try {
      exchange_in_agreement(ranks, body);
      return 0;
    } catch (const AgreedFailure& failure) {
      return static_cast<int>(failure.code);
    }
  };
  const auto nothing = [] { return Parcels{{}, {0, 0}}; };
  SingleProcess alone;
  EXPECT_EQ(code_of_exchange(alone, nothing), 0);
  EXPECT_EQ(code_of_exchange(alone, []() -> Parcels { throw std::bad_alloc(); }), -6);
  struct Failing final : SingleProcess {
    Parcels exchange(const Parcels&, std::int32_t) override { throw AgreedFailure(-6); }
  } failing;
  EXPECT_EQ(code_of_exchange(failing, nothing), -6);
}

/// The cost of a triangulation of 20,000 nodes by one rank.
ParallelCost cost_of(const std::string& family, int patches, std::size_t most_questions) {
  const Set set(point_sets::make(family, 20000, 1));
  SingleProcess process;
  const LocalNodes local{set.nodes.data(), set.nodes.size()};
  ParallelOptions options;
  options.patches = patches;
  options.most_questions = most_questions;
  const Point corners[3] = {set.nodes[0], set.nodes[1], set.nodes[2]};
  ParallelCost cost;
  triangulate<std::int32_t>(local, check_nodes(local.points, local.count), corners, {1, 2, 3}, process,
                            options, &cost);
  return cost;
}

TEST(GivingUp, WhereThereAreTooManyQuestions) { EXPECT_EQ(cost_of("ring", 4, 100).in_one_patch, 1); }

TEST(GivingUp, BeforeTheTriangulationWherePatchesWouldNotPay) {
  for (const char* family : {"moment:6", "crossing:1e-3", "nest:150"}) {
    const ParallelCost cost = cost_of(family, 2, 2500);
    EXPECT_EQ(cost.in_one_patch, 1) << family;
    EXPECT_EQ(cost.halo, 0) << family << ": nodes were delivered";
  }
}

TEST(GivingUp, NotWhereTheyPay) {
  for (const char* family :
       {"random", "latlon", "earth", "variable:1e6", "hemisphere", "box", "cap:0.0175", "strip:1e-15",
        "comb:1e-9", "ulp-groups:8", "tracks:50", "coast:0.3", "cap:1e-12", "axis-cap:1e-150",
        "small-circle:1", "hemisphere-rim", "ellipse:1e-9", "two-curves:1e-3"})
    EXPECT_EQ(cost_of(family, 2, 2500).in_one_patch, 0) << family;
}

TEST(GivingUp, NodesThatAreCloseTogetherAreNoReasonToAsk) {
  for (const char* family :
       {"random", "cap:1e-6", "cap:1e-10", "dense-cap:1e-7", "pairs:1e-10", "ulp-groups:8"})
    EXPECT_EQ(cost_of(family, 16, 4000).in_one_patch, 0) << family;
  for (const char* family : {"random", "cap:1e-6", "axis-cap"})
    EXPECT_EQ(cost_of(family, 16, 300).in_one_patch, 0) << family;
}

// ---- agreement --------------------------------------------------------------------------------------

/// A ring of nodes around a few others, each of which is a hub: triangles with two and with three hubs.
TEST(Agreement, OfHubsThatAreNeighbours) {
  for (const std::size_t inside : {2u, 3u, 7u})
    for (const double height : {0.5, -0.3}) {
      Nodes nodes;
      point_sets::Random random(inside);
      const auto on_parallel = [](double z, double phi) {
        return point_sets::normalized(
            {std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z});
      };
      for (int i = 0; i < 3000; ++i) nodes.push_back(on_parallel(height, random.uniform(0, 6.28)));
      for (std::size_t i = 0; i < inside; ++i)
        nodes.push_back(on_parallel(0.97, 6.28 * static_cast<double>(i) / static_cast<double>(inside)));
      nodes.push_back({0, 0, -1});
      const Set set(nodes);
      for (const int ranks : {4, 8}) {
        const Outcome out =
            run(set.nodes, {ranks, 1, PartitionKind::bisection, Brings::every_other}, true, 2);
        EXPECT_TRUE(is_serial(set, out)) << inside << " " << ranks;
        EXPECT_GT(out.cost[0].rounds, 0);
      }
    }
}

/// The neighbours of hubs come from many ranks.
TEST(Agreement, TellsEachRankTheNeighboursThatItHasNotBrought) {
  for (const char* family : {"ring", "moment:6", "crossing:1e-3", "random"})
    for (const Brings brings : {Brings::every_other, Brings::home, Brings::rank_0}) {
      const Set set(point_sets::make(family, 3000, 6));
      const Configuration c{5, 2, PartitionKind::bisection, brings};
      const Outcome out = run(set.nodes, c, true, 2);
      ASSERT_TRUE(is_serial(set, out)) << family;
      ASSERT_TRUE(has_outside(set, ranks_that_bring(set.nodes, c), out)) << family;
    }
}

TEST(Agreement, FindsNodesThatCoincide) {
  for (const char* family : {"random", "ring", "crossing:1e-3"})
    for (const std::size_t closing_nodes : {2u, 256u}) {
      Nodes nodes = point_sets::make(family, 3000, 4);
      nodes[1500] = nodes[20];
      nodes[700] = nodes[20];
      const Outcome out =
          run(nodes, {4, 2, PartitionKind::bisection, Brings::every_other}, true, closing_nodes);
      for (const auto& stars : out.stars) {
        EXPECT_EQ(first_coincidence(stars.coincident).l, 21);
        EXPECT_EQ(first_coincidence(stars.coincident).m, 701);
        EXPECT_EQ(stars.coincident, out.stars[0].coincident);
      }
    }
}

TEST(Halo, IsThinWhereDensityVaries) {
  const std::pair<const char*, int> most[] = {
      {"random", 8500}, {"clusters:1e-7", 8500}, {"falling:14", 40000}, {"axis-cap", 14000}};
  for (const auto& [family, nodes] : most) EXPECT_LT(cost_of(family, 16, SIZE_MAX).halo, nodes) << family;
}

// ---- the partition ----------------------------------------------------------------------------------

TEST(Partitions, MarginIsWhatIsWithinReach) {
  for (const auto& [kind, name] : kPartitions)
    for (const char* family : {"random", "variable:1e6", "clusters", "latlon", "cap"}) {
      const Nodes nodes = point_sets::make(family, 4000, 1);
      for (const int patches : {1, 2, 3, 13, 64}) {
        const Partition partition(kind, patches, nodes, nodes.size());
        ASSERT_EQ(partition.patches(), patches);
        std::vector<std::uint32_t> owners(nodes.size());
        std::vector<double> nearest_plane(nodes.size());
        partition.owners(nodes.data(), nodes.size(), owners.data(), nearest_plane.data());
        std::vector<std::vector<bool>> in_halo(nodes.size(),
                                               std::vector<bool>(static_cast<std::size_t>(patches), false));
        partition.for_each_margin(nodes.data(), nodes.size(), owners.data(), nearest_plane.data(),
                                  [&](std::size_t i, int q) {
                                    ASSERT_FALSE(in_halo[i][static_cast<std::size_t>(q)]) << "twice";
                                    in_halo[i][static_cast<std::size_t>(q)] = true;
                                  });
        for (std::size_t i = 0; i < nodes.size(); i += 7) {
          const Point& x = nodes[i];
          ASSERT_EQ(static_cast<int>(owners[i]), partition.owner(x));
          for (int q = 0; q < patches; ++q)
            ASSERT_EQ(in_halo[i][static_cast<std::size_t>(q)],
                      q != partition.owner(x) && partition.distance(q, x) <= partition.reach(x))
                << family << ", " << name << ", patch " << q << " of " << patches;
        }
      }
    }
}

std::size_t most_of_a_patch(const Partition& partition, const Nodes& nodes) {
  std::vector<std::size_t> count(static_cast<std::size_t>(partition.patches()));
  for (const Point& x : nodes) ++count[static_cast<std::size_t>(partition.owner(x))];
  return *std::max_element(count.begin(), count.end());
}

TEST(Partitions, BisectionIsBalancedWhateverTheDensity) {
  for (const char* family : {"random", "variable:1e6", "clusters", "dense-cap", "cap"}) {
    const Nodes nodes = point_sets::make(family, 20000, 1);
    const Partition partition(PartitionKind::bisection, 13, nodes, nodes.size());
    EXPECT_LE(most_of_a_patch(partition, nodes), 20000 / 13 + 5) << family;
  }
}

// A sample of a few nodes per patch leaves some patches much too large.
TEST(Partitions, CutsAreMovedToWhereAllNodesAreShared) {
  constexpr int kPatches = 24;
  for (const char* family : {"random", "variable:1e6", "clusters", "dense-cap", "cap"}) {
    const Nodes nodes = point_sets::make(family, 100000, 1);
    const LocalNodes local{nodes.data(), nodes.size()};
    std::vector<SentNode> sample(sample_size(nodes.size(), kPatches));
    write_share(local, sample.size(), sample.data());
    Nodes places;
    for (const SentNode& r : sample) places.push_back(r.point);
    const auto most = [&](const Cuts& cuts) {
      return static_cast<double>(most_of_a_patch(Partition(cuts, nodes.size()), nodes)) * kPatches /
             static_cast<double>(nodes.size());
    };
    auto counted = places_to_count(local, nodes.size(), kPatches, Places(Lengths::as_given, 0));
    const Cuts cuts = Cuts::of_sample(kPatches, places, {counted.begin(), counted.end()});
    EXPECT_GT(most(Cuts::of_sample(kPatches, places)), 1.15) << family;
    EXPECT_LT(most(cuts), 1.02) << family;
  }
}

// Equal heights, fewer places than patches, or nothing counted: the cuts stay where they are.
TEST(Partitions, CutsStayWhereThereIsNothingToCount) {
  for (const std::size_t n : {0, 1, 2, 30}) {
    const Nodes places(n, {0.6, 0.8, 0});
    const Cuts at_medians = Cuts::of_sample(5, places);
    for (const Nodes& counted : {Nodes(), places}) {
      const Cuts cuts = Cuts::of_sample(5, places, counted);
      ASSERT_EQ(cuts.all().size(), 4u);
      for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(cuts.all()[k].height, at_medians.all()[k].height);
      EXPECT_EQ(Partition(cuts, n).patches(), 5);
    }
  }
  EXPECT_EQ(Cuts::levels(1), 0);
  EXPECT_TRUE(Cuts::of_sample(1, Nodes(7, {1, 0, 0})).all().empty());
}

// Stripes are cut along z even where their nodes hardly differ in it: differences without a finite inverse.
TEST(Partitions, OfNodesWhoseHeightsHardlyDiffer) {
  for (const double height : {0.0, 5e-324, 1e-310, 1e-200, 1e-17}) {
    point_sets::Random random(3);
    Nodes nodes;
    for (int k = 0; k < 400; ++k) {
      const double phi = random.uniform(0, 6.28), z = k % 3 == 0 ? 0 : height * random.uniform(0, 1);
      nodes.push_back({std::cos(phi), std::sin(phi), z});
    }
    for (const PartitionKind kind : {PartitionKind::bisection, PartitionKind::stripes}) {
      const Partition partition(kind, 7, nodes, nodes.size());
      EXPECT_LE(most_of_a_patch(partition, nodes), 400 / 7 + 3) << height;
    }
  }
}

// Slices as in pool and comm mode, from which pictures of owners are made.
TEST(Partitions, OverRanksAreThoseOfTheTriangulation) {
  const Nodes nodes = point_sets::make("variable", 3001);
  for (const PartitionKind kind : {PartitionKind::bisection, PartitionKind::stripes}) {
    constexpr int kRanks = 7;
    const Partition expected = partition_over_ranks(kind, kRanks, nodes);
    ThreadRanks::run(kRanks, [&](Communicator& ranks) {
      const auto r = static_cast<std::size_t>(ranks.rank());
      const std::size_t first = slice_begin(nodes.size(), r, kRanks);
      const LocalNodes local{nodes.data() + first, slice_begin(nodes.size(), r + 1, kRanks) - first, nullptr,
                             static_cast<std::int64_t>(first) + 1};
      ParallelOptions options;
      options.partition = kind;
      const auto stars = triangulate<std::int32_t>(local, check_of_all(local, ranks),
                                                   {nodes[0], nodes[1], nodes[2]}, {1, 2, 3}, ranks, options);
      for (const Point& p : nodes) ASSERT_EQ(stars.homes->rank(p), expected.owner(p));
    });
  }
}

TEST(Workspace, ArraysBeginWithCacheLinesAndEndInsideIt) {
  std::vector<unsigned char> memory(4096 + 64);
  for (std::size_t beyond = 0; beyond < 64; ++beyond) {
    unsigned char* const begin = memory.data() + beyond;
    Workspace workspace(begin, 4096);
    std::vector<std::pair<unsigned char*, std::size_t>> arrays;
    for (const std::size_t size : {1, 63, 64, 65, 200, 500}) {
      arrays.emplace_back(workspace.for_call<unsigned char>(size), size);
      arrays.emplace_back(workspace.for_phase<unsigned char>(size), size);
    }
    std::sort(arrays.begin(), arrays.end());
    const unsigned char* end = begin;
    for (const auto& [array, size] : arrays) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array) % 64, 0u);
      EXPECT_GE(array, end);
      end = array + size;
    }
    EXPECT_LE(end, begin + 4096);
    EXPECT_THROW(workspace.for_call<unsigned char>(2500), std::length_error);
  }
  EXPECT_THROW(Workspace(memory.data() + 1, 10).for_call<unsigned char>(1), std::length_error);
}

}  // namespace
