#pragma once
// The nodes that a partition is made of: a sample, the same on every rank, to which every rank adds its
// share.

#include <cstddef>
#include <vector>

#include "parallel/local_nodes.h"
#include "parallel/partition.h"
#include "parallel/places.h"
#include "parallel/sent_node.h"

namespace pstripack {

/// The size of the sample: 64 nodes a patch, 16 if there are more than 256 patches; more where that costs
/// little beside the work on all nodes.
std::size_t sample_size(std::size_t nodes, std::size_t patches);

/// How many of the `wanted` sample nodes come from a rank that brings `of_rank` of all `nodes` nodes; the
/// ranks before it bring `before`.
std::size_t share_of_sample(std::size_t before, std::size_t of_rank, std::size_t wanted, std::size_t nodes);

/// Cuts this rank's nodes into `share` runs and writes one node of each.
void write_share(const LocalNodes& mine, std::size_t share, SentNode* sample);

/// The places of the nodes of this rank that are counted to move the cuts between patches: the same share on
/// every rank.
BlockArray<Point> places_to_count(const LocalNodes& mine, std::size_t nodes, std::size_t patches,
                                  const Places& places);

/// How `ranks` ranks of one patch each share these nodes (of about length 1) if each has brought its slice
/// of them, as in pool and comm mode: by boxes or stripes.
Partition partition_over_ranks(PartitionKind kind, int ranks, const std::vector<Point>& nodes);

}  // namespace pstripack
