#include "shapes.h"

namespace point_sets {
namespace {

Points single_nodes(std::size_t n, double, Random& random) {
  Points p = uniform(n, random);
  for (Point& q : p) q = rounded_to_single(q);
  return p;
}

}  // namespace

Family single_family() {
  return {"single", "", "n", "uniform, coordinates rounded to single precision", single_nodes};
}

}  // namespace point_sets
