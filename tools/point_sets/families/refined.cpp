#include "shapes.h"

namespace point_sets {
namespace {

// A square of 4 m x 4 m cells; its inner 2 m x 2 m cells are replaced by the square of the next level, and so
// on.
Points refined_nodes(std::size_t n, double levels, Random&) {
  const std::size_t finest = static_cast<std::size_t>(levels);
  const std::size_t m = nearest(n, 1, [&](std::size_t k) { return 12 * k * k * finest + 16 * k * k; });
  const Frame f = frame(centre());
  double half = 0.5;
  Points p;
  for (std::size_t level = 0; level <= finest; ++level, half /= 2)
    for (std::size_t j = 0; j < 4 * m; ++j)
      for (std::size_t i = 0; i < 4 * m; ++i) {
        const auto is_inner = [m](std::size_t k) { return k >= m && k < 3 * m; };
        if (level < finest && is_inner(i) && is_inner(j)) continue;
        const auto cell = [&](std::size_t k) {
          return half * ((static_cast<double>(k) + 0.5) / static_cast<double>(2 * m) - 1);
        };
        p.push_back(at(f, cell(i), cell(j)));
      }
  return p;
}

}  // namespace

Family refined_family() {
  return {"refined", "20", "(12 k + 16) m^2", "mesh cells that halve k times towards a place", refined_nodes};
}

}  // namespace point_sets
