#pragma once
// Exact counts of the method's defects, and the cost of repairing them by flips. The root does both with all
// triangles; neither is part of the method.

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/triangulation.h"

namespace thesis {

using pstripack::Point;
using pstripack::Triangles;

/// Of the Delaunay triangulation.
struct Expected {
  std::size_t triangles;
  double area;
};
/// Throws std::runtime_error where there is none.
Expected expected(const std::vector<Point>& points);

/// PSTRIPACK's triangulation, which its validator has checked. Throws std::runtime_error where there is none.
Triangles delaunay_triangles(const std::vector<Point>& points);

struct Defects {
  std::size_t missing_nodes = 0;      ///< in no triangle
  std::size_t inverted = 0;           ///< triangles that are not counterclockwise
  std::size_t non_manifold_arcs = 0;  ///< that more than two triangles have, or two on one side
  std::size_t boundary_arcs = 0;      ///< that one triangle has
  std::size_t non_delaunay_arcs = 0;  ///< interior ones with the opposite node in the circle, by `above`
  std::size_t ties = 0;               ///< of these: less than 1e-14 above the plane of the other three nodes
  double uncovered_area = 0;          ///< expected area minus the triangles' signed areas
  std::string verdict;                ///< the validator's first finding; empty: this is the triangulation
};
Defects find_defects(const std::vector<Point>& points, const Triangles& triangles, double expected_area);

struct Repair {
  std::size_t flips = 0;
  std::size_t stuck = 0;  ///< arcs that are not locally Delaunay and cannot be flipped
  double cpu_seconds = 0;
};
/// Flips interior arcs until all are locally Delaunay, exactly. Holes stay; triangles keep their places.
Repair repair(const std::vector<Point>& points, Triangles& triangles);

}  // namespace thesis
