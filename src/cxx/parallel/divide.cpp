#include "parallel/divide.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "geometry/insertion_order.h"
#include "parallel/agreement.h"
#include "parallel/homes.h"
#include "parallel/levels.h"
#include "parallel/number_table.h"
#include "parallel/sample.h"
#include "parallel/sample_hull.h"

namespace pstripack {
namespace {

// Number of sample nodes that are searched for hidden ones before nodes go to patches. A hidden node that is
// found later costs the time of the patches once more.
constexpr std::size_t kLookedThrough = 500;
// The second draft has a sample this many times as large: then halos are thinner where the density varies.
constexpr std::size_t kFinerSample = 4;

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
  std::optional<Loads> loads;  ///< for the second draft
  BlockArray<Record> sample;
  std::vector<std::size_t> begin;     ///< bytes of the sample that the ranks bring
  std::vector<std::int64_t> counter;  ///< memory for the counters of cut_anew()
};

/// Writes this rank's share of a sample. `loads`: the patches are cut by these.
Supply take_stock(const LocalNodes& nodes, const std::vector<Headcount>& heads, const Division& division,
                  RankNumber me, const ParallelOptions& options, bool keeps_patches,
                  std::optional<Loads> loads = std::nullopt) {
  Supply supply;
  supply.keeps_patches = keeps_patches;
  supply.loads = std::move(loads);
  supply.looks_through = !keeps_patches || options.last->lengths() != division.places.lengths();
  const std::size_t usual = sample_size(division.nodes, static_cast<std::size_t>(division.patches.count())),
                    enough = supply.looks_through ? kLookedThrough : options.closing_nodes;
  const std::size_t wanted = std::min(division.nodes, keeps_patches  ? enough
                                                      : supply.loads ? kFinerSample * usual
                                                                     : usual);
  supply.begin.assign(1, 0);
  for (const Headcount& h : heads)
    supply.begin.push_back(supply.begin.back() +
                           share_of_sample(h.nodes, wanted, division.nodes) * sizeof(Record));
  supply.sample = BlockArray<Record>(supply.begin.back() / sizeof(Record));
  write_share(nodes, share_of_sample(nodes.count, wanted, division.nodes),
              supply.sample.data() + supply.begin[me] / sizeof(Record));
  supply.counter.resize(Cuts::counters(division.patches.count()));
  return supply;
}

std::vector<Point> places_of(const BlockArray<Record>& sample, const Places& places) {
  std::vector<Point> result(sample.size());
  for (std::size_t k = 0; k < sample.size(); ++k) result[k] = places(sample[k].point);
  return result;
}

/// Cuts the sphere into patches with equal numbers of nodes or equal work, as far as a sample and counts can
/// tell. Returns the outcome on this rank, not agreed on yet. A rank that has failed counts nothing but takes
/// part in all sums.
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
    std::vector<Point> sample = places,
                       counted = places_to_count(nodes, division.nodes, static_cast<std::size_t>(patches),
                                                 division.places);
    if (supply.loads) {
      supply.loads->thin(sample);
      supply.loads->thin(counted);
    }
    cuts.emplace(patches, std::move(sample), std::move(counted));
  });
  for (int level = 0; is_bisection && level < Cuts::levels(patches); ++level) {
    std::fill(supply.counter.begin(), supply.counter.end(), 0);
    go_on([&] { cuts->cut(); });
    if (outcome.is_good()) cuts->count(supply.counter.data());
    ranks.all_sum(supply.counter.data(), supply.counter.size());
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

/// Takes slices of the mesh of the sample in place of boxes if boxes cut more than twice as many triangles.
/// If not, but patches of the last call had many questions, the halos of the boxes become the nodes that the
/// mesh has next to them. Collective. Throws AgreedFailure.
void follow_mesh(const LocalNodes& nodes, Supply& supply, Communicator& ranks, Division& division) {
  const auto weight_of = [&](const Point& place) {
    constexpr double kOne = 1000;
    return static_cast<std::int64_t>(supply.loads ? std::ceil(kOne * supply.loads->weight(place)) : kOne);
  };
  const int patches = division.patches.count();
  std::optional<Levels> levels;
  std::shared_ptr<Partition> cells;
  std::vector<PatchNumber> box_of_cell;  // empty: slices are better
  std::vector<std::int64_t> weight;
  in_agreement(ranks, [&] {
    std::vector<Point> points;
    for (const Record& r : supply.sample) points.push_back(r.point);
    const std::vector<Point> places = places_of(supply.sample, division.places);
    std::vector<PatchNumber> box;
    for (const Point& p : places) box.push_back(division.partition->owner(p));
    const CoarseMesh mesh(points);
    const std::size_t triangles = mesh.triangles().size() + mesh.triangles_at_hubs();
    const std::size_t in_boxes = mesh.mixed([&](SampleNode v) { return box[v]; });
    division.gave_up = division.may_give_up && 3 * (in_boxes + mesh.triangles_at_hubs()) > triangles;
    if (division.gave_up) return;
    cells = std::make_shared<Partition>(places);
    levels.emplace(mesh, places, *cells);
    const std::vector<CellNumber>& cell = levels->cell_of();
    weight.resize(cells->cells());
    for (SampleNode v = 0; v < places.size(); ++v) weight[cell[v]] += weight_of(places[v]);
    const std::vector<PatchNumber> slice_of_cell = levels->slices(patches, weight);
    const std::size_t in_slices = mesh.mixed([&](SampleNode v) { return slice_of_cell[cell[v]]; });
    if (2 * in_slices >= in_boxes) {
      if (!supply.loads || !supply.loads->have_many_questions()) return levels.reset();
      box_of_cell.resize(cells->cells());
      for (SampleNode v = 0; v < places.size(); ++v) box_of_cell[cell[v]] = box[v];
      return;
    }
    std::fill(weight.begin(), weight.end(), 0);
    const std::vector<Point> counted =
        places_to_count(nodes, division.nodes, static_cast<std::size_t>(patches), division.places);
    std::vector<CellNumber> cell_of_counted(counted.size());
    cells->cells_of(counted.data(), counted.size(), cell_of_counted.data());
    for (std::size_t v = 0; v < counted.size(); ++v) weight[cell_of_counted[v]] += weight_of(counted[v]);
  });
  if (!levels) return;
  if (box_of_cell.empty()) ranks.all_sum(weight.data(), weight.size());
  in_agreement(ranks, [&] {
    cells->give_cells(patches, box_of_cell.empty() ? levels->slices(patches, weight) : box_of_cell,
                      levels->begin(), levels->beside());
    division.partition = cells;
  });
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

/// Agrees with all ranks on what there is, on whether the patches of the last call are kept, and, if not,
/// whether they tell how to cut better ones. Collective. Throws AgreedFailure.
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
  std::vector<PatchLoad> loads;  // of all patches, if they were the first draft; stripes have no other
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
    if (keeps_patches && last->draft() == Draft::first && options.partition == PartitionKind::bisection)
      loads.resize(static_cast<std::size_t>(division.patches.count()));
    else
      supply = take_stock(nodes, heads, division, me, options, keeps_patches);
  });
  if (keeps_patches)
    division.draft = last->draft();
  else if (last != nullptr && (last->draft() == Draft::second || last->draft() == Draft::last))
    division.draft = Draft::last;
  if (loads.empty()) return supply;
  std::copy(last->loads().begin(), last->loads().end(), loads.begin() + division.patches.first(me));
  static_assert(sizeof(PatchLoad) == 4 * sizeof(std::int64_t));
  ranks.all_sum(&loads[0].own, 4 * loads.size());
  in_agreement(ranks, [&] {
    Loads of_all(last->partition(), division.patches, loads);
    const bool was_bad = of_all.are_uneven() || of_all.have_many_questions();
    division.draft = was_bad ? Draft::second : Draft::kept;
    supply = was_bad ? take_stock(nodes, heads, division, me, options, false, std::move(of_all))
                     : take_stock(nodes, heads, division, me, options, true);
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
  bool is_hard = false;
  in_agreement(ranks, [&] {
    outcome.accept();
    const auto patches = static_cast<std::size_t>(division.patches.count());
    division.may_give_up = ranks.size() == 1 && patches > 1 && options.most_questions < nodes.count;
    is_hard = !supply.keeps_patches && options.given == nullptr &&
              options.partition == PartitionKind::bisection &&
              ((supply.loads && supply.loads->have_many_questions()) ||
               may_be_hard(division.closing, *division.partition, places));
  });
  if (is_hard) follow_mesh(nodes, supply, ranks, division);
  if (!supply.loads) return division;
  in_agreement(ranks, [&] {
    if (supply.loads->expect_less_of(*division.partition, places_of(supply.sample, places), division.nodes))
      return;
    division.partition = options.last->partition();
    division.draft = Draft::kept;
  });
  return division;
}

}  // namespace pstripack
