#include "shapes.h"

namespace point_sets {
namespace {

Points falling_tee_nodes(std::size_t n, double decades, Random& random) {
  const Frame f = frame(centre());
  const double bar = ten_to_minus(decades);
  std::size_t i = 0;
  return distinct(n, [&] {
    return i++ % 2 == 0 ? at(f, bar * random.uniform(-1, 1), 0)
                        : at(f, 0, ten_to_minus(decades * random.uniform()));
  });
}

}  // namespace

Family falling_tee_family() {
  return {"falling-tee", "6", "n",
          "half on a bar 10^-d long, half on a stem, 10^(-d u) from it; the parameter is d",
          falling_tee_nodes};
}

}  // namespace point_sets
