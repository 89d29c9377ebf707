// The incremental hull, in order:
//   1  sort the nodes along a curve over the sphere          (speed only)
//   2  start from one triangle, seen from both sides
//   3  insert node by node: find a face that it sees, collect all that it sees, put a fan in their place
//   4  decide which faces are part of the triangulation
//
// One predicate decides everything: `above`, whether a node sees a face. It is exact and consistent (the
// tie rule is a real perturbation of the nodes), so what a node sees of the hull is always a disc bounded
// by one simple polygon, and the result is the hull of the perturbed nodes whatever the order was.
//
// References: Clarkson & Shor (1989), incremental hulls; Edelsbrunner & Muecke (1990), simulation of
// simplicity; Amenta, Choi & Rote (2003), insertion in rounds along a curve.

#include "mesh/delaunay.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "base/parallel_for.h"
#include "geometry/insertion_order.h"
#include "mesh/hidden_nodes.h"

namespace pstripack {
namespace {

/// A node seen from another: the difference of their positions and its square.
struct Spoke {
  Point d;
  double square;
};

// ---- the plane of a face: the filter in front of `above` -----------------------------------------
//
// For a face a,b,c let e = b-a, f = c-a, n = e x f, w = n.a. Node d sees it if n.d - w > 0. Errors, with
// u = 2^-53, S = |e||f| and M = u S + 2^-98 (|e| + |f|):
//   components of e, f       3u of themselves and 2^-99 (Directions; one u for Coordinates)
//   n = e x f                |E(n)| <= sqrt(2) (2*3u + 2u) S + sqrt(3) 2^-99 (|e| + |f|) < 12 M
//   n.d, n.a                 4u |n| each for the sums and the scale (|d| < 1 + 2^-19);
//                            E(n).(d-a) < 2.1 * 12 M; positions of directions are rounded: 2u |n|, or longer
//                            by 4u each: 8u |n|
// Together less than 42 M, and less than 42 M for w alone. The plane is multiplied by less than 1 / (50 M):
// then |n.d - w| > 1 is a certain sign, and so is |w| > 1 for det(a,b,c) = n.a.
//
// Where all is close together n.d drowns in the rounding of w. Then, and wherever it is at hand, the
// difference g = a - d to any corner a of the face takes the place of d: small and accurate. n.g has an error
// of 12 M |g| from n, 7u |n| |g| from the product and the scale, and 2^-98 |n|; in the scale of the plane,
// where 50u |n| < 1, that is less than |g| / 2 + 2^-45.

double above_plane(const Plane& f, const Point& p) { return (f.x * p.x + f.y * p.y) + (f.z * p.z - f.w); }

/// The same for the node from which the spoke leads to a corner of the face.
double above_plane(const Plane& f, const Spoke& to_corner) {
  const Point& g = to_corner.d;
  return -(f.x * g.x + f.y * g.y + f.z * g.z);
}

/// The sign of above_plane(f, to_corner) is certain if its magnitude exceeds this.
double certain_height(const Spoke& to_corner) {
  const Point& g = to_corner.d;
  return 0.5 * (std::fabs(g.x) + std::fabs(g.y) + std::fabs(g.z)) + 0x1p-45;
}

template <class Predicates>
[[gnu::always_inline]] inline Spoke make_spoke(const Predicates& predicates, HullNode to, HullNode from) {
  const Point d = predicates.difference(static_cast<index_t>(to), static_cast<index_t>(from));
  return {d, dot(d, d)};
}

[[gnu::always_inline]] inline Plane scaled_plane(const Point& a, const Spoke& b, const Spoke& c,
                                                 double scale) {
  const Point n = cross(b.d, c.d);
  return {n.x * scale, n.y * scale, n.z * scale, dot(n, a) * scale};
}

std::uint64_t bits_of(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// make_plane where an edge is so short that 2^-98 (|e| + |f|) counts.
[[gnu::always_inline]] inline Plane make_small_plane(const Point& a, const Spoke& b, const Spoke& c) {
  // An edge shorter than 2^-70 is known too inaccurately, and its square may underflow: no plane, always
  // exact.
  if (!(std::min(b.square, c.square) >= 0x1p-140)) return {0, 0, 0, 0};
  const double e = std::sqrt(b.square), f = std::sqrt(c.square);
  return scaled_plane(a, b, c, 1 / (0x1.1p-47 * (e * f) + 0x1.1p-92 * (e + f)));
}

/// The plane of the face a,b,c from the position of a and the spokes a->b and a->c.
///
/// The scale is about 2^46.9 / S, by arithmetic on the bits of the squares of e and f: as an integer, those
/// of 2^k (1 + m), 0 <= m < 1, are 2^52 (1023 + k + m), and k + m is less than the logarithm by 0.0861 at
/// most. So S times the scale is from 2^46.8 to 2^(46.8 + 2 * 0.0861) < 2^47 = 1 / (64u), and where neither
/// |e| nor |f| is below 2^-42, as where S^2 >= 2^-80, M <= 1.25u S.
[[gnu::always_inline]] inline Plane make_plane(const Point& a, const Spoke& b, const Spoke& c) {
  constexpr double kOne = 0x1p52;
  const std::uint64_t squares = bits_of(b.square) + bits_of(c.square);
  if (squares < static_cast<std::uint64_t>((2 * 1023 - 80) * kOne) &&
      !(std::min(b.square, c.square) >= 0x1p-84))
    return make_small_plane(a, b, c);
  const std::uint64_t bits = static_cast<std::uint64_t>((2 * 1023 + 46.8) * kOne) - squares / 2;
  double scale;
  std::memcpy(&scale, &bits, sizeof scale);
  return scaled_plane(a, b, c, scale);
}

// ---- the hull under construction ------------------------------------------------------------------

template <class Predicates>
class Builder final : public GrowingHull {
 public:
  Builder(const HullArrays& arrays, std::size_t n) : predicates_(with_capacity(arrays, n)), n_(n) {
    set_arrays(arrays);
  }

  void build(std::size_t leading) override {
    start(leading);
    const auto n = static_cast<std::uint32_t>(n_), first = static_cast<std::uint32_t>(leading);
    for (std::uint32_t v = 0; v < first; ++v) insert_unless_started(v);
    // Rounds along the curve: ..., every 256th node, every 16th node, then all others. A round makes the
    // triangles small everywhere, so that each node of the next replaces few of them, however the nodes lie.
    // Two rounds would not suffice: nodes in line towards the middle of an arc of others would each take over
    // the faces at all nodes of that arc from the node before, in quadratic time.
    constexpr std::uint32_t kRatio = 16;
    std::uint32_t stride = 1;
    while (stride <= (n - first) / kRatio) stride *= kRatio;
    for (std::uint32_t done = 0; stride > 0; done = stride, stride /= kRatio)
      for (std::uint32_t v = first; v < n; v += stride)
        if (done == 0 || ((v - first) & (done - 1)) != 0) insert_unless_started(v);
  }

  HullNode add(const Point& p) override {
    const auto v = static_cast<HullNode>(n_);
    nodes_[v] = p;
    predicates_.extend(nodes_, n_ + 1);
    const std::size_t before = coincident_.size();
    start_near(predicates_.position(v));
    insert(v);
    if (coincident_.size() == before) return static_cast<HullNode>(n_++);
    const HullNode in = coincident_.back().first;
    coincident_.pop_back();
    predicates_.extend(nodes_, n_);
    return in;
  }

  void move_to(const HullArrays& arrays) override {
    set_arrays(arrays);
    predicates_.extend(nodes_, n_);
  }

  std::size_t node_count() const override { return n_; }
  std::size_t face_count() const override { return count_; }
  const std::vector<std::pair<HullNode, HullNode>>& coincident() const override { return coincident_; }
  int left(HullNode a, HullNode b, HullNode c) const override { return predicates_.left(a, b, c); }
  bool above(HullNode a, HullNode b, HullNode c, HullNode d) const override {
    return predicates_.above(a, b, c, d);
  }
  Point difference(HullNode a, HullNode b) const override {
    return predicates_.difference(static_cast<index_t>(a), static_cast<index_t>(b));
  }

  void look_for_hidden_nodes(std::size_t leading) const override {
    if constexpr (std::is_same_v<Predicates, Directions>) return;  // none can be hidden
    const std::vector<std::size_t> closest = closest_nodes(nodes_, n_, leading);
    if (closest.empty()) return;
    HullNode corners[4];
    choose_corners(corners, leading);
    triangulate_around(closest, nodes_, n_, leading, corners);
  }

  bool surrounds_centre() const override { return surrounds_centre_; }

  // -- 4: which faces are part of the triangulation

  Hull finish() const override {
    Hull hull;
    hull.lengths = std::is_same_v<Predicates, Coordinates> ? Lengths::as_given : Lengths::directions;
    hull.node_count = n_;
    hull.face_count = count_;
    hull.faces = faces_;
    hull.corner = corner_;
    hull.surrounds_centre = surrounds_centre_;
    if (surrounds_centre_) return hull;
    hull.back.assign(count_, false);
    hull.at_back.assign(n_, false);
    const HullFace one = some_back_face();
    hull.surrounds_centre = one == kNone;
    if (hull.surrounds_centre) return hull;
    // The back faces form one connected region. Those that the centre sees are connected, since the hull is
    // convex. A face whose plane contains the centre either has such a face across its nearest edge, or
    // contains the centre itself, and then no face is seen.
    hull.back[one] = true;
    for (std::vector<HullFace> region{one}; !region.empty();) {
      const Face& f = faces_[region.back()];
      region.pop_back();
      for (int i = 0; i < 3; ++i) {
        hull.at_back[f.vertex[i]] = true;
        const HullFace next = face_of(f.neighbour[i]);
        if (hull.back[next] || front(next)) continue;
        hull.back[next] = true;
        region.push_back(next);
      }
    }
    for (HullNode v = 0; v < n_; ++v)
      if (hull.at_back[v] && !turn_to_first_front_face(hull, v)) throw HiddenNode{};
    return hull;
  }

  bool front(HullFace t) const override {
    const double w = planes_[t].w;
    if (w > 1) return true;
    if (w < -1) return false;
    const Face& f = faces_[t];
    return predicates_.left(f.vertex[0], f.vertex[1], f.vertex[2]) > 0;
  }

 private:
  static Predicates with_capacity(const HullArrays& arrays, std::size_t n) {
    if constexpr (std::is_same_v<Predicates, Directions>)
      return {arrays.nodes, n, arrays.capacity};
    else
      return {arrays.nodes, n};
  }

  void set_arrays(const HullArrays& arrays) {
    nodes_ = arrays.nodes;
    faces_ = arrays.faces;
    words_ = reinterpret_cast<std::uint32_t*>(arrays.faces);
    planes_ = arrays.planes;
    corner_ = arrays.corner;
  }

  /// Any back face; kNone if there is none.
  HullFace some_back_face() const {
    // Walk away from a node, always across an edge that has the node on the face's side. A walk over
    // Delaunay triangles never returns to one (De Floriani et al. 1991), but this walk may be long, or end
    // opposite the node. Then all faces are searched.
    HullFace t = last_;
    const HullNode from = faces_[t].vertex[0];
    for (std::size_t steps = count_ / 8; steps > 0; --steps) {
      const Face& f = faces_[t];
      std::uint32_t out = 0;
      while (out < 3 && predicates_.left(f.vertex[next_edge(out)], f.vertex[previous_edge(out)], from) <= 0)
        ++out;
      if (out == 3) break;
      t = face_of(f.neighbour[out]);
      if (!front(t)) return t;
    }
    for (t = 0; t < count_; ++t)
      if (!front(t)) return t;
    return kNone;
  }

  /// For a node v with a back face: sets corner_[v] to the first front face counterclockwise after the back
  /// faces, where the ring of v starts. False if v has no front face.
  bool turn_to_first_front_face(const Hull& hull, HullNode v) const {
    HullCorner corner = corner_[v];
    do {
      const HullCorner next = clockwise(hull, corner);
      if (hull.front(face_of(corner)) && !hull.front(face_of(next))) {
        corner_[v] = corner;
        return true;
      }
      corner = next;
    } while (corner != corner_[v]);
    return false;
  }

  // -- 2: the first nodes

  /// The hull of three nodes: one triangle, seen from both sides. A fourth node on the opposite side of the
  /// sphere is inserted at once, so that the hull surrounds the centre early if it ever does.
  void start(std::size_t leading) {
    HullNode corner[4];
    choose_corners(corner, leading);
    const auto [a, b, c, d] = corner;
    // front face 0: a,b,c   back face 1: b,a,c   edges opposite c, then a against b
    corner_[a] = 0, corner_[b] = 1, corner_[c] = 2;
    faces_[0] = {{a, b, c, c}, {4 * 1 + 1, 4 * 1 + 0, 4 * 1 + 2, 0}};
    faces_[1] = {{b, a, c, c}, {4 * 0 + 1, 4 * 0 + 0, 4 * 0 + 2, 0}};
    const Spoke ab = make_spoke(predicates_, b, a), ac = make_spoke(predicates_, c, a);
    planes_[0] = make_plane(predicates_.position(a), ab, ac);
    planes_[1] = make_plane(predicates_.position(a), ac, ab);
    count_ = 2;
    last_ = 0;
    std::copy(corner, corner + 3, started_);
    started_[3] = c;
    if (n_ == 3) return;
    insert(d);
    started_[3] = d;
    surrounds_centre_ = count_ == 4;
    for (HullFace t = 0; t < count_; ++t) surrounds_centre_ = surrounds_centre_ && planes_[t].w > 1;
  }

  /// Chooses four nodes, the first three counterclockwise and not on one great circle: those of the leading
  /// nodes and of a sample of the others that lie farthest towards the corners of a regular tetrahedron. If
  /// these do not work, any. Usually they surround the centre if all nodes do, and then all faces are known
  /// to be front faces.
  void choose_corners(HullNode (&corner)[4], std::size_t leading) const {
    static constexpr double towards[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    const std::size_t stride = n_ / 256 + 1;
    double best[4] = {-4, -4, -4, -4};
    std::fill(corner, corner + 4, 0);
    for (std::size_t v = 0; v < n_; v += v < leading ? 1 : stride)
      for (int k = 0; k < 4; ++k) {
        const Point& p = predicates_.position(static_cast<index_t>(v));
        const double d = p.x * towards[k][0] + p.y * towards[k][1] + p.z * towards[k][2];
        if (d > best[k]) best[k] = d, corner[k] = static_cast<HullNode>(v);
      }
    if (!turn_counterclockwise(corner)) choose_any_corners(corner);
    if (n_ > 3 && (corner[3] == corner[0] || corner[3] == corner[1] || corner[3] == corner[2]))
      for (corner[3] = 0; corner[3] == corner[0] || corner[3] == corner[1] || corner[3] == corner[2];)
        ++corner[3];
  }

  bool turn_counterclockwise(HullNode (&corner)[4]) const {
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) return false;
    const int turn = predicates_.left(corner[0], corner[1], corner[2]);
    if (turn < 0) std::swap(corner[0], corner[1]);
    return turn != 0;
  }

  /// The first node a, the first node b not on the line of a, the first node not on the great circle of a, b.
  void choose_any_corners(HullNode (&corner)[4]) const {
    const auto n = static_cast<std::uint32_t>(n_);
    corner[0] = 0;
    for (corner[1] = 1; corner[1] < n && on_one_line(corner[0], corner[1]);) ++corner[1];
    for (corner[2] = corner[1] + 1; corner[2] < n; ++corner[2])
      if (turn_counterclockwise(corner)) return;
    // TRMESH returns -2 before; a patch has corners of the whole
    throw std::domain_error("all nodes lie on one great circle");
  }

  /// True if a and b point in the same or in opposite directions, exactly: a x b = 0, component by component.
  bool on_one_line(HullNode a, HullNode b) const {
    const Point &p = predicates_.given(a), &q = predicates_.given(b);
    return pstripack::left(p, q, {1, 0, 0}) == 0 && pstripack::left(p, q, {0, 1, 0}) == 0 &&
           pstripack::left(p, q, {0, 0, 1}) == 0;
  }

  void insert_unless_started(HullNode v) {
    if (v != started_[0] && v != started_[1] && v != started_[2] && v != started_[3]) insert(v);
  }

  // -- 3: one node

  /// True if node v at p sees face t. to_corner: from v to any corner of t.
  bool sees(const Point& p, HullNode v, HullFace t, const Spoke& to_corner) {
    const double s = above_plane(planes_[t], p);
    if (s > 1) return true;
    if (s < -1) return false;
    return sees_closely(v, t, to_corner);
  }

  /// The same if v is close to the face, so that the plane and p alone would seldom decide.
  bool sees_closely(HullNode v, HullFace t, const Spoke& to_corner) {
    const Face& f = faces_[t];
    if (f.vertex[2] == v) throw HiddenNode{};  // a face of the fan of v itself: see replace_seen_by_fan
    const int side = certain_side(t, to_corner);
    return side != 0 ? side > 0 : view_.above(f.vertex[0], f.vertex[1], f.vertex[2]);
  }

  /// The spoke leads from a node to a corner of face t. +1: the node sees t, -1: it does not, 0: not certain.
  int certain_side(HullFace t, const Spoke& to_corner) const {
    const double s = above_plane(planes_[t], to_corner), certain = certain_height(to_corner);
    return (s > certain) - (s < -certain);
  }

  void insert(HullNode v) {
    const Point& p = predicates_.position(v);
    view_.from(static_cast<index_t>(v));
    HullFace seen = walk(p);
    if (seen != kNone)
      return replace_seen_by_fan(
          v, seen, [](HullCorner) {},
          [&](HullFace t, const Spoke& to_corner) { return sees(p, v, t, to_corner); });
    seen = walk_exactly(v);
    if (seen == kNone) return;  // coincides with a node inserted before
    replace_seen_by_fan(
        v, seen, [&](HullCorner code) { fetch(face_of(code)); },
        [&](HullFace t, const Spoke& to_corner) { return sees_closely(v, t, to_corner); });
  }

  /// Makes the next search start near p: at the nearest of 64 nodes, then at nearer ones between that and its
  /// neighbours among the 64, since most nodes are numbered along the curve. The last search may have ended
  /// far away, and the faces in between are in no cache (Muecke, Saias & Zhu 1999, jump and walk).
  void start_near(const Point& p) {
    if (!coincident_.empty()) return;  // nodes that were left out have no corner_
    const auto square_from = [&](HullNode v) {
      const Point d = minus(predicates_.position(v), p);
      return dot(d, d);
    };
    constexpr std::size_t kLookedAt = 64;
    const std::size_t step = n_ / kLookedAt + 1;
    const auto& last = faces_[last_].vertex;
    double least = std::min({square_from(last[0]), square_from(last[1]), square_from(last[2])});
    std::size_t nearest = n_;
    const auto look_at = [&](std::size_t v) {
      const double square = square_from(static_cast<HullNode>(v));
      if (!(square < least)) return;
      const HullFace t = face_of(corner_[v]);
      if (planes_[t].w > 1) least = square, nearest = v, last_ = t;
    };
    for (std::size_t v = 0; v < n_; v += step) look_at(v);
    for (std::size_t half = step / 2; half > 0 && nearest < n_; half /= 2) {
      const std::size_t v = nearest;
      if (v >= half) look_at(v - half);
      if (v + half < n_) look_at(v + half);
    }
  }

  /// Walks from the last face towards p by floating-point tests until p certainly sees a face; kNone if the
  /// tests do not suffice. It crosses front faces only, since the tests are meaningless elsewhere. `last_`
  /// becomes the last face crossed.
  ///
  ///         c           The walk came in across the edge w-u. It leaves across u-c if p is right of u->c,
  ///        / \          or across c-w if p is right of c->w. With X = (c-p) x p these are the signs of
  ///       /   \    p    (u-p).X and -(w-p).X.
  ///      u --- w
  HullFace walk(const Point& p) {
    constexpr int kSteps = 1000;
    HullFace passed = kNone;  // a face met before: rounding can send the walk in circles
    HullFace t = last_;
    if (above_plane(planes_[t], p) > 1) return t;
    const Face& first = faces_[t];
    Point corner[3];  // relative to p
    for (int k = 0; k < 3; ++k) corner[k] = minus(predicates_.position(first.vertex[k]), p);
    // Leave the first face across any edge that has p on its right.
    std::uint32_t out = 0;
    while (out < 3 && !(dot(corner[next_edge(out)], cross(corner[previous_edge(out)], p)) < 0)) ++out;
    if (out == 3) return kNone;
    Point* u = &corner[next_edge(out)];
    Point* w = &corner[previous_edge(out)];
    Point* c = &corner[out];
    HullCorner code = first.neighbour[out];
    for (int step = 0; step < kSteps; ++step) {
      t = face_of(code);
      const Plane& plane = planes_[t];
      if (above_plane(plane, p) > 1) return t;
      if (!(plane.w > 1) || t == passed) return kNone;
      if ((step & (step - 1)) == 0) passed = t;
      last_ = t;
      const Face& f = faces_[t];
      const std::uint32_t in = edge_of(code);
      *c = minus(predicates_.position(f.vertex[in]), p);
      const Point x = cross(*c, p);
      if (dot(*u, x) < 0) {
        code = f.neighbour[next_edge(in)];
        std::swap(w, c);
      } else if (dot(*w, x) > 0) {
        code = f.neighbour[previous_edge(in)];
        std::swap(u, c);
      } else {
        return kNone;
      }
    }
    return kNone;
  }

  /// The same walk by exact signs. It ends: seen from the centre, the front faces are a regular
  /// triangulation of the directions, and in those a walk towards a point never returns to a triangle
  /// (Edelsbrunner 1990, acyclicity).
  ///   - A face that p sees: done. A tie of directions does not count: p may merely outrank a node that it
  ///     coincides with, which is a corner of the face below p.
  ///   - The silhouette: p is strictly right of an edge u->v between a front face F and a face B that is
  ///     not one. The plane through the centre, u and v is above F on its far side and above B on its
  ///     near side, so what neither F nor B has below it lies left of that plane: p sees F or B.
  ///   - A front face below which p lies, its direction inside: p is one of its corners, or hidden. (Another
  ///     direction inside lies strictly above.)
  HullFace walk_exactly(HullNode v) {
    HullFace t = last_;
    for (;;) {
      const Face& f = faces_[t];
      for (int i = 0; i < 3; ++i) fetch(face_of(f.neighbour[i]));
      const int side = certain_side(t, make_spoke(predicates_, f.vertex[0], v));
      if (side > 0) return t;
      for (const HullNode corner : {f.vertex[0], f.vertex[1], f.vertex[2]})
        // Compare positions first: they are in the cache.
        if (predicates_.position(corner) == predicates_.position(v) &&
            predicates_.given(corner) == predicates_.given(v))
          return coincides(v, corner);
      const bool seen = side == 0 && view_.above(f.vertex[0], f.vertex[1], f.vertex[2]);
      if (seen && !by_tie_of_directions()) return t;
      std::uint32_t out = 0;
      while (out < 3 && view_.left(f.vertex[next_edge(out)], f.vertex[previous_edge(out)]) >= 0) ++out;
      if (out == 3) {
        for (const HullNode corner : {f.vertex[0], f.vertex[1], f.vertex[2]})
          if (predicates_.coincide(corner, v)) return coincides(v, corner);
        throw HiddenNode{};
      }
      const HullFace next = face_of(f.neighbour[out]);
      if (!front(next)) return seen ? t : next;
      last_ = t = next;
    }
  }

  /// Needed where nodes lie along lines: faces that share an edge are then far apart in memory.
  [[gnu::always_inline]] void fetch(HullFace t) const {
    __builtin_prefetch(planes_ + t);
    __builtin_prefetch(faces_ + t);
  }

  /// True if v, which `view_` has just found above a face, lies in its plane. Always false for Coordinates:
  /// there nodes that coincide have the same rank and see the same faces.
  bool by_tie_of_directions() const {
    if constexpr (std::is_same_v<Predicates, Directions>) return view_.tied();
    return false;
  }

  HullFace coincides(HullNode v, HullNode corner) {
    coincident_.emplace_back(corner, v);
    return kNone;
  }

  /// Replaces all faces that node v at p sees, `seen` among them, by a fan of faces around v.
  ///
  /// Depth first over the faces seen. The region they make is a disc, and its dual graph is a tree unless a
  /// node lies inside it; so the search meets the border of the disc counterclockwise, and each edge u-w of
  /// the border becomes a face (u,w,v) at once:
  ///
  ///              outside
  ///        u ------------- w          neighbour[2]: outside, across u-w
  ///          \    t      / \  next     neighbour[0]: the next face, across w-v
  ///  previous  \      /              neighbour[1]: the previous face, across v-u
  ///              \  /
  ///               v
  ///
  /// A tree of m faces has m + 2 edges around it: new faces take two new places, then those of the faces
  /// already visited. A node inside the disc would vanish from the triangulation. The search then circles
  /// around it until it meets a face of the fan, whose plane contains v, or exceeds the number of faces.
  ///
  /// expect(code): called before the search comes to this face, to prefetch it.
  template <class Expect, class Sees>
  [[gnu::always_inline]] void replace_seen_by_fan(HullNode v, HullFace seen, const Expect& expect,
                                                  const Sees& sees) {
    const Point p = predicates_.position(v);
    std::size_t visited = 2, used = 0, top = 3, limit = visit_limit();
    place_[0] = static_cast<std::uint32_t>(count_);
    place_[1] = static_cast<std::uint32_t>(count_ + 1);
    place_[visited++] = seen;
    for (int k = 0; k < 3; ++k) expect(stack_[k] = faces_[seen].neighbour[2 - k]);
    const HullFace first = place_[0];
    HullFace previous = first;
    HullNode u = faces_[seen].vertex[1];  // where edge 0 of `seen` starts
    Spoke to_u = make_spoke(predicates_, u, v);
    while (top > 0) {
      const HullCorner code = stack_[--top], after = next_code(code);
      if (sees(face_of(code), to_u)) {
        expect(stack_[top++] = neighbour(previous_code(code)));
        expect(stack_[top++] = neighbour(after));
        place_[visited++] = face_of(code);
        if (visited >= limit) {
          if (visited >= count_ + 2) throw HiddenNode{};
          grow(place_), grow(stack_);
          limit = visit_limit();
        }
      } else {
        const HullFace t = place_[used++];
        const HullNode w = vertex(after);
        neighbour(code) = 4 * t + 2;
        neighbour(4 * previous) = 4 * t + 1;
        std::uint32_t* const face = words_ + 8 * std::size_t{t};
        face[0] = u, face[1] = w, face[2] = v;
        face[5] = 4 * previous, face[6] = code;
        corner_[u] = 4 * t;
        const Spoke to_w = make_spoke(predicates_, w, v);
        planes_[t] = make_plane(p, to_u, to_w);
        previous = t;
        u = w;
        to_u = to_w;
      }
    }
    neighbour(4 * previous) = 4 * first + 1;
    neighbour(4 * first + 1) = 4 * previous;
    count_ += 2;
    corner_[v] = 4 * previous + 2;
    const auto end = place_.begin() + used;
    const auto shown = std::find_if(place_.begin(), end, [&](HullFace t) {
      const double w = planes_[t].w;
      return w > 1 || (w >= -1 && view_.left(faces_[t].vertex[0], faces_[t].vertex[1]) > 0);
    });
    // finish() finds such nodes too; no test's set has one hidden when it is added
    if (shown == end) throw HiddenNode{};
    last_ = *shown;
  }

  /// Upper bound of the visits: the room in the arrays, and the number of faces plus 2.
  std::size_t visit_limit() const { return std::min(count_ + 2, place_.size() - 4); }

  // A code addresses the word of its edge, and of the vertex opposite, in the array of faces.
  static std::size_t word(HullCorner code) { return std::size_t{code} + (code & ~std::uint32_t{3}); }
  HullNode& vertex(HullCorner code) { return words_[word(code)]; }
  HullCorner& neighbour(HullCorner code) { return words_[word(code) + 4]; }

  static void grow(Buffer<std::uint32_t>& buffer) {
    Buffer<std::uint32_t> larger(2 * buffer.size());
    std::copy(buffer.begin(), buffer.end(), larger.begin());
    buffer.swap(larger);
  }

  static constexpr HullFace kNone = ~std::uint32_t{0};

  Predicates predicates_;
  typename Predicates::View view_{predicates_};
  std::size_t n_;
  Point* nodes_;
  Face* faces_;
  std::uint32_t* words_;  ///< faces_ as words
  Plane* planes_;
  HullCorner* corner_;  ///< for each node inserted, 4*t + i of a face t with vertex[i] there
  std::size_t count_ = 0;
  HullFace last_ = 0;  ///< a front face near the last node: where the next search starts
  HullNode started_[4];
  bool surrounds_centre_ = false;
  static constexpr std::size_t kRoom = 128;
  Buffer<HullCorner> stack_{kRoom};
  Buffer<HullFace> place_{kRoom};
  std::vector<std::pair<HullNode, HullNode>> coincident_;
};

}  // namespace

std::unique_ptr<GrowingHull> GrowingHull::make(const HullArrays& arrays, std::size_t n, Lengths lengths) {
  if (lengths == Lengths::as_given) return std::make_unique<Builder<Coordinates>>(arrays, n);
  return std::make_unique<Builder<Directions>>(arrays, n);
}

Hull delaunay(const Point* p, std::size_t n, Workspace& workspace, Lengths lengths) {
  auto* const order = workspace.for_call<std::uint32_t>(n);
  const std::size_t alone = insertion_order(p, n, order, workspace);
  HullArrays arrays;
  arrays.capacity = n;
  arrays.nodes = workspace.for_call<Point>(n);
  std::atomic<bool> unit{lengths != Lengths::directions};
  parallel_pieces(n, threads_for(n), [&](std::size_t first, std::size_t last, int) {
    constexpr std::size_t kAhead = 16;
    bool all = true;
    for (std::size_t v = first; v < last; ++v) {
      if (v + kAhead < last) __builtin_prefetch(p + order[v + kAhead]);
      arrays.nodes[v] = p[order[v]];
      all = all & length_is_one(arrays.nodes[v]);
    }
    if (!all) unit = false;
  });
  workspace.next_phase();
  arrays.faces = workspace.for_call<Face>(2 * n);
  arrays.corner = workspace.for_call<HullCorner>(n);
  arrays.planes = workspace.for_phase<Plane>(2 * n);
  return with_lengths(unit, [&](Lengths which) {
    const auto growing = GrowingHull::make(arrays, n, which);
    growing->look_for_hidden_nodes(alone);
    growing->build(alone);
    Hull hull = growing->finish();
    hull.order = order;
    for (const auto& [in, out] : growing->coincident())
      hull.coincident.emplace_back(static_cast<index_t>(order[in]), static_cast<index_t>(order[out]));
    return hull;
  });
}

}  // namespace pstripack
