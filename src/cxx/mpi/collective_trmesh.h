#pragma once

#include "mpi/gather_lists.h"
#include "mpi/mpi_communicator.h"
#include "parallel/triangulate.h"
#include "trmesh/trmesh.h"

namespace pstripack {

/// TRMESH (trmesh/trmesh.h) by all ranks together: the same bytes, the same codes, on every rank. Collective.
/// Throws AgreedFailure, having written nothing. `arrays`: of the call; on_every_rank (comm mode): the same
/// arguments and lists on every rank, -7 if they differ; on_one_rank (pool mode): those of rank 0, the others
/// pass none, of the same kind of reals, and get the result code only.
/// If rank 0 passes `cost`, it is told there what the call cost all ranks, and so are others that pass one.
TrmeshResult collective_trmesh(MpiCommunicator& ranks, Arrays arrays, const TrmeshCall& call,
                               GroupCost* cost = nullptr);

}  // namespace pstripack
