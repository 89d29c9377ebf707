#include "parallel/sample_hull.h"

#include <algorithm>
#include <memory>

#include "base/workspace.h"
#include "geometry/insertion_order.h"
#include "mesh/delaunay.h"

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

}  // namespace pstripack
