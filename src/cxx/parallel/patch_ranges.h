#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "parallel/local_numbers.h"

namespace pstripack {

/// Which patches each rank has, counted through all ranks.
class PatchRanges {
 public:
  /// Adds the patches of the next rank: their number.
  void add(int patches) {
    if (first_.empty()) first_.push_back(0);
    first_.push_back(first_.back() + patches);
  }

  int count() const { return first_.back(); }
  std::size_t ranks() const { return first_.empty() ? 0 : first_.size() - 1; }
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

}  // namespace pstripack
