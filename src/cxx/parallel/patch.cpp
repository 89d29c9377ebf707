// A patch, in order: triangulate what it knows, ask about what it cannot know, learn, read off the rings.
// Why the stars are final when no question is left: docs/parallel.md.

#include "parallel/patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "geometry/insertion_order.h"

namespace pstripack {
namespace {

constexpr double u = 0x1p-53;
constexpr Ball kEverywhere{{0, 0, 0}, 4};

/// How many times as far from the centre as the plane of a face a place in its direction can be, no place
/// being farther than `farthest`. Infinite unless the centre is certainly below the plane, whose product with
/// a unit vector is known to 1.
double stretch_of(const Plane& p, double farthest) {
  const double w = p.w - 4;
  return w > 0 ? farthest * std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z) / w
               : std::numeric_limits<double>::infinity();
}

/// The same for a triangle, whatever its plane: a mean y of places no shorter than 1 - deviation, whose
/// distances are at most h, has |y|^2 >= (1 - deviation)^2 - h^2 / 3.
double stretch_of(const Point& a, const Point& b, const Point& c, double deviation) {
  const Point e = minus(b, a), f = minus(c, a), g = minus(c, b);
  const double lowest = 1 - deviation - 0.5 * std::max({dot(e, e), dot(f, f), dot(g, g)}) - 4 * u;
  return lowest > 0 ? (1 + deviation) / lowest : std::numeric_limits<double>::infinity();
}

/// A ball around the places p with |p| <= 1 + deviation and normal.p >= height, the normal a unit vector
/// known to `error`: |p - normal|^2 = |p|^2 + 1 - 2 normal.p.
Ball ball_beyond(const Point& normal, double height, double error, double deviation) {
  const double square = 2 * (1 - height) + 3 * deviation + 2 * error + 16 * u;
  return {normal, std::sqrt(std::max(square, 0.0)) + error + 1e-12};
}

/// The component of the largest of a, where |a| = |a + e| = 1, follows from the others: (2a + e).e = 0. Where
/// these are small it is known as well as they are, whatever the rounding of the directions.
void follow_others(const Point& a, Point& e) {
  double Point::*const axis[] = {&Point::x, &Point::y, &Point::z};
  const auto size = [&](int k) { return std::fabs(a.*axis[k]); };
  const int k = size(0) >= size(1) ? (size(0) >= size(2) ? 0 : 2) : (size(1) >= size(2) ? 1 : 2);
  const auto x = axis[k], y = axis[(k + 1) % 3], z = axis[(k + 2) % 3];
  e.*x = -(e.*y * (a.*y + 0.5 * e.*y) + e.*z * (a.*z + 0.5 * e.*z)) / (a.*x + 0.5 * e.*x);
}

/// A ball around all directions above the triangle a, a + e, a + f of directions, the longest edge of which
/// is the third, with the centre below it: that of its circle. The cap above a plane at height d >= 0 is no
/// farther from the point where the plane is nearest to the centre than the circle, sqrt(1 - d^2).
Ball ball_around(const Point& a, Point e, Point f) {
  // An edge as far as it is known: its components to 2.1u and 2^-98 of those of its ends. If it is short,
  // that along the axis follows from the others, to 45u of the edge and 2^-96 of the others of a.
  const double longest = std::max(
      {std::fabs(e.x), std::fabs(e.y), std::fabs(e.z), std::fabs(f.x), std::fabs(f.y), std::fabs(f.z)});
  if (!(longest > 0x1p-900)) return kEverywhere;
  double relative = 8 * u, absolute = 0x1p-95;
  if (longest < 0x1p-40) {
    follow_others(a, e);
    follow_others(a, f);
    relative = 48 * u;
    const double across = std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z) -
                          std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
    absolute *= across + longest;
  }
  int exponent;
  std::frexp(longest, &exponent);
  const auto scaled = [](const Point& p, int by) {
    return Point{std::ldexp(p.x, by), std::ldexp(p.y, by), std::ldexp(p.z, by)};
  };
  e = scaled(e, -exponent), f = scaled(f, -exponent);
  absolute = std::ldexp(absolute, -exponent);
  const Point n = cross(e, f), g = minus(f, e);
  const double ee = dot(e, e), ff = dot(f, f), nn = dot(n, n), edges = std::sqrt(ee * ff);
  const double length = std::sqrt(nn);
  // Of n, relative: that of the factors, and 4u |e||f| of the product.
  const double error =
      ((2 * relative + 4 * u) * edges + 2 * absolute * (std::sqrt(ee) + std::sqrt(ff))) / length;
  if (!(error < 0.01 && nn > 0x1p-900)) return kEverywhere;
  // From a to the centre of the circle: (|e|^2 f - |f|^2 e) x n / (2 |n|^2). The first factor is |e||f||g|
  // long and known to 6 errors of its terms, no longer than 2 of that; n and |n|^2 to 3.
  const Point v{ee * f.x - ff * e.x, ee * f.y - ff * e.y, ee * f.z - ff * e.z};
  const Point to_centre = cross(v, n);
  const double half = 0.5 / nn;
  const double radius = edges * std::sqrt(dot(g, g)) / (2 * length) * (1 + 32 * error);
  const Point c = scaled({to_centre.x * half, to_centre.y * half, to_centre.z * half}, exponent);
  return {{a.x + c.x, a.y + c.y, a.z + c.z}, std::ldexp(radius, exponent)};
}

}  // namespace

// ---- triangulate ------------------------------------------------------------------------------------

namespace {

/// Room for nodes that are learnt later. They are few; where they are not, memory is taken anew.
std::size_t capacity_for(std::size_t nodes) { return nodes + nodes / 32 + 256; }

}  // namespace

template <class Int>
void Patch<Int>::set_nodes(const Record* nodes, std::size_t own, std::size_t count) {
  nodes_ = nodes;
  own_ = own;
  count_ = count;
}

template <class Int>
std::size_t Patch<Int>::workspace_bytes(std::size_t closing) const {
  if (own_ == 0) return 0;
  const std::size_t capacity = capacity_for(count_ + closing);
  return capacity * (sizeof(std::uint32_t) + sizeof(Point) + sizeof(Int) + 2 * sizeof(Face) +
                     sizeof(std::uint32_t) + 2 * sizeof(Plane)) +
         Workspace::kSlack;
}

template <class Int>
void Patch<Int>::set_up(const std::vector<Record>& closing, Workspace& workspace) {
  if (own_ == 0) return;
  std::vector<Record> leading;
  for (const Record& r : closing)
    if (!partition_->knows(id_, places_(r.point))) leading.push_back(r);
  const std::size_t first = leading.size();
  built_ = count_ + first;
  arrays_.capacity = capacity_for(built_);
  order_ = workspace.keep<std::uint32_t>(built_);
  leading_ = first + insertion_order(&nodes_->point, count_, order_ + first, workspace, sizeof(Record));
  workspace.next_phase();
  arrays_.nodes = workspace.keep<Point>(arrays_.capacity);
  number_ = workspace.keep<Int>(arrays_.capacity);
  for (std::size_t v = 0; v < first; ++v) {
    order_[v] = static_cast<std::uint32_t>(count_ + v);
    arrays_.nodes[v] = leading[v].point;
    number_[v] = static_cast<Int>(leading[v].number);
  }
  constexpr std::size_t kAhead = 16;
  for (std::size_t v = first; v < built_; ++v) {
    if (v + kAhead < built_) __builtin_prefetch(nodes_ + order_[v + kAhead]);
    const Record& r = nodes_[order_[v]];
    arrays_.nodes[v] = r.point;
    number_[v] = static_cast<Int>(r.number);
  }
  arrays_.faces = workspace.keep<Face>(2 * arrays_.capacity);
  arrays_.corner = workspace.keep<std::uint32_t>(arrays_.capacity);
  arrays_.planes = workspace.take<Plane>(2 * arrays_.capacity);
  first_planes_ = arrays_.planes;
  growing_ = GrowingHull::make(arrays_, built_, places_.lengths());
  growing_->look_for_hidden_nodes(leading_);
}

template <class Int>
void Patch<Int>::triangulate() {
  if (own_ == 0) return;
  growing_->build(leading_);
  for (const auto& [in, out] : growing_->coincident()) coincident_.emplace_back(number_[in], number_[out]);
}

// ---- certify ----------------------------------------------------------------------------------------

template <class Int>
Ball Patch<Int>::ball_above(std::uint32_t ia, std::uint32_t ib, std::uint32_t ic) const {
  // From the corner opposite the longest edge: the product of the others is large then, even in a needle.
  const auto square = [](const Point& d) { return dot(d, d); };
  for (int turn = 0; turn < 2; ++turn) {
    const double bc = square(growing_->difference(ic, ib));
    if (bc >= square(growing_->difference(ib, ia)) && bc >= square(growing_->difference(ic, ia))) break;
    std::tie(ia, ib, ic) = std::make_tuple(ib, ic, ia);
  }
  const Point a = place(ia);
  const Point e = growing_->difference(ib, ia), f = growing_->difference(ic, ia);
  if (places_.lengths() != Lengths::as_given) return ball_around(a, e, f);
  const Point n = cross(e, f);
  const double length = std::sqrt(dot(n, n)), edge_e = std::sqrt(dot(e, e)), edge_f = std::sqrt(dot(f, f));
  // Rounding of the differences and of their product: 12u |e||f| and 2^-95 (|e| + |f|), as of a plane in
  // mesh/delaunay.cpp.
  const double error = (16 * u * edge_e * edge_f + 0x1p-94 * (edge_e + edge_f)) / length;
  if (!(error < 0.1)) return kEverywhere;
  const Point normal{n.x / length, n.y / length, n.z / length};
  return ball_beyond(normal, dot(normal, a), error, places_.deviation());
}

/// The smallest number first, so that a triangle has one name.
template <class Int>
Question Patch<Int>::question_about(std::uint32_t t) const {
  const Face& f = arrays_.faces[t];
  std::uint32_t first = 0;
  for (const std::uint32_t i : {1, 2})
    if (number_[f.vertex[i]] < number_[f.vertex[first]]) first = i;
  Question question{};
  for (std::uint32_t i = 0, e = first; i < 3; ++i, e = next_edge(e))
    question.corner[i] = {arrays_.nodes[f.vertex[e]], number_[f.vertex[e]]};
  question.from = id_;
  return question;
}

template <class Int>
void Patch<Int>::ask_about_triangle(std::uint32_t t, std::vector<Question>& questions) {
  const Face& f = arrays_.faces[t];
  partition_->strangers(id_, ball_above(f.vertex[0], f.vertex[1], f.vertex[2]), strangers_);
  if (strangers_.empty()) return;
  Question question = question_about(t);
  for (const int q : strangers_) {
    question.to = q;
    questions.push_back(question);
  }
}

/// Seen from the front, the edge u -> w of a face at the back is w -> u, with the triangulation on its left.
template <class Int>
std::vector<typename Patch<Int>::Arc> Patch<Int>::boundary_arcs() const {
  std::vector<Arc> arcs;
  if (growing_->surrounds_centre()) return arcs;
  const auto faces = static_cast<std::uint32_t>(growing_->face_count());
  for (std::uint32_t t = 0; t < faces; ++t) {
    if (arrays_.planes[t].w > 1 || growing_->front(t)) continue;
    const Face& f = arrays_.faces[t];
    for (std::uint32_t i = 0; i < 3; ++i)
      if (growing_->front(face_of(f.neighbour[i])))
        arcs.push_back({f.vertex[previous_edge(i)], f.vertex[next_edge(i)]});
  }
  return arcs;
}

/// An arc with one end of another patch is asked of that patch. Where all agree, the arcs at own nodes close
/// to curves that turn left only, around a place z inside the triangle of the corners. Each of them crosses
/// the great circle through z and a corner; the arc that crosses it is asked of all, so that there is one
/// curve and no node beyond it. z is infinitely close to the first corner, on the side of the second.
template <class Int>
void Patch<Int>::ask_about_arcs(const std::array<Record, 3>& corners, Doubts& doubts) {
  const auto is_left = [&](std::uint32_t v) {
    const Point& x = arrays_.nodes[v];
    const int side = left(corners[0].point, corners[2].point, x);
    return (side != 0 ? side : left(corners[1].point, corners[2].point, x)) > 0;
  };
  std::vector<Arc> arcs;
  if (asked_with_ == 0) {
    arcs = boundary_arcs();
  } else {
    for (const Arc& arc : asked_arcs_)
      if (beside_on_boundary(arc.a).b == arc.b) arcs.push_back(arc);
    // An arc that was none before ends at a node that has come in since.
    for (auto v = static_cast<std::uint32_t>(asked_with_); v < growing_->node_count(); ++v) {
      const Arc beside = beside_on_boundary(v);
      if (beside.a == kNobody) continue;
      arcs.push_back({beside.a, v});
      arcs.push_back({v, beside.b});
    }
  }
  asked_arcs_.clear();
  for (const Arc& arc : arcs) {
    const std::uint32_t a = arc.a, b = arc.b;
    const bool owns_a = is_own(a), owns_b = is_own(b);
    if (!owns_a && !owns_b) continue;
    const auto ask = [&](int patch) {
      doubts.questions.push_back(
          {{{arrays_.nodes[a], number_[a]}, {arrays_.nodes[b], number_[b]}, {{0, 0, 0}, 0}}, id_, patch});
      ++doubts.arcs;
      if (asked_arcs_.empty() || asked_arcs_.back().a != a) asked_arcs_.push_back({a, b});
    };
    if (owns_a && is_left(a) && !is_left(b)) {
      for (int q = 0; q < partition_->patches(); ++q)
        if (q != id_) ask(q);
    } else if (!owns_a || !owns_b) {
      ask(partition_->owner(place(owns_a ? b : a)));
    }
  }
}

template <class Int>
Doubts Patch<Int>::ask(const std::array<Record, 3>& corners, double stretch, std::size_t most) {
  Doubts doubts;
  if (own_ == 0 || partition_->patches() == 1) return doubts;
  doubts.has_grown = growing_->node_count() != asked_with_;
  ask_about_arcs(corners, doubts);
  // A node that lies above some triangle of own nodes lies above one that has a corner of another patch as
  // well, or its direction is in a triangle of own nodes, which must bulge out of the patch then.
  // After the first time only triangles at nodes that have come in since are new.
  const bool first_time = asked_with_ == 0;
  is_around_.resize(growing_->node_count());
  for_each_face_at_border(asked_with_, [&](std::uint32_t t, int own) {
    if (own == 0 || doubts.questions.size() > most) return;
    for (int i = 0; i < 3; ++i) meet(arrays_.faces[t].vertex[i]);
    ask_about_triangle(t, doubts.questions);
  });
  asked_with_ = growing_->node_count();
  if (!first_time || doubts.questions.size() > most || partition_->holds_all(id_, stretch)) return doubts;
  // What lies in the direction of a point y of a triangle is at most 1 + deviation times as long as 1 / |y|.
  const double margin = partition_->smallest_margin(), farthest = 1 + places_.deviation();
  const double lowest = std::max(0.0, farthest - margin + 1e-12);
  const double limit = lowest * lowest;
  const auto is_flat = [&](std::uint32_t t) {  // few are not; no branch where it cannot be guessed
    const Plane& p = arrays_.planes[t];        // its product with a unit vector is known to 1
    const double w = p.w - 4;
    return (w > 0) & (w * w >= limit * (p.x * p.x + p.y * p.y + p.z * p.z));
  };
  const auto examine = [&](std::uint32_t t) {
    const auto& v = arrays_.faces[t].vertex;
    if (is_flat(t) || !(is_own(v[0]) && is_own(v[1]) && is_own(v[2]))) return;
    const Point a = place(v[0]), b = place(v[1]), c = place(v[2]);
    const double most_stretch =
        std::min(stretch_of(arrays_.planes[t], farthest), stretch_of(a, b, c, places_.deviation()));
    if (!partition_->holds(id_, a, b, c, most_stretch) && growing_->front(t))
      ask_about_triangle(t, doubts.questions);
  };
  constexpr std::uint32_t kTogether = 8;
  const auto faces = static_cast<std::uint32_t>(growing_->face_count());
  std::uint32_t t = 0;
  for (; t + kTogether <= faces; t += kTogether) {
    bool all = true;
    for (std::uint32_t j = 0; j < kTogether; ++j) all &= is_flat(t + j);
    if (all) continue;
    for (std::uint32_t j = 0; j < kTogether; ++j) examine(t + j);
  }
  for (; t < faces; ++t) examine(t);
  return doubts;
}

// ---- what some nodes tell of all --------------------------------------------------------------------

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

// ---- answer and learn -------------------------------------------------------------------------------

template <class Int>
void Patch<Int>::make_room() {
  const std::size_t n = growing_->node_count(), faces = growing_->face_count();
  if (n < arrays_.capacity) return;
  HullArrays larger;
  larger.capacity = 2 * arrays_.capacity;
  auto memory = decltype(memory_){Buffer<Point>(larger.capacity), Buffer<Int>(larger.capacity),
                                  Buffer<Face>(2 * larger.capacity), Buffer<Plane>(2 * larger.capacity),
                                  Buffer<std::uint32_t>(larger.capacity)};
  std::copy(arrays_.nodes, arrays_.nodes + n, memory.nodes.begin());
  std::copy(number_, number_ + n, memory.number.begin());
  std::copy(arrays_.faces, arrays_.faces + faces, memory.faces.begin());
  std::copy(arrays_.planes, arrays_.planes + faces, memory.planes.begin());
  std::copy(arrays_.corner, arrays_.corner + n, memory.corner.begin());
  memory_ = std::move(memory);
  larger.nodes = memory_.nodes.data();
  larger.faces = memory_.faces.data();
  larger.planes = memory_.planes.data();
  larger.corner = memory_.corner.data();
  number_ = memory_.number.data();
  arrays_ = larger;
  growing_->move_to(arrays_);
}

template <class Int>
std::uint32_t Patch<Int>::take_in(const Record& node) {
  const auto [taken, is_new] = taken_in_.try_emplace(node.number, 0);
  if (!is_new) return taken->second;
  make_room();
  const std::size_t before = growing_->node_count();
  const std::uint32_t v = growing_->add(node.point);
  if (v == before)
    number_[v] = static_cast<Int>(node.number);
  else if (number_[v] != node.number)
    coincident_.emplace_back(number_[v], node.number);
  taken->second = v;
  return v;
}

template <class Int>
typename Patch<Int>::Arc Patch<Int>::beside_on_boundary(std::uint32_t v) const {
  Arc beside{kNobody, kNobody};
  if (growing_->surrounds_centre()) return beside;
  for_each_face_at(v, [&](std::uint32_t t, std::uint32_t i) {
    if (growing_->front(t)) return;
    const Face& f = arrays_.faces[t];
    const std::uint32_t next = next_edge(i), previous = previous_edge(i);
    if (growing_->front(face_of(f.neighbour[next]))) beside.b = f.vertex[previous];
    if (growing_->front(face_of(f.neighbour[previous]))) beside.a = f.vertex[next];
  });
  return beside;
}

/// Uphill on the hull, which is convex: rounding can end the way early.
template <class Int>
std::uint32_t Patch<Int>::farthest_right(std::uint32_t a, std::uint32_t b, std::uint32_t v) const {
  const Point normal = cross(place(b), place(a));
  double highest = dot(normal, place(v));
  for (std::uint32_t from = kNobody, farthest = v; from != farthest;) {
    from = farthest;
    for_each_face_at(from, [&](std::uint32_t t, std::uint32_t i) {
      const std::uint32_t w = arrays_.faces[t].vertex[next_edge(i)];
      const double height = dot(normal, place(w));
      if (height > highest) highest = height, farthest = w;
    });
    if (growing_->left(a, b, farthest) < 0) v = farthest;
  }
  return v;
}

/// Nodes strictly right of a -> b or on it, if it is not an arc of the boundary. If a is on the boundary, the
/// next node there is such a node; else a is inside, and one of its neighbours is.
template <class Int>
void Patch<Int>::answer_about_arc(std::uint32_t a, std::uint32_t b, std::vector<Record>& nodes) {
  const std::uint32_t next = beside_on_boundary(a).b, previous = beside_on_boundary(b).a;
  if (next == b) return;
  const auto add = [&](std::uint32_t v) { nodes.push_back({arrays_.nodes[v], number_[v]}); };
  std::uint32_t right = kNobody;
  const auto look_at = [&](std::uint32_t v) {
    if (v != kNobody && v != b && growing_->left(a, b, v) < 0) right = v;
  };
  if (next != kNobody) {
    add(next);
    look_at(next);
  } else {
    for_each_face_at(a, [&](std::uint32_t t, std::uint32_t i) {
      if (right == kNobody) look_at(arrays_.faces[t].vertex[next_edge(i)]);
    });
  }
  if (previous != kNobody && previous != next) add(previous);
  if (right == kNobody) return;
  if (right != next) add(right);
  const std::uint32_t farthest = farthest_right(a, b, right);
  if (farthest != right) add(farthest);
}

template <class Int>
void Patch<Int>::answer(const Question& question, std::vector<Record>& nodes) {
  nodes.clear();
  if (own_ == 0 || !coincident_.empty()) return;
  if (question.is_about_arc()) {
    const std::uint32_t a = take_in(question.corner[0]), b = take_in(question.corner[1]);
    answer_about_arc(a, b, nodes);
    return;
  }
  std::uint32_t v[3] = {0, 0, 0};
  for (int i = 0; i < 3; ++i) v[i] = take_in(question.corner[i]);
  std::vector<std::uint32_t> above;
  const auto add_those_above = [&](std::uint32_t node, std::size_t faces) {
    std::uint32_t corner = arrays_.corner[node];
    do {
      const std::uint32_t w = arrays_.faces[face_of(corner)].vertex[next_edge(edge_of(corner))];
      if (w != v[0] && w != v[1] && w != v[2] && growing_->above(v[0], v[1], v[2], w)) above.push_back(w);
      corner = counterclockwise(corner);
    } while (--faces > 0 && corner != arrays_.corner[node]);
  };
  // All nodes lie in the cone that the hull makes at a corner, so one of the neighbours of that corner lies
  // above if any node does. The corner with the fewest: its ring closes first.
  std::uint32_t at[3] = {arrays_.corner[v[0]], arrays_.corner[v[1]], arrays_.corner[v[2]]}, least = 0;
  do {
    least = least == 2 ? 0 : least + 1;
    at[least] = counterclockwise(at[least]);
  } while (at[least] != arrays_.corner[v[least]]);
  bool is_face = false;
  for_each_face_at(v[least], [&](std::uint32_t t, std::uint32_t i) {
    const auto& corner = arrays_.faces[t].vertex;
    is_face |=
        corner[next_edge(i)] == v[next_edge(least)] && corner[previous_edge(i)] == v[previous_edge(least)];
  });
  if (is_face) return;
  constexpr std::size_t kManyFaces = 512;  // not all at a node with very many neighbours
  add_those_above(v[least], SIZE_MAX);
  if (above.empty()) return;
  for (std::uint32_t k = 0; k < 3; ++k)
    if (k != least) add_those_above(v[k], kManyFaces);
  std::sort(above.begin(), above.end());
  above.erase(std::unique(above.begin(), above.end()), above.end());
  // The highest few: they change the asker's triangulation most, and the others may not matter then.
  constexpr std::size_t kFew = 64;
  if (above.size() > kFew) {
    const Point a = place(v[0]);
    const Point normal = cross(minus(place(v[1]), a), minus(place(v[2]), a));
    const auto height = [&](std::uint32_t w) { return dot(normal, minus(place(w), a)); };
    std::nth_element(above.begin(), above.begin() + kFew, above.end(),
                     [&](std::uint32_t s, std::uint32_t t) { return height(s) > height(t); });
    above.resize(kFew);
  }
  for (const std::uint32_t w : above) nodes.push_back({arrays_.nodes[w], number_[w]});
}

template <class Int>
void Patch<Int>::learn(const Question& question, const Record* nodes, std::size_t count) {
  if (count > 0 && !asked_about_.empty())
    for (const Record& r : question.corner)
      if (const auto found = taken_in_.find(r.number);
          found != taken_in_.end() && owner_of(found->second) == question.to)
        asked_about_[found->second].refuted += 1;
  for (std::size_t k = 0; k < count; ++k) take_in(nodes[k]);
}

// ---- the rings --------------------------------------------------------------------------------------

template <class Int>
std::size_t Patch<Int>::finish() {
  if (own_ == 0) return 0;
  hull_ = growing_->finish();
  // The corners of all triangles, and for each node one more at the boundary and its count.
  return 3 * hull_.face_count + 2 * hull_.node_count;
}

template <class Int>
void* Patch<Int>::room_for_rings(std::size_t bytes) const {
  return bytes <= 2 * built_ * sizeof(Plane) ? first_planes_ : nullptr;
}

template class Patch<std::int32_t>;
template class Patch<std::int64_t>;

}  // namespace pstripack
