#include "shapes.h"

namespace point_sets {
namespace {

Points axis_cap_nodes(std::size_t n, double radius, Random& random) {
  return distinct(n, [&] {
    const auto [u, v] = in_disc(random);
    return Point{1, radius * u, radius * v};
  });
}

}  // namespace

Family axis_cap_family() {
  return {"axis-cap", "1e-150", "n", "(1, y, z) in a disc of that radius; lengths are not rounded to 1",
          axis_cap_nodes};
}

}  // namespace point_sets
