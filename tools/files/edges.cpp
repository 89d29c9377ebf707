#include <algorithm>

#include "files/mesh.h"

namespace files {

Edges edges_of(const Faces& faces) {
  std::vector<FaceSide> sides;
  sides.reserve(faces.corner.size());
  faces.for_each_corner([&](std::size_t f, std::size_t k) {
    const auto [low, high] = std::minmax(faces.corner[k], faces.corner[faces.after(f, k)]);
    sides.push_back({low, high, f, k});
  });
  std::sort(sides.begin(), sides.end());
  Edges edges;
  edges.of_faces.resize(faces.corner.size());
  for (const FaceSide& side : sides) {
    const std::size_t place = faces.corner[side.slot] == side.low ? 0 : 1;  // 0: the face is on the left
    const std::size_t last = edges.nodes.size() - 2;
    const bool is_known = !edges.nodes.empty() && edges.nodes[last] == side.low &&
                          edges.nodes[last + 1] == side.high && edges.faces[last + place] < 0;
    if (!is_known) {
      edges.nodes.insert(edges.nodes.end(), {side.low, side.high});
      edges.faces.insert(edges.faces.end(), {-1, -1});
    }
    edges.faces[edges.faces.size() - 2 + place] = static_cast<std::int32_t>(side.face + 1);
    edges.of_faces[side.slot] = static_cast<std::int32_t>(edges.faces.size() / 2);
  }
  return edges;
}

}  // namespace files
