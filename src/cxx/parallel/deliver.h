#pragma once
// The second phase: every node goes to its patch and to those that have it in their halo.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/workspace.h"
#include "parallel/agreement.h"
#include "parallel/divide.h"
#include "parallel/local_numbers.h"
#include "parallel/record.h"

namespace pstripack {

/// The places of rings in a table: first come those of this rank's nodes that other ranks' patches own, patch
/// by patch, then those of all own nodes of each patch here.
struct ReturnAddresses {
  std::vector<std::size_t> away_begin;  ///< by PatchNumber
  std::vector<std::size_t> own_begin;   ///< by PatchHere; then the end of the table
  /// [PatchHere][RankNumber]: the PatchNode of the first own node that the rank brought; then the end.
  std::vector<std::vector<std::size_t>> own_from;
  std::unique_ptr<Workspace> memory;
  std::uint32_t* position = nullptr;  ///< in the table, by LocalNode
};

/// What the patches of this rank know.
struct Delivery {
  std::vector<PatchNodes> of_patch;  ///< own nodes in the order of the ranks that brought them
  std::unique_ptr<Workspace> memory;
  ReturnAddresses addresses;
  Outcome outcome;  ///< of this rank: the next agreement has to accept it
};

/// Collective. Throws AgreedFailure.
Delivery deliver(const LocalNodes& nodes, const Division& division, Communicator& ranks, int threads);

}  // namespace pstripack
