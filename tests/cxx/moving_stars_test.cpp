// Stars that stay on their ranks while the nodes move, on ranks that are threads of this process: the same
// stars as those of the triangulation made anew, or false on every rank.

#include "parallel/moving_stars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "base/workspace.h"
#include "parallel/partition.h"
#include "parallel/triangulate.h"
#include "point_sets.h"
#include "support/cases.h"
#include "support/lists.h"
#include "support/moves.h"
#include "support/thread_ranks.h"

namespace {

using namespace pstripack;
using point_sets::make;
using point_sets::Random;

/// What one hull says of the nodes. No rings where nodes coincide.
std::optional<Rings> rings_of_one_hull(const Nodes& nodes) {
  Workspace workspace(workspace_bytes(nodes.size()));
  const Hull hull = delaunay(nodes.data(), nodes.size(), workspace);
  if (!hull.coincident.empty()) return {};
  Faces faces;
  for (std::size_t t = 0; t < hull.face_count; ++t) {
    const auto& v = hull.faces[t].vertex;
    const auto node = [&](int i) { return static_cast<std::int32_t>(hull.order[v[i]]); };
    if (hull.front(t)) faces.push_back({node(0), node(1), node(2)});
  }
  return rings_of(nodes.size(), faces);
}

/// Numbers that do not fit 32 bits, or nodes from 1.
template <class Int>
std::int64_t number_of(std::size_t node) {
  return static_cast<std::int64_t>(node) * (sizeof(Int) == 8 ? std::int64_t{1} << 33 : 1) + 1;
}

struct Tally {
  int warm = 0, refused = 0, cold = 0, rounds = 0;
  std::size_t flips = 0;
};

/// One rank: its nodes, their stars, and those of the last call.
template <class Int>
class OneRank {
 public:
  OneRank(Communicator& ranks, const std::vector<std::size_t>& mine) : ranks_(ranks), mine_(mine) {
    for (const std::size_t i : mine) numbers_.push_back(number_of<Int>(i));
  }

  void call(const Nodes& nodes, const std::optional<Rings>& right, Tally& tally) {
    Nodes here;
    for (const std::size_t i : mine_) here.push_back(nodes[i]);
    const LocalNodes local{here.data(), here.size(), numbers_.data()};
    if (moving_ != nullptr) {
      if (moving_->repair(local, ranks_)) {
        moving_->update(local, stars_);
        ++tally.warm;
        tally.flips += moving_->flips();
        tally.rounds = std::max(tally.rounds, moving_->rounds());
        EXPECT_TRUE(right) << "stars of nodes that have none";
        EXPECT_TRUE(moving_->sample().fits(local.points));
        if (right) compare(nodes, *right);
        return;
      }
      ++tally.refused;
    }
    ++tally.cold;
    moving_.reset();
    stars_ = {};
    Look look = look_at(local.points, local.count);
    agree_on(look, ranks_);
    const Point corners[3] = {nodes[0], nodes[1], nodes[2]};
    ParallelOptions options;
    options.with_neighbours = true;
    stars_ = triangulate<Int>(local, look, corners, {number_of<Int>(0), number_of<Int>(1), number_of<Int>(2)},
                              ranks_, options);
    if (!stars_.coincident.empty()) return;
    if (look.lengths_are_one.value) moving_ = MovingStars::make(local, stars_, ranks_);
    if (right) compare(nodes, *right);
  }

 private:
  void compare(const Nodes& nodes, const Rings& right) {
    std::set<std::int64_t> outside;
    const std::set<std::int64_t> own(numbers_.begin(), numbers_.end());
    ASSERT_EQ(stars_.of_node.size(), mine_.size());
    for (std::size_t i = 0; i < mine_.size(); ++i) {
      std::vector<Int> expected;
      for (const std::int32_t b : right.neighbours[mine_[i]]) {
        expected.push_back(static_cast<Int>(number_of<Int>(static_cast<std::size_t>(b))));
        if (own.count(expected.back()) == 0) outside.insert(expected.back());
      }
      if (right.boundary[mine_[i]]) expected.back() = -expected.back();
      const Ring<Int> ring = stars_.of_node[i];
      ASSERT_EQ(std::vector<Int>(ring.begin, ring.begin + ring.count), expected) << "node " << mine_[i];
    }
    ASSERT_EQ(stars_.outside.size(), outside.size());
    auto number = outside.begin();
    for (const Record& r : stars_.outside) {
      ASSERT_EQ(r.number, *number++);
      ASSERT_EQ(r.point, nodes[static_cast<std::size_t>((r.number - 1) / (number_of<Int>(1) - 1))]);
    }
  }

  Communicator& ranks_;
  const std::vector<std::size_t>& mine_;
  std::vector<std::int64_t> numbers_;
  Stars<Int> stars_;
  std::unique_ptr<MovingStars> moving_;
};

/// Calls with these sets, one after another, on so many ranks. `owner`: by node; empty: by patches of the
/// first set.
template <class Int = std::int32_t>
Tally follow(const std::vector<Nodes>& sets, int size, std::vector<int> owner = {}) {
  const Partition home(PartitionKind::bisection, size, sets[0], sets[0].size());
  if (owner.empty())
    for (const Point& p : sets[0]) owner.push_back(home.owner(p));
  std::vector<std::vector<std::size_t>> mine(static_cast<std::size_t>(size));
  for (std::size_t i = 0; i < owner.size(); ++i) mine[static_cast<std::size_t>(owner[i])].push_back(i);
  std::vector<std::optional<Rings>> right;
  for (const Nodes& nodes : sets) right.push_back(rings_of_one_hull(nodes));
  std::vector<Tally> tally(static_cast<std::size_t>(size));
  ThreadRanks::run(size, [&](Communicator& ranks) {
    const auto r = static_cast<std::size_t>(ranks.rank());
    OneRank<Int> rank(ranks, mine[r]);
    for (std::size_t s = 0; s < sets.size(); ++s) rank.call(sets[s], right[s], tally[r]);
  });
  for (const Tally& t : tally) {
    EXPECT_EQ(t.warm, tally[0].warm);
    EXPECT_EQ(t.refused, tally[0].refused);
    EXPECT_EQ(t.rounds, tally[0].rounds);
  }
  for (std::size_t r = 1; r < tally.size(); ++r) tally[0].flips += tally[r].flips;
  return tally[0];
}

/// `steps` sets, each of which `move(nodes, step)` makes of the one before.
std::vector<Nodes> sets_of(Nodes nodes, int steps, const std::function<void(Nodes&, int)>& move) {
  std::vector<Nodes> sets;
  for (int step = 0; step < steps; ++step) {
    if (step > 0) move(nodes, step);
    sets.push_back(nodes);
  }
  return sets;
}

/// The same moves of the mesh as one part: as many flips.
std::size_t flips_of_one_rank(const std::vector<Nodes>& sets) { return follow(sets, 1).flips; }

constexpr int kSizes[] = {1, 2, 3, 5, 8};

TEST(MovingStars, FollowNodesThatMoveALittle) {
  Random random(1);
  int rounds = 0;
  for (const std::size_t n : {500, 2000})
    for (const double fraction : {1e-16, 1e-9, 1e-3, 0.01, 0.03}) {
      const auto sets = sets_of(make("random", n, n), 12, [&](Nodes& nodes, int) {
        move_all(nodes, fraction * spacing(n), random);
      });
      const std::size_t flips = flips_of_one_rank(sets);
      for (const int size : kSizes) {
        SCOPED_TRACE(std::to_string(size) + " ranks, " + std::to_string(n) + " nodes, " +
                     std::to_string(fraction));
        const Tally tally = follow(sets, size);
        rounds = std::max(rounds, tally.rounds);
        if (fraction < 0.01) {
          EXPECT_EQ(tally.refused, 0);
          EXPECT_EQ(tally.warm, 11);
          EXPECT_EQ(tally.flips, flips);
        }
      }
    }
  EXPECT_GT(rounds, 1) << "no flip in the neighbourhood of another, across ranks";
}

}  // namespace
