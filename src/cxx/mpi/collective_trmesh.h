#pragma once

#include "mpi/gather_lists.h"
#include "mpi/mpi_communicator.h"
#include "parallel/triangulate.h"
#include "trmesh/trmesh.h"

namespace pstripack {

/// TRMESH (trmesh/trmesh.h) by all ranks together; lists and codes have the same bits as on one process.
/// Collective. Throws AgreedFailure, having written nothing.
///   arrays  on_every_rank (comm mode): every rank passes the same arguments and gets the lists; -7 if they
///           differ. Up to 8 ranks begin with the mesh of an earlier call, if all have one. on_one_rank (pool
///           mode): rank 0 passes the arguments and gets the lists; the others pass no arrays, but the same
///           size of reals, and get the result code only. shared: all pass the same memory
///   cost    if rank 0 passes it, the cost of the call is stored on every rank that passes it
TrmeshResult collective_trmesh(MpiCommunicator& ranks, Arrays arrays, const TrmeshCall& call,
                               GroupCost* cost = nullptr);

}  // namespace pstripack
