#include "shapes.h"

namespace point_sets {
namespace {

Points earth_nodes(std::size_t n, double radius, Random& random) {
  Points p = latlon_family().make(n, 0, random);
  for (Point& q : p) q = radius * q;
  return p;
}

}  // namespace

Family earth_family() {
  return {"earth", "6371229", "2 m^2 + 2", "latlon on a sphere of that radius", earth_nodes};
}

}  // namespace point_sets
