#pragma once

#include "base/kept.h"
#include "mpi/gather_lists.h"
#include "mpi/mpi_communicator.h"
#include "parallel/last_rings.h"
#include "parallel/triangulate.h"
#include "trmesh/patience.h"
#include "trmesh/trmesh.h"

namespace pstripack {

/// What ranks keep of a call for the next one. The numbers are the same on every rank.
struct LastCall {
  std::size_t n = 0;  ///< 0: there was none with stars
  SampleOfStars sample;
  bool has_sample = false;  ///< on this rank
  Kept<LastRings> rings;    ///< on this rank, of calls whose nodes fitted
  Patience patience;
};

/// TRMESH (trmesh/trmesh.h) by all ranks together: the same bytes, the same codes, on every rank. Collective.
/// Throws AgreedFailure, having written nothing. `arrays`: of the call; on_every_rank (comm mode): the same
/// arguments and lists on every rank, -7 if they differ; on_one_rank (pool mode): those of rank 0, the others
/// pass none, of the same kind of reals, and get the result code only.
/// A call may begin with the rings of the last one that had this `last`; on all ranks or none.
/// If rank 0 passes `cost`, it is told there what the call cost all ranks, and so are others that pass one.
TrmeshResult collective_trmesh(MpiCommunicator& ranks, Arrays arrays, const TrmeshCall& call,
                               GroupCost* cost = nullptr, LastCall* last = nullptr);

}  // namespace pstripack
