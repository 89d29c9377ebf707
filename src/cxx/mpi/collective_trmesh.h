#pragma once

#include <cstdint>

#include "mpi/mpi_communicator.h"
#include "parallel/triangulate.h"
#include "trmesh/trmesh.h"

namespace pstripack {

/// Where the arrays of a collective TRMESH are.
enum class Arrays {
  on_every_rank,  ///< comm mode: the same arguments on every rank, the lists on every rank; -7 if they differ
  on_rank_0,      ///< pool mode: the others pass n = 0 and null pointers, and get the result code only
  shared          ///< the same on one machine: every rank passes the same memory; lnew is rank 0's
};

/// TRMESH (trmesh/trmesh.h) by all ranks together: the same bytes, the same codes, on every rank.
/// Collective; Real is the same on every rank. Throws AgreedFailure, having written nothing.
/// If rank 0 passes `cost`, it is told there what the call cost all ranks, and so are others that pass one.
template <class Real>
TrmeshResult collective_trmesh(MpiCommunicator& ranks, Arrays arrays, std::int32_t n, const Real* x,
                               const Real* y, const Real* z, std::int32_t* list, std::int32_t* lptr,
                               std::int32_t* lend, std::int32_t* lnew, GroupCost* cost = nullptr);

}  // namespace pstripack
