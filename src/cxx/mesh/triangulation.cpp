#include "mesh/triangulation.h"

#include <algorithm>

namespace pstripack {
namespace {

Triangle smallest_first(const Triangle& t) {
  if (t[0] <= t[1] && t[0] <= t[2]) return t;
  if (t[1] <= t[2]) return {t[1], t[2], t[0]};
  return {t[2], t[0], t[1]};
}

/// The finaliser of SplitMix64 (Steele, Lea & Flood 2014): a bijection that spreads every bit.
std::uint64_t mix(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return v ^ (v >> 31);
}

}  // namespace

void make_canonical(Triangles& triangles) {
  for (Triangle& t : triangles) t = smallest_first(t);
  std::sort(triangles.begin(), triangles.end());
}

std::uint64_t fingerprint(const Triangle* triangles, std::size_t count) {
  std::uint64_t sum = mix(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle t = smallest_first(triangles[i]);
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (const index_t v : t) h = mix(h + static_cast<std::uint32_t>(v));
    sum += h;
  }
  return mix(sum);
}

}  // namespace pstripack
