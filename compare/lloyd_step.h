#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mpi/distributed_mesh.h"
#include "point_sets.h"
#include "voronoi_cell.h"

/// A step of Lloyd's method: moves each point by `part` of the way to the centroid of its Voronoi cell.
inline void lloyd_step(const pstripack::DistributedMesh& mesh, std::vector<pstripack::Point>& points,
                       double part) {
  using pstripack::Point;
  std::vector<Point> known = points;
  std::vector<std::int64_t> begin(points.size() + 1), halo(mesh.own().outside().size());
  std::vector<std::int32_t> neighbour(mesh.own().arcs());
  known.resize(points.size() + halo.size());
  mesh.own().halo(halo.data(), &known[points.size()].x);
  mesh.own().local_stars(begin.data(), neighbour.data());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point p = known[k];
    const std::int64_t count = begin[k + 1] - begin[k];
    const auto place = [&](std::int64_t i) {
      const auto slot = static_cast<std::size_t>(begin[k] + i);
      return known[static_cast<std::size_t>(neighbour[slot]) - 1];
    };
    points[k] = point_sets::part_of_the_way(p, point_sets::middle_of_cell(p, count, place), part);
  }
}
