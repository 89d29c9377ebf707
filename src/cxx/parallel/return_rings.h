#pragma once
// The last phase: the stars of the nodes go back to the ranks that brought them.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/buffer.h"
#include "base/workspace.h"
#include "mesh/ring_table.h"
#include "parallel/coincidence.h"
#include "parallel/deliver.h"
#include "parallel/divide.h"
#include "parallel/halo.h"
#include "parallel/homes.h"
#include "parallel/patches.h"

namespace pstripack {

/// The stars of this rank's nodes. Int: std::int32_t, or std::int64_t where numbers need it.
template <class Int>
struct Stars {
  /// Of each of LocalNodes, as it stands in LIST: the numbers of its neighbours, counterclockwise; of an
  /// interior node from the smallest on; of a boundary node from the first boundary neighbour to the last,
  /// negated. Empty if nodes coincide.
  RingTable<Int> of_node;
  /// The memory of of_node and of the rings.
  std::vector<std::unique_ptr<Workspace>> memory;
  std::vector<Buffer<Int>> more_memory;
  Parcels received;
  Lengths lengths = Lengths::as_given;
  CoincidentPairs coincident;  ///< on every rank the same; empty if there are none
  /// With options.with_neighbours: the nodes that the stars name and this rank did not bring, by number.
  std::vector<HaloNode> outside;
  std::unique_ptr<Homes> homes;
};

/// `addresses`: of these nodes. Collective. Throws AgreedFailure or HiddenNode.
template <class Int>
Stars<Int> return_rings(Patches<Int> patches, ReturnAddresses addresses, const LocalNodes& nodes,
                        const Division& division, Communicator& ranks, const ParallelOptions& options);

}  // namespace pstripack
