#include "parallel/divide.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "geometry/insertion_order.h"
#include "parallel/agreement.h"
#include "parallel/coarse_mesh.h"
#include "parallel/homes.h"
#include "parallel/sample.h"
#include "parallel/sample_hull.h"

namespace pstripack {
namespace {

// Number of sample nodes that are searched for hidden ones before nodes go to patches. A hidden node that is
// found later costs the time of the patches once more.
constexpr std::size_t kLookedThrough = 500;

/// What a rank brings; one number tells all ranks.
struct Headcount {
  std::size_t nodes;  ///< < 2^29
  int patches;        ///< < 2^30
  /// The last call's patches are known, and nearly all of its nodes are in those here.
  bool are_at_home;

  std::int64_t encode() const {
    return static_cast<std::int64_t>(nodes) | std::int64_t{patches} << 32 | std::int64_t{are_at_home} << 62;
  }
  static Headcount decode(std::int64_t h) {
    return {static_cast<std::size_t>(h & 0xffffffff), static_cast<int>(h >> 32 & 0x3fffffff), h >> 62 != 0};
  }
};

/// What the ranks bring, and the sample to which each has written its share.
struct Supply {
  bool keeps_patches = false;  ///< of the last call
  bool looks_through = true;   ///< for hidden nodes; not where the last call found none
  BlockArray<Record> sample;
  std::vector<std::size_t> begin;     ///< bytes of the sample that the ranks bring
  std::vector<std::int64_t> counter;  ///< memory for the counters of cut_anew()
};

/// Writes this rank's share of a sample.
Supply take_stock(const LocalNodes& nodes, const std::vector<Headcount>& heads, const Division& division,
                  RankNumber me, const ParallelOptions& options, bool keeps_patches) {
  Supply supply;
  supply.keeps_patches = keeps_patches;
  supply.looks_through = !keeps_patches || options.last->lengths() != division.places.lengths();
  const std::size_t usual = sample_size(division.nodes, static_cast<std::size_t>(division.patches.count())),
                    enough = supply.looks_through ? kLookedThrough : options.closing_nodes;
  const std::size_t wanted = std::min(division.nodes, keeps_patches ? enough : usual);
  supply.begin.assign(1, 0);
  std::size_t before = 0, mine = 0;
  for (RankNumber r = 0; r < heads.size(); ++r) {
    const std::size_t share = share_of_sample(before, heads[r].nodes, wanted, division.nodes);
    before += heads[r].nodes;
    supply.begin.push_back(supply.begin.back() + share * sizeof(Record));
    if (r == me) mine = share;
  }
  supply.sample = BlockArray<Record>(supply.begin.back() / sizeof(Record));
  write_share(nodes, mine, supply.sample.data() + supply.begin[me] / sizeof(Record));
  if (!keeps_patches)
    supply.counter.resize(Cuts::counters(std::max(1, Cuts::levels(division.patches.count())) - 1));
  return supply;
}

std::vector<Point> places_of(const BlockArray<Record>& sample, const Places& places) {
  std::vector<Point> result(sample.size());
  for (std::size_t k = 0; k < sample.size(); ++k) result[k] = places(sample[k].point);
  return result;
}

/// Cuts the sphere into patches with equal numbers of nodes, as far as a sample and counts can tell. Returns
/// the outcome on this rank, not agreed on yet. A rank that has failed counts nothing but takes part in all
/// sums.
Outcome cut_anew(const LocalNodes& nodes, Supply& supply, PartitionKind kind, Communicator& ranks,
                 Division& division, Outcome outcome) {
  const int patches = division.patches.count();
  const bool is_bisection = kind == PartitionKind::bisection;
  std::vector<Point> places;
  std::optional<Cuts> cuts;
  const auto go_on = [&](const auto& body) {
    if (outcome.is_good()) outcome = Outcome::of(body);
  };
  go_on([&] {
    places = places_of(supply.sample, division.places);
    if (!is_bisection) return;
    cuts.emplace(patches, std::vector<Point>(places),
                 places_to_count(nodes, division.nodes, static_cast<std::size_t>(patches), division.places));
  });
  for (int level = 0; is_bisection && level < Cuts::levels(patches); ++level) {
    const std::size_t counters = Cuts::counters(level);
    std::fill_n(supply.counter.begin(), counters, 0);
    go_on([&] { cuts->cut(); });
    if (outcome.is_good()) cuts->count(supply.counter.data());
    ranks.all_sum(supply.counter.data(), counters);
    if (outcome.is_good()) cuts->move(supply.counter.data());
  }
  go_on([&] {
    division.partition = cuts ? std::make_shared<Partition>(*cuts, std::move(places), division.nodes)
                              : std::make_shared<Partition>(kind, patches, std::move(places), division.nodes);
  });
  return outcome;
}

/// True if neighbours in the mesh may be far from each other: in the mesh of a few nodes, more than a third
/// of the triangles have corners in different quarters of the patches.
bool may_be_hard(const std::vector<Record>& few, const Partition& partition, const Places& places) {
  constexpr std::size_t kEnough = 64, kQuarters = 4;
  const auto patches = static_cast<std::size_t>(partition.patches());
  if (few.size() < kEnough || patches == 1) return false;
  std::vector<Point> points;
  std::vector<std::size_t> quarter;
  for (const Record& r : few) {
    points.push_back(r.point);
    const auto owner = static_cast<std::size_t>(partition.owner(places(r.point)));
    quarter.push_back(patches > kQuarters ? owner * kQuarters / patches : owner);
  }
  const CoarseMesh mesh(points);
  const std::size_t mixed = mesh.mixed([&](SampleNode v) { return quarter[v]; });
  return 3 * (mixed + mesh.triangles_at_hubs()) > mesh.triangles().size() + mesh.triangles_at_hubs();
}

/// True if boxes cut most triangles of the mesh of the sample.
bool cuts_most(BlockArray<Record>& sample, const Partition& partition, const Places& places) {
  std::vector<Point> points;
  std::vector<PatchNumber> owner;
  for (const Record& r : sample) {
    points.push_back(r.point);
    owner.push_back(partition.owner(places(r.point)));
  }
  const CoarseMesh mesh(points);
  const std::size_t mixed = mesh.mixed([&](SampleNode v) { return owner[v]; });
  return 3 * (mixed + mesh.triangles_at_hubs()) > mesh.triangles().size() + mesh.triangles_at_hubs();
}

/// About `most` nodes of the sample and all of `some`, each once.
std::vector<Record> some_of(BlockArray<Record>& sample, std::size_t most, std::vector<Record> some = {}) {
  const std::size_t step = sample.size() / most + 1;
  for (std::size_t k = 0; k < sample.size(); k += step) some.push_back(sample[k]);
  keep_one_of_each(some);
  return some;
}

/// About `most` of the sample and all of `others`, along a curve.
std::vector<Record> along_curve(BlockArray<Record>& sample, std::size_t most, std::vector<Record> others) {
  const std::vector<Record> some = some_of(sample, most, std::move(others));
  Workspace workspace(16 * some.size());
  std::vector<std::uint32_t> order(some.size());
  insertion_order(&some[0].point, some.size(), order.data(), workspace, sizeof(Record));
  std::vector<Record> ordered;
  for (const std::uint32_t k : order) ordered.push_back(some[k]);
  return ordered;
}

/// Agrees with all ranks on what there is, and on whether the patches of the last call are kept. Collective.
/// Throws AgreedFailure.
Supply take_stock_of_all(const LocalNodes& nodes, Communicator& ranks, const ParallelOptions& options,
                         Division& division) {
  const auto me = static_cast<RankNumber>(ranks.rank()), size = static_cast<std::size_t>(ranks.size());
  const Homes* const last = options.last;
  const bool at_home =
      last != nullptr && (options.fits_last ? !last->are_crowded() : last->are_home_to(nodes, ranks.rank()));
  const std::int64_t* const encoded =
      ranks.all_gather_one(Headcount{nodes.count, options.patches, at_home}.encode());
  Supply supply;
  std::vector<Headcount> heads;
  bool keeps_patches = last != nullptr;
  in_agreement(ranks, [&] {
    for (RankNumber r = 0; r < size; ++r) {
      heads.push_back(Headcount::decode(encoded[r]));
      division.patches.add(heads.back().patches);
      division.nodes += heads.back().nodes;
      keeps_patches = keeps_patches && heads.back().are_at_home;
    }
    keeps_patches =
        keeps_patches && last->are_for(options.partition, division.patches, division.places.lengths());
    supply = take_stock(nodes, heads, division, me, options, keeps_patches);
  });
  return supply;
}

}  // namespace

Division divide(const LocalNodes& nodes, const Corners& corners, const Places& places, Communicator& ranks,
                const ParallelOptions& options) {
  Division division(places);
  Supply supply = take_stock_of_all(nodes, ranks, options, division);
  ranks.all_gather_in_place(supply.sample.data(), supply.begin);
  Outcome outcome = Outcome::of([&] {
    std::vector<Record> known{corners.begin(), corners.end()};
    if (supply.looks_through && options.given == nullptr)
      look_for_hidden_nodes(along_curve(supply.sample, kLookedThrough, known), places);
    division.closing = along_curve(supply.sample, options.closing_nodes, std::move(known));
  });
  if (options.given != nullptr) {
    division.partition = options.given;
  } else if (supply.keeps_patches) {
    division.partition = options.last->partition();
  } else {
    outcome = cut_anew(nodes, supply, options.partition, ranks, division, outcome);
  }
  in_agreement(ranks, [&] {
    outcome.accept();
    division.may_give_up =
        ranks.size() == 1 && division.patches.count() > 1 && options.most_questions < nodes.count;
    division.gave_up = division.may_give_up && options.partition == PartitionKind::bisection &&
                       may_be_hard(division.closing, *division.partition, places) &&
                       cuts_most(supply.sample, *division.partition, places);
  });
  return division;
}

}  // namespace pstripack
