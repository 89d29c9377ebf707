#include "parallel/coarse_mesh.h"

#include <stdexcept>

#include "base/workspace.h"
#include "mesh/delaunay.h"

namespace pstripack {
namespace {

constexpr std::uint32_t kManyNeighbours = 64;  // of a hub

}  // namespace

CoarseMesh::CoarseMesh(const std::vector<Point>& nodes) {
  const std::size_t n = nodes.size();
  if (n < 3) return;
  Workspace workspace(workspace_bytes(n) + 48 * n);
  try {
    const Hull hull = delaunay(nodes.data(), n, workspace);
    std::vector<std::uint32_t> neighbours(n);
    const auto for_each_front = [&](const auto& visit) {
      for (std::size_t t = 0; t < hull.face_count; ++t)
        if (hull.front(t)) visit(hull.faces[t].vertex);
    };
    for_each_front([&](const HullNode* v) {
      for (int i = 0; i < 3; ++i) ++neighbours[v[i]];
    });
    const auto is_hub = [&](HullNode v) { return neighbours[v] > kManyNeighbours; };
    triangles_.reserve(hull.face_count);
    for_each_front([&](const HullNode* v) {
      if (is_hub(v[0]) || is_hub(v[1]) || is_hub(v[2]))
        ++at_hubs_;
      else
        triangles_.push_back({hull.order[v[0]], hull.order[v[1]], hull.order[v[2]]});
    });
  } catch (const std::domain_error&) {  // all on one great circle
  }
}

}  // namespace pstripack
