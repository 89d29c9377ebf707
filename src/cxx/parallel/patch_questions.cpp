#include "parallel/patch_questions.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "parallel/bounds.h"

namespace pstripack {
namespace {

constexpr HullNode kNobody = PatchHull<std::int32_t>::kNobody;

// ---- ask --------------------------------------------------------------------------------------------

/// A ball that holds all places above the triangle.
template <class Int>
Ball ball_above(const PatchHull<Int>& hull, HullNode ia, HullNode ib, HullNode ic) {
  // From the corner opposite the longest edge: the product of the others is large then, even in a needle.
  const auto square = [](const Point& d) { return dot(d, d); };
  const GrowingHull& growing = hull.growing();
  for (int turn = 0; turn < 2; ++turn) {
    const double bc = square(growing.difference(ic, ib));
    if (bc >= square(growing.difference(ib, ia)) && bc >= square(growing.difference(ic, ia))) break;
    std::tie(ia, ib, ic) = std::make_tuple(ib, ic, ia);
  }
  const Point a = hull.place(ia);
  const Point e = growing.difference(ib, ia), f = growing.difference(ic, ia);
  if (hull.places().lengths() != Lengths::as_given) return ball_around(a, e, f);
  const Point n = cross(e, f);
  const double length = std::sqrt(dot(n, n)), edge_e = std::sqrt(dot(e, e)), edge_f = std::sqrt(dot(f, f));
  // Rounding of the differences and of their product: 12u |e||f| and 2^-95 (|e| + |f|), as of a plane in
  // mesh/delaunay.cpp.
  const double error = (16 * 0x1p-53 * edge_e * edge_f + 0x1p-94 * (edge_e + edge_f)) / length;
  if (!(error < 0.1)) return kEverywhere;
  const Point normal{n.x / length, n.y / length, n.z / length};
  return ball_beyond(normal, dot(normal, a), error, hull.places().deviation());
}

template <class Int>
void ask_about_triangle(const PatchView<Int>& patch, HullFace t, std::vector<PatchNumber>& strangers,
                        std::vector<Question>& questions) {
  const Face& f = patch.hull.face(t);
  patch.partition.strangers(patch.id, ball_above(patch.hull, f.vertex[0], f.vertex[1], f.vertex[2]),
                            strangers);
  if (strangers.empty()) return;
  Question question = question_about(patch, t);
  for (const PatchNumber q : strangers) {
    question.to = q;
    questions.push_back(question);
  }
}

/// Calls visit(t) for the front faces of own nodes that bulge out of the patch.
template <class Int, class Visit>
void for_each_bulge(const PatchView<Int>& patch, const Visit& visit) {
  const PatchHull<Int>& hull = patch.hull;
  // What lies in the direction of a point y of a triangle is at most 1 + deviation times as long as 1 / |y|.
  const double deviation = hull.places().deviation(), farthest = 1 + deviation;
  const double lowest = std::max(0.0, farthest - patch.partition.smallest_margin() + 1e-12);
  const double limit = lowest * lowest;
  const auto is_flat = [&](HullFace t) {  // few are not; no branch where it cannot be guessed
    const Plane& p = hull.plane(t);       // its product with a unit vector is known to 1
    const double w = p.w - 4;
    return (w > 0) & (w * w >= limit * (p.x * p.x + p.y * p.y + p.z * p.z));
  };
  const auto examine = [&](HullFace t) {
    const auto& v = hull.face(t).vertex;
    if (is_flat(t) || !(hull.is_own(v[0]) && hull.is_own(v[1]) && hull.is_own(v[2]))) return;
    const Point a = hull.place(v[0]), b = hull.place(v[1]), c = hull.place(v[2]);
    const double most_stretch = std::min(stretch_of(hull.plane(t), farthest), stretch_of(a, b, c, deviation));
    if (!patch.partition.holds(patch.id, a, b, c, most_stretch) && hull.growing().front(t)) visit(t);
  };
  constexpr std::uint32_t kTogether = 8;
  const auto faces = static_cast<HullFace>(hull.growing().face_count());
  HullFace t = 0;
  for (; t + kTogether <= faces; t += kTogether) {
    bool all = true;
    for (std::uint32_t j = 0; j < kTogether; ++j) all &= is_flat(t + j);
    if (all) continue;
    for (std::uint32_t j = 0; j < kTogether; ++j) examine(t + j);
  }
  for (; t < faces; ++t) examine(t);
}

}  // namespace

template <class Int>
Question question_about(const PatchView<Int>& patch, HullFace t) {
  const auto& vertex = patch.hull.face(t).vertex;
  Question question{};
  for (std::uint32_t i = 0, e = first_vertex(patch.hull, t); i < 3; ++i, e = next_edge(e))
    question.corner[i] = patch.hull.node(vertex[e]);
  question.from = patch.id;
  return question;
}

/// An arc with one end in another patch is asked of that patch. Where all agree, the arcs at own nodes close
/// to curves that turn left only, around a place z inside the triangle of the corners. Each of them crosses
/// the great circle through z and a corner; the arc that crosses it is asked of all, so that there is one
/// curve and no node beyond it. z is infinitely close to the first corner, on the side of the second.
template <class Int>
void ask_about_arcs(const PatchView<Int>& patch, const std::array<Record, 3>& corners, Asked& asked,
                    Doubts& doubts) {
  const PatchHull<Int>& hull = patch.hull;
  const auto is_left = [&](HullNode v) {
    const Point& x = hull.point(v);
    const int side = left(corners[0].point, corners[2].point, x);
    return (side != 0 ? side : left(corners[1].point, corners[2].point, x)) > 0;
  };
  std::vector<BoundaryArc> arcs;
  if (asked.nodes == 0) {
    arcs = hull.boundary_arcs();
  } else {
    for (const BoundaryArc& arc : asked.arcs)
      if (hull.beside_on_boundary(arc.a).b == arc.b) arcs.push_back(arc);
    // An arc that was none before ends at a node that has come in since.
    for (auto v = static_cast<HullNode>(asked.nodes); v < hull.growing().node_count(); ++v) {
      const BoundaryArc beside = hull.beside_on_boundary(v);
      if (beside.a == kNobody) continue;
      arcs.push_back({beside.a, v});
      arcs.push_back({v, beside.b});
    }
  }
  asked.arcs.clear();
  for (const BoundaryArc& arc : arcs) {
    const HullNode a = arc.a, b = arc.b;
    const bool owns_a = hull.is_own(a), owns_b = hull.is_own(b);
    if (!owns_a && !owns_b) continue;
    const auto ask = [&](PatchNumber to) {
      doubts.questions.push_back({{hull.node(a), hull.node(b), {{0, 0, 0}, kNoNumber}}, patch.id, to});
      ++doubts.arcs;
      if (asked.arcs.empty() || asked.arcs.back().a != a) asked.arcs.push_back({a, b});
    };
    if (owns_a && is_left(a) && !is_left(b)) {
      for (PatchNumber q = 0; q < patch.partition.patches(); ++q)
        if (q != patch.id) ask(q);
    } else if (!owns_a || !owns_b) {
      ask(patch.owner(owns_a ? b : a));
    }
  }
}

template <class Int>
Doubts ask(const PatchView<Int>& patch, const std::array<Record, 3>& corners, double stretch,
           std::size_t most, Asked& asked) {
  const PatchHull<Int>& hull = patch.hull;
  Doubts doubts;
  const std::size_t nodes = hull.growing().node_count();
  doubts.has_grown = nodes != asked.nodes;
  ask_about_arcs(patch, corners, asked, doubts);
  // A node that lies above some triangle of own nodes lies above one that has a corner of another patch as
  // well, or its direction is in a triangle of own nodes, which must bulge out of the patch then.
  // After the first time only triangles at nodes that have come in since are new.
  const bool first_time = asked.nodes == 0;
  std::vector<PatchNumber> strangers;
  const auto ask_about = [&](HullFace t) { ask_about_triangle(patch, t, strangers, doubts.questions); };
  asked.is_around.resize(nodes);
  hull.for_each_face_at_border(asked.nodes, [&](HullFace t) {
    if (doubts.questions.size() > most || !hull.is_front(t)) return;
    const Face& f = hull.face(t);
    for (const HullNode v : {f.vertex[0], f.vertex[1], f.vertex[2]})
      if (!hull.is_own(v)) asked.meet(v);
    ask_about(t);
  });
  asked.nodes = nodes;
  if (first_time && doubts.questions.size() <= most && !patch.partition.holds_all(patch.id, stretch))
    for_each_bulge(patch, ask_about);
  return doubts;
}

// ---- answer -----------------------------------------------------------------------------------------

namespace {

/// Node v is strictly right of a -> b. Returns v, or a node farther right that is strictly right, too. Walks
/// uphill on the hull, which is convex; rounding can end the walk early.
template <class Int>
HullNode farthest_right(const PatchHull<Int>& hull, HullNode a, HullNode b, HullNode v) {
  const Point normal = cross(hull.place(b), hull.place(a));
  double highest = dot(normal, hull.place(v));
  for (HullNode from = kNobody, farthest = v; from != farthest;) {
    from = farthest;
    hull.for_each_face_at(from, [&](HullFace t, std::uint32_t i) {
      const HullNode w = hull.face(t).vertex[next_edge(i)];
      const double height = dot(normal, hull.place(w));
      if (height > highest) highest = height, farthest = w;
    });
    if (hull.growing().left(a, b, farthest) < 0) v = farthest;
  }
  return v;
}

/// Nodes strictly right of a -> b or on it, if it is not an arc of the boundary. If a is on the boundary, the
/// next node there is such a node; else a is inside, and one of its neighbours is.
template <class Int>
std::vector<HullNode> nodes_beyond(const PatchHull<Int>& hull, HullNode a, HullNode b) {
  std::vector<HullNode> nodes;
  const HullNode next = hull.beside_on_boundary(a).b, previous = hull.beside_on_boundary(b).a;
  if (next == b) return nodes;
  HullNode right = kNobody;
  const auto look_at = [&](HullNode v) {
    if (v != kNobody && v != b && hull.growing().left(a, b, v) < 0) right = v;
  };
  if (next != kNobody) {
    nodes.push_back(next);
    look_at(next);
  } else {
    hull.for_each_face_at(a, [&](HullFace t, std::uint32_t i) {
      if (right == kNobody) look_at(hull.face(t).vertex[next_edge(i)]);
    });
  }
  if (previous != kNobody && previous != next) nodes.push_back(previous);
  if (right == kNobody) return nodes;
  if (right != next) nodes.push_back(right);
  const HullNode farthest = farthest_right(hull, a, b, right);
  if (farthest != right) nodes.push_back(farthest);
  return nodes;
}

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
  HullNode v[3] = {0, 0, 0};
  for (int i = 0; i < question.corners(); ++i) v[i] = hull.take_in(question.corner[i]);
  std::vector<Record> nodes;
  for (const HullNode w :
       question.is_about_arc() ? nodes_beyond(hull, v[0], v[1]) : nodes_above(hull, v, kFew))
    nodes.push_back(hull.node(w));
  return nodes;
}

template Question question_about(const PatchView<std::int32_t>&, HullFace);
template void ask_about_arcs(const PatchView<std::int32_t>&, const std::array<Record, 3>&, Asked&, Doubts&);
template Doubts ask(const PatchView<std::int32_t>&, const std::array<Record, 3>&, double, std::size_t,
                    Asked&);
template Question question_about(const PatchView<std::int64_t>&, HullFace);
template void ask_about_arcs(const PatchView<std::int64_t>&, const std::array<Record, 3>&, Asked&, Doubts&);
template Doubts ask(const PatchView<std::int64_t>&, const std::array<Record, 3>&, double, std::size_t,
                    Asked&);
template std::vector<Record> answer(PatchHull<std::int32_t>&, const Question&);
template std::vector<Record> answer(PatchHull<std::int64_t>&, const Question&);

}  // namespace pstripack
