#pragma once
// Ways in which the nodes of a mesh move from one call to the next.

#include <cmath>
#include <functional>
#include <vector>

#include "lists.h"
#include "point_sets.h"
#include "voronoi_cell.h"

/// `steps` sets; `move(nodes, step)` makes each from the previous one.
inline std::vector<Nodes> sets_of(Nodes nodes, int steps, const std::function<void(Nodes&, int)>& move) {
  std::vector<Nodes> sets;
  for (int step = 0; step < steps; ++step) {
    if (step > 0) move(nodes, step);
    sets.push_back(nodes);
  }
  return sets;
}

/// The mean distance of neighbours among n nodes.
inline double spacing(std::size_t n) { return std::sqrt(4 * 3.14159265358979 / static_cast<double>(n)); }

/// Moves every node by up to `distance` in a random direction.
inline void move_all(Nodes& nodes, double distance, point_sets::Random& random) {
  for (auto& p : nodes) {
    const auto d = random.direction();
    const double by = distance * random.uniform();
    p = point_sets::normalized(plus(p, scaled(by, d)));
  }
}

inline void rotate(Nodes& nodes, const pstripack::Point& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (auto& p : nodes) {
    const auto across = pstripack::cross(axis, p);
    const double along = (1 - c) * pstripack::dot(axis, p);
    p = {c * p.x + s * across.x + along * axis.x, c * p.y + s * across.y + along * axis.y,
         c * p.z + s * across.z + along * axis.z};
  }
}

/// A step of Lloyd's method, on nodes that surround the centre: each goes to the centroid of its Voronoi
/// cell.
inline void lloyd_step(Nodes& nodes, const std::vector<std::int32_t>& list,
                       const std::vector<std::int32_t>& lend) {
  using namespace pstripack;
  const Nodes before = nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const std::int32_t begin = k == 0 ? 0 : lend[k - 1], count = lend[k] - begin;
    const Point p = before[k];
    const auto neighbour = [&](std::int32_t i) {
      return before[static_cast<std::size_t>(std::abs(list[static_cast<std::size_t>(begin + i)])) - 1];
    };
    nodes[k] = point_sets::middle_of_cell(p, count, neighbour);
  }
}
