#pragma once
// The nodes of the last call, of which other ranks bring some now, or in another order: docs/parallel.md,
// "Warm start".

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/workspace.h"
#include "mesh/sample_of_stars.h"
#include "parallel/communicator.h"
#include "parallel/local_nodes.h"
#include "parallel/number_table.h"
#include "parallel/return_rings.h"

namespace pstripack {

class Relocation {
 public:
  /// Compares the nodes that this rank brings with the `had` nodes, with these numbers, that it brought in
  /// the last call. None on every rank if all ranks together do not bring the same nodes as before, or if
  /// more than an eighth of these come from other ranks. Collective. Throws AgreedFailure.
  static std::optional<Relocation> find(const std::int64_t* before, std::size_t had, const LocalNodes& nodes,
                                        Communicator& ranks);

  /// Not for others: only find() knows whether the nodes are the same. Throws std::bad_alloc.
  Relocation(const std::int64_t* before, std::size_t had, const LocalNodes& nodes);

  /// Those stars of the last call's sample all of whose nodes are still here. Throws std::bad_alloc.
  SampleOfStars sample(const SampleOfStars& last) const { return last.renumbered(to_.data()); }

  /// The last call's stars, on the ranks that bring their nodes now. `outside` has numbers without places,
  /// those that the stars name and perhaps some more. Collective. Throws AgreedFailure.
  template <class Int>
  Stars<Int> stars(const Stars<Int>& last, Communicator& ranks) const;

 private:
  /// A node that was here.
  struct Gone {
    std::int64_t number;
    std::uint32_t node, rank;  ///< which it was here; which rank brings it now
  };
  bool find_ranks(const LocalNodes& nodes, Communicator& ranks);

  std::size_t had_;
  bool are_distinct_ = true;         ///< the numbers now, and positive
  NumberTable<std::uint32_t> here_;  ///< the nodes by number
  BlockArray<std::uint32_t> from_;   ///< of each: which it was here; had_, had_ + 1, ... if it was not
  BlockArray<std::uint32_t> to_;     ///< of each that was here: which it is; SampleOfStars::kGone
  std::size_t come_ = 0;             ///< nodes that were not here
  std::vector<Gone> gone_;
};

}  // namespace pstripack
