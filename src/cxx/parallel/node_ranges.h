#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/global_number.h"
#include "parallel/local_numbers.h"

namespace pstripack {

/// A node of any rank: the rank that brings it, its owner, and which of LocalNodes it is there.
struct NodeAddress {
  RankOfNode rank;
  LocalNode node;
};

/// The nodes of all ranks counted through from 1, rank after rank, so that a number tells the address. The
/// same on every rank.
class NodeRanges {
 public:
  NodeRanges() = default;
  /// counts[r]: the nodes that rank r brings. Throws std::bad_alloc.
  NodeRanges(const std::int64_t* counts, std::size_t ranks) : first_(ranks + 1, 1) {
    for (RankNumber r = 0; r < ranks; ++r) first_[r + 1] = first_[r] + counts[r];
  }

  std::int64_t nodes() const { return first_.empty() ? 0 : first_.back() - 1; }
  /// The number of the rank's first node.
  std::int64_t first(RankNumber rank) const { return first_[rank]; }
  std::size_t count(RankNumber rank) const {
    return static_cast<std::size_t>(first_[rank + 1] - first_[rank]);
  }
  GlobalNumber number(const NodeAddress& a) const {
    return GlobalNumber{first_[a.rank] + static_cast<std::int64_t>(a.node)};
  }
  NodeAddress address(GlobalNumber number) const {
    const auto next = std::upper_bound(first_.begin(), first_.end(), value_of(number));
    return {static_cast<RankOfNode>(next - first_.begin() - 1),
            static_cast<LocalNode>(value_of(number) - next[-1])};
  }
  bool is_of(RankNumber rank, GlobalNumber number) const {
    return value_of(number) >= first_[rank] && value_of(number) < first_[rank + 1];
  }

 private:
  std::vector<std::int64_t> first_;  ///< of each rank, and the end
};

}  // namespace pstripack
