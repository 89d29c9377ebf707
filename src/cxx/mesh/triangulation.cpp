#include "mesh/triangulation.h"

#include <algorithm>

#include "base/splitmix64.h"

namespace pstripack {
namespace {

Triangle smallest_first(const Triangle& t) {
  if (t[0] <= t[1] && t[0] <= t[2]) return t;
  if (t[1] <= t[2]) return {t[1], t[2], t[0]};
  return {t[2], t[0], t[1]};
}

}  // namespace

void make_canonical(Triangles& triangles) {
  for (Triangle& t : triangles) t = smallest_first(t);
  std::sort(triangles.begin(), triangles.end());
}

std::uint64_t fingerprint(const Triangle* triangles, std::size_t count) {
  std::uint64_t sum = splitmix64(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle t = smallest_first(triangles[i]);
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (const index_t v : t) h = splitmix64(h + static_cast<std::uint32_t>(v));
    sum += h;
  }
  return splitmix64(sum);
}

}  // namespace pstripack
