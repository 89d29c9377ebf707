#include "parallel/homes.h"

namespace pstripack {

Homes::Homes(const Division& division, const ParallelOptions& options, std::size_t own)
    : partition_(division.partition),
      kind_(options.partition),
      patches_(division.patches),
      places_(division.places),
      share_(options.last != nullptr && options.last->partition_ == partition_ ? options.last->share_ : own) {
}

bool Homes::are_home_to(const LocalNodes& nodes, int me) const {
  constexpr std::size_t kFew = 64;  // of a small set, where an eighth is little
  if (nodes.count > share_ + share_ / 8 + kFew) return false;
  constexpr std::size_t kTested = 256;
  const std::size_t step = nodes.count / kTested + 1;
  std::size_t tested = 0, away = 0;
  for (std::size_t i = 0; i < nodes.count; i += step, ++tested) away += rank(nodes.points[i]) != me;
  return 16 * away <= tested;
}

}  // namespace pstripack
