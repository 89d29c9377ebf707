#pragma once
// Counts the method's defects exactly, and repairs them by flips. The root does both with all triangles;
// neither is part of the method.

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/triangulation.h"

namespace thesis {

using pstripack::Point;
using pstripack::Triangles;

/// Expected figures: those of the Delaunay triangulation.
struct Expected {
  std::size_t triangles;
  double area;
};
/// Throws std::runtime_error if the nodes have no triangulation.
Expected expected(const std::vector<Point>& points);

/// PSTRIPACK's triangulation, checked by its validator. Throws std::runtime_error if there is none.
Triangles delaunay_triangles(const std::vector<Point>& points);

struct Defects {
  std::size_t missing_nodes = 0;      ///< nodes in no triangle
  std::size_t inverted = 0;           ///< triangles that are not counterclockwise
  std::size_t non_manifold_arcs = 0;  ///< arcs with more than two triangles, or two on one side
  std::size_t boundary_arcs = 0;      ///< arcs with one triangle
  std::size_t non_delaunay_arcs = 0;  ///< interior arcs with the opposite node in the circle, by `above`
  std::size_t ties = 0;       ///< those whose node is less than 1e-14 above the plane of the other three
  double uncovered_area = 0;  ///< expected area minus the triangles' signed areas
  std::string verdict;        ///< the validator's first finding; empty: this is the Delaunay triangulation
};
Defects find_defects(const std::vector<Point>& points, const Triangles& triangles, double expected_area);

struct Repair {
  std::size_t flips = 0;
  std::size_t stuck = 0;  ///< arcs that are not locally Delaunay and cannot be flipped
  double cpu_seconds = 0;
};
/// Flips interior arcs until all are locally Delaunay by exact tests. Holes remain; triangles keep their
/// indices.
Repair repair(const std::vector<Point>& points, Triangles& triangles);

}  // namespace thesis
