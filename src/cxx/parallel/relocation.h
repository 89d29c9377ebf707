#pragma once
// Nodes of the last call that other ranks bring now, or the same ranks in another order:
// docs/internals/parallel.md, "Warm start".
//
// Each rank compares its numbers with those of the last call, and tells those that have come and those that
// have gone to the rank that their hash names, since the caller alone knows where they went. That rank tells
// the ranks that had them where they have come, or that one of them has come nowhere: then the numbers are
// not the same. All that is named by its address, in stars and outside, gets its new address from the rank
// that had it; then the stars of nodes that have gone travel to the ranks that bring these nodes now.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/workspace.h"
#include "mesh/sample_of_stars.h"
#include "parallel/communicator.h"
#include "parallel/local_nodes.h"
#include "parallel/local_numbers.h"
#include "parallel/node_ranges.h"
#include "parallel/number_table.h"
#include "parallel/return_rings.h"

namespace pstripack {

class Relocation {
 public:
  /// Compares the nodes that this rank brings with those that it brought in the last call: the caller's
  /// numbers, and the ranges of all ranks then. Returns none, on every rank, if all ranks together do not
  /// bring the same nodes as before, or if more than an eighth of these come from other ranks. Collective.
  /// Throws AgreedFailure.
  static std::optional<Relocation> find(const std::int64_t* before, const NodeRanges& ranges,
                                        const LocalNodes& nodes, Communicator& ranks);

  /// Not for others: only find() knows whether the nodes are the same. Throws std::bad_alloc.
  Relocation(const std::int64_t* before, const NodeRanges& last, const NodeRanges& now, RankNumber me,
             const LocalNodes& nodes);

  /// Those stars of the last call's sample all of whose nodes are still here. Throws std::bad_alloc.
  SampleOfStars sample(const SampleOfStars& last) const { return last.renumbered(to_.data()); }

  /// The last call's stars, on the ranks that bring their nodes now, with the addresses that nodes have now.
  /// Collective. Throws AgreedFailure.
  template <class Int>
  Stars<Int> stars(const Stars<Int>& last, const LocalNodes& nodes, Communicator& ranks);
  /// After that: what a number counted in the last call is now; kNoNumber if this rank did not know its node.
  GlobalNumber now(GlobalNumber counted) const;
  const NodeRanges& ranges() const { return now_; }

  /// True if another rank brought node i in the last call.
  bool has_come(std::size_t i) const { return from_[i] >= had_; }
  std::size_t come() const { return come_; }

 private:
  static constexpr LocalNode kGone = SampleOfStars::kGone;
  /// A node that was here.
  struct Gone {
    GlobalNumber number;  ///< the caller's
    LastNode node;
    GlobalNumber now;  ///< counted
  };
  bool find_addresses(const LocalNodes& nodes, Communicator& ranks);
  GlobalNumber now(LastNode k) const;

  NodeRanges last_, now_;
  RankNumber me_;
  std::size_t had_;
  BlockArray<LastNode> from_;              ///< by LocalNode; had_, had_ + 1, ... if it was not here
  BlockArray<LocalNode> to_;               ///< by LastNode; kGone if another rank brings it
  std::size_t come_ = 0;                   ///< nodes that were not here
  std::vector<Gone> gone_;                 ///< by node
  NumberTable<GlobalNumber> outside_now_;  ///< of what was outside, by its counted number
};

}  // namespace pstripack
