#include "shapes.h"

namespace point_sets {
namespace {

Points antipodal_nodes(std::size_t n, double radius, Random& random) {
  return caps(n, {centre(), -1.0 * centre()}, radius, random);
}

}  // namespace

Family antipodal_family() {
  return {"antipodal", "0.1", "n", "two caps of that radius, opposite each other", antipodal_nodes};
}

}  // namespace point_sets
