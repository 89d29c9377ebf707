#include "shapes.h"

namespace point_sets {
namespace {

Points cap_nodes(std::size_t n, double radius, Random& random) {
  return distinct(n, [&] { return in_cap(random, centre(), radius); });
}

}  // namespace

Family cap_family() { return {"cap", "0.0175", "n", "uniform in a cap of that radius", cap_nodes}; }

}  // namespace point_sets
