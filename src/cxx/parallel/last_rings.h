#pragma once
// Rings of an earlier call in which ranks have slices of the nodes (pool, comm mode): docs/parallel.md, "Warm
// start".
//
// The slices may lie anywhere on the sphere. So a rank has the stars of the nodes that were at home in its
// patches when the first such call began. It reads where these nodes are now, or is told by the ranks that
// have their slices (pool on several machines), and sends the rings that have changed to those ranks.
//
// As on threads, the first call caches a sample, the next one whose nodes fit caches the rings, the third
// begins with them. One set of rings is cached. Where only rank 0 can read all nodes, its sample decides.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/workspace.h"
#include "parallel/moving_stars.h"

namespace pstripack {

/// The rings of this rank's slice of the nodes: first_node (from 0) and the following ones. Each rank moves
/// and repairs the stars of the nodes that are at home there, and sends the rings that have changed to the
/// ranks that have these nodes in their slices.
class LastRings {
 public:
  /// Throws std::bad_alloc.
  LastRings(const RingTable<std::int32_t>& rings, std::size_t first_node, std::unique_ptr<const Homes> homes);

  /// Updates the rings for the nodes' current positions and returns true. Or returns false, on every rank;
  /// the rings must then be discarded. `begin`: the first node of each rank's slice, then the number of all
  /// nodes. If ranks cannot read all nodes, positions are sent to the homes. Collective. Throws
  /// AgreedFailure.
  bool move(const LocalNodes& slice, const std::vector<std::size_t>& begin, Communicator& ranks);
  const RingTable<std::int32_t>& rings() const { return of_slice_.of_node; }
  const MovingStars& stars() const { return *moving_; }

 private:
  void send_home(const LocalNodes& slice, Communicator& ranks);
  void send_places(const LocalNodes& slice, Communicator& ranks);
  void replace(const Parcels& changed);

  const CacheReservation stay_;
  const std::size_t first_node_;
  const std::unique_ptr<const Homes> homes_;
  NodeRanges slices_;
  Stars<std::int32_t> of_slice_;
  std::vector<RankOfNode> home_;  ///< of the nodes of the slice
  std::size_t replaced_ = 0;      ///< entries of rings that replace() has stored
  // At home here:
  std::vector<std::int64_t> numbers_;
  BlockArray<Point> points_;
  std::unique_ptr<MovingStars> moving_;
};

}  // namespace pstripack
