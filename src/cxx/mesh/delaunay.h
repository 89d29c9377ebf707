#pragma once
// The kernel: the Delaunay triangulation of nodes on the sphere as their convex hull in space.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/workspace.h"
#include "geometry/predicates.h"
#include "mesh/hull_numbers.h"
#include "mesh/triangulation.h"

namespace pstripack {

/// A triangle of the hull. vertex: three hull nodes, counterclockwise seen from outside. neighbour[i] is
/// the triangle t across the edge opposite vertex[i], as the code 4*t + e, where e is the number of that
/// edge in t. Codes are mutual: face[t].neighbour[e] == 4*(this) + i.
///
///                    vertex[0]
///                     /     \            edge 0 runs from vertex[1] to vertex[2], and so on
///        neighbour[2]/       \neighbour[1]
///                   /         \                                                                  .
///          vertex[1] --------- vertex[2]
///                  neighbour[0]
/// The fourth word of each array is unused: it makes a word's address a simple function of the code, see
/// Hull::word.
struct Face {
  HullNode vertex[4];
  HullCorner neighbour[4];
};

inline HullFace face_of(HullCorner code) { return code >> 2; }
inline std::uint32_t edge_of(HullCorner code) { return code & 3; }
inline std::uint32_t next_edge(std::uint32_t e) { return (0x1021u >> (4 * e)) & 3; }      // 1,2,0
inline std::uint32_t previous_edge(std::uint32_t e) { return (0x2102u >> (4 * e)) & 3; }  // 2,0,1

inline HullCorner next_code(HullCorner code) { return (code & 3) == 2 ? code - 2 : code + 1; }
inline HullCorner previous_code(HullCorner code) { return (code & 3) == 0 ? code + 2 : code - 1; }

/// The hull of n nodes. Hull nodes are numbered along the insertion curve: hull node v is the caller's node
/// order[v]. `front` is true for faces of the triangulation, those with det > 0; if the nodes surround the
/// centre, these are all faces. The arrays lie in the workspace of the call.
struct Hull {
  std::size_t node_count = 0, face_count = 0;
  const std::uint32_t* order = nullptr;
  const Face* faces = nullptr;
  /// For each node, the code 4*t + i of a face t whose vertex[i] is the node. If the node has back faces, t
  /// is the first front face counterclockwise after them.
  const HullCorner* corner = nullptr;
  bool surrounds_centre = false;  ///< every face is a front face
  // Empty if surrounds_centre. Else, by face: it is not part of the triangulation; by node: it has such a
  // face.
  std::vector<bool> back, at_back;
  Lengths lengths = Lengths::as_given;  ///< the predicates that decided
  /// Coincident nodes: (inserted, left out), in the caller's numbers.
  std::vector<std::pair<index_t, index_t>> coincident;

  /// Address of vertex[i] of face t for the code 4*t + i; neighbour[i] is four words further.
  const std::uint32_t* word(HullCorner code) const {
    return reinterpret_cast<const std::uint32_t*>(faces) + (std::size_t{code} + (code & ~std::uint32_t{3}));
  }

  bool front(std::size_t face) const { return surrounds_centre || !back[face]; }
  /// True if all faces around the node are part of the triangulation.
  bool inner(std::size_t node) const { return surrounds_centre || !at_back[node]; }
};

/// The corner at the same node in the next face clockwise.
inline HullCorner clockwise(const Hull& hull, HullCorner corner) {
  const HullCorner beyond = hull.faces[face_of(corner)].neighbour[previous_edge(edge_of(corner))];
  return 4 * face_of(beyond) + previous_edge(edge_of(beyond));
}

/// The scaled plane of a face: see mesh/delaunay.cpp.
struct Plane {
  double x, y, z, w;
};

/// Thrown, with Lengths::as_given only, if a node lies inside the hull of the others and so would be
/// missing from the triangulation. More nodes never uncover it; with predicates on directions no node is
/// hidden.
struct HiddenNode {};

/// Memory of a growing hull, owned by the caller: arrays for `capacity` nodes and 2 `capacity` faces.
struct HullArrays {
  std::size_t capacity = 0;
  Point* nodes = nullptr;  ///< as given, in the order of insertion
  Face* faces = nullptr;
  Plane* planes = nullptr;
  HullCorner* corner = nullptr;
};

/// A hull to which nodes are added. Nodes are numbered as in HullArrays::nodes.
class GrowingHull {
 public:
  /// A hull for the nodes arrays.nodes[0..n-1], 3 <= n <= capacity, not built yet. `lengths`: as_given or
  /// directions. Throws std::bad_alloc.
  static std::unique_ptr<GrowingHull> make(const HullArrays& arrays, std::size_t n, Lengths lengths);
  virtual ~GrowingHull() = default;

  /// A quick test before build(): throws HiddenNode if it finds a node inside the hull of the others. It need
  /// not find one. `leading`: as for build().
  virtual void look_for_hidden_nodes(std::size_t leading) const = 0;

  /// Inserts the first `leading` nodes in their order, then the others, which should follow a curve, in
  /// rounds. Throws HiddenNode, std::bad_alloc, and std::domain_error if all nodes lie on one great circle.
  virtual void build(std::size_t leading) = 0;

  /// Adds a node after build(); node_count() must be below the capacity. Returns the number of the new
  /// node. If it coincides with a node, changes nothing and returns that one's number. Throws HiddenNode,
  /// std::bad_alloc.
  virtual HullNode add(const Point& p) = 0;

  /// Continues in other arrays, to which the caller has copied the contents.
  virtual void move_to(const HullArrays& arrays) = 0;

  virtual std::size_t node_count() const = 0;
  virtual std::size_t face_count() const = 0;
  virtual const std::vector<std::pair<HullNode, HullNode>>& coincident() const = 0;  ///< (in, out)

  /// Exact predicates on the nodes added so far.
  virtual int left(HullNode a, HullNode b, HullNode c) const = 0;
  virtual bool above(HullNode a, HullNode b, HullNode c, HullNode d) const = 0;
  /// a - b in the predicates' coordinates; every component has 2 roundings and an absolute error of 2^-99.
  virtual Point difference(HullNode a, HullNode b) const = 0;

  /// True if the centre is known to be inside the hull: then every face is part of the triangulation.
  virtual bool surrounds_centre() const = 0;

  /// True if the face is part of the triangulation: det > 0.
  virtual bool front(HullFace face) const = 0;

  /// The current triangulation, except `order`, which the caller sets. Changes `corner` as Hull::corner asks.
  /// Throws HiddenNode, std::bad_alloc.
  virtual Hull finish() const = 0;
};

/// The hull of the nodes p[0..n-1], 3 <= n < 2^29, finite and non-zero. Lengths::automatic: by the predicates
/// on coordinates, or those on directions if a length differs from 1 by more than 1e-6 or the given lengths
/// would hide a node. Lengths::directions: by those on directions.
/// Coincident nodes are inserted once. Deterministic up to the numbering of faces. Throws std::bad_alloc,
/// and std::domain_error if all nodes lie on one great circle. The workspace must have workspace_bytes(n);
/// p may be an array of its current phase and is then overwritten. Directions allocate 48 more bytes per
/// node.
Hull delaunay(const Point* p, std::size_t n, Workspace& workspace, Lengths lengths = Lengths::automatic);

/// Arrays of the call: order, sorted nodes, faces, corners. The largest phase, the insertion, has the planes
/// of 2n faces.
constexpr std::size_t workspace_bytes(std::size_t n) {
  return (4 + 24 + 2 * sizeof(Face) + 4 + 2 * sizeof(Plane)) * n;
}

}  // namespace pstripack
