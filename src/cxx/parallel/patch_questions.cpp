#include "parallel/patch_questions.h"

#include <algorithm>

namespace pstripack {

template <class Int>
Question question_about(const PatchView<Int>& patch, HullFace t) {
  const auto& vertex = patch.hull.face(t).vertex;
  Question question{};
  for (std::uint32_t i = 0, e = first_vertex(patch.hull, t); i < 3; ++i, e = next_edge(e))
    question.corner[i] = patch.hull.node(vertex[e]);
  question.from = patch.id;
  return question;
}

namespace {

/// The `most` highest of the nodes above the triangle of three others; empty only if there are none.
template <class Int>
std::vector<HullNode> nodes_above(const PatchHull<Int>& hull, const HullNode (&v)[3], std::size_t most) {
  std::vector<HullNode> above;
  const auto add_those_above = [&](HullNode node, std::size_t faces) {
    HullCorner corner = hull.corner(node);
    do {
      const HullNode w = hull.face(face_of(corner)).vertex[next_edge(edge_of(corner))];
      if (w != v[0] && w != v[1] && w != v[2] && hull.growing().above(v[0], v[1], v[2], w))
        above.push_back(w);
      corner = hull.counterclockwise(corner);
    } while (--faces > 0 && corner != hull.corner(node));
  };
  // All nodes lie in the cone that the hull makes at a corner, so one of the neighbours of that corner lies
  // above if any node does. The corner with the fewest: its ring closes first.
  HullCorner at[3] = {hull.corner(v[0]), hull.corner(v[1]), hull.corner(v[2])};
  std::uint32_t least = 0;
  do {
    least = least == 2 ? 0 : least + 1;
    at[least] = hull.counterclockwise(at[least]);
  } while (at[least] != hull.corner(v[least]));
  bool is_face = false;
  hull.for_each_face_at(v[least], [&](HullFace t, std::uint32_t i) {
    const auto& corner = hull.face(t).vertex;
    is_face |=
        corner[next_edge(i)] == v[next_edge(least)] && corner[previous_edge(i)] == v[previous_edge(least)];
  });
  if (is_face) return above;
  constexpr std::size_t kManyFaces = 512;  // not all at a node with very many neighbours
  add_those_above(v[least], SIZE_MAX);
  if (above.empty()) return above;
  for (std::uint32_t k = 0; k < 3; ++k)
    if (k != least) add_those_above(v[k], kManyFaces);
  std::sort(above.begin(), above.end());
  above.erase(std::unique(above.begin(), above.end()), above.end());
  if (above.size() > most) {
    const Point a = hull.place(v[0]);
    const Point normal = cross(minus(hull.place(v[1]), a), minus(hull.place(v[2]), a));
    const auto height = [&](HullNode w) { return dot(normal, minus(hull.place(w), a)); };
    std::nth_element(above.begin(), above.begin() + static_cast<std::ptrdiff_t>(most), above.end(),
                     [&](HullNode s, HullNode t) { return height(s) > height(t); });
    above.resize(most);
  }
  return above;
}

}  // namespace

template <class Int>
std::vector<Record> answer(PatchHull<Int>& hull, const Question& question) {
  // The highest few: they change the asker's triangulation most, and the others may not matter then.
  constexpr std::size_t kFew = 64;
  HullNode v[3];
  for (int i = 0; i < 3; ++i) v[i] = hull.take_in(question.corner[i]);
  std::vector<Record> nodes;
  for (const HullNode w : nodes_above(hull, v, kFew)) nodes.push_back(hull.node(w));
  return nodes;
}

template Question question_about(const PatchView<std::int32_t>&, HullFace);
template std::vector<Record> answer(PatchHull<std::int32_t>&, const Question&);
template Question question_about(const PatchView<std::int64_t>&, HullFace);
template std::vector<Record> answer(PatchHull<std::int64_t>&, const Question&);

}  // namespace pstripack
