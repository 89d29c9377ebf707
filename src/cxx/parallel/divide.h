#pragma once
// The first phase: a sample of the nodes, the same on every rank, and counts near the cuts cut the sphere
// into patches.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "parallel/communicator.h"
#include "parallel/local_nodes.h"
#include "parallel/local_numbers.h"
#include "parallel/partition.h"
#include "parallel/places.h"
#include "parallel/record.h"

namespace pstripack {

class Homes;

struct ParallelOptions {
  PartitionKind partition = PartitionKind::bisection;
  int patches = 1;  ///< of this rank, perhaps 0; may differ from rank to rank
  int threads = 1;  ///< of this rank
  /// Fill Stars::outside, and give the stars memory of their own, so that the hulls can be freed.
  bool with_neighbours = false;
  /// Of a single rank: give up if the patches have more questions than this, since one patch would be faster.
  /// Of several: if a rank has more, they agree on stars instead.
  std::size_t most_questions = SIZE_MAX;
  /// The homes of an earlier call on these ranks; set on all of them or on none. Its patches are kept if
  /// nearly all nodes lie in patches of the ranks that bring them and no rank has too many. So nodes that
  /// were sent home stay at home.
  const Homes* last = nullptr;
};

/// Three nodes that are not on one great circle, the same on every rank.
using Corners = std::array<Record, 3>;

/// Which patches each rank has, counted through all ranks.
class PatchRanges {
 public:
  /// Adds the patches of the next rank: their number.
  void add(int patches) {
    if (first_.empty()) first_.push_back(0);
    first_.push_back(first_.back() + patches);
  }

  int count() const { return first_.back(); }
  PatchNumber first(RankNumber rank) const { return first_[rank]; }
  PatchNumber end(RankNumber rank) const { return first_[rank + 1]; }
  std::size_t count(RankNumber rank) const { return static_cast<std::size_t>(end(rank) - first(rank)); }
  RankNumber rank_of(PatchNumber patch) const {
    return static_cast<RankNumber>(std::upper_bound(first_.begin(), first_.end(), patch) - first_.begin()) -
           1;
  }
  bool operator==(const PatchRanges& other) const { return first_ == other.first_; }

 private:
  std::vector<PatchNumber> first_;  ///< of each rank, and the end; no memory before ranks can agree on it
};

/// The sphere cut into patches. The same on every rank.
struct Division {
  explicit Division(const Places& p) : places(p) {}
  Places places;
  std::size_t nodes = 0;  ///< of all ranks
  PatchRanges patches;
  std::shared_ptr<const Partition> partition;
  std::vector<Record> closing;                                    ///< nodes from everywhere
  double most_stretch = std::numeric_limits<double>::infinity();  ///< of the closing nodes, if computed
  /// Patches agree on stars: they would have too many questions.
  bool by_agreement = false;
  /// There is one process only. Its caller can build one hull instead of asking many questions.
  bool may_give_up = false;
  bool gave_up = false;  ///< then there is nothing else
};

/// Which rank is the home of a place: the rank of its patch.
class Homes {
 public:
  Homes(const Division& division, PartitionKind kind)
      : partition_(division.partition),
        by_agreement_(division.by_agreement),
        kind_(kind),
        patches_(division.patches),
        places_(division.places) {}

  const std::shared_ptr<const Partition>& partition() const { return partition_; }
  bool by_agreement() const { return by_agreement_; }
  /// True if a call of this kind, with these numbers of patches and these lengths, can use these patches.
  /// Nodes with Lengths::as_given always can: lengths are about 1, so places are nearly directions.
  bool are_for(PartitionKind kind, const PatchRanges& patches, Lengths lengths) const {
    return kind == kind_ && patches == patches_ &&
           (lengths == Lengths::as_given || lengths == places_.lengths());
  }
  Lengths lengths() const { return places_.lengths(); }
  /// False if a rank that brings `nodes` of `all` nodes has an eighth more than its share: then these patches
  /// are not kept.
  bool is_share_of(RankNumber rank, std::size_t nodes, std::size_t all) const;
  /// True if nearly all of these nodes are at home on this rank, as a look at some of them tells.
  bool are_home_to_most(const LocalNodes& nodes, int rank) const;
  int rank(const Point& p) const { return static_cast<int>(patches_.rank_of(partition_->owner(places_(p)))); }

 private:
  std::shared_ptr<const Partition> partition_;
  bool by_agreement_;
  PartitionKind kind_;
  PatchRanges patches_;
  Places places_;
};

/// Collective. Throws AgreedFailure.
Division divide(const LocalNodes& nodes, const Corners& corners, const Places& places, Communicator& ranks,
                const ParallelOptions& options);

}  // namespace pstripack
