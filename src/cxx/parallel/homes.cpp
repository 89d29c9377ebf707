#include "parallel/homes.h"

#include <utility>

namespace pstripack {
namespace {

// A rank's nodes, evenly spaced, of which at most a sixteenth may lie in other ranks' patches if the patches
// of the last call are kept.
constexpr std::size_t kLookedAt = 256;
// Nodes that a rank may have above 9/8 of its share if patches are kept: for small sets, where 1/8 is little.
constexpr std::size_t kCloselyEnough = 64;

}  // namespace

Homes::Homes(const Division& division, const ParallelOptions& options, std::vector<PatchLoad> loads,
             std::vector<GlobalNumber> hubs)
    : partition_(division.partition),
      by_agreement_(division.by_agreement),
      kind_(options.partition),
      patches_(division.patches),
      places_(division.places),
      draft_(division.draft),
      loads_(std::move(loads)),
      hubs_(std::move(hubs)) {
  if (options.last != nullptr && options.last->partition_ == partition_)
    share_ = options.last->share_;
  else
    for (const PatchLoad& load : loads_) share_ += static_cast<std::size_t>(load.own);
}

bool Homes::are_home_to(const LocalNodes& nodes, int me) const {
  if (nodes.count > share_ + share_ / 8 + kCloselyEnough) return false;
  const std::size_t step = nodes.count / kLookedAt + 1;
  std::size_t looked_at = 0, away = 0;
  for (std::size_t i = 0; i < nodes.count; i += step, ++looked_at) away += rank(nodes.points[i]) != me;
  return 16 * away <= looked_at;
}

}  // namespace pstripack
