#pragma once

#include <mpi.h>

#include <cstddef>

#include "base/shared_area.h"

namespace pstripack {

/// New memory that all ranks of a communicator map, all of them on one machine. Empty on a rank that cannot
/// map it, and on all if rank 0 cannot create it. Collective. Does not throw.
SharedArea area_of_all(MPI_Comm machine, std::size_t size);

}  // namespace pstripack
