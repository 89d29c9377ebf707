#pragma once
// The parallel triangulation: patches over threads and ranks, certified, bit for bit the serial result.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/point.h"
#include "geometry/workspace.h"
#include "mesh/delaunay.h"
#include "mesh/rings.h"
#include "parallel/communicator.h"
#include "parallel/cost.h"
#include "parallel/local_nodes.h"
#include "parallel/partition.h"
#include "parallel/places.h"
#include "parallel/record.h"

namespace pstripack {

/// Which rank is home to a place: where its patch is.
class Homes {
 public:
  Homes() = default;
  Homes(std::shared_ptr<const Partition> partition, PartitionKind kind, std::vector<int> first_patch,
        const Places& places)
      : partition_(std::move(partition)),
        kind_(kind),
        first_patch_(std::move(first_patch)),
        places_(places) {}

  const std::shared_ptr<const Partition>& partition() const { return partition_; }
  /// True if a call could have these patches, so many on each rank, for nodes in such places. Lengths are as
  /// given where they are about one: then the places are nearly those of directions.
  bool are_for(PartitionKind kind, const std::vector<int>& first_patch, Lengths lengths) const {
    return kind == kind_ && first_patch == first_patch_ &&
           (lengths == Lengths::as_given || lengths == places_.lengths());
  }
  int rank(const Point& p) const {
    const int patch = partition_->owner(places_(p));
    return static_cast<int>(std::upper_bound(first_patch_.begin(), first_patch_.end(), patch) -
                            first_patch_.begin()) -
           1;
  }

 private:
  std::shared_ptr<const Partition> partition_;
  PartitionKind kind_ = PartitionKind::bisection;
  std::vector<int> first_patch_;  ///< of each rank
  Places places_{Lengths::as_given, 0};
};

struct ParallelOptions {
  PartitionKind partition = PartitionKind::bisection;
  int patches = 1;  ///< of this rank; may differ from rank to rank
  int threads = 1;  ///< of this rank
  /// Fill Stars::outside, and let the stars hold little memory beside their own.
  bool with_neighbours = false;
  /// Of a single rank: give up if the patches have more questions, or nodes on what they take for the
  /// boundary, than this, since one patch would be faster.
  std::size_t most_questions = SIZE_MAX;
  /// Of an earlier call on these ranks, on all of them or none: its patches are kept if nearly all nodes are
  /// where they belong in them, in equal numbers. Then nodes that were sent home are at home.
  const Homes* last = nullptr;
};

/// The stars of this rank's nodes. Int: std::int32_t, or std::int64_t where numbers need it.
template <class Int>
struct Stars {
  /// Of each of LocalNodes, as it stands in LIST: the numbers of its neighbours, counterclockwise; of an
  /// interior node from the smallest on; of a boundary node from the first boundary neighbour to the last,
  /// negated. Empty if nodes coincide.
  RingTable<Int> of_node;
  /// What of_node and the rings lie in.
  std::vector<std::unique_ptr<Workspace>> memory;
  std::vector<Buffer<Int>> more_memory;
  Parcels received;
  Lengths lengths = Lengths::as_given;
  bool gave_up = false;  ///< more than options.most_questions: there is nothing else
  /// Two different nodes in the same direction, numbers, on every rank the same; empty if there are none.
  std::vector<std::pair<std::int64_t, std::int64_t>> coincident;
  /// With options.with_neighbours: the nodes that the stars name and this rank did not bring, by number.
  std::vector<Record> outside;
  std::unique_ptr<Homes> homes;
};

/// What all ranks see: lengths and deviation become those of all nodes. Collective.
void agree_on(Look& look, Communicator& ranks);

/// The triangulation of the nodes of all ranks together, at least three and not all on one great circle
/// (`corners`: three of them that are not, the same on every rank). `look`: what all ranks see; all nodes
/// must have a direction. Collective. Throws AgreedFailure, on every rank.
template <class Int>
Stars<Int> triangulate(const LocalNodes& nodes, const Look& look, const Point (&corners)[3],
                       const std::int64_t (&numbers)[3], Communicator& ranks, const ParallelOptions& options,
                       ParallelCost* cost = nullptr);

}  // namespace pstripack
