#include <algorithm>

#include "shapes.h"

namespace point_sets {
namespace {

std::size_t divisor(std::size_t a, std::size_t b) { return b == 0 ? a : divisor(b, a % b); }
std::size_t size(int i) { return static_cast<std::size_t>(i < 0 ? -i : i); }

/// Shell m: the integer vectors with greatest common divisor 1 whose largest coordinate is +-m.
Points shell(int m) {
  Points p;
  for (int i = -m; i <= m; ++i)
    for (int j = -m; j <= m; ++j)
      for (int k = -m; k <= m; k += size(i) == size(m) || size(j) == size(m) ? 1 : 2 * m)
        if (divisor(divisor(size(i), size(j)), size(k)) == 1)
          p.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
  return p;
}

Points lattice_nodes(std::size_t n, double, Random& random) {
  Points p;
  for (int m = 1; p.size() < n; ++m) {
    Points outer = shell(m);
    shuffle(outer, random.bits());
    outer.resize(std::min(outer.size(), n - p.size()));
    p.insert(p.end(), outer.begin(), outer.end());
  }
  shuffle(p, random.bits());
  return p;
}

}  // namespace

Family lattice_family() {
  return {"lattice", "", "n",
          "directions to the vertices of a cubic lattice, shell after shell, shuffled; lengths are not 1",
          lattice_nodes};
}

}  // namespace point_sets
