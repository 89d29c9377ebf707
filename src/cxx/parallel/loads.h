#pragma once
// What the last call had to do in its patches. If these were badly cut, the next call cuts them better.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "parallel/partition.h"
#include "parallel/patch_ranges.h"

namespace pstripack {

struct PatchLoad {
  std::int64_t own, known;  ///< nodes; `known`: with the halo
  std::int64_t work;        ///< Patch::work(), nanoseconds
  std::int64_t questions;   ///< Patch::questions()
};

/// The loads of all patches of a partition. The same on every rank.
class Loads {
 public:
  /// of_patch: in the order of the patches. Throws std::bad_alloc.
  Loads(std::shared_ptr<const Partition> partition, const PatchRanges& patches,
        const std::vector<PatchLoad>& of_patch);

  /// True if a rank had much more work than most: nodes that are very close take longer.
  bool are_uneven() const { return are_uneven_; }
  /// True if a rank had many questions: neighbours in the mesh are far from each other.
  bool have_many_questions() const { return have_many_questions_; }

  /// The work of a node at this place over that of a node in the patch where it is most: 0 to 1.
  double weight(const Point& place) const {
    return nanoseconds_[static_cast<std::size_t>(partition_->owner(place))] / most_;
  }
  /// Leaves out places, so that each patch keeps a part of its own that is its weight().
  void thin(std::vector<Point>& places) const;
  /// True if with this partition the rank that has most to do would have less, halos included, as a sample of
  /// the nodes tells. Throws std::bad_alloc.
  bool expect_less_of(const Partition& other, const std::vector<Point>& sample, std::size_t nodes) const;

 private:
  std::shared_ptr<const Partition> partition_;
  PatchRanges patches_;
  std::vector<double> nanoseconds_;        ///< of a node, with the questions of its patch, by patch
  std::vector<double> without_questions_;  ///< the same without them
  double most_ = 1;                        ///< the largest of nanoseconds_
  double most_of_rank_ = 0;                ///< nanoseconds of the rank with most to do
  bool are_uneven_ = false, have_many_questions_ = false;
};

}  // namespace pstripack
