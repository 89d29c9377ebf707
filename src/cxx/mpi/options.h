#pragma once

#include <cstdint>

#include "mpi/mpi_communicator.h"
#include "parallel/options.h"

namespace pstripack {

/// Environments may differ from machine to machine; the partition may not. Rank 0's as a number that all_min
/// makes known to all, together with other values.
std::int64_t partition_vote(const MpiCommunicator& ranks, PartitionKind kind);
inline PartitionKind elected_partition(std::int64_t vote) { return static_cast<PartitionKind>(vote); }

}  // namespace pstripack
