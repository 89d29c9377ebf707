#include "trmesh/exact_difference.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "capi/pstripack.h"
#include "mesh/delaunay.h"
#include "parallel/coincidence.h"
#include "stripack/list_queries.h"

namespace pstripack {
namespace {

/// The faces of the exact mesh, with neighbours merged that have the same circumcircle: an arc may join any
/// two nodes of one circle.
class Circles {
 public:
  Circles(const Hull& hull, const Point* p) : hull_(hull), p_(p), circle_(hull.face_count) {
    std::iota(circle_.begin(), circle_.end(), 0);
    for_each_edge([&](std::uint32_t face, std::uint32_t beyond, std::uint32_t edge) {
      if (beyond < face && hull.front(beyond) && are_in_one_circle(face, edge))
        circle_[circle_of(face)] = circle_of(beyond);
    });
  }

  /// Calls visit(face, the face beyond, the edge between) for all faces of the mesh; the face beyond may be
  /// outside the mesh.
  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    for (std::uint32_t face = 0; face < hull_.face_count; ++face)
      for (std::uint32_t edge = 0; edge < 3 && hull_.front(face); ++edge)
        visit(face, face_of(hull_.faces[face].neighbour[edge]), edge);
  }
  /// The caller's node, from 0.
  std::uint32_t node(std::uint32_t face, std::uint32_t corner) const {
    return hull_.order[hull_.faces[face].vertex[corner]];
  }
  std::uint32_t circle_of(std::uint32_t face) {
    while (circle_[face] != face) face = circle_[face] = circle_[circle_[face]];
    return face;
  }

 private:
  bool are_in_one_circle(std::uint32_t face, std::uint32_t edge) const {
    const std::uint32_t code = hull_.faces[face].neighbour[edge];
    const Point &a = p_[node(face, 0)], &b = p_[node(face, 1)], &c = p_[node(face, 2)],
                &d = p_[node(face_of(code), edge_of(code))];
    return (hull_.lengths == Lengths::directions ? orientation_of_directions(a, b, c, d)
                                                 : orientation(a, b, c, d)) == 0;
  }

  const Hull& hull_;
  const Point* const p_;
  std::vector<std::uint32_t> circle_;
};

/// Number of arcs between nodes that share no circle of the exact mesh.
std::int64_t wrong_arcs(const ListsView<std::int32_t>& lists, Circles& circles) {
  using Pair = std::pair<std::uint32_t, std::uint32_t>;  // a node and one of its circles
  std::vector<Pair> pairs;
  circles.for_each_edge([&](std::uint32_t face, std::uint32_t, std::uint32_t corner) {
    pairs.emplace_back(circles.node(face, corner), circles.circle_of(face));
  });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<std::size_t> begin(lists.n + 1, 0);  // where the pairs of each node begin
  for (const Pair& pair : pairs) ++begin[pair.first + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());

  // Look up the circles of the node that has fewer of them among those of the other. This is linear in
  // total: the arcs of a triangulation form three forests, and in a forest each node has one parent.
  const auto have_one_in_common = [&](std::size_t a, std::size_t b) {
    const auto count = [&](std::size_t node) { return begin[node + 1] - begin[node]; };
    if (count(a) > count(b)) std::swap(a, b);
    const Pair *const first = pairs.data() + begin[b], *const last = pairs.data() + begin[b + 1];
    return std::any_of(pairs.data() + begin[a], pairs.data() + begin[a + 1], [&](const Pair& pair) {
      return std::binary_search(first, last, Pair(static_cast<std::uint32_t>(b), pair.second));
    });
  };
  std::int64_t wrong = 0;
  const ListReader<std::int32_t> reader(lists);
  for (std::size_t a = 0; a < lists.n; ++a)
    reader.for_each_neighbour(static_cast<std::int32_t>(a + 1), [&](std::int32_t node) {
      const auto b = static_cast<std::size_t>(node - 1);
      wrong += b < a && !have_one_in_common(a, b);
    });
  return wrong;
}

/// Number of boundary triangles that only one of the two triangulations has, and number of our arcs that
/// belong to such triangles of ours.
struct BoundaryDifference {
  std::int64_t triangles, our_arcs;
};

BoundaryDifference boundary_difference(const ListsView<std::int32_t>& lists, const Hull& hull,
                                       const Circles& circles) {
  std::vector<bool> is_exact(lists.n, false);
  circles.for_each_edge([&](std::uint32_t face, std::uint32_t beyond, std::uint32_t edge) {
    if (hull.front(beyond)) return;
    is_exact[circles.node(face, next_edge(edge))] = is_exact[circles.node(face, previous_edge(edge))] = true;
  });
  std::int64_t both = 0, ours_only = 0, exact_only = 0;
  for (std::size_t k = 0; k < lists.n; ++k) {
    const bool is_ours = lists.list[lists.lend[k] - 1] < 0;
    both += is_ours && is_exact[k];
    ours_only += is_ours && !is_exact[k];
    exact_only += !is_ours && is_exact[k];
  }
  // With b nodes on the boundary a triangulation has 2n-2-b triangles and 3n-3-b arcs, without a boundary
  // 2n-4 and 3n-6.
  if (both + exact_only == 0 && ours_only > 0) return {ours_only - 2, 0};
  if (both + ours_only == 0 && exact_only > 0) return {exact_only - 2, exact_only - 3};
  return {ours_only + exact_only, exact_only};
}

}  // namespace

ExactDifference exact_difference(const NodeArrays& nodes, const ListsView<std::int32_t>& lists) {
  ExactDifference difference;
  BlockArray<Point> copy(lists.n);
  const Point* const p = nodes.points(0, lists.n, copy.data());
  if (left(p[0], p[1], p[2]) == 0) {
    difference.ier = PSTRIPACK_COLLINEAR;
    return difference;
  }
  Workspace workspace(workspace_bytes(lists.n));
  const Hull hull = delaunay(p, lists.n, workspace);
  if (!hull.coincident.empty()) {
    CoincidentPairs pairs;
    for (const auto& [in, out] : hull.coincident)
      pairs.emplace_back(GlobalNumber{in + 1}, GlobalNumber{out + 1});
    difference.ier = static_cast<std::int32_t>(first_coincidence(pairs).l);
    return difference;
  }
  Circles circles(hull, p);
  const auto [triangles, our_arcs] = boundary_difference(lists, hull, circles);
  difference.boundary_triangles = triangles;
  difference.arcs = std::max<std::int64_t>(wrong_arcs(lists, circles) - our_arcs, 0);
  return difference;
}

}  // namespace pstripack
