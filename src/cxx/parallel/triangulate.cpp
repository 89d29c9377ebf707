// The parallel triangulation, in order:
//
//   nodes of this rank
//        |  divide               a sample of the nodes, the same on every rank, and counts near the cuts
//        v                       cut the sphere into patches
//   Division
//        |  deliver              every node goes to its patch and to those that have it in their halo
//        v
//   Delivery
//        |  triangulate_patches  every patch its own nodes, its halo and a few nodes from everywhere
//        v
//   Patches
//        |  certify              patches compare lists of the triangles that two of them answer for; what one
//        v                       lacks travels, until all lists match
//   Certified
//        |  return_rings         the stars of the nodes go back to the ranks that brought them
//        v
//   Stars
//
// Patches are divided among the ranks, one after another, and a rank's among its threads. There is no
// sequential merge: the predicates are exact and know nothing of numbers.

#include "parallel/triangulate.h"

#include <utility>

#include "mesh/delaunay.h"
#include "parallel/certify.h"
#include "parallel/deliver.h"
#include "parallel/patches.h"

namespace pstripack {
namespace {

/// Throws HiddenNode on every rank, or AgreedFailure on every rank.
template <class Int>
Stars<Int> triangulate_places(const LocalNodes& nodes, const Corners& corners, const Places& places,
                              Communicator& ranks, const ParallelOptions& options, ParallelCost& cost) {
  const auto phase = [&](ParallelCost::Phase kind, const char* name, const auto& body) {
    const PhaseTimer timer(&cost, kind, &ranks);
    ranks.set_phase(name);
    return body();
  };
  Stars<Int> unfinished;
  unfinished.lengths = places.lengths();

  const Division division =
      phase(ParallelCost::divide, "divide", [&] { return divide(nodes, corners, places, ranks, options); });
  unfinished.gave_up = division.gave_up;
  if (unfinished.gave_up) return unfinished;

  Delivery delivery =
      phase(ParallelCost::divide, "divide", [&] { return deliver(nodes, division, ranks, options.threads); });
  unfinished.gave_up = delivery.gave_up;
  if (unfinished.gave_up) return unfinished;
  for (const auto& patch : delivery.of_patch) cost.halo += static_cast<std::int64_t>(patch.halo);

  Patches<Int> patches = phase(ParallelCost::triangulate, "triangulate", [&] {
    return triangulate_patches<Int>(delivery, division, ranks, options.threads);
  });

  Certified<Int> certified = phase(ParallelCost::merge, "merge",
                                   [&] { return certify(std::move(patches), division, ranks, options); });
  cost.rounds += certified.rounds;
  if (!certified.is_done()) {
    unfinished.gave_up = certified.gave_up;
    unfinished.coincident = std::move(certified.coincident);
    if (unfinished.gave_up)
      in_agreement(ranks, [&] {
        unfinished.homes = std::make_unique<Homes>(division, options, own_nodes(certified.patches));
      });
    return unfinished;
  }

  return phase(ParallelCost::lists, "lists", [&] {
    return return_rings(std::move(certified), std::move(delivery.addresses), nodes, division, ranks, options);
  });
}

}  // namespace

template <class Int>
Stars<Int> triangulate(const LocalNodes& nodes, const Look& look, const Point (&corners)[3],
                       const std::int64_t (&numbers)[3], Communicator& ranks, const ParallelOptions& options,
                       ParallelCost* cost) {
  ParallelCost own_cost;
  ParallelCost& c = cost != nullptr ? *cost : own_cost;
  Corners records;
  for (std::size_t k = 0; k < 3; ++k) records[k] = {corners[k], GlobalNumber{numbers[k]}};
  const auto run = [&](Lengths lengths) {
    const Places places(lengths, look.deviation.value);
    Stars<Int> stars = triangulate_places<Int>(nodes, records, places, ranks, options, c);
    if (stars.gave_up && ranks.size() > 1) {
      // One patch, of rank 0. The homes stay those of the many patches: another call may not give up.
      c.in_one_patch = 1;
      ParallelOptions one_patch = options;
      one_patch.patches = ranks.rank() == 0 ? 1 : 0;
      one_patch.last = nullptr;
      std::unique_ptr<Homes> homes = std::move(stars.homes);
      stars = triangulate_places<Int>(nodes, records, places, ranks, one_patch, c);
      if (stars.homes != nullptr) stars.homes = std::move(homes);
    }
    c.bytes_sent = ranks.bytes_sent;
    return stars;
  };
  // The predicates must be the same everywhere.
  if (look.lengths_are_one.value && !look.by_direction.value) {
    try {
      return run(Lengths::as_given);
    } catch (const HiddenNode&) {
      // The lengths as given hide a node: only directions show all.
    }
  }
  return run(Lengths::directions);
}

template Stars<std::int32_t> triangulate(const LocalNodes&, const Look&, const Point (&)[3],
                                         const std::int64_t (&)[3], Communicator&, const ParallelOptions&,
                                         ParallelCost*);
template Stars<std::int64_t> triangulate(const LocalNodes&, const Look&, const Point (&)[3],
                                         const std::int64_t (&)[3], Communicator&, const ParallelOptions&,
                                         ParallelCost*);

}  // namespace pstripack
