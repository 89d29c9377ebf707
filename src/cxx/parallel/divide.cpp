#include "parallel/divide.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "geometry/insertion_order.h"
#include "parallel/agreement.h"
#include "parallel/levels.h"
#include "parallel/sample.h"
#include "parallel/sample_hull.h"

namespace pstripack {
namespace {

constexpr std::size_t kClosingNodes = 256;
// Number of sample nodes that are searched for hidden ones before nodes go to patches. A hidden node that is
// found later costs the time of the patches once more.
constexpr std::size_t kLookedThrough = 500;
// A rank's nodes, evenly spaced, of which at most a sixteenth may lie in other ranks' patches if the patches
// of the last call are kept.
constexpr std::size_t kLookedAt = 256;
// Nodes that a rank may have above 9/8 of its share if patches are kept: for small sets, where 1/8 is little.
constexpr std::size_t kCloselyEnough = 64;

/// What a rank brings; one number tells all ranks.
struct Headcount {
  std::size_t nodes;  ///< < 2^29
  int patches;        ///< < 2^30
  bool are_at_home;   ///< the last call's patches are known, and nearly all of its nodes are in those here

  std::int64_t encode() const {
    return static_cast<std::int64_t>(nodes) | std::int64_t{patches} << 32 | std::int64_t{are_at_home} << 62;
  }
  static Headcount decode(std::int64_t h) {
    return {static_cast<std::size_t>(h & 0xffffffff), static_cast<int>(h >> 32 & 0x3fffffff), h >> 62 != 0};
  }
};

/// What the ranks bring, and the sample to which each has written its share.
struct Supply {
  std::size_t nodes = 0;      ///< of all ranks
  bool keeps_patches = true;  ///< of the last call
  bool looks_through = true;  ///< for hidden nodes; not where the last call found none
  BlockArray<Record> sample;
  std::vector<std::size_t> begin;     ///< bytes of the sample that the ranks bring
  std::vector<std::int64_t> counter;  ///< memory for the counters of cut_anew()
};

Supply take_stock(const LocalNodes& nodes, const PatchRanges& patches, const std::vector<Headcount>& heads,
                  const Division& division, RankNumber me, const ParallelOptions& options) {
  Supply supply;
  for (const Headcount& h : heads) {
    supply.nodes += h.nodes;
    supply.keeps_patches = supply.keeps_patches && h.are_at_home;
  }
  const auto all_patches = static_cast<std::size_t>(patches.count());
  supply.keeps_patches =
      supply.keeps_patches && options.last->are_for(options.partition, patches, division.places.lengths());
  for (RankNumber r = 0; r < heads.size(); ++r)
    supply.keeps_patches = supply.keeps_patches && options.last->is_share_of(r, heads[r].nodes, supply.nodes);
  supply.looks_through = !supply.keeps_patches || options.last->lengths() != division.places.lengths();
  const std::size_t enough = supply.looks_through ? kLookedThrough : kClosingNodes;
  const std::size_t wanted =
      supply.keeps_patches ? std::min(supply.nodes, enough) : sample_size(supply.nodes, all_patches);
  supply.begin.assign(1, 0);
  for (const Headcount& h : heads)
    supply.begin.push_back(supply.begin.back() +
                           share_of_sample(h.nodes, wanted, supply.nodes) * sizeof(Record));
  supply.sample = BlockArray<Record>(supply.begin.back() / sizeof(Record));
  write_share(nodes, share_of_sample(nodes.count, wanted, supply.nodes),
              supply.sample.data() + supply.begin[me] / sizeof(Record));
  supply.counter.resize(Cuts::counters(patches.count()));
  return supply;
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
    places.reserve(supply.sample.size());
    for (const Record& r : supply.sample) places.push_back(division.places(r.point));
    if (is_bisection)
      cuts.emplace(patches, places,
                   places_to_count(nodes, supply.nodes, static_cast<std::size_t>(patches), division.places));
  });
  for (int level = 0; is_bisection && level < Cuts::levels(patches); ++level) {
    std::fill(supply.counter.begin(), supply.counter.end(), 0);
    go_on([&] { cuts->cut(); });
    if (outcome.is_good()) cuts->count(supply.counter.data());
    ranks.all_sum(supply.counter.data(), supply.counter.size());
    if (outcome.is_good()) cuts->move(supply.counter.data());
  }
  go_on([&] {
    division.partition = cuts ? std::make_shared<Partition>(*cuts, std::move(places), supply.nodes)
                              : std::make_shared<Partition>(kind, patches, std::move(places), supply.nodes);
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

/// Takes slices of the mesh of the sample in place of boxes if boxes cut more than twice as many triangles.
/// Collective. Throws AgreedFailure.
void slice(const LocalNodes& nodes, Supply& supply, Communicator& ranks, Division& division) {
  const int patches = division.patches.count();
  std::optional<Levels> levels;
  std::shared_ptr<Partition> cells;
  std::vector<std::int64_t> weight;
  in_agreement(ranks, [&] {
    std::vector<Point> points, places;
    for (const Record& r : supply.sample) {
      points.push_back(r.point);
      places.push_back(division.places(r.point));
    }
    const CoarseMesh mesh(points);
    const std::size_t triangles = mesh.triangles().size() + mesh.triangles_at_hubs();
    const std::size_t in_boxes =
        mesh.mixed([&](SampleNode v) { return division.partition->owner(places[v]); });
    division.by_agreement = 3 * (in_boxes + mesh.triangles_at_hubs()) > triangles;
    division.gave_up = division.may_give_up && division.by_agreement;
    if (division.gave_up) return;
    cells = std::make_shared<Partition>(places);
    levels.emplace(mesh, places, *cells);
    const std::vector<CellNumber>& cell = levels->cell_of();
    weight.resize(cells->cells());
    for (const CellNumber c : cell) ++weight[c];
    const std::vector<PatchNumber> of_sample = levels->slices(patches, weight);
    const std::size_t in_slices = mesh.mixed([&](SampleNode v) { return of_sample[cell[v]]; });
    if (2 * in_slices >= in_boxes) {
      levels.reset();
      return;
    }
    std::fill(weight.begin(), weight.end(), 0);
    const std::vector<Point> counted =
        places_to_count(nodes, supply.nodes, static_cast<std::size_t>(patches), division.places);
    std::vector<CellNumber> cell_of_counted(counted.size());
    cells->cells_of(counted.data(), counted.size(), cell_of_counted.data());
    for (const CellNumber c : cell_of_counted) ++weight[c];
  });
  if (!levels) return;
  ranks.all_sum(weight.data(), weight.size());
  in_agreement(ranks, [&] {
    cells->give_cells(patches, levels->slices(patches, weight), levels->begin(), levels->beside());
    division.partition = cells;
    division.by_agreement = true;
  });
}

/// About `most` nodes of the sample and all of `some`, each once.
std::vector<Record> some_of(BlockArray<Record>& sample, std::size_t most, std::vector<Record> some = {}) {
  const std::size_t step = sample.size() / most + 1;
  for (std::size_t k = 0; k < sample.size(); k += step) some.push_back(sample[k]);
  keep_one_of_each(some);
  return some;
}

/// About `most` of the sample and the corners, along a curve.
std::vector<Record> along_curve(BlockArray<Record>& sample, std::size_t most, const Corners& corners) {
  const std::vector<Record> some = some_of(sample, most, {corners.begin(), corners.end()});
  Workspace workspace(16 * some.size());
  std::vector<std::uint32_t> order(some.size());
  insertion_order(&some[0].point, some.size(), order.data(), workspace, sizeof(Record));
  std::vector<Record> ordered;
  for (const std::uint32_t k : order) ordered.push_back(some[k]);
  return ordered;
}

}  // namespace

bool Homes::is_share_of(RankNumber rank, std::size_t nodes, std::size_t all) const {
  const std::size_t share = all / static_cast<std::size_t>(patches_.count()) * patches_.count(rank);
  return nodes <= share + share / 8 + kCloselyEnough;
}

bool Homes::are_home_to_most(const LocalNodes& nodes, int me) const {
  const std::size_t step = nodes.count / kLookedAt + 1;
  std::size_t looked_at = 0, away = 0;
  for (std::size_t i = 0; i < nodes.count; i += step, ++looked_at) away += rank(nodes.points[i]) != me;
  return 16 * away <= looked_at;
}

Division divide(const LocalNodes& nodes, const Corners& corners, const Places& places, Communicator& ranks,
                const ParallelOptions& options) {
  const auto me = static_cast<RankNumber>(ranks.rank()), size = static_cast<std::size_t>(ranks.size());
  Division division(places);
  Supply supply;
  const bool at_home = options.last != nullptr && options.last->are_home_to_most(nodes, static_cast<int>(me));
  const std::int64_t* const encoded =
      ranks.all_gather_one(Headcount{nodes.count, options.patches, at_home}.encode());
  in_agreement(ranks, [&] {
    std::vector<Headcount> heads;
    for (RankNumber r = 0; r < size; ++r) {
      heads.push_back(Headcount::decode(encoded[r]));
      division.patches.add(heads.back().patches);
    }
    supply = take_stock(nodes, division.patches, heads, division, me, options);
    division.nodes = supply.nodes;
  });
  ranks.all_gather_in_place(supply.sample.data(), supply.begin);
  Outcome outcome = Outcome::of([&] {
    if (supply.looks_through)
      look_for_hidden_nodes(along_curve(supply.sample, kLookedThrough, corners), places);
    division.closing = along_curve(supply.sample, kClosingNodes, corners);
  });
  if (supply.keeps_patches) {
    division.partition = options.last->partition();
    division.by_agreement = options.last->by_agreement();
  } else {
    outcome = cut_anew(nodes, supply, options.partition, ranks, division, outcome);
  }
  bool is_hard = false;
  in_agreement(ranks, [&] {
    outcome.accept();
    const auto patches = static_cast<std::size_t>(division.patches.count());
    division.may_give_up = size == 1 && patches > 1 && options.most_questions < nodes.count;
    // Worth its time in large patches, where it spares many triangles a closer look.
    constexpr std::size_t kManyInAPatch = 50000;
    if (supply.nodes / patches > kManyInAPatch)
      division.most_stretch = most_stretch(division.closing, places);
    is_hard = !supply.keeps_patches && options.partition == PartitionKind::bisection &&
              may_be_hard(division.closing, *division.partition, places);
  });
  if (is_hard) slice(nodes, supply, ranks, division);
  return division;
}

}  // namespace pstripack
