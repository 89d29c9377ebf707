#include "shapes.h"

namespace point_sets {
namespace {

Points pairs_nodes(std::size_t n, double distance, Random& random) {
  Points p;
  for (std::size_t i = 0; i < (n + 1) / 2; ++i) {
    const Point q = random.direction();
    p.push_back(q);
    p.push_back(normalized(q + distance * normalized(cross(q, random.direction()))));
  }
  return p;
}

}  // namespace

Family pairs_family() {
  return {"pairs", "1e-10", "2 m", "uniform, each node with a neighbour at that distance", pairs_nodes};
}

}  // namespace point_sets
