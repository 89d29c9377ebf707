#include "stripack/search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/predicates.h"
#include "stripack/list_queries.h"
#include "stripack/original_rules.h"
#include "stripack/random.h"

namespace pstripack {
namespace {

/// The search of TRFIND. Names: o is the node from which we look, r and l the right and left end of the
/// arc through which we look, side(a,b) > 0 where p lies left of a->b.
template <class Real, class Int>
class Search {
 public:
  Search(const Vector<Real>& p, const ListsView<Int>& lists, const Nodes<Real>& nodes, Real& b1, Real& b2,
         Real& b3)
      : p_(p),
        lists_(lists),
        node_(nodes),
        n_(lists_.size()),
        steps_(4 * std::int64_t{n_} + (rules_.follow ? 1'000'000 : 100)),
        b1_(b1),
        b2_(b2),
        b3_(b3) {}

  Location<Int> find(Int start) {
    if (n_ < 3 || !is_finite(p_)) return nowhere;
    Int o = start >= 1 && start <= n_ ? start : draw();
    Location<Int> found = nowhere;
    for (int restarts = 0; affordable();) {
      Int r, l;
      switch (look_out(o, r, l)) {
        case View::wedge:
          switch (walk(o, r, l, found)) {
            case Walk::arrived:
              return found;
            case Walk::left_the_hull:
              return see_boundary(r, l, found) ? found : walk_exactly(o);
            case Walk::astray:
              if (!rules_.follow && ++restarts > most_restarts) return walk_exactly(o);
              o = draw();
          }
          break;
        case View::outside:
          return see_boundary(r, l, found) ? found : walk_exactly(o);
        case View::move_on:
          break;
        case View::collinear:
          return nowhere;
      }
    }
    return walk_exactly(o);
  }

 private:
  enum class View { wedge, outside, move_on, collinear };
  enum class Walk { arrived, left_the_hull, astray };

  static constexpr Location<Int> nowhere{0, 0, 0};
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  static constexpr int most_restarts = 30;

  Real side(Int a, Int b) const { return pstripack::side(node_[a], node_[b], p_); }
  Real dot(Int a, Int b) const { return pstripack::dot(node_[a], node_[b]); }
  Real dot_p(Int a) const { return pstripack::dot(p_, node_[a]); }

  /// A random node. JRAND's n+1, with which the original reads past LEND, becomes n.
  Int draw() {
    Seeds<Int>& seeds = rules_.follow ? kept_seeds<Int>() : fresh_seeds_;
    return std::min(n_, rules_.single_precision_random ? jrand<float>(n_, seeds) : jrand<Real>(n_, seeds));
  }

  /// No search that makes progress takes more steps than there are arcs. Under original rules a million
  /// more (10 to 20 ms) are spent on new starts: the original makes as many as it needs.
  bool affordable() { return --steps_ >= 0; }

  /// Finds adjacent neighbours r, l of o between which p lies, or a boundary arc r->l with p to its right.
  View look_out(Int& o, Int& r, Int& l) const {
    const Int last_slot = lists_.last_slot(o);
    const Int last = lists_.neighbour(last_slot);
    Int slot = lists_.next(last_slot);
    const Int first = lists_.neighbour(slot);
    r = first;
    if (lists_.on_boundary(o)) {
      if (side(o, first) < 0) {
        r = o;
        l = first;
        return View::outside;
      }
      if (side(last, o) < 0) {
        r = last;
        l = o;
        return View::outside;
      }
    } else {
      while (side(o, r) < 0) {
        slot = lists_.next(slot);
        r = lists_.neighbour(slot);
        if (r == last) {
          l = first;
          return View::wedge;
        }
      }
    }
    do {
      slot = lists_.next(slot);
      l = lists_.neighbour(slot);
      if (side(o, l) < 0) return View::wedge;
      r = l;
    } while (r != last);
    l = first;
    if (side(o, first) < 0) return View::wedge;

    // p is not strictly right of any arc from o: it lies in line with one, or is o or its antipode.
    if (std::abs(dot_p(o)) < 1 - 4 * epsilon) {
      for (slot = last_slot; !(side(r, o) < 0); r = lists_.neighbour(slot)) {
        slot = lists_.next(slot);
        if (slot == last_slot) return View::collinear;
      }
    }
    o = r;
    return View::move_on;
  }

  /// Crosses triangle by triangle away from o, through arcs r-l, until p lies before the arc.
  Walk walk(Int o, Int& r, Int& l, Location<Int>& found) {
    Int behind = o, first_r = r, first_l = l;
    for (;;) {
      b3_ = side(r, l);
      if (!(b3_ < 0)) break;
      const Int slot = lists_.slot_of(l, r);
      if (lists_.entry(slot) < 0) return Walk::left_the_hull;
      const Int beyond = lists_.neighbour(lists_.next(slot));
      if (side(o, beyond) < 0) {
        behind = l;
        l = beyond;
        first_r = r;
        if (l == first_l || l == o) return Walk::astray;
      } else {
        behind = r;
        r = beyond;
        first_l = l;
        if (r == first_r || r == o) return Walk::astray;
      }
      if (!affordable()) return Walk::astray;
    }
    weigh(r, l, behind);
    const Real tolerance = static_cast<Real>(rules_.tolerance_in_epsilons) * epsilon;
    if (b1_ < -tolerance || b2_ < -tolerance) return Walk::astray;
    b1_ = std::max(b1_, Real(0));
    b2_ = std::max(b2_, Real(0));
    found = {r, l, behind};
    return Walk::arrived;
  }

  /// b1, b2, b3 for triangle (i1,i2,i3) from b3 = side(i1,i2) >= 0.
  void weigh(Int i1, Int i2, Int i3) {
    if (b3_ >= epsilon) {
      b1_ = side(i2, i3);
      b2_ = side(i3, i1);
    } else {
      const Real cosine = dot(i1, i2), to_1 = dot_p(i1), to_2 = dot_p(i2);
      b1_ = to_1 - cosine * to_2;
      b2_ = to_2 - cosine * to_1;
      b3_ = 0;
    }
  }

  /// True if a boundary node is an end of what p sees, where the arc between `end` and the node `further`
  /// away is not strictly seen. With c the part of `start` that is perpendicular to `end`, p or `further`
  /// lies on the side of `start`; otherwise all is nearly collinear and we must look on.
  bool ends_view(Int start, Int end, Int further) const {
    const Vector<Real> s = node_[start], e = node_[end];
    const Real cosine = pstripack::dot(s, e);
    const Vector<Real> c{s.x - cosine * e.x, s.y - cosine * e.y, s.z - cosine * e.z};
    return pstripack::dot(p_, c) >= 0 || pstripack::dot(node_[further], c) >= 0;
  }

  /// The ends of the part of the boundary that p sees, given an arc r->l of it. False if there is none.
  bool see_boundary(const Int first_r, const Int first_l, Location<Int>& found) {
    Int rightmost, far_end = 0;
    for (Int r = first_r, l = first_l;;) {  // counterclockwise
      if (!affordable()) return false;
      const Int next = lists_.first_neighbour(l);
      if (side(l, next) >= 0) {
        if (ends_view(r, l, next)) {
          rightmost = l;
          break;
        }
        far_end = l;
      }
      r = l;
      l = next;
      if (l == first_r) {
        found = {l, l, 0};
        return true;
      }
    }
    if (far_end != 0) {
      found = {rightmost, far_end, 0};
      return true;
    }
    for (Int r = first_r, l = first_l;;) {  // clockwise
      if (!affordable()) return false;
      const Int next = lists_.last_neighbour(r);
      if (side(next, r) >= 0) {
        if (ends_view(l, r, next)) {
          found = {rightmost, r, 0};
          return true;
        }
        rightmost = r;
      }
      l = r;
      r = next;
      if (r == first_r) {
        found = {r, r, 0};
        return true;
      }
    }
  }

  // ---- the exact search, for what the rounded walk cannot decide ----

  /// The exact sign of pstripack::side(a, b, c); 0 where one of them is not finite.
  static int exact_left(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c) {
    const auto point = [](const Vector<Real>& v) {
      return Point{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
    };
    return is_finite(a) && is_finite(b) && is_finite(c) ? left(point(a), point(b), point(c)) : 0;
  }
  int exact_side(Int a, Int b) const { return exact_left(node_[a], node_[b], p_); }

  /// The visibility walk: out of triangle (u,v,w) through an arc that has p strictly to its right.
  ///
  ///        w         p lies left of u->v, or on it. The walk ends: in a Delaunay triangulation because
  ///       / \        the planes of the triangles passed cut the ray to p ever further out, in others
  ///      u---v       because steps are counted.
  ///
  Location<Int> walk_exactly(Int u) {
    Int v = lists_.first_neighbour(u);
    if (exact_side(u, v) < 0) std::swap(u, v);
    for (std::int64_t steps = 4 * std::int64_t{n_}; steps > 0; --steps) {
      const Int slot = lists_.slot_of(u, v);
      if (lists_.entry(slot) < 0) return see_boundary_exactly(v, u);
      const Int w = lists_.neighbour(lists_.next(slot));
      if (exact_side(v, w) < 0) {
        u = w;
      } else if (exact_side(w, u) < 0) {
        v = w;
      } else {
        if (contains(u, v, w)) return weighed(u, v, w);
        break;  // a null triangle, with p elsewhere on its circle
      }
    }
    return search_all();
  }

  Location<Int> search_all() {
    for (Int a = 1; a <= n_; ++a) {
      const Int last = lists_.last_slot(a);
      Int slot = last;
      do {
        const Int b = lists_.entry(slot);
        slot = lists_.next(slot);
        const Int c = lists_.neighbour(slot);
        if (b > a && c > a && contains(a, b, c)) return weighed(a, b, c);
      } while (slot != last);
    }
    for (Int r = 1; r <= n_; ++r)
      if (lists_.on_boundary(r) && exact_side(r, lists_.first_neighbour(r)) < 0)
        return see_boundary_exactly(r, lists_.first_neighbour(r));
    return nowhere;
  }

  /// True of a counterclockwise triangle that p lies in, and of a half-sphere: three nodes all the way round
  /// a great circle.
  bool contains(Int a, Int b, Int c) const {
    const int ab = exact_side(a, b), bc = exact_side(b, c), ca = exact_side(c, a);
    if (ab < 0 || bc < 0 || ca < 0 || ab + bc + ca == 0) return false;
    const int turn = exact_left(node_[a], node_[b], node_[c]);
    return turn > 0 || (turn == 0 && ab + bc + ca == 3);
  }

  /// The triangle, turned so that p is closest to the arc i1-i2, and its weights.
  Location<Int> weighed(Int a, Int b, Int c) {
    Location<Int> t{a, b, c};
    if (side(b, c) < side(t.i1, t.i2)) t = {b, c, a};
    if (side(c, a) < side(t.i1, t.i2)) t = {c, a, b};
    b3_ = side(t.i1, t.i2);
    weigh(t.i1, t.i2, t.i3);
    b1_ = std::max(b1_, Real(0));
    b2_ = std::max(b2_, Real(0));
    return t;
  }

  /// The run of boundary arcs with p strictly to their right, one of which is r->l.
  Location<Int> see_boundary_exactly(const Int r, const Int l) const {
    Int rightmost = l, leftmost = r;
    for (Int next; exact_side(rightmost, next = lists_.first_neighbour(rightmost)) < 0; rightmost = next)
      if (next == r) return {r, r, 0};
    for (Int next; exact_side(next = lists_.last_neighbour(leftmost), leftmost) < 0;) leftmost = next;
    return {rightmost, leftmost, 0};
  }

  const Vector<Real> p_;
  const ListReader<Int> lists_;
  const Nodes<Real> node_;
  const Int n_;
  const OriginalRules& rules_ = original_rules();
  std::int64_t steps_;
  Seeds<Int> fresh_seeds_;
  Real &b1_, &b2_, &b3_;
};

/// The nodes whose caps would lose ground if p were inserted, as a ring round p, in the order in which
/// they are met. Entry 0 closes the ring of a point outside.
template <class Int>
class Candidates {
 public:
  static constexpr int most = 25;

  explicit Candidates(Int first) : count_(1) { node_[0] = first; }

  int count() const { return count_; }
  bool full() const { return count_ == most; }
  Int operator[](int i) const { return node_[i]; }
  int after(int i) const { return next_[i]; }
  /// Adds a node after position i and returns its position.
  int insert(Int node, int i) {
    const int position = count_++;
    node_[position] = node;
    next_[position] = next_[i];
    next_[i] = position;
    return position;
  }

 private:
  Int node_[most] = {};
  int next_[most] = {};
  int count_;
};

/// A set of nodes; up to 64 of them take no memory from the heap.
template <class Int>
class NodeSet {
 public:
  explicit NodeSet(std::size_t most) {
    while (most > (std::size_t{1} << bits_) / 2) ++bits_;
    if (bits_ > few_bits) many_.assign(std::size_t{1} << bits_, 0);
    cell_ = bits_ > few_bits ? many_.data() : few_;
  }
  NodeSet(const NodeSet&) = delete;
  NodeSet& operator=(const NodeSet&) = delete;

  /// False if it is there already.
  bool insert(Int node) {
    Int& cell = find(node);
    return std::exchange(cell, node) == 0;
  }
  bool contains(Int node) const { return find(node) != 0; }

 private:
  static constexpr int few_bits = 7;

  /// The node's cell, or the empty one where it would go.
  Int& find(Int node) const {
    const std::size_t mask = (std::size_t{1} << bits_) - 1;
    std::size_t i =
        static_cast<std::size_t>(static_cast<std::uint64_t>(node) * 0x9E3779B97F4A7C15 >> (64 - bits_));
    while (cell_[i] != 0 && cell_[i] != node) i = (i + 1) & mask;
    return cell_[i];
  }

  int bits_ = few_bits;
  Int few_[std::size_t{1} << few_bits] = {};
  std::vector<Int> many_;
  Int* cell_;
};

}  // namespace

template <class Real, class Int>
Location<Int> trfind(Int start, const Vector<Real>& p, const ListsView<Int>& lists, const Nodes<Real>& nodes,
                     Real& b1, Real& b2, Real& b3) {
  return Search<Real, Int>(p, lists, nodes, b1, b2, b3).find(start);
}

template <class Real, class Int>
Int nearnd(const Vector<Real>& p, Int start, const ListsView<Int>& lists, const Nodes<Real>& nodes,
           Real& angle) {
  if (std::is_same_v<Real, double> && original_rules().clear_angle) angle = 0;
  const ListReader<Int> reader(lists);
  const Int n = reader.size();
  if (n < 3) return 0;
  Real b1, b2, b3;
  const Location<Int> found = trfind(start >= 1 && start <= n ? start : Int(1), p, lists, nodes, b1, b2, b3);
  if (found.i1 == 0) return 0;

  Candidates<Int> ring(found.i1);
  if (found.i3 != 0) {
    ring.insert(found.i3, ring.insert(found.i2, 0));
  } else {
    int end = 0;
    for (Int node = found.i1; ring.count() < Candidates<Int>::most - 1;) {
      node = reader.last_neighbour(node);
      end = ring.insert(node, end);
      if (node == found.i2) break;
    }
    ring.insert(0, end);
  }

  // Between neighbours u and v on the ring goes the node beyond their arc, if p lies in its cap.
  for (int u = 0, v = ring.after(0);;) {
    const Int slot = reader.slot_of(ring[v], ring[u]);
    if (reader.entry(slot) >= 0) {
      const Int beyond = reader.neighbour(reader.next(slot));
      if (ring.full()) break;
      if (height(nodes[ring[v]], nodes[ring[u]], nodes[beyond], p) > 0) {
        v = ring.insert(beyond, u);
        continue;
      }
    }
    if (v == 0) break;
    u = v;
    v = ring.after(u);
    if (ring[v] == 0) break;
  }

  Int nearest = ring[0];
  Real cosine = dot(nodes[nearest], p);
  for (int i = 1; i < ring.count(); ++i) {
    if (ring[i] == 0) continue;
    const Real other = dot(nodes[ring[i]], p);
    if (-other < -cosine) {
      nearest = ring[i];
      cosine = other;
    }
  }
  angle = std::acos(std::min(cosine, Real(1)));
  return nearest;
}

template <class Real, class Int>
NextNearestStatus next_nearest(const ListsView<Int>& lists, const Nodes<Real>& nodes, Int l, Int* npts,
                               Real& distance) {
  if (l < 2) return NextNearestStatus::too_short;
  const Int given = l - 1;
  NodeSet<Int> taken(static_cast<std::size_t>(given));
  for (Int i = 0; i < given; ++i)
    if (npts[i] < 1 || !taken.insert(npts[i])) return NextNearestStatus::bad_nodes;

  const ListReader<Int> reader(lists);
  const Vector<Real> centre = nodes[npts[0]];
  Int nearest = 0;
  Real least = 2;
  for (Int i = 0; i < given; ++i) {
    const Int last = reader.last_slot(npts[i]);
    Int slot = last;
    do {
      const Int candidate = reader.neighbour(slot);
      if (!taken.contains(candidate)) {
        const Real d = -dot(nodes[candidate], centre);
        if (!std::isfinite(d)) return NextNearestStatus::not_finite;
        if (d < least) {
          least = d;
          nearest = candidate;
        }
      }
      slot = reader.next(slot);
    } while (slot != last);
  }
  if (nearest == 0) return NextNearestStatus::none_left;
  npts[given] = nearest;
  distance = least;
  return NextNearestStatus::done;
}

#define PSTRIPACK_SEARCH(Real, Int)                                                                         \
  template Location<Int> trfind(Int, const Vector<Real>&, const ListsView<Int>&, const Nodes<Real>&, Real&, \
                                Real&, Real&);                                                              \
  template Int nearnd(const Vector<Real>&, Int, const ListsView<Int>&, const Nodes<Real>&, Real&);          \
  template NextNearestStatus next_nearest(const ListsView<Int>&, const Nodes<Real>&, Int, Int*, Real&);
PSTRIPACK_SEARCH(float, std::int32_t)
PSTRIPACK_SEARCH(double, std::int32_t)
PSTRIPACK_SEARCH(double, std::int64_t)

}  // namespace pstripack
