#include "mpi/options.h"

#include <limits>

namespace pstripack {

std::int64_t partition_vote(const MpiCommunicator& ranks, PartitionKind kind) {
  return ranks.rank() == 0 ? static_cast<std::int64_t>(kind) : std::numeric_limits<std::int64_t>::max();
}

}  // namespace pstripack
