#include "parallel/divide.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "geometry/predicates.h"
#include "mesh/delaunay.h"
#include "parallel/agreement.h"
#include "parallel/homes.h"
#include "parallel/sample.h"

namespace pstripack {
namespace {

/// What a rank brings.
struct Headcount {
  std::size_t nodes;
  int patches;
  /// The last call's patches are known, and nearly all of its nodes are in those here.
  bool are_at_home;
};

/// A sample of the nodes of all ranks, the same on every rank.
struct GlobalSample {
  bool reuses_patches = false;  ///< of the last call
  std::vector<SentNode> nodes;
  std::vector<std::int64_t> counter;  ///< memory for the counters of cut_anew()
};

/// Agrees with all ranks on what there is, and on whether the patches of the last call are used again.
/// Collective. Throws AgreedFailure.
GlobalSample sample_of_all(const LocalNodes& nodes, Communicator& ranks, const ParallelOptions& options,
                           Division& division) {
  const auto me = static_cast<RankNumber>(ranks.rank());
  const Homes* const last = options.last;
  std::vector<Headcount> heads;
  std::vector<std::size_t> begin;  // bytes of each rank
  in_agreement(ranks, [&] {
    heads.resize(static_cast<std::size_t>(ranks.size()));
    for (RankNumber r = 0; r <= heads.size(); ++r) begin.push_back(r * sizeof(Headcount));
  });
  heads[me] = {nodes.count, options.patches, last != nullptr && last->are_home_to(nodes, ranks.rank())};
  ranks.all_gather_in_place(heads.data(), begin);
  GlobalSample sample;
  in_agreement(ranks, [&] {
    bool are_at_home = last != nullptr;
    for (const Headcount& head : heads) {
      division.patches.add(head.patches);
      division.nodes += head.nodes;
      are_at_home = are_at_home && head.are_at_home;
    }
    const auto patches = static_cast<std::size_t>(division.patches.count());
    sample.reuses_patches =
        are_at_home && last->are_for(options.partition, division.patches, division.places.lengths());
    const std::size_t wanted =
        sample.reuses_patches ? options.closing_nodes : sample_size(division.nodes, patches);
    std::size_t before = 0, size = 0;
    for (RankNumber r = 0; r < heads.size(); ++r) {
      const std::size_t share =
          share_of_sample(before, heads[r].nodes, std::min(division.nodes, wanted), division.nodes);
      sample.nodes.resize(size + share);
      if (r == me) write_share(nodes, share, sample.nodes.data() + size);
      before += heads[r].nodes;
      size += share;
      begin[r + 1] = size * sizeof(SentNode);
    }
    if (!sample.reuses_patches)
      sample.counter.resize(Cuts::counters(std::max(1, Cuts::levels(division.patches.count())) - 1));
  });
  ranks.all_gather_in_place(sample.nodes.data(), begin);
  return sample;
}

std::vector<Point> places_of(const std::vector<SentNode>& sample, const Places& places) {
  std::vector<Point> result(sample.size());
  for (std::size_t k = 0; k < sample.size(); ++k) result[k] = places(sample[k].point);
  return result;
}

/// Cuts the sphere into patches with equal numbers of nodes, as far as a sample and counts can tell. Returns
/// the outcome on this rank, not agreed on yet. A rank that has failed counts nothing but takes part in all
/// sums.
Outcome cut_anew(const LocalNodes& nodes, GlobalSample& sample, PartitionKind kind, Communicator& ranks,
                 Division& division, Outcome outcome) {
  const int patches = division.patches.count();
  const bool is_bisection = kind == PartitionKind::bisection;
  std::vector<Point> places;
  std::optional<Cuts> cuts;
  outcome.go_on([&] {
    places = places_of(sample.nodes, division.places);
    if (!is_bisection) return;
    cuts.emplace(patches, std::move(places),
                 places_to_count(nodes, division.nodes, static_cast<std::size_t>(patches), division.places));
  });
  for (int level = 0; is_bisection && level < Cuts::levels(patches); ++level) {
    const std::size_t counters = Cuts::counters(level);
    std::fill_n(sample.counter.begin(), counters, 0);
    outcome.go_on([&] { cuts->cut(); });
    if (outcome.is_good()) cuts->count(sample.counter.data());
    ranks.all_sum(sample.counter.data(), counters);
    if (outcome.is_good()) cuts->move(sample.counter.data());
  }
  outcome.go_on([&] {
    if (cuts) cuts->cut();
    division.partition = cuts ? std::make_shared<Partition>(*cuts, division.nodes)
                              : std::make_shared<Partition>(kind, patches, std::move(places), division.nodes);
  });
  return outcome;
}

/// About `most` nodes of the sample and all corners, each once.
std::vector<SentNode> some_of(const std::vector<SentNode>& sample, std::size_t most, const Corners& corners) {
  std::map<GlobalNumber, Point> points;
  for (const SentNode& r : corners) points.emplace(r.number, r.point);
  const std::size_t step = sample.size() / most + 1;
  for (std::size_t k = 0; k < sample.size(); k += step) points.emplace(sample[k].number, sample[k].point);
  std::vector<SentNode> some;
  for (const auto& [number, point] : points) some.push_back({point, number});
  return some;
}

/// True if more than a third of the triangles of these nodes have corners in different patches, or, if these
/// are more than `parts`, in different parts of so many.
bool cuts_many_triangles(const Partition& partition, std::size_t parts, const std::vector<SentNode>& nodes,
                         const Places& places) {
  const auto patches = static_cast<std::size_t>(partition.patches());
  std::vector<std::size_t> part;
  std::vector<Point> points;
  for (const SentNode& r : nodes) {
    points.push_back(r.point);
    const auto owner = static_cast<std::size_t>(partition.owner(places(r.point)));
    part.push_back(patches > parts ? owner * parts / patches : owner);
  }
  Workspace workspace(workspace_bytes(points.size()));
  const Hull hull = delaunay(points.data(), points.size(), workspace);
  std::size_t triangles = 0, cut = 0;
  for (std::size_t t = 0; t < hull.face_count; ++t) {
    if (!hull.front(t)) continue;
    const auto part_of = [&](int i) { return part[hull.order[hull.faces[t].vertex[i]]]; };
    ++triangles;
    cut += part_of(0) != part_of(1) || part_of(1) != part_of(2);
  }
  return 3 * cut > triangles;
}

/// True if neighbours in the mesh may be far from each other, as along lines that cross.
bool cuts_many_triangles(const Division& division, const std::vector<SentNode>& sample,
                         const Corners& corners) {
  constexpr std::size_t kEnough = 64, kQuarters = 4;
  const auto cuts_many = [&](std::size_t parts, const std::vector<SentNode>& nodes) {
    return cuts_many_triangles(*division.partition, parts, nodes, division.places);
  };
  // A few nodes tell first: this costs next to nothing.
  return division.closing.size() >= kEnough && cuts_many(kQuarters, division.closing) &&
         cuts_many(SIZE_MAX, some_of(sample, sample.size() + 1, corners));
}

}  // namespace

Division divide(const LocalNodes& nodes, const Corners& corners, const Places& places, Communicator& ranks,
                const ParallelOptions& options) {
  assert(left(corners[0].point, corners[1].point, corners[2].point) != 0);
  Division division(places);
  GlobalSample sample = sample_of_all(nodes, ranks, options, division);
  Outcome outcome = Outcome::of([&] {
    division.closing = some_of(sample.nodes, options.closing_nodes, corners);
    sort_along_curve(division.closing);
  });
  if (options.given != nullptr) {
    division.partition = options.given;
  } else if (sample.reuses_patches) {
    division.partition = options.last->partition();
  } else {
    outcome = cut_anew(nodes, sample, options.partition, ranks, division, outcome);
  }
  in_agreement(ranks, [&] {
    outcome.accept();
    // A single process can give up now. Ranks have to send their nodes first.
    const bool may_give_up = ranks.size() == 1 && division.patches.count() > 1 &&
                             options.most_questions < nodes.count &&
                             options.partition == PartitionKind::bisection;
    if (may_give_up && cuts_many_triangles(division, sample.nodes, corners)) throw PatchesDoNotPay{};
  });
  return division;
}

}  // namespace pstripack
