#include <algorithm>

#include "shapes.h"

namespace point_sets {
namespace {

Points tracks_nodes(std::size_t n, double ports, Random& random) {
  const Points port = uniform(std::max<std::size_t>(2, static_cast<std::size_t>(ports)), random);
  std::vector<std::pair<Point, Point>> routes;
  while (routes.size() < 4 * port.size()) {
    const std::size_t a = random.below(port.size()), b = random.below(port.size());
    if (a != b) routes.push_back({port[a], port[b]});
  }
  return distinct(n, [&] {
    const auto& [from, to] = routes[random.below(routes.size())];
    const double t = random.uniform();
    return normalized((1 - t) * from + t * to);
  });
}

}  // namespace

Family tracks_family() {
  return {"tracks", "50", "n", "ships and aircraft on great circles between that many ports", tracks_nodes};
}

}  // namespace point_sets
