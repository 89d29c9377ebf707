#pragma once
// The last phase: the stars of the nodes go back to the ranks that brought them.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/workspace.h"
#include "mesh/ring_table.h"
#include "parallel/coincidence.h"
#include "parallel/deliver.h"
#include "parallel/divide.h"
#include "parallel/halo.h"
#include "parallel/homes.h"
#include "parallel/patches.h"

namespace pstripack {

/// The stars of this rank's nodes. Int: std::int32_t, or std::int64_t where numbers need it.
template <class Int>
struct Stars {
  /// Of each of LocalNodes, as it stands in LIST: the numbers of its neighbours, counterclockwise; of an
  /// interior node from the smallest on; of a boundary node from the first boundary neighbour to the last,
  /// negated. Empty if nodes coincide.
  RingTable<Int> of_node;
  std::vector<Block> memory;   ///< of the rings
  CoincidentPairs coincident;  ///< on every rank the same; empty if there are none
  /// With options.with_neighbours: the nodes that the stars name and this rank did not bring, by number; see
  /// fetch_halo().
  std::vector<HaloNode> outside;
  Halo halo;  ///< exchanges values of `outside`
  std::unique_ptr<Homes> homes;
};

/// `addresses`: of these nodes. Collective. Throws AgreedFailure or HiddenNode.
template <class Int>
Stars<Int> return_rings(Patches<Int> patches, RingAddresses addresses, const LocalNodes& nodes,
                        const Division& division, Communicator& ranks, const ParallelOptions& options);

/// Collects the nodes that rings name and this rank does not bring. Numbers are counted through all ranks;
/// this rank brings `count` nodes from `first` on.
template <class Int>
class NamedOutside {
 public:
  NamedOutside(GlobalNumber first, std::size_t count)
      : first_(static_cast<Int>(first)),
        last_(static_cast<Int>(value_of(first) + static_cast<std::int64_t>(count) - 1)) {}

  void add(Int entry) {
    if (is_outside(entry)) named_.push_back(named_by(entry));
  }
  /// All entries of a stored ring. Returns its end.
  const Int* add_ring(const Int* place) {
    const Int* const end = place + 1 + *place;
    std::for_each(place + 1, end, [this](Int entry) { add(entry); });
    return end;
  }
  void add(const NamedOutside& other) {
    named_.insert(named_.end(), other.named_.begin(), other.named_.end());
  }
  /// By number, without points. Throws std::bad_alloc, as all other members do.
  std::vector<HaloNode> nodes() {
    std::sort(named_.begin(), named_.end());
    named_.erase(std::unique(named_.begin(), named_.end()), named_.end());
    std::vector<HaloNode> nodes;
    for (const GlobalNumber number : named_) nodes.push_back({{}, number, kNoNumber});
    return nodes;
  }

 private:
  bool is_outside(Int entry) const {
    const Int number = entry < 0 ? -entry : entry;
    return (number < first_) | (number > last_);
  }
  Int first_, last_;
  std::vector<GlobalNumber> named_;
};

}  // namespace pstripack
