#pragma once
// Where two triangulations of the same nodes differ, and why.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "mesh/triangulation.h"
#include "mesh/validate.h"

namespace comparison {

/// Causes of a difference, from harmless to serious.
enum class Cause {
  exact_tie,   ///< the four nodes lie in one plane exactly: both are Delaunay, the tie rules differ
  rounding,    ///< the exact value is smaller than the rounding of the original's test
  directions,  ///< lengths differ from 1: the original uses the coordinates, ours the directions; both are
               ///< right
  original_wrong,  ///< an exact check fails in the original's result
  ours_wrong       ///< no exact check fails in the original's result
};
constexpr std::size_t kCauses = 5;
const char* name(Cause cause);        ///< for tables: "exact tie"
const char* identifier(Cause cause);  ///< for JSON: "exact_tie"

/// A decision that the original made differently: an arc of its result with the opposite nodes, or three
/// nodes on its boundary.
struct Decision {
  Cause cause;
  std::vector<pstripack::index_t> nodes;  ///< from 0: u, v, left of u-v, right of u-v; or three nodes
  std::string text;                       ///< one line, node numbers from 1
  std::string determinant, bound;         ///< decimal; empty if there is none
};

struct Count {
  std::size_t places = 0;         ///< connected sets of differing triangles
  std::size_t original_arcs = 0;  ///< arcs of the original that are not ours
  std::size_t our_arcs = 0;       ///< arcs of ours that are not the original's
};

struct Differences {
  std::array<Count, kCauses> count;  ///< each differing place and arc is counted once
  std::size_t original_triangles = 0, our_triangles = 0;
  std::vector<Decision> decisions;  ///< at most `show` of each cause, the most serious cause first

  const Count& of(Cause cause) const { return count[static_cast<std::size_t>(cause)]; }
  bool none() const { return original_triangles == 0 && our_triangles == 0; }
};

struct Mesh {
  const pstripack::Triangles& triangles;  ///< canonical; a manifold unless the verdict says otherwise
  const pstripack::Verdict& verdict;
};

/// `epsilon` is that of the original's arithmetic. All coordinates must be finite.
Differences differences(const std::vector<pstripack::Point>& points, const Mesh& original, const Mesh& ours,
                        double epsilon, std::size_t show);

/// The nodes of arcs with a triangle on one side only; increasing, from 0.
std::vector<pstripack::index_t> boundary_nodes(const pstripack::Triangles& triangles);

}  // namespace comparison
