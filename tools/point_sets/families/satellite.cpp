#include "shapes.h"

namespace point_sets {
namespace {

Points satellite_nodes(std::size_t n, double inclination, Random&) {
  constexpr double days = 16, orbits_a_day = 14.57;
  std::size_t i = 0;
  return distinct(n, [&] {
    const double day = days * static_cast<double>(i++) / static_cast<double>(n);
    return Orbit{inclination}.seen_from_earth(360 * orbits_a_day * day, 0, 360 * day);
  });
}

}  // namespace

Family satellite_family() {
  return {"satellite", "98.2", "n",
          "ground track of 16 days, in time; the parameter is the inclination in degrees", satellite_nodes};
}

}  // namespace point_sets
