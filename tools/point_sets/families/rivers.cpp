#include "shapes.h"

namespace point_sets {
namespace {

Points rivers_nodes(std::size_t n, double step, Random& random) {
  Points stations;
  Point p{}, heading{};
  return distinct(n, [&] {
    const std::size_t chance = stations.empty() ? 0 : random.below(1000);
    const bool is_source = chance == 0, is_fork = chance > 0 && chance <= 10;
    if (is_source) p = random.direction();
    if (is_fork) p = stations[random.below(stations.size())];
    if (is_source || is_fork) heading = normalized(cross(p, random.direction()));
    if (!is_source) p = normalized(p + step * heading);
    heading = heading + random.uniform(-0.5, 0.5) * cross(p, heading);
    heading = normalized(heading + -dot(heading, p) * p);
    stations.push_back(p);
    return p;
  });
}

}  // namespace

Family rivers_family() {
  return {"rivers", "1e-4", "n", "stations at that distance along rivers that branch", rivers_nodes};
}

}  // namespace point_sets
