// Stars that stay on their ranks while the nodes move; ranks are threads of this process. The stars must be
// those of a new triangulation, or all ranks must return false. Also the rings of slices that follow such
// stars.

#include "parallel/moving_stars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <string>

#include "base/workspace.h"
#include "parallel/agreement.h"
#include "parallel/partition.h"
#include "parallel/relocation.h"
#include "parallel/triangulate.h"
#include "point_sets.h"
#include "support/cases.h"
#include "support/hull_rings.h"
#include "support/moves.h"
#include "support/room_in_cache.h"
#include "support/thread_ranks.h"

namespace {

using namespace pstripack;
using point_sets::make;
using point_sets::Random;

/// The rings of one hull of all nodes; none if nodes coincide.
std::optional<Rings> rings_of_one_hull(const Nodes& nodes) {
  Workspace workspace(workspace_bytes(nodes.size()));
  const Hull hull = delaunay(nodes.data(), nodes.size(), workspace);
  if (!hull.coincident.empty()) return {};
  return rings_of_hull(hull, nodes.size());
}

/// Numbers that do not fit 32 bits, or nodes from 1.
template <class Int>
std::int64_t number_of(std::size_t node) {
  return static_cast<std::int64_t>(node) * (sizeof(Int) == 8 ? std::int64_t{1} << 33 : 1) + 1;
}

NodeRanges ranges_of(const LocalNodes& nodes, Communicator& ranks) {
  return NodeRanges(ranks.all_gather_one(static_cast<std::int64_t>(nodes.count)),
                    static_cast<std::size_t>(ranks.size()));
}

struct Tally {
  int warm = 0, refused = 0, cold = 0, rounds = 0;
  int laid_out_anew = 0;  ///< calls that wrote all rings, not only those that changed
  std::size_t flips = 0;
};

/// One rank: its nodes, their stars, and those of the last call.
template <class Int>
class OneRank {
 public:
  explicit OneRank(Communicator& ranks) : ranks_(ranks) {}

  /// A call with the nodes `mine`.
  void call(const Nodes& nodes, std::vector<std::size_t> mine, const std::optional<Rings>& right,
            Tally& tally) {
    Nodes here;
    std::vector<std::int64_t> numbers;
    for (const std::size_t i : mine) {
      here.push_back(nodes[i]);
      numbers.push_back(number_of<Int>(i));
    }
    const LocalNodes local{here.data(), here.size(), numbers.data()};
    mine_ = std::move(mine);
    numbers_ = numbers;
    if (moving_ != nullptr) {
      if (moving_->repair(local, ranks_)) {
        update(tally);
        ++tally.warm;
        tally.flips += moving_->flips();
        tally.rounds = std::max(tally.rounds, moving_->rounds());
        EXPECT_TRUE(right) << "stars of nodes that have none";
        EXPECT_TRUE(sample_of(stars_, ranges_, static_cast<RankNumber>(ranks_.rank())).fits(local.points));
        if (right) compare(nodes, *right);
        return;
      }
      ++tally.refused;
    }
    ++tally.cold;
    moving_.reset();
    stars_ = {};
    NodeCheck check = check_nodes(local.points, local.count);
    agree_on(check, ranks_);
    ranges_ = ranges_of(local, ranks_);
    const LocalNodes counted{local.points, local.count, nullptr, ranges_.first(me_)};
    std::int64_t corner[3] = {0, 0, 0};
    for (std::size_t i = 0; i < mine_.size(); ++i)
      if (mine_[i] < 3) corner[mine_[i]] = value_of(counted.number(i));
    ranks_.all_sum(corner, 3);
    const Point corners[3] = {nodes[0], nodes[1], nodes[2]};
    ParallelOptions options;
    options.with_neighbours = true;
    stars_ = triangulate<Int>(counted, check, corners, {corner[0], corner[1], corner[2]}, ranks_, options);
    if (!stars_.coincident.empty()) return;
    stars_.halo = fetch_halo(stars_.outside, local, ranges_, ranks_);
    if (check.lengths_are_one.value) moving_ = MovingStars::make(local, ranges_, stars_, ranks_);
    if (right) compare(nodes, *right);
  }

 private:
  void update(Tally& tally) {
    std::vector<const Int*> before;
    for (std::size_t i = 0; i < mine_.size(); ++i) before.push_back(stars_.of_node[i].begin);
    moving_->update(stars_);
    std::size_t written = 0;
    for (std::size_t i = 0; i < mine_.size(); ++i) written += stars_.of_node[i].begin != before[i];
    if (stars_.memory.size() == 1 && written == mine_.size() && !mine_.empty()) {
      ++tally.laid_out_anew;
    } else if (moving_->rounds() == 0 && moving_->flips() == 0) {
      EXPECT_EQ(written, 0u);
    }
  }
  void compare(const Nodes& nodes, const Rings& right) {
    std::set<std::int64_t> outside;
    const std::set<std::int64_t> own(numbers_.begin(), numbers_.end());
    ASSERT_EQ(stars_.of_node.size(), mine_.size());
    for (std::size_t i = 0; i < mine_.size(); ++i) {
      std::vector<std::int64_t> expected, found;
      for (const std::int32_t b : right.neighbours[mine_[i]]) {
        expected.push_back(number_of<Int>(static_cast<std::size_t>(b)));
        if (own.count(expected.back()) == 0) outside.insert(expected.back());
      }
      if (right.boundary[mine_[i]]) expected.back() = -expected.back();
      const Ring<Int> ring = stars_.of_node[i];
      for (std::uint32_t k = 0; k < ring.count; ++k)
        found.push_back((ring.begin[k] < 0 ? -1 : 1) * number(named_by(ring.begin[k])));
      if (found.back() > 0)
        std::rotate(found.begin(), std::min_element(found.begin(), found.end()), found.end());
      ASSERT_EQ(found, expected) << "node " << mine_[i];
    }
    ASSERT_EQ(stars_.outside.size(), outside.size());
    auto number = outside.begin();
    for (const HaloNode& r : stars_.outside) {
      ASSERT_EQ(value_of(r.number), *number++);
      ASSERT_EQ(r.point, nodes[static_cast<std::size_t>((value_of(r.number) - 1) / (number_of<Int>(1) - 1))]);
    }
  }

  /// The caller's number of a node that is here or outside.
  std::int64_t number(GlobalNumber counted) const {
    if (ranges_.is_of(me_, counted)) return numbers_[ranges_.address(counted).node];
    for (const HaloNode& node : stars_.outside)
      if (node.counted == counted) return value_of(node.number);
    ADD_FAILURE() << "no such node";
    return 0;
  }

  Communicator& ranks_;
  const RankNumber me_ = static_cast<RankNumber>(ranks_.rank());
  NodeRanges ranges_;
  std::vector<std::size_t> mine_;
  std::vector<std::int64_t> numbers_;
  Stars<Int> stars_;
  std::unique_ptr<MovingStars> moving_;
};

/// The ranks of nodes by patches.
std::vector<int> patches_of(const Nodes& nodes, int size) {
  const Partition home(PartitionKind::bisection, size, nodes, nodes.size());
  std::vector<int> owner;
  for (const Point& p : nodes) owner.push_back(home.owner(p));
  return owner;
}

using NodesOfRank = std::vector<std::vector<std::size_t>>;
NodesOfRank nodes_of_ranks(const std::vector<int>& owner, int size) {
  NodesOfRank mine(static_cast<std::size_t>(size));
  for (std::size_t i = 0; i < owner.size(); ++i) mine[static_cast<std::size_t>(owner[i])].push_back(i);
  return mine;
}

/// Calls with these sets, one after another, on `size` ranks. `owner`: the rank of each node; empty: by
/// patches of the first set.
template <class Int = std::int32_t>
Tally follow(const std::vector<Nodes>& sets, int size, const std::vector<int>& owner = {}) {
  const NodesOfRank mine = nodes_of_ranks(owner.empty() ? patches_of(sets[0], size) : owner, size);
  std::vector<std::optional<Rings>> right;
  for (const Nodes& nodes : sets) right.push_back(rings_of_one_hull(nodes));
  std::vector<Tally> tally(static_cast<std::size_t>(size));
  ThreadRanks::run(size, [&](Communicator& ranks) {
    const auto r = static_cast<std::size_t>(ranks.rank());
    OneRank<Int> rank(ranks);
    for (std::size_t s = 0; s < sets.size(); ++s) rank.call(sets[s], mine[r], right[s], tally[r]);
  });
  for (const Tally& t : tally) {
    EXPECT_EQ(t.warm, tally[0].warm);
    EXPECT_EQ(t.refused, tally[0].refused);
    EXPECT_EQ(t.rounds, tally[0].rounds);
  }
  for (std::size_t r = 1; r < tally.size(); ++r) tally[0].flips += tally[r].flips;
  return tally[0];
}

constexpr int kSizes[] = {1, 2, 3, 5, 8};

/// The same on every number of ranks. Returns how many calls began with the last stars. `expect`: further
/// checks.
int follow_on_all(
    const std::vector<Nodes>& sets, const std::function<void(const Tally&)>& expect = [](const Tally&) {}) {
  int warm = 0;
  for (const int size : kSizes) {
    SCOPED_TRACE(std::to_string(size) + " ranks");
    const Tally tally = follow(sets, size);
    expect(tally);
    warm += tally.warm;
    if (::testing::Test::HasFailure()) break;
  }
  return warm;
}

TEST(MovingStars, FollowNodesThatMoveALittle) {
  Random random(1);
  int rounds = 0;
  for (const double fraction : {1e-16, 1e-3, 0.02, 0.05}) {
    SCOPED_TRACE(fraction);
    const int calls = cases(fraction < 1e-3 ? 4 : 16);
    const auto sets = sets_of(make("fibonacci", 800, 1), calls,
                              [&](Nodes& nodes, int) { move_all(nodes, fraction * spacing(800), random); });
    const Tally alone = follow(sets, 1);
    EXPECT_EQ(alone.rounds, 0);
    if (fraction < 0.05) {
      EXPECT_EQ(alone.warm, calls - 1);
    }
    follow_on_all(sets, [&](const Tally& tally) {
      EXPECT_EQ(tally.warm, alone.warm);
      if (fraction < 0.05) {
        EXPECT_EQ(tally.flips, alone.flips);
      }
      rounds = std::max(rounds, tally.rounds);
    });
  }
  EXPECT_GT(rounds, 1) << "no flips next to each other across ranks";
}

TEST(MovingStars, FollowOrRefuseLargeMoves) {
  Random random(2);
  for (const double fraction : {0.1, 0.3, 1.0}) {
    SCOPED_TRACE(fraction);
    const int warm = follow_on_all(sets_of(make("fibonacci", 500, 1), cases(6), [&](Nodes& nodes, int) {
      move_all(nodes, fraction * spacing(500), random);
    }));
    if (fraction == 0.1) {
      EXPECT_GT(warm, 0);
    }
    if (fraction == 1) {
      EXPECT_EQ(warm, 0);
    }
  }
}

/// Nodes of a lattice move by a rounding and come back: nearly all arcs are ties then.
TEST(MovingStars, FollowTiesThatAppearAndVanish) {
  Random random(3);
  for (const std::string family : {"icosahedral", "cubed-sphere"}) {
    SCOPED_TRACE(family);
    Nodes first = make(family, 600, 1);
    for (std::uint64_t seed = 1; left(first[0], first[1], first[2]) == 0; ++seed)
      point_sets::shuffle(first, seed);
    const int warm = follow_on_all(sets_of(first, cases(8), [&](Nodes& nodes, int step) {
      if (step % 2 == 0)
        nodes = first;
      else
        move_all(nodes, 1e-15, random);
    }));
    EXPECT_GT(warm, 0);
  }
}

/// All nodes rotate, so that most move to where no node of their rank was; the arcs stay the same.
TEST(MovingStars, FollowNodesThatLeaveTheirPatches) {
  const Nodes nodes = make("random", 500, 1);
  follow_on_all(sets_of(nodes, cases(6),
                        [](Nodes& p, int) {
                          rotate(p, {0.6, 0, 0.8}, 0.7);
                        }),
                [](const Tally& tally) { EXPECT_EQ(tally.refused, 0); });
}

/// Where the sphere is mirrored no triangle is counterclockwise, so none can be chosen whose interior must be
/// covered only once. Where lengths are not 1 the predicates on directions decide.
TEST(MovingStars, GoTheColdWayWhereTheMeshDoesNotFit) {
  Random random(4);
  const Nodes nodes = make("random", 500, 1);
  follow_on_all(sets_of(nodes, 14,
                        [&](Nodes& p, int step) {
                          p = nodes;
                          if (step == 2) p[77] = scaled(-1, p[77]);
                          if (step == 4) p[78] = p[79];
                          if (step == 6) p[80] = scaled(0.5, p[80]);
                          if (step == 8)
                            for (Point& q : p) q.z = std::fabs(q.z);  // a hemisphere
                          for (Point& q : p) {
                            if (step == 10) q.z = -q.z;
                            const double length = step == 12 ? 1 + 1e-4 * random.uniform() : 1;
                            q = scaled(length, q);
                          }
                        }),
                [](const Tally& tally) {
                  EXPECT_EQ(tally.refused, 8);  // the ways back from the jump and the mirror, too
                  EXPECT_GT(tally.warm, 0);
                });
}

/// Nodes of rank 1 move on among nodes of rank 0, until more have been their neighbours than rank 1 has room
/// for. A cap that stays gives rank 1 room for longer rings.
TEST(MovingStars, GoTheColdWayWhereThereIsNoRoomForNodesOutside) {
  constexpr std::size_t n = 6000, cap = 800, apart = 30;
  const Nodes nodes = make("fibonacci", n, 1);
  std::vector<int> owner(n, 0);
  for (std::size_t k = 0; k < n; ++k) owner[k] = k < cap || k % apart == 0;
  const auto sets = sets_of(nodes, 80, [&](Nodes& p, int) {
    for (std::size_t k = apart; k < n; k += apart)
      p[k] = point_sets::normalized(plus(p[k], scaled(0.1 * spacing(n), cross({0, 0, 1}, p[k]))));
  });
  const Tally tally = follow(sets, 2, owner);
  EXPECT_EQ(tally.refused, 1);
}

/// Such a mesh has as many arcs as one of the whole sphere.
TEST(MovingStars, GoTheColdWayWhereThreeNodesAreTheBoundary) {
  Random random(11);
  Nodes nodes;
  for (int k = 0; k < 3; ++k)
    nodes.push_back(point_sets::normalized({std::cos(2.1 * k), std::sin(2.1 * k), 0.1}));
  while (nodes.size() < 300)
    if (const Point p = random.direction(); p.z > 0.6) nodes.push_back(p);
  const auto sets = sets_of(nodes, 3, [](Nodes&, int) {});
  follow_on_all(sets, [](const Tally& tally) { EXPECT_EQ(tally.cold, 3); });
}

/// The neighbours of a node, on several ranks, come so close that rounded lengths hide it, or nearly.
TEST(MovingStars, FollowOrRefuseNodesThatAreNearlyHidden) {
  const Nodes nodes = make("random", 300, 1);
  const Rings rings = *rings_of_one_hull(nodes);
  const Partition home(PartitionKind::bisection, 5, nodes, nodes.size());
  Tally all;
  int tried = 0;
  for (std::size_t k = 0; k < nodes.size() && tried < cases(60); ++k) {
    const auto& ring = rings.neighbours[k];
    if (std::all_of(ring.begin(), ring.end(), [&](std::int32_t b) {
          return home.owner(nodes[static_cast<std::size_t>(b)]) == home.owner(nodes[k]);
        }))
      continue;
    ++tried;
    SCOPED_TRACE(k);
    const auto sets = sets_of(nodes, 3, [&](Nodes& p, int step) {
      p = nodes;
      if (step == 2) return;
      const double scale = 1e-8 * (1 + tried % 5);
      for (const std::int32_t b : ring) {
        Point& q = p[static_cast<std::size_t>(b)];
        const Point from = p[k], d = minus(q, from);
        q = point_sets::normalized(plus(from, scaled(scale, d)));
      }
    });
    const Tally tally = follow(sets, 5);
    all.warm += tally.warm, all.refused += tally.refused;
  }
  EXPECT_GT(all.refused, 0);
}

/// Whoever brings the nodes: ranks without a node, with one, with every other one.
TEST(MovingStars, FollowHoweverNodesAreDistributed) {
  Random random(5);
  const auto sets = sets_of(make("random", 400, 1), 6,
                            [&](Nodes& nodes, int) { move_all(nodes, 0.01 * spacing(400), random); });
  std::vector<int> owner(400, 2);
  EXPECT_GT(follow(sets, 4, owner).warm, 0) << "ranks without nodes";
  owner[17] = 3;
  EXPECT_GT(follow(sets, 4, owner).warm, 0) << "a rank with one node";
  for (std::size_t i = 0; i < owner.size(); ++i) owner[i] = static_cast<int>(i) % 2;
  EXPECT_GT(follow(sets, 2, owner).warm, 0) << "every other node";
  for (std::size_t i = 0; i < owner.size(); ++i) owner[i] = static_cast<int>(i) % 5;
  EXPECT_EQ(follow(sets, 5, owner).warm, 0) << "every rank would have nearly all nodes";

  // Nodes of ranks 0 and 1 next to each other, among those of rank 2: flips of three ranks count once.
  std::fill(owner.begin(), owner.end(), 2);
  const Nodes& first = sets[0];
  for (std::size_t i = 0; i < 22; ++i) {
    owner[i] = 0;
    const auto nearest =
        std::max_element(first.begin() + 22, first.end(),
                         [&](const Point& p, const Point& q) { return dot(p, first[i]) < dot(q, first[i]); });
    owner[static_cast<std::size_t>(nearest - first.begin())] = 1;
  }
  const auto more =
      sets_of(first, 12, [&](Nodes& nodes, int) { move_all(nodes, 0.03 * spacing(400), random); });
  const Tally three = follow(more, 3, owner), alone = follow(more, 1);
  EXPECT_GT(three.warm, 5);
  EXPECT_EQ(three.warm, alone.warm);
  EXPECT_EQ(three.flips, alone.flips);  // for these nodes: in another order there may be one more
}

/// A node loses every other neighbour of its ring. All these flips share the node, so the ranks can make only
/// one per round.
TEST(MovingStars, GoTheColdWayWhereManyFlipsWaitForEachOther) {
  const auto wheel = [](int spokes, double out) {
    Nodes nodes{{0, 0, 1}};
    for (int k = 0; k < spokes; ++k) {
      const double turn = 6.2831853071796 * k / spokes, distance = k % 2 == 0 ? 0.5 + out : 0.5;
      nodes.push_back(point_sets::normalized({distance * std::cos(turn), distance * std::sin(turn), 1}));
    }
    for (const Point& p : make("random", 4000, 1)) nodes.push_back({p.x, p.y, -std::fabs(p.z)});
    return nodes;
  };
  for (const int spokes : {40, 200}) {
    SCOPED_TRACE(spokes);
    const double out = spokes == 40 ? 2e-2 : 1e-3;
    const std::vector<Nodes> sets{wheel(spokes, -1e-5), wheel(spokes, out), wheel(spokes, out)};
    std::vector<int> owner;
    for (std::size_t i = 0; i < sets[0].size(); ++i)
      owner.push_back(i <= static_cast<std::size_t>(spokes) ? static_cast<int>(i % 2) : sets[0][i].x > 0);
    EXPECT_EQ(follow(sets, 1).warm, 2);
    const Tally tally = follow(sets, 2, owner);
    EXPECT_EQ(tally.refused, spokes == 40 ? 0 : 1);
    if (spokes == 40) {
      EXPECT_GT(tally.rounds, 10);
    }
  }
}

TEST(MovingStars, HaveNumbersOf64Bits) {
  Random random(6);
  const auto sets = sets_of(make("random", 500, 1), cases(6),
                            [&](Nodes& nodes, int) { move_all(nodes, 0.01 * spacing(500), random); });
  const Tally tally = follow<std::int64_t>(sets, 3);
  EXPECT_GT(tally.warm, 0);
  EXPECT_GT(tally.flips, 0u);
}

/// Enough calls that rewritten rings are stored together again, and rings that have grown get a new place.
TEST(MovingStars, FollowForALongTime) {
  Random random(7);
  const auto sets = sets_of(make("fibonacci", 200, 1), cases(150),
                            [&](Nodes& nodes, int) { move_all(nodes, 0.03 * spacing(200), random); });
  const Tally tally = follow(sets, 2);
  EXPECT_GT(tally.warm, cases(150) / 2);
  EXPECT_GE(tally.laid_out_anew, cases(150) / 30);
  EXPECT_LE(tally.laid_out_anew, 1 + cases(150) / 10);
}

TEST(MovingStars, CountAmongWhatStays) {
  const Nodes nodes = make("random", 500, 1);
  std::vector<std::size_t> mine(nodes.size());
  std::iota(mine.begin(), mine.end(), std::size_t{0});
  SingleProcess process;
  const std::size_t before = room_in_cache();
  {
    OneRank<std::int32_t> rank(process);
    Tally tally;
    rank.call(nodes, mine, rings_of_one_hull(nodes), tally);
    EXPECT_LT(room_in_cache(), before - 50 * nodes.size());
  }
  EXPECT_EQ(room_in_cache(), before);
}

/// Every rank must refuse what is not a relocation.
TEST(Relocation, IsOfFewNodesAndTheSame) {
  using Numbers = std::vector<std::vector<std::int64_t>>;  // of each rank
  const auto is_found = [](const Numbers& before, const Numbers& now) {
    std::vector<int> found(before.size());
    ThreadRanks::run(static_cast<int>(before.size()), [&](Communicator& ranks) {
      const auto r = static_cast<std::size_t>(ranks.rank());
      const Nodes nodes(now[r].size());
      const LocalNodes local{nodes.data(), now[r].size(), now[r].data()};
      const NodeRanges ranges = ranges_of({nodes.data(), before[r].size()}, ranks);
      found[r] = Relocation::find(before[r].data(), ranges, local, ranks).has_value();
    });
    for (const int f : found) EXPECT_EQ(f, found[0]);
    return found[0] != 0;
  };
  const Numbers last{{1, 2, 3, 4, 5, 6}, {}, {11, 12, 13, 14, 15, 16, 17, 18, 19, 20}};
  EXPECT_TRUE(is_found(last, last));
  EXPECT_TRUE(is_found(last, {{6, 1, 5, 2, 3, 4}, {}, {20, 12, 13, 14, 15, 16, 17, 18, 19, 11}}));
  EXPECT_TRUE(is_found(last, {{1, 2, 3, 4, 5, 20}, {6}, {12, 11, 13, 14, 15, 16, 17, 18, 19}}))
      << "an eighth";
  EXPECT_FALSE(is_found(last, {{1, 2, 3, 4, 20}, {5, 6}, {12, 11, 13, 14, 15, 16, 17, 18, 19}})) << "more";
  EXPECT_FALSE(is_found(last, {{1, 2, 3, 4, 5}, {}, {11, 12, 13, 14, 15, 16, 17, 18, 19, 20}})) << "one less";
  EXPECT_FALSE(is_found(last, {{1, 2, 3, 4, 5, 7}, {}, last[2]})) << "another one";
  EXPECT_FALSE(is_found(last, {{1, 2, 3, 4, 5, 5}, {}, last[2]})) << "one twice";
  EXPECT_FALSE(is_found(last, {{1, 2, 3, 4, 5}, {5}, last[2]})) << "one on two ranks";
  EXPECT_FALSE(is_found(last, {{1, 2, 3, 4}, {20}, {11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 6}}))
      << "one stays and comes";
  EXPECT_FALSE(is_found(last, {{1, 2, 3, 4, 5}, {19}, {11, 12, 13, 14, 15, 16, 17, 18, 20, 19}}));
  EXPECT_FALSE(is_found(last, {{1, 2, 3, 4, 5, 0}, {}, last[2]})) << "no number";
  EXPECT_FALSE(is_found(last, {{1, 2, 3, 4, 5, -6}, {}, last[2]}));
  EXPECT_FALSE(is_found({{1, 2, 3, 4, 5, 6, 7}, {8, 9, 10}, {11, 12, 13, 14, 15, 16}},
                        {{1, 2, 3, 4, 5, 6, 11}, {8, 9, 11}, {12, 13, 14, 15, 16, 7}}))
      << "one comes twice, and one nowhere";
}

}  // namespace
