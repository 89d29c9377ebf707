#include "shapes.h"

namespace point_sets {
namespace {

Points random_nodes(std::size_t n, double, Random& random) { return uniform(n, random); }

}  // namespace

Family random_family() { return {"random", "", "n", "uniform on the sphere", random_nodes}; }

}  // namespace point_sets
