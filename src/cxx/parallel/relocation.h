#pragma once
// The nodes of the last call, of which other ranks bring some now, or in another order: docs/parallel.md,
// "Warm start".
//
// Each rank compares its numbers with those of the last call, and tells those that have come and those that
// have gone to the rank that their hash names. That rank tells the ranks that had them where they have come,
// or that one of them has come nowhere: then the numbers are not the same. The stars of nodes that have gone
// travel to the ranks that bring these nodes now, and every rank asks all others anew which of them bring the
// neighbours that it does not.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/workspace.h"
#include "mesh/sample_of_stars.h"
#include "parallel/communicator.h"
#include "parallel/local_nodes.h"
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
  Stars<Int> stars(const Stars<Int>& last, const LocalNodes& nodes, Communicator& ranks) const;

  static constexpr std::uint32_t kGone = SampleOfStars::kGone;
  /// Which node here was node k of the last call here; kGone if another rank brings it.
  std::uint32_t to(std::size_t k) const { return to_[k]; }
  std::size_t had() const { return had_; }
  /// Calls visit(k, number) for each node k of the last call here that another rank brings.
  template <class Visit>
  void for_each_that_has_gone(const Visit& visit) const {
    for (const Gone& g : gone_) visit(std::size_t{g.node}, g.number);
  }
  /// Node i was not here.
  bool has_come(std::size_t i) const { return from_[i] >= had_; }
  std::size_t come() const { return come_; }

 private:
  /// A node that was here.
  struct Gone {
    GlobalNumber number;
    std::uint32_t node, rank;  ///< which it was here; which rank brings it now
  };
  bool find_ranks(const LocalNodes& nodes, Communicator& ranks);

  std::size_t had_;
  bool are_positive_ = true;        ///< the numbers of nodes that were not here
  BlockArray<std::uint32_t> from_;  ///< of each: which it was here; had_, had_ + 1, ... if it was not
  BlockArray<std::uint32_t> to_;    ///< of each that was here: which it is; kGone
  std::size_t come_ = 0;            ///< nodes that were not here
  std::vector<Gone> gone_;
};

}  // namespace pstripack
