#pragma once
// Where the nodes of the next call should be: in the patches of the last call, if these are used again.

#include <cstddef>
#include <memory>

#include "parallel/divide.h"

namespace pstripack {

/// Which rank is the home of a place: the rank of its patch.
class Homes {
 public:
  /// own: nodes in the patches of this rank.
  Homes(const Division& division, const ParallelOptions& options, std::size_t own);

  const std::shared_ptr<const Partition>& partition() const { return partition_; }
  /// True if a call of this kind, with these numbers of patches and these lengths, can use these patches.
  /// Nodes with Lengths::as_given always can: lengths are about 1, so places are nearly directions.
  bool are_for(PartitionKind kind, const PatchRanges& patches, Lengths lengths) const {
    return kind == kind_ && patches == patches_ &&
           (lengths == Lengths::as_given || lengths == places_.lengths());
  }
  Lengths lengths() const { return places_.lengths(); }
  /// True if nearly all of these nodes are at home on this rank, as a look at some of them tells, and they
  /// are at most an eighth more than when these patches were cut.
  bool are_home_to(const LocalNodes& nodes, int rank) const;
  int rank(const Point& p) const { return static_cast<int>(patches_.rank_of(partition_->owner(places_(p)))); }

 private:
  std::shared_ptr<const Partition> partition_;
  PartitionKind kind_;
  PatchRanges patches_;
  Places places_;
  std::size_t share_;  ///< nodes in this rank's patches when these were cut
};

}  // namespace pstripack
