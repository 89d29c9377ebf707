#pragma once
// The kernel: the Delaunay triangulation of nodes on the sphere as their convex hull in space.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/predicates.h"
#include "geometry/workspace.h"
#include "mesh/triangulation.h"

namespace pstripack {

/// A triangle of the hull. vertex: three hull nodes, counterclockwise from outside. neighbour[i], across
/// the edge opposite vertex[i], is the code 4*t + e: edge e of triangle t is the same edge. Both ends of
/// the code lead back: face[t].neighbour[e] == 4*(this) + i.
///
///                    vertex[0]
///                     /     \            edge 0 runs from vertex[1] to vertex[2], and so on
///        neighbour[2]/       \neighbour[1]
///                   /         \                                                                  .
///          vertex[1] --------- vertex[2]
///                  neighbour[0]
/// Four words each, of which the last is not used, so that a code finds its word by a sum: see `word`.
struct Face {
  std::uint32_t vertex[4];
  std::uint32_t neighbour[4];
};

inline std::uint32_t face_of(std::uint32_t code) { return code >> 2; }
inline std::uint32_t edge_of(std::uint32_t code) { return code & 3; }
inline std::uint32_t next_edge(std::uint32_t e) { return (0x1021u >> (4 * e)) & 3; }      // 1,2,0
inline std::uint32_t previous_edge(std::uint32_t e) { return (0x2102u >> (4 * e)) & 3; }  // 2,0,1

inline std::uint32_t next_code(std::uint32_t code) { return (code & 3) == 2 ? code - 2 : code + 1; }
inline std::uint32_t previous_code(std::uint32_t code) { return (code & 3) == 0 ? code + 2 : code - 1; }

/// The hull of n nodes. Hull nodes are numbered along the insertion curve: hull node v is the caller's
/// node order[v]. `front` tells whether a face belongs to the triangulation: those with det > 0, which
/// are all of them where the nodes surround the centre. Its arrays lie in the workspace of the call.
struct Hull {
  std::size_t node_count = 0, face_count = 0;
  const std::uint32_t* order = nullptr;
  const Face* faces = nullptr;
  const std::uint32_t* corner = nullptr;  ///< for each node, the code 4*t + i of a face with vertex[i] there
  bool surrounds_centre = false;          ///< every face is a front face
  std::vector<bool> back;                 ///< else: true for the faces that are not part of the triangulation
  Lengths lengths = Lengths::as_given;    ///< the predicates that decided
  /// Nodes left out because they coincide with one that is in: (in, out), the caller's numbers.
  std::vector<std::pair<index_t, index_t>> coincident;

  bool front(std::size_t face) const { return surrounds_centre || !back[face]; }
};

/// The hull of the nodes p[0..n-1], n >= 3: finite, non-zero, not all on one great circle. Decides with
/// Coordinates, or with Directions where lengths differ from 1 by more than 1e-6 or where the lengths as
/// given would hide a node from the triangulation. Nodes that coincide are inserted once.
/// Deterministic up to the numbering of faces. Throws std::bad_alloc, std::domain_error if all nodes lie
/// on one great circle. n < 2^29.
/// The workspace must have workspace_bytes(n), and may hold p as an array of the current phase, which is
/// overwritten then. Directions need 48 bytes a node more.
Hull delaunay(const Point* p, std::size_t n, Workspace& workspace);

/// Kept: order, sorted nodes, faces, corners. Of the phases the insertion takes most: the planes of 2n faces.
constexpr std::size_t workspace_bytes(std::size_t n) { return (4 + 24 + 2 * sizeof(Face) + 4 + 64) * n; }

}  // namespace pstripack
