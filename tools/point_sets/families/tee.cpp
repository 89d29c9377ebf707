#include "shapes.h"

namespace point_sets {
namespace {

// Each node of the stem sees the whole bar until a nearer node has been inserted. The stem runs along an edge
// of the face -x of the cube around the sphere, as the curve of insertion_order.h does; the bar lies beyond
// it.
Points tee_nodes(std::size_t n, double width, Random& random) {
  const std::size_t bar = n / 2, stem = n - bar;
  const auto jitter = [&] { return width * random.uniform(); };
  Points p;
  for (std::size_t i = 0; i < stem; ++i) {
    const double along = 1.9 * (static_cast<double>(i) + 0.5) / static_cast<double>(stem);
    p.push_back(normalized({-1, 0.95 - along, 0.99 + jitter()}));
    if (i < bar)
      p.push_back(normalized(
          {-1, -1.05 - jitter(), 0.49 + (static_cast<double>(i) + 0.5) / static_cast<double>(bar)}));
  }
  return p;
}

}  // namespace

Family tee_family() {
  return {"tee", "1e-8", "n", "half along an arc, half towards its middle, in strips of that width",
          tee_nodes};
}

}  // namespace point_sets
