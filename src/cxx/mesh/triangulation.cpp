#include "mesh/triangulation.h"

#include <algorithm>

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
  std::uint64_t hashes = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle t = smallest_first(triangles[i]);
    const auto corner = [&](std::size_t k) { return static_cast<std::uint32_t>(t[k]); };
    hashes += hash_of_triangle(corner(0), corner(1), corner(2));
  }
  return fingerprint_of(hashes, count);
}

}  // namespace pstripack
