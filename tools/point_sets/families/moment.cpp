#include "shapes.h"

namespace point_sets {
namespace {

Points moment_nodes(std::size_t n, double decades, Random& random) {
  return distinct(n, [&] {
    const double t = ten_to_minus(decades * random.uniform());
    return Point{1, t, t * t};
  });
}

}  // namespace

Family moment_family() {
  return {"moment", "6", "n", "(1, t, t^2), t over that many decades; lengths are not 1", moment_nodes};
}

}  // namespace point_sets
