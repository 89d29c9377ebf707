#include "files/near_nodes.h"

#include <algorithm>
#include <map>

#include "geometry/measures.h"

namespace files {

bool is_near(const Point& a, const Point& b, double within) {
  // Most pairs are far apart: |a x b| = |a| |b| sin(angle), rounded by less than 1e-15 |a| |b|. The factor 2
  // covers the rounding of products near the least double. Where the limit overflows or is 0, this is silent.
  const Point normal = cross(a, b);
  const double sine = 2 * (within + 1e-15), limit = sine * sine * dot(a, a) * dot(b, b);
  if (limit > 0 && dot(normal, normal) > limit) return false;
  return arc_length(pstripack::direction_of(a), pstripack::direction_of(b)) <= within;
}

std::vector<Duplicate> coincident_nodes(const pstripack::Hull& hull) {
  std::map<pstripack::index_t, std::vector<pstripack::index_t>> same;  // key: the node that was inserted
  for (const auto& [in, out] : hull.coincident) same[in].push_back(out);
  std::vector<Duplicate> later;
  for (auto& [in, nodes] : same) {
    nodes.push_back(in);
    const pstripack::index_t first = *std::min_element(nodes.begin(), nodes.end());
    for (const pstripack::index_t node : nodes)
      if (node != first) later.push_back({static_cast<std::size_t>(node), static_cast<std::size_t>(first)});
  }
  std::sort(later.begin(), later.end(),
            [](const Duplicate& a, const Duplicate& b) { return a.node < b.node; });
  return later;
}

NearNeighbours near_neighbours(const pstripack::ListsView<std::int32_t>& lists,
                               const std::vector<Point>& points, double within) {
  const pstripack::ListReader<std::int32_t> reader(lists);
  NearNeighbours all;
  for (std::size_t i = 0; i < points.size(); ++i)
    for_each_neighbour(reader, i, [&](std::size_t j) {
      if (j < i || !is_near(points[i], points[j], within)) return;
      if (all.pairs++ == 0 || (all.first == i && j < all.second)) all.first = i, all.second = j;
    });
  return all;
}

std::vector<Duplicate> near_duplicates(const Mesh& mesh, double within) {
  // The nodes in a cap smaller than a hemisphere are connected by arcs of the Delaunay mesh that join nodes
  // in the cap: so a search from the node in the middle that does not leave the cap finds them all. Caps
  // around kept nodes: a node lies in five of them at most, since kept nodes are further than `within` apart.
  const pstripack::ListReader<std::int32_t> reader(mesh.lists());
  const std::vector<Point>& points = mesh.points;
  const std::size_t n = points.size();
  std::vector<std::size_t> first(n, n);   // the kept node in whose place each node is; n: none
  std::vector<std::size_t> centre(n, n);  // of the last search that looked at the node
  std::vector<std::size_t> open;
  std::vector<Duplicate> found;
  for (std::size_t i = 0; i < n; ++i) {
    if (first[i] < n) {
      found.push_back({i, first[i]});
      continue;
    }
    centre[i] = i;
    open.assign(1, i);
    while (!open.empty()) {
      const std::size_t from = open.back();
      open.pop_back();
      for_each_neighbour(reader, from, [&](std::size_t j) {
        if (centre[j] == i) return;
        centre[j] = i;
        if (!is_near(points[std::min(i, j)], points[std::max(i, j)], within)) return;
        if (j > i && first[j] == n) first[j] = i;
        open.push_back(j);
      });
    }
  }
  return found;
}

}  // namespace files
