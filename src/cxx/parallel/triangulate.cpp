// The parallel triangulation, in order:
//
//   nodes of this rank
//        |  divide               a sample of the nodes, the same on every rank, and counts near the cuts
//        v                       cut the sphere into patches
//   Division
//        |  deliver              every node goes to its patch and to those that have it in their margin
//        v
//   Delivery
//        |  triangulate_patches  every patch its own nodes, its margin and a few nodes of the sample
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

#include <memory>
#include <utility>

#include "capi/pstripack.h"
#include "mesh/delaunay.h"
#include "parallel/certify.h"
#include "parallel/deliver.h"
#include "parallel/patches.h"

namespace pstripack {
namespace {

/// `homes`: will be those of the patches, if not null. Throws HiddenNode, PatchesDoNotPay or AgreedFailure,
/// on every rank.
template <class Int>
Stars<Int> triangulate_places(const LocalNodes& nodes, const Corners& corners, const Places& places,
                              Communicator& ranks, const ParallelOptions& options, ParallelCost& cost,
                              std::unique_ptr<Homes>* homes) {
  const auto phase = [&](ParallelCost::Phase kind, const auto& body) {
    const PhaseTimer timer(&cost, kind, &ranks);
    return body();
  };
  const Division division =
      phase(ParallelCost::divide, [&] { return divide(nodes, corners, places, ranks, options); });
  Delivery delivery =
      phase(ParallelCost::divide, [&] { return deliver(nodes, division, ranks, options.threads); });
  std::size_t own = 0;
  for (const PatchNodes& patch : delivery.of_patch) {
    own += patch.own;
    cost.halo += static_cast<std::int64_t>(patch.margin);
  }
  if (homes != nullptr)
    delivery.outcome.go_on([&] { *homes = std::make_unique<Homes>(division, options, own); });

  Patches<Int> patches = phase(ParallelCost::triangulate, [&] {
    return triangulate_patches<Int>(delivery, division, ranks, options.threads);
  });
  Certified<Int> certified = phase(ParallelCost::merge, [&] {
    return certify(std::move(patches), division, ranks, options, cost.rounds);
  });
  if (!certified.coincident.empty()) {
    Stars<Int> none;
    none.coincident = std::move(certified.coincident);
    return none;
  }
  return phase(ParallelCost::lists, [&] {
    return return_rings(std::move(certified.patches), std::move(delivery.addresses), nodes, division, ranks,
                        options);
  });
}

}  // namespace

template <class Int>
Stars<Int> triangulate(const LocalNodes& nodes, const NodeCheck& check, const Point (&corners)[3],
                       const std::int64_t (&numbers)[3], Communicator& ranks, const ParallelOptions& options,
                       ParallelCost* cost) {
  ParallelCost own_cost;
  ParallelCost& c = cost != nullptr ? *cost : own_cost;
  Corners records;
  for (std::size_t k = 0; k < 3; ++k) records[k] = {corners[k], GlobalNumber{numbers[k]}};
  std::unique_ptr<Homes> homes;
  const bool by_coordinates = check.lengths_are_one.value && !check.by_direction.value;
  Stars<Int> stars = with_lengths(by_coordinates, [&](Lengths lengths) {
    const Places places(lengths, check.deviation.value);
    c.halo = 0;  // without that of a try that a hidden node has ended
    try {
      return triangulate_places<Int>(nodes, records, places, ranks, options, c, &homes);
    } catch (const PatchesDoNotPay&) {
      std::int64_t all = static_cast<std::int64_t>(nodes.count);
      ranks.all_sum(&all, 1);
      if (all > kMostHullNodes) throw AgreedFailure(PSTRIPACK_TOO_MANY_NODES);
      // One patch, of rank 0. The homes stay those of the many patches, which may pay in another call.
      c.in_one_patch = 1;
    }
    ParallelOptions one_patch = options;
    one_patch.patches = ranks.rank() == 0 ? 1 : 0;
    one_patch.last = nullptr;
    one_patch.given = nullptr;
    return triangulate_places<Int>(nodes, records, places, ranks, one_patch, c, nullptr);
  });
  stars.homes = std::move(homes);
  c.bytes_sent = ranks.bytes_sent;
  return stars;
}

template Stars<std::int32_t> triangulate(const LocalNodes&, const NodeCheck&, const Point (&)[3],
                                         const std::int64_t (&)[3], Communicator&, const ParallelOptions&,
                                         ParallelCost*);
template Stars<std::int64_t> triangulate(const LocalNodes&, const NodeCheck&, const Point (&)[3],
                                         const std::int64_t (&)[3], Communicator&, const ParallelOptions&,
                                         ParallelCost*);

}  // namespace pstripack
