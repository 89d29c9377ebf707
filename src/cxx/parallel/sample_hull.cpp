#include "parallel/sample_hull.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>

#include "base/workspace.h"
#include "geometry/insertion_order.h"
#include "mesh/delaunay.h"
#include "parallel/bounds.h"

namespace pstripack {
namespace {

/// The hull of a few nodes, which stands for larger ones.
struct SmallHull {
  /// Throws HiddenNode, std::bad_alloc, std::domain_error if all are on one great circle.
  SmallHull(const std::vector<Record>& nodes, Lengths lengths)
      : workspace(workspace_bytes(nodes.size())), order(workspace.keep<std::uint32_t>(nodes.size())) {
    const std::size_t n = nodes.size();
    const std::size_t alone = insertion_order(&nodes[0].point, n, order, workspace, sizeof(Record));
    workspace.next_phase();
    arrays = {n, workspace.keep<Point>(n), workspace.keep<Face>(2 * n), nullptr, nullptr};
    arrays.corner = workspace.keep<std::uint32_t>(n);
    arrays.planes = workspace.take<Plane>(2 * n);
    for (std::size_t v = 0; v < n; ++v) arrays.nodes[v] = nodes[order[v]].point;
    growing = GrowingHull::make(arrays, n, lengths);
    growing->build(alone);
  }

  Workspace workspace;
  std::uint32_t* order;  ///< hull node v is nodes[order[v]]
  HullArrays arrays;
  std::unique_ptr<GrowingHull> growing;
};

}  // namespace

double most_stretch(const std::vector<Record>& nodes, const Places& places) {
  double most = 1;
  try {
    const SmallHull hull(nodes, places.lengths());
    for (std::uint32_t t = 0; t < hull.growing->face_count(); ++t)
      most = std::max(most, stretch_of(hull.arrays.planes[t], 1 + places.deviation()));
  } catch (const HiddenNode&) {
    most = std::numeric_limits<double>::infinity();
  }
  return most;
}

void look_for_hidden_nodes(const std::vector<Record>& nodes, const Places& places) {
  if (places.lengths() != Lengths::as_given) return;
  // A node of length 1 - d among others of length 1 is hidden if they are no farther off than sqrt(2 d).
  double least = 4;
  for (std::size_t k = 1; k < nodes.size(); ++k) {
    const Point d = minus(nodes[k].point, nodes[k - 1].point);
    least = std::min(least, dot(d, d));
  }
  if (least > 4 * places.deviation()) return;
  SmallHull(nodes, places.lengths()).growing->finish();
}

bool patches_know_most(const std::vector<Record>& nodes, const Partition& partition, const Places& places) {
  if (nodes.size() < 64) return true;
  try {
    const SmallHull hull(nodes, places.lengths());
    const GrowingHull& growing = *hull.growing;
    std::vector<int> owner;
    for (std::size_t v = 0; v < nodes.size(); ++v)
      owner.push_back(partition.owner(places(hull.arrays.nodes[v])));
    std::size_t triangles = 0, shared = 0, outside = 0;
    for (std::uint32_t t = 0; t < growing.face_count(); ++t) {
      const Face& f = hull.arrays.faces[t];
      if (!growing.surrounds_centre() && !growing.front(t)) {
        for (const std::uint32_t next : {f.neighbour[0], f.neighbour[1], f.neighbour[2]})
          outside += growing.front(face_of(next));
        continue;
      }
      ++triangles;
      shared += owner[f.vertex[0]] != owner[f.vertex[1]] || owner[f.vertex[1]] != owner[f.vertex[2]];
    }
    // Nodes spread over an area: a tenth of the triangles, and the boundary has hardly any nodes.
    return 3 * shared <= triangles && 5 * outside <= nodes.size();
  } catch (const HiddenNode&) {
  } catch (const std::domain_error&) {
  }
  return true;  // the nodes do not tell
}

}  // namespace pstripack
