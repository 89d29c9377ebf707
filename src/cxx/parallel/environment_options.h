#pragma once

#include <cstddef>

#include "parallel/triangulate.h"

namespace pstripack {

/// The partition that PSTRIPACK_PARTITION of this process names (read once), and as many
/// threads and patches as `local_nodes` nodes are worth.
ParallelOptions options_from_environment(std::size_t local_nodes);

/// False under PSTRIPACK_WARM_START=0 (read once): every call begins anew.
bool warm_start_is_allowed();

}  // namespace pstripack
