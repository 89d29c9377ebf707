#include "shapes.h"

namespace point_sets {
namespace {

Points clusters_nodes(std::size_t n, double radius, Random& random) {
  Random of_centres(8);
  return half_in_caps(n, uniform(8, of_centres), radius, random);
}

}  // namespace

Family clusters_family() {
  return {"clusters", "1e-3", "n", "half uniform, half in eight caps of that radius", clusters_nodes};
}

}  // namespace point_sets
