#pragma once
// The triangulation of a set of nodes by ranks that are threads, and by one patch.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "base/workspace.h"
#include "parallel/coincidence.h"
#include "parallel/node_ranges.h"
#include "parallel/triangulate.h"
#include "point_sets.h"
#include "support/hull_rings.h"
#include "support/thread_ranks.h"

namespace {

using namespace pstripack;

/// A set of nodes, the first three of which are not on one great circle, and its rings by one patch.
struct Set {
  explicit Set(Nodes points) : nodes(std::move(points)) {
    for (std::uint64_t seed = 1; left(nodes[0], nodes[1], nodes[2]) == 0; ++seed)
      point_sets::shuffle(nodes, seed);
    Workspace workspace(workspace_bytes(nodes.size()));
    const Hull hull = delaunay(nodes.data(), nodes.size(), workspace);
    lengths = hull.lengths;
    for (const auto& [a, b] : hull.coincident)
      coincident.emplace_back(GlobalNumber{a + 1}, GlobalNumber{b + 1});
    if (!coincident.empty()) return;
    rings = rings_of_hull(hull, nodes.size());
  }
  Nodes nodes;
  Rings rings;
  Lengths lengths;
  CoincidentPairs coincident;
};

struct Outcome {
  std::vector<std::vector<std::int64_t>> ring;  // by node
  std::vector<std::int32_t> codes;              // of the ranks
  std::vector<Stars<std::int32_t>> stars;       // coincident and outside alone
  std::vector<Lengths> lengths;                 // that decided
  std::vector<ParallelCost> cost;
};

inline NodeCheck check_of_all(const LocalNodes& nodes, Communicator& ranks) {
  NodeCheck check = check_nodes(nodes.points, nodes.count);
  agree_on(check, ranks);
  return check;
}

/// name(number): the number from 1 that a node has in its set.
template <class Int, class Name>
void keep(const Stars<Int>& stars, const LocalNodes& nodes, std::size_t rank, const Name& name,
          Outcome& out) {
  for (std::size_t i = 0; i < stars.of_node.size(); ++i) {
    const Ring<Int> ring = stars.of_node[i];
    auto& kept = out.ring[static_cast<std::size_t>(value_of(name(nodes.number(i)))) - 1];
    for (std::uint32_t k = 0; k < ring.count; ++k)
      kept.push_back((ring.begin[k] < 0 ? -1 : 1) * value_of(name(named_by(ring.begin[k]))));
    if (kept.back() > 0) std::rotate(kept.begin(), std::min_element(kept.begin(), kept.end()), kept.end());
  }
  for (const auto& [a, b] : stars.coincident) out.stars[rank].coincident.emplace_back(name(a), name(b));
  out.lengths[rank] = stars.homes->lengths();
  for (const HaloNode& node : stars.outside)
    out.stars[rank].outside.push_back({node.point, node.counted, name(node.number)});
}

/// homes: of the ranks in the last call, then in this one. With neighbours, nodes are counted through all
/// ranks; in the outcome they always have their numbers in `nodes`. patches: of each rank, if not the same.
template <class Int = std::int32_t>
Outcome run(const Nodes& nodes, const std::vector<std::size_t>& rank_of_node,
            const ParallelOptions& all_options, std::vector<std::unique_ptr<Homes>>& homes,
            const std::vector<int>& patches = {}) {
  const std::size_t n = nodes.size(), size = homes.size();
  std::vector<Nodes> points(size);
  std::vector<std::vector<std::int64_t>> numbers(size);
  for (std::size_t i = 0; i < n; ++i) {
    points[rank_of_node[i]].push_back(nodes[i]);
    numbers[rank_of_node[i]].push_back(static_cast<std::int64_t>(i) + 1);
  }
  std::vector<std::int64_t> counts, all;
  for (const auto& of_rank : numbers) {
    counts.push_back(static_cast<std::int64_t>(of_rank.size()));
    all.insert(all.end(), of_rank.begin(), of_rank.end());
  }
  const NodeRanges ranges(counts.data(), size);
  const bool is_counted = all_options.with_neighbours;
  const auto name = [&](GlobalNumber number) {
    return is_counted ? GlobalNumber{all[static_cast<std::size_t>(number) - 1]} : number;
  };
  const auto number = [&](std::int64_t node) {
    return is_counted ? std::find(all.begin(), all.end(), node) - all.begin() + 1 : node;
  };
  Outcome out;
  out.ring.resize(n);
  out.codes.resize(size);
  out.stars.resize(size);
  out.lengths.resize(size);
  out.cost.resize(size);
  std::mutex mutex;
  ThreadRanks::run(static_cast<int>(size), [&](Communicator& ranks) {
    const auto r = static_cast<std::size_t>(ranks.rank());
    const LocalNodes local{points[r].data(), points[r].size(), is_counted ? nullptr : numbers[r].data(),
                           ranges.first(r)};
    ParallelOptions options = all_options;
    options.last = homes[r].get();
    if (!patches.empty()) options.patches = patches[r];
    try {
      const Point corners[3] = {nodes[0], nodes[1], nodes[2]};
      Stars<Int> stars = triangulate<Int>(local, check_of_all(local, ranks), corners,
                                          {number(1), number(2), number(3)}, ranks, options, &out.cost[r]);
      if (is_counted) stars.halo = fetch_halo(stars.outside, local, ranges, ranks);
      const std::lock_guard lock(mutex);
      keep(stars, local, r, name, out);
      homes[r] = std::move(stars.homes);
    } catch (const AgreedFailure& failure) {
      out.codes[r] = failure.code;
    }
  });
  return out;
}

inline ::testing::AssertionResult is_serial(const Set& set, const Outcome& out) {
  for (const std::int32_t code : out.codes)
    if (code != 0) return ::testing::AssertionFailure() << "code " << code;
  for (const Lengths lengths : out.lengths)
    if (lengths != set.lengths) return ::testing::AssertionFailure() << "other predicates";
  for (std::size_t k = 0; k < set.nodes.size(); ++k) {
    const auto& expected = set.rings.neighbours[k];
    std::vector<std::int64_t> ring;
    for (const std::int32_t b : expected) ring.push_back(b + 1);
    if (set.rings.boundary[k]) ring.back() = -ring.back();
    if (ring != out.ring[k]) return ::testing::AssertionFailure() << "ring of node " << k + 1 << " differs";
  }
  return ::testing::AssertionSuccess();
}

}  // namespace
