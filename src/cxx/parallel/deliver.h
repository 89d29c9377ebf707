#pragma once
// The second phase: every node goes to its patch and to those that have it in their margin.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/workspace.h"
#include "parallel/agreement.h"
#include "parallel/divide.h"
#include "parallel/local_numbers.h"
#include "parallel/sent_node.h"

namespace pstripack {

/// The places of rings in a table, patch by patch: of a patch here, the rings of all its own nodes; of
/// another rank's patch, those of its own nodes that this rank has brought.
struct RingAddresses {
  std::vector<std::size_t> begin;  ///< by PatchNumber; then the end of the table
  /// [PatchHere][RankNumber]: the PatchNode of the first own node that the rank brought; then the end.
  std::vector<std::vector<std::size_t>> own_from;
  BlockArray<std::uint32_t> position;  ///< in the table, by LocalNode
};

/// What the patches of this rank know.
struct Delivery {
  std::vector<PatchNodes> of_patch;  ///< own nodes in the order of the ranks that brought them
  BlockArray<SentNode> nodes;        ///< of all patches
  RingAddresses addresses;
  Outcome outcome;  ///< of this rank: the next agreement has to accept it
};

/// Collective. Throws AgreedFailure.
Delivery deliver(const LocalNodes& nodes, const Division& division, Communicator& ranks, int threads);

}  // namespace pstripack
