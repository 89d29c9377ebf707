// Patches that compare lists must give the serial rings whoever owns a node and whatever patches know of the
// others: random owners and halos, small sets rich in ties, rims and hidden nodes. PSTRIPACK_TEST_SETS: the
// number of sets; the usual number takes a second.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <numeric>
#include <string>

#include "base/splitmix64.h"
#include "distributions.h"
#include "parallel/partition.h"
#include "support/serial_rings.h"

namespace {

using point_sets::Random;

constexpr double kPi = 3.141592653589793;

// ---- sets -------------------------------------------------------------------------------------------

bool has_three(const Nodes& nodes) {  // not on one great circle
  for (std::size_t k = 2; k < nodes.size(); ++k)
    for (std::size_t j = 1; j < k; ++j)
      if (left(nodes[0], nodes[j], nodes[k]) != 0) return true;
  return false;
}

Point unit(const Point& p) {
  const double r = 1 / std::sqrt(dot(p, p));
  return {p.x * r, p.y * r, p.z * r};
}

/// Nodes of a small lattice of integers, in all or part of the sphere, with or without their lengths.
Nodes lattice(Random& random, std::size_t n) {
  const int largest = 1 + static_cast<int>(random.below(3));
  const std::size_t part = random.below(6), lengths = random.below(4);
  Nodes nodes;
  for (int tries = 0; nodes.size() < n && tries < 400; ++tries) {
    const auto coordinate = [&] { return static_cast<double>(random.below(2 * largest + 1)) - largest; };
    Point p{coordinate(), coordinate(), coordinate()};
    if (part == 1) p.z = std::fabs(p.z);                                  // a hemisphere, its rim included
    if (part == 2) p.z = 1;                                               // many on one plane
    if (part == 3) p.x = std::fabs(p.x), p.y = std::fabs(p.y);            // a lune
    if (part == 4) p = {std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)};  // an octant
    if (p == Point{0, 0, 0}) continue;
    if (lengths == 1) p = unit(p);
    if (lengths == 2) {
      const double r = 1 + 4e-7 * (random.uniform() - 0.5);  // hides some
      p = unit(p);
      p = {p.x * r, p.y * r, p.z * r};
    }
    if (std::none_of(nodes.begin(), nodes.end(), [&](const Point& q) { return same_direction(p, q); }))
      nodes.push_back(p);
  }
  return nodes;
}

/// Nodes most of which are on the boundary: on curves, on the rim of a closed hemisphere, at the sides of
/// polygons.
Nodes with_rim(Random& random, std::size_t n) {
  const std::size_t shape = random.below(10);
  Nodes nodes;
  for (std::size_t k = 0; k < n; ++k) {
    const double phi = random.uniform(0, 2 * kPi), c = std::cos(phi), s = std::sin(phi), r = random.uniform();
    const auto integer = [&](int low, int high) {
      return static_cast<double>(random.below(static_cast<std::uint64_t>(high - low + 1))) + low;
    };
    const double x = integer(-40, 40), y = integer(-40, 40), z = integer(1, 40);
    const Point p = unit({c, s, 0.5});
    const auto shapes = [&]() -> Point {
      switch (shape) {
        case 0:
          return unit({c, s, 1});  // a small circle
        case 1:
          return {p.x * (1 + r), p.y * (1 + r), p.z * (1 + r)};  // with different lengths
        case 2:
          return unit({c, 0.01 * s, 0.3});  // a narrow ellipse
        case 3:
          return unit({c * (1 + 1e-7 * r), s * (1 + 1e-7 * r), 0.2});  // a band along a circle
        case 4:
          return unit({r, r * r, 1});  // an arc
        case 5:
          return k % 3 == 0 ? unit({0.3, c, s}) : unit({1, 0.1 * c * r, 0.1 * s * r});  // a cap in a circle
        case 6:
          return unit({1, integer(-2, 2) + 0.01 * c * r, integer(-1, 1) + 0.01 * s * r});  // clusters
        case 7:
          return k % 3 == 0 ? Point{x, y, z} : Point{x, y, 0};  // a closed hemisphere
        case 8:
          return k % 2 == 0 ? Point{z, 0, x} : Point{z, z, y};  // a lune
        default:
          return k % 2 == 0 ? Point{x, k % 4 == 0 ? 40.0 : -40.0, 70} : Point{x, y, 70};  // a square
      }
    };
    Point q = shapes();
    if (shape == 7 && k % 9 == 1) q = {-nodes.back().x, -nodes.back().y, 0};  // an antipode, or nearly
    if (q == Point{0, 0, 0}) continue;
    if (std::none_of(nodes.begin(), nodes.end(), [&](const Point& o) { return same_direction(q, o); }))
      nodes.push_back(q);
  }
  return nodes;
}

Nodes of_family(Random& random, std::size_t n) {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names = point_sets::families();
    const auto& hard = point_sets::hard_families();
    names.insert(names.end(), hard.begin(), hard.end());
    for (const point_sets::Distribution& d : point_sets::distributions())
      if (d.limit <= 4) names.push_back(d.name);
    return names;
  }();
  try {
    Nodes nodes = point_sets::make(all[random.below(all.size())], std::max<std::size_t>(n, 4), random.bits());
    if (nodes.size() > 3 * n + 60) nodes.clear();
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (std::size_t j = 0; j < k; ++j)
        if (same_direction(nodes[j], nodes[k])) return {};
    return nodes;
  } catch (const std::invalid_argument&) {
    return {};
  }
}

// ---- owners and halos -------------------------------------------------------------------------------

std::uint64_t hash_of(const Point& p, std::uint64_t seed) {
  std::uint64_t hash = seed;
  for (const double x : {p.x, p.y, p.z}) {
    const double value = x + 0.0;  // -0 as 0
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    hash = splitmix64(hash ^ bits) + 1;
  }
  return hash;
}

std::shared_ptr<const Partition> random_partition(Random& random, int patches) {
  const std::size_t kind = random.below(5);
  const std::uint64_t seed = random.bits();
  static constexpr double kShares[] = {0, 0, 0.1, 0.3, 0.6};
  const double share = kShares[random.below(5)], reach = random.uniform(0, 0.7);
  const bool by_distance = random.below(2) == 0;
  const auto part = [=](double x) {
    return static_cast<PatchNumber>(std::clamp(x, 0.0, 0.999999) * patches);
  };
  const auto owner = [=](const Point& p) -> PatchNumber {
    if (kind == 1) return part((p.z + 1) / 2);
    if (kind == 2) return part(std::atan2(p.y, p.x) / (2 * kPi) + 0.5);
    if (kind == 3) return (p.x < 0) * 4 % patches + ((p.y < 0) * 2 + (p.z < 0)) % patches;
    return static_cast<PatchNumber>(hash_of(p, seed) % static_cast<std::uint64_t>(patches));
  };
  const auto bounded = [=](const Point& p) { return owner(p) % patches; };
  const auto is_in_halo = [=](PatchNumber q, const Point& p) {
    if (by_distance)
      for (const double dx : {-reach, 0.0, reach})
        for (const double dz : {-reach, 0.0, reach})
          if (bounded({p.x + dx, p.y, p.z + dz}) == q && kind < 4) return true;
    return static_cast<double>(hash_of(p, seed + 1 + static_cast<std::uint64_t>(q)) >> 11) * 0x1p-53 < share;
  };
  return std::make_shared<Partition>(patches, Partition::Rule{bounded, is_in_halo});
}

// ---- the test ---------------------------------------------------------------------------------------

struct Tally {
  int sets = 0, by_one_rank = 0, on_directions = 0, most_rounds = 0;
  std::vector<int> rounds = std::vector<int>(64);
};

void try_one(std::uint64_t seed, Tally& tally) {
  Random random(seed);
  random.bits();
  Nodes nodes;
  while (nodes.size() < 3 || !has_three(nodes)) {
    const std::size_t n = 3 + random.below(random.below(4) == 0 ? 60 : 18);
    const std::size_t kind = random.below(4);
    nodes = kind == 0 ? of_family(random, n) : kind == 1 ? with_rim(random, n) : lattice(random, n);
  }
  const Set set(std::move(nodes));
  ASSERT_TRUE(set.coincident.empty()) << "seed " << seed;
  static constexpr int kRanks[] = {1, 1, 1, 2, 2, 3, 4, 5, 8, 16, 64};
  const int ranks = kRanks[random.below(random.below(20) == 0 ? 11 : 9)];
  ParallelOptions options;
  options.closing_nodes = 1 + random.below(6);
  options.patches = ranks == 1 ? 2 + static_cast<int>(random.below(7)) : 1 + (random.below(4) == 0);
  options.partition = kPartitions[random.below(std::size(kPartitions))].kind;
  options.with_neighbours = random.below(2) == 0;
  if (random.below(4) != 0) options.given = random_partition(random, ranks * options.patches);
  std::vector<std::unique_ptr<Homes>> homes(static_cast<std::size_t>(ranks));
  std::vector<std::size_t> rank_of_node;
  for (std::size_t i = 0; i < set.nodes.size(); ++i)
    rank_of_node.push_back(random.below(static_cast<std::size_t>(ranks)));
  const Outcome out = run<std::int32_t>(set.nodes, rank_of_node, options, homes);
  EXPECT_TRUE(is_serial(set, out)) << "seed " << seed << ": " << set.nodes.size() << " nodes, " << ranks
                                   << " ranks, " << options.patches << " patches";
  ++tally.sets;
  tally.by_one_rank += out.cost[0].in_one_patch;
  tally.on_directions += set.lengths == Lengths::directions;
  tally.most_rounds = std::max(tally.most_rounds, out.cost[0].rounds);
  ++tally.rounds[static_cast<std::size_t>(std::min(out.cost[0].rounds, 63))];
}

TEST(Lists, GiveTheSerialRingsWhoeverOwnsANode) {
  const char* const asked = std::getenv("PSTRIPACK_TEST_SETS");
  const char* const from = std::getenv("PSTRIPACK_TEST_FIRST");
  const std::uint64_t sets = asked != nullptr ? std::strtoull(asked, nullptr, 10) : 300,
                      first = from != nullptr ? std::strtoull(from, nullptr, 10) : 1;
  Tally tally;
  for (std::uint64_t seed = first; seed < first + sets && !HasFailure(); ++seed) try_one(seed, tally);
  EXPECT_EQ(tally.by_one_rank, 0);  // all by agreement
  std::string rounds;
  for (const int count : tally.rounds) rounds += std::to_string(count) + " ";
  std::printf("%d sets, %d on directions, %d by one rank, most rounds %d: %s\n", tally.sets,
              tally.on_directions, tally.by_one_rank, tally.most_rounds, rounds.c_str());
}

}  // namespace
