#pragma once
// The parallel triangulation: patches over threads and ranks, certified, bit for bit the serial result.

#include <cstdint>

#include "geometry/point.h"
#include "parallel/communicator.h"
#include "parallel/cost.h"
#include "parallel/divide.h"
#include "parallel/local_nodes.h"
#include "parallel/return_rings.h"

namespace pstripack {

/// What all ranks see: lengths and deviation become those of all nodes. Collective.
inline void agree_on(NodeCheck& check, Communicator& ranks) {
  agree(ranks, check.lengths_are_one, check.deviation, check.by_direction);
}

/// The triangulation of the nodes of all ranks together, at least three and not all on one great circle
/// (`corners`: three of them that are not, the same on every rank). `check`: what all ranks see; all nodes
/// must have a direction. Collective. Throws AgreedFailure, on every rank; PatchesDoNotPay if there is one
/// rank.
template <class Int>
Stars<Int> triangulate(const LocalNodes& nodes, const NodeCheck& check, const Point (&corners)[3],
                       const std::int64_t (&numbers)[3], Communicator& ranks, const ParallelOptions& options,
                       ParallelCost* cost = nullptr);

}  // namespace pstripack
