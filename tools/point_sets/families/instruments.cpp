// As instruments and surveys deliver them.
#include <algorithm>
#include <cmath>

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

Points swaths_nodes(std::size_t n, double pixels, Random&) {
  constexpr double width = 24, orbits_a_day = 14.57;  // degrees
  const std::size_t across =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(n))), 2,
                              std::max<std::size_t>(2, static_cast<std::size_t>(pixels)));
  const double step = width / static_cast<double>(across);
  std::size_t i = 0;
  return distinct(n, [&] {
    const double along = step * static_cast<double>(i / across), pixel = static_cast<double>(i % across);
    ++i;
    return Orbit{98.2}.seen_from_earth(along, step * (pixel + 0.5) - width / 2, along / orbits_a_day);
  });
}

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

// The longest segment is divided at a point beside its middle until there are n segments.
Points coast_nodes(std::size_t n, double roughness, Random& random) {
  const Frame f = frame(centre());
  Points coast;
  for (std::size_t i = 0; i < std::min<std::size_t>(n, 8); ++i) {
    const double angle = 45 * static_cast<double>(i) + random.uniform(0, 30);
    coast.push_back(at(f, 0.5 * cos_degrees(angle), 0.5 * sin_degrees(angle)));
  }
  while (coast.size() < n) {
    Points finer;
    for (std::size_t i = 0; i < coast.size(); ++i) {
      const Point &a = coast[i], &b = coast[(i + 1) % coast.size()];
      finer.push_back(a);
      if (finer.size() + coast.size() - i - 1 < n) {
        const Point middle = 0.5 * (a + b);
        finer.push_back(
            normalized(middle + (roughness * random.uniform(-1, 1)) * cross(middle, b + -1.0 * a)));
      }
    }
    coast.swap(finer);
  }
  std::size_t i = 0;
  return distinct(n, [&] { return coast[i++ % n]; });
}

Points earthquakes_nodes(std::size_t n, double distance, Random& random) {
  Points shocks;
  return distinct(n, [&] {
    const double u = random.uniform(), angle = random.uniform(0, 360);
    if (shocks.empty() || random.below(20) == 0) {
      shocks.push_back(random.direction());
    } else {
      const double s = distance * u / (1 - u);  // P(s > x) = distance / (distance + x)
      const Frame f = frame(shocks[random.below(shocks.size())]);
      shocks.push_back(at(f, s * cos_degrees(angle), s * sin_degrees(angle)));
    }
    return shocks.back();
  });
}

}  // namespace

std::vector<Family> instruments_families() {
  return {
      {"satellite", "98.2", "n",
       "ground track of 16 days, in time; the parameter is the inclination in degrees", satellite_nodes},
      {"swaths", "200", "n", "scan lines of that many pixels across a ground track, line after line",
       swaths_nodes},
      {"tracks", "50", "n", "ships and aircraft on great circles between that many ports", tracks_nodes},
      {"rivers", "1e-4", "n", "stations at that distance along rivers that branch", rivers_nodes},
      {"coast", "0.3", "n", "along a closed fractal curve of that roughness", coast_nodes},
      {"earthquakes", "1e-4", "n", "clusters of aftershocks of aftershocks, at about that distance",
       earthquakes_nodes},
  };
}

}  // namespace point_sets
