#pragma once
// Nodes that are near each other, found by the arcs of their mesh.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "files/mesh.h"
#include "mesh/delaunay.h"

namespace files {

constexpr double kMillimetre = 1e-6 / kEarthRadius;  ///< on the Earth, in radians

/// True if the angle between the directions is at most `within` radians. Right for angles from 1e-150 on.
bool is_near(const Point& a, const Point& b, double within);

/// All nodes but the first of each direction, in increasing order.
std::vector<Duplicate> coincident_nodes(const pstripack::Hull& hull);

struct NearNeighbours {
  std::size_t pairs = 0;
  std::size_t first = 0, second = 0;  ///< the first pair by its smaller, then its larger index
};

/// The arcs of the mesh that are at most `within` radians long. The closest two nodes are always among them.
NearNeighbours near_neighbours(const pstripack::ListsView<std::int32_t>& lists,
                               const std::vector<Point>& points, double within);

/// The nodes that have an earlier node within `within` radians, less than pi/2, that is not such a node
/// itself; in increasing order, with the earliest such node.
std::vector<Duplicate> near_duplicates(const Mesh& mesh, double within);

}  // namespace files
