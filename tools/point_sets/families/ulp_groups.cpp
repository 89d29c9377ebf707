#include <algorithm>
#include <cmath>

#include "shapes.h"

namespace point_sets {
namespace {

/// The double `steps` doubles after `value`.
double beyond(double value, std::size_t steps) {
  for (; steps > 0; --steps) value = std::nextafter(value, 2);
  return value;
}

// The nodes of a group fill a cube of doubles: their bits number x, y and z in turn.
Points ulp_groups_nodes(std::size_t n, double size, Random& random) {
  const std::size_t group = std::max<std::size_t>(1, static_cast<std::size_t>(size));
  Point first{};
  std::size_t i = 0;
  return distinct(n, [&] {
    const std::size_t k = i++ % group;
    if (k == 0) first = random.direction();
    return Point{beyond(first.x, k % 2 + 2 * (k / 8)), beyond(first.y, k / 2 % 2),
                 beyond(first.z, k / 4 % 2)};
  });
}

}  // namespace

Family ulp_groups_family() {
  return {"ulp-groups", "2", "n", "uniform groups of that many nodes, neighbours are one last bit apart",
          ulp_groups_nodes};
}

}  // namespace point_sets
