#include <algorithm>
#include <numeric>
#include <tuple>

#include "files/mesh.h"

namespace files {

Edges edges_of(const Faces& faces) {
  struct Side {
    std::int32_t to, face;
    std::size_t slot;
    bool is_left;  ///< the face is on the left of the edge from the smaller node to the other one
  };
  std::vector<std::size_t> begin(faces.points.size() + 1);
  const auto for_each_side = [&](const auto& take) {
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t k = faces.begin[f]; k < faces.begin[f + 1]; ++k)
        take(f, k, faces.corner[k], faces.corner[k + 1 < faces.begin[f + 1] ? k + 1 : faces.begin[f]]);
  };
  for_each_side([&](std::size_t, std::size_t, std::int32_t a, std::int32_t b) {
    ++begin[static_cast<std::size_t>(std::min(a, b))];
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Side> sides(faces.corner.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for_each_side([&](std::size_t f, std::size_t k, std::int32_t a, std::int32_t b) {
    sides[next[static_cast<std::size_t>(std::min(a, b)) - 1]++] = {
        std::max(a, b), static_cast<std::int32_t>(f + 1), k, a < b};
  });
  Edges edges;
  edges.of_faces.resize(faces.corner.size());
  for (std::size_t from = 0; from + 1 < begin.size(); ++from) {
    const auto first = sides.begin() + static_cast<std::ptrdiff_t>(begin[from]),
               last = sides.begin() + static_cast<std::ptrdiff_t>(begin[from + 1]);
    std::sort(first, last,
              [](const Side& a, const Side& b) { return std::tie(a.to, a.slot) < std::tie(b.to, b.slot); });
    for (auto side = first; side != last; ++side) {
      const std::size_t place = side->is_left ? 0 : 1;
      const bool is_known =
          side != first && side[-1].to == side->to && edges.faces[edges.faces.size() - 2 + place] < 0;
      if (!is_known) {
        edges.nodes.insert(edges.nodes.end(), {static_cast<std::int32_t>(from + 1), side->to});
        edges.faces.insert(edges.faces.end(), {-1, -1});
      }
      edges.faces[edges.faces.size() - 2 + place] = side->face;
      edges.of_faces[side->slot] = static_cast<std::int32_t>(edges.faces.size() / 2);
    }
  }
  return edges;
}

}  // namespace files
