#include "shapes.h"

namespace point_sets {
namespace {

Points dense_cap_nodes(std::size_t n, double radius, Random& random) {
  return half_in_caps(n, {centre()}, radius, random);
}

}  // namespace

Family dense_cap_family() {
  return {"dense-cap", "1e-5", "n", "half uniform, half in one cap of that radius", dense_cap_nodes};
}

}  // namespace point_sets
