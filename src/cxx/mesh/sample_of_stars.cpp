#include "mesh/sample_of_stars.h"

#include <algorithm>

#include "geometry/predicates.h"

namespace pstripack {

void SampleOfStars::add(std::size_t k, const std::int32_t* ring, std::size_t count) {
  if (count > kMost) return;
  stars_.push_back({static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(count)});
  rings_.insert(rings_.end(), ring, ring + count);
}

SampleOfStars SampleOfStars::renumbered(const std::uint32_t* to) const {
  SampleOfStars sample;
  std::int32_t there[kMost];
  const std::int32_t* ring = rings_.data();
  for (const auto& [k, count] : stars_) {
    bool is_whole = to[k] != kGone;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t node = to[ring[i] - 1];
      is_whole = is_whole && node != kGone;
      there[i] = static_cast<std::int32_t>(node) + 1;
    }
    if (is_whole) sample.add(to[k], there, count);
    ring += count;
  }
  return sample;
}

bool SampleOfStars::fits(const NodeArrays& nodes) const {
  constexpr std::size_t kFew = 16;  // at most one arc in 16 may be bad
  std::size_t arcs = 0, bad = 0;
  const std::int32_t* ring = rings_.data();
  for (const auto& [k, count] : stars_) {
    const Point p = nodes[k];
    Point spoke[kMost + 2];
    for (std::size_t i = 0; i < count; ++i) {
      const Point q = nodes[static_cast<std::size_t>(ring[i]) - 1];
      if (!length_is_one(q)) return false;
      spoke[i] = minus(q, p);
    }
    spoke[count] = spoke[0], spoke[count + 1] = spoke[1];
    for (std::size_t i = 0; i < count; ++i) {
      const Point n = cross(spoke[i], spoke[i + 1]);
      const Point &e = spoke[i], &f = spoke[i + 1], &g = spoke[i + 2];
      const double size = dot(n, n), length = dot(e, e) * dot(f, f);
      if (dot(n, p) < 0 && size > 0x1p-40 * length) return false;
      const double height = dot(n, g);
      bad += height > 0 && height * height > 0x1p-80 * length * dot(g, g);
    }
    arcs += count;
    if (bad * kFew > std::max<std::size_t>(arcs, 256)) return false;
    ring += count;
  }
  return bad * kFew <= arcs;
}

}  // namespace pstripack
