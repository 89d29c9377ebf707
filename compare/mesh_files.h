#pragma once
// Points and triangles as scvt_legacy writes them; compares two such meshes.

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/triangulation.h"

namespace comparison {

struct MeshFiles {
  std::vector<pstripack::Point> points;
  pstripack::Triangles triangles;  ///< canonical
};

/// Reads PREFIX_points.txt (lines of x y z) and PREFIX_triangles.txt (lines of three node numbers, from 1).
/// Throws std::runtime_error with one line that names the error and its place.
MeshFiles read_mesh(const std::string& prefix);

struct MeshComparison {
  double largest_distance =
      0;  ///< between points with equal numbers; infinite if the numbers of points differ
  std::size_t only_in_a = 0, only_in_b = 0;
};
MeshComparison compare_meshes(const MeshFiles& a, const MeshFiles& b);

}  // namespace comparison
