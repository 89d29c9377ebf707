#include "shapes.h"

namespace point_sets {
namespace {

Points hemisphere_nodes(std::size_t n, double, Random& random) {
  Points p;
  while (p.size() < n) {
    const Point q = random.direction();
    if (q.z > 0) p.push_back(q);
  }
  return p;
}

}  // namespace

Family hemisphere_family() {
  return {"hemisphere", "", "n", "uniform in the open hemisphere z > 0", hemisphere_nodes};
}

}  // namespace point_sets
