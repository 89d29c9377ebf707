#include "parallel/loads.h"

#include <algorithm>
#include <utility>

namespace pstripack {
namespace {

constexpr double kUneven = 1.15;     // the most work of a rank, over the mean
constexpr double kUnevenHalo = 1.5;  // the same with its halo and questions, over the mean without
constexpr std::int64_t kSeldom = 4;  // own nodes for each question
constexpr double kOfQuestion = 300;  // nanoseconds, about: of patches that know the nodes it is about

}  // namespace

Loads::Loads(std::shared_ptr<const Partition> partition, const PatchRanges& patches,
             const std::vector<PatchLoad>& of_patch)
    : partition_(std::move(partition)), patches_(patches) {
  // For own nodes only, since halos grow and shrink with the borders: the mean of all ranks, and the most.
  double even = 0, most = 0;
  for (RankNumber r = 0; r < patches_.ranks(); ++r) {
    double of_own = 0, of_rank = 0;
    std::int64_t own = 0, questions = 0;
    for (PatchNumber k = patches_.first(r); k < patches_.end(r); ++k) {
      const PatchLoad& load = of_patch[static_cast<std::size_t>(k)];
      const double known = static_cast<double>(std::max<std::int64_t>(load.known, 1));
      const double asking = kOfQuestion * static_cast<double>(load.questions);
      const double work = static_cast<double>(load.work);
      nanoseconds_.push_back((work + asking) / known);
      without_questions_.push_back(work / known);
      of_own += work * static_cast<double>(load.own) / known;
      of_rank += work + asking;
      own += load.own;
      questions += load.questions;
    }
    even += of_own / static_cast<double>(patches_.ranks());
    most = std::max(most, of_own);
    most_of_rank_ = std::max(most_of_rank_, of_rank);
    have_many_questions_ = have_many_questions_ || kSeldom * questions > own;
  }
  are_uneven_ = most > kUneven * even || most_of_rank_ > kUnevenHalo * even;
  most_ = std::max(1.0, *std::max_element(nanoseconds_.begin(), nanoseconds_.end()));
}

void Loads::thin(std::vector<Point>& places) const {
  double sum = 0;
  const auto is_left_out = [&](const Point& place) {
    sum += weight(place);
    if (sum < 1) return true;
    sum -= 1;
    return false;
  };
  places.erase(std::remove_if(places.begin(), places.end(), is_left_out), places.end());
}

bool Loads::expect_less_of(const Partition& other, const std::vector<Point>& sample,
                           std::size_t nodes) const {
  std::vector<PatchOfNode> owner(sample.size());
  std::vector<double> nearest_plane(sample.size()), of_rank(patches_.ranks());
  other.owners(sample.data(), sample.size(), owner.data(), nearest_plane.data());
  // Where halos follow the mesh, there are few questions.
  const std::vector<double>& of_node = other.has_convex_patches() ? nanoseconds_ : without_questions_;
  const auto add = [&](std::size_t i, PatchNumber q) {
    of_rank[patches_.rank_of(q)] += of_node[static_cast<std::size_t>(partition_->owner(sample[i]))];
  };
  for (std::size_t i = 0; i < sample.size(); ++i) add(i, static_cast<PatchNumber>(owner[i]));
  other.for_each_halo(sample.data(), sample.size(), owner.data(), nearest_plane.data(), add);
  const double most = *std::max_element(of_rank.begin(), of_rank.end());
  return most * static_cast<double>(nodes) < most_of_rank_ * static_cast<double>(sample.size());
}

}  // namespace pstripack
