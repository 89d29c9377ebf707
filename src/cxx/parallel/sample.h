#pragma once
// The nodes that a partition is made of: a sample, the same on every rank, to which every rank adds its
// share.

#include <cstddef>
#include <vector>

#include "parallel/local_nodes.h"
#include "parallel/partition.h"
#include "parallel/record.h"

namespace pstripack {

/// So many nodes a patch, more where that costs little beside the work on all nodes.
std::size_t sample_size(std::size_t nodes, std::size_t patches);

/// Adds one node in each of as many runs of this rank's nodes as are its share of `wanted` out of `nodes`.
void add_share(const LocalNodes& mine, std::size_t wanted, std::size_t nodes, std::vector<Record>& sample);

/// How `ranks` ranks of one patch each share these nodes (of about length 1) if each has brought its slice
/// of them, as in pool and comm mode.
Partition partition_over_ranks(PartitionKind kind, int ranks, const std::vector<Point>& nodes);

}  // namespace pstripack
