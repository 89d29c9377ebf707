#include "parallel/homes.h"

namespace pstripack {
namespace {

// Nodes that a rank may have above 9/8 of its share if patches are kept: for small sets, where 1/8 is little.
constexpr std::size_t kCloselyEnough = 64;

bool is_crowd(std::size_t nodes, std::size_t share) { return nodes > share + share / 8 + kCloselyEnough; }

/// True if is_right(k, patches[k]) for at least 15/16 of the patches.
template <class IsRight>
bool are_most(const Homes::SomePatches& patches, const IsRight& is_right) {
  std::size_t looked_at = 0, wrong = 0;
  for (; looked_at < patches.size() && patches[looked_at] >= 0; ++looked_at)
    wrong += !is_right(looked_at, patches[looked_at]);
  return 16 * wrong <= looked_at;
}

}  // namespace

Homes::Homes(const Division& division, const ParallelOptions& options, std::size_t own)
    : partition_(division.partition),
      kind_(options.partition),
      patches_(division.patches),
      places_(division.places),
      own_(own) {
  const bool are_kept = options.last != nullptr && options.last->partition_ == partition_;
  share_ = are_kept ? options.last->share_ : own_;
}

bool Homes::are_crowded() const { return is_crowd(own_, share_); }

Homes::SomePatches Homes::patches_of_some(const LocalNodes& nodes) const {
  SomePatches patches;
  patches.fill(-1);
  const std::size_t step = nodes.count / kLookedAt + 1;
  for (std::size_t i = 0, k = 0; i < nodes.count; i += step, ++k)
    patches[k] = partition_->owner(places_(nodes.points[i]));
  return patches;
}

bool Homes::are_home_to(const LocalNodes& nodes, int me) const {
  if (is_crowd(nodes.count, share_)) return false;
  return are_most(patches_of_some(nodes), [&](std::size_t, PatchNumber q) {
    return patches_.rank_of(q) == static_cast<RankNumber>(me);
  });
}

bool Homes::have_kept(const SomePatches& before, const SomePatches& now) {
  return are_most(now, [&](std::size_t k, PatchNumber q) { return q == before[k]; });
}

}  // namespace pstripack
