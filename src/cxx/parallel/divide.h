#pragma once
// The first phase: a sample of the nodes, the same on every rank, and counts near the cuts cut the sphere
// into patches.

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "parallel/communicator.h"
#include "parallel/local_nodes.h"
#include "parallel/local_numbers.h"
#include "parallel/partition.h"
#include "parallel/patch_ranges.h"
#include "parallel/places.h"
#include "parallel/sent_node.h"

namespace pstripack {

class Homes;

struct ParallelOptions {
  PartitionKind partition = PartitionKind::bisection;
  int patches = 1;                               ///< of this rank, perhaps 0; may differ from rank to rank
  int threads = 1;                               ///< of this rank
  ThreadLimit thread_limit = ThreadLimit::size;  ///< for reports
  /// Fill Stars::outside, and give the stars memory of their own, so that the hulls can be freed. The numbers
  /// must be counted through all ranks: see NodeRanges.
  bool with_neighbours = false;
  /// Patches do not pay if a rank has more triangles that other patches lack.
  std::size_t most_questions = SIZE_MAX;
  /// For tests: patches of any shape, the same on every rank. Null: the nodes are divided by `partition`.
  std::shared_ptr<const Partition> given;
  /// For tests: about the number of nodes that all patches know.
  std::size_t closing_nodes = 256;
  /// The homes of an earlier call on these ranks; set on all of them or on none. Its patches are used again
  /// if nearly all nodes lie in patches of the ranks that bring them and no rank has too many, so nodes that
  /// were sent home stay at home.
  const Homes* last = nullptr;
};

/// Three nodes that are not on one great circle, the same on every rank.
using Corners = std::array<SentNode, 3>;

/// The sphere cut into patches. The same on every rank.
struct Division {
  explicit Division(const Places& p) : places(p) {}
  Places places;
  std::size_t nodes = 0;  ///< of all ranks
  PatchRanges patches;
  std::shared_ptr<const Partition> partition;
  std::vector<SentNode> closing;  ///< nodes of the sample that every patch knows
};

/// Collective. Throws AgreedFailure or PatchesDoNotPay.
Division divide(const LocalNodes& nodes, const Corners& corners, const Places& places, Communicator& ranks,
                const ParallelOptions& options);

}  // namespace pstripack
