#pragma once

#include <mpi.h>

#include <cstddef>

#include "base/shared_area.h"

namespace pstripack {

/// New memory of `size` bytes that all ranks of the communicator `machine` map. All must be on one machine.
/// Empty on a rank that fails to map it, and on all ranks if rank 0 fails to create it. Collective. Does
/// not throw.
SharedArea area_of_all(MPI_Comm machine, std::size_t size);

}  // namespace pstripack
