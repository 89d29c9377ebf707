#pragma once

#include <mpi.h>

#include <cstddef>

#include "base/shared_area.h"

namespace pstripack {

/// New memory that all ranks of a communicator map, all of them on one machine. Collective. Empty on a rank
/// that cannot; on all if rank 0 cannot.
SharedArea area_of_all(MPI_Comm machine, std::size_t size);

}  // namespace pstripack
