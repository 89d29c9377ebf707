#pragma once

#include <cstddef>

#include "base/cached.h"
#include "mpi/gather_lists.h"
#include "mpi/mpi_communicator.h"
#include "parallel/last_rings.h"
#include "parallel/triangulate.h"
#include "trmesh/patience.h"
#include "trmesh/trmesh.h"

namespace pstripack {

/// What a rank caches from one call for the next. n and patience are the same on every rank.
struct LastCall {
  std::size_t n = 0;  ///< number of nodes; 0: nothing is cached
  SampleOfStars sample;
  bool has_sample = false;  ///< false if this rank had no memory for the sample
  Cached<LastRings> rings;  ///< only after calls whose nodes fitted the sample
  Patience patience;
};

/// TRMESH (trmesh/trmesh.h) by all ranks together; lists and codes have the same bits as on one process.
/// Collective. Throws AgreedFailure, having written nothing.
///   arrays  on_every_rank (comm mode): every rank passes the same arguments and gets the lists; -7 if they
///           differ. on_one_rank (pool mode): rank 0 passes the arguments and gets the lists; the others pass
///           no arrays, but the same size of reals, and get the result code only. shared: all pass the same
///           memory
///   cost    if rank 0 passes it, the cost of the call is stored on every rank that passes it
///   last    null on all ranks or on none; the call may start from the last call with the same `last`
TrmeshResult collective_trmesh(MpiCommunicator& ranks, Arrays arrays, const TrmeshCall& call,
                               GroupCost* cost = nullptr, LastCall* last = nullptr);

}  // namespace pstripack
