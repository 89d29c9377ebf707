#pragma once
// The validator: shares only the exact predicates with the algorithm.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/workspace.h"
#include "mesh/triangulation.h"

namespace pstripack {

enum class Defect {
  none,
  malformed,         ///< index out of range, a corner twice in a triangle, broken lists
  not_manifold,      ///< an arc with more than two triangles or twice in one direction, a broken star
  missing_node,      ///< a node in no triangle
  coincident_nodes,  ///< two corners of a triangle coincide
  orientation,       ///< a triangle that is not strictly counterclockwise
  not_delaunay,      ///< an arc that is not locally Delaunay (ties by the rule)
  not_covered_once,  ///< the star of a node winds not exactly once, wrong Euler number, not connected
  not_convex         ///< a boundary node where the covered region is not convex
};

/// Which diagonals of four exactly cocircular nodes are accepted.
enum class Ties {
  by_rule,    ///< only that of the symbolic rule (predicates.h): one triangulation is valid
  either_way  ///< both
};

/// Result of is_valid. `node` holds up to four node indices (from 0, else -1) that show the defect.
struct Verdict {
  Defect defect = Defect::none;
  std::array<index_t, 4> node{-1, -1, -1, -1};
  std::string message;                  ///< one line for people, node numbers from 1; empty if valid
  Lengths lengths = Lengths::as_given;  ///< the predicates that were used
  explicit operator bool() const { return defect == Defect::none; }
};

/// True if `triangles` is the Delaunay triangulation of the nodes p[0..n-1]:
///  - every node is a corner, every arc has one or two triangles, every star is one cycle or one fan;
///  - every triangle is strictly counterclockwise (exact sign);
///  - every interior arc is locally Delaunay (exact sign, ties by the symbolic rule);
///  - the sphere, or the convex hull of the nodes in a hemisphere, is covered exactly once: every
///    star winds once, the boundary is locally convex (exact signs), the surface is connected and its
///    Euler number is that of a sphere or a disc. docs/internals/design.md proves that these local tests
///    suffice.
/// p: n >= 3 nodes, finite and non-zero. Accepts any number of triangles and any indices. O(n log n). Throws
/// std::bad_alloc.
Verdict is_valid(const Point* p, std::size_t n, const Triangle* triangles, std::size_t count,
                 Lengths lengths = Lengths::automatic, Ties ties = Ties::by_rule);

/// The neighbours of all nodes, indices from 0: those of v are to[begin[v]] to to[begin[v+1]-1],
/// counterclockwise, all different. If the star of v is a fan, its last neighbour is stored as `~last`,
/// which is negative.
struct StarTable {
  explicit StarTable(std::size_t n, std::size_t neighbours) : begin(n + 1), to(neighbours) {}
  std::size_t size() const { return begin.size() - 1; }
  BlockArray<std::uint32_t> begin;
  BlockArray<index_t> to;
};

/// The same for triangles given by the stars of the nodes. The stars must agree: c follows b around a if and
/// only if a follows c around b. Parallel.
Verdict is_valid(const Point* p, const StarTable& stars, Lengths lengths = Lengths::automatic,
                 Ties ties = Ties::by_rule);

/// True if these stars form one sphere or one disc, regardless of coordinates. O(n).
Verdict check_surface(const StarTable& stars);

const char* name(Defect defect);

}  // namespace pstripack
