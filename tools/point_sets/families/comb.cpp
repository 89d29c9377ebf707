#include "shapes.h"

namespace point_sets {
namespace {

Points comb_nodes(std::size_t n, double width, Random& random) {
  constexpr std::size_t lines = 1000;
  const Frame f = frame(centre());
  return distinct(n, [&] {
    const double line = static_cast<double>(random.below(lines)) / lines, beside = width * random.uniform();
    return at(f, line + beside - 0.5, random.uniform(-0.5, 0.5));
  });
}

}  // namespace

Family comb_family() {
  return {"comb", "1e-9", "n", "along 1,000 parallel lines, in strips of that width", comb_nodes};
}

}  // namespace point_sets
