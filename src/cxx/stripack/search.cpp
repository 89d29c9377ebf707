#include "stripack/search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/predicates.h"
#include "stripack/list_queries.h"
#include "stripack/original_rules.h"
#include "stripack/random.h"
#include "stripack/trfind_walk.h"

namespace pstripack {
namespace {

/// The caller's lists and nodes, as TrfindWalk reads them.
template <class Real, class Int>
class PlainLists : public ListReader<Int> {
 public:
  PlainLists(const ListsView<Int>& lists, const Nodes<Real>& nodes) : ListReader<Int>(lists), node_(nodes) {}

  Vector<Real> operator[](Int node) const { return node_[node]; }
  Int slot_of_third(Int /*a*/, Int /*b_of_a*/, Int b, Int c) const { return this->slot_of(b, c); }

 private:
  Nodes<Real> node_;
};

/// Arrays of lists that may be none: throws BrokenLists also where there are more steps round a node, or more
/// nodes on the way, than any search in good lists takes.
template <class Int>
class CountedArrays : public CheckedArrays<Int> {
 public:
  CountedArrays(const EditedLists<Int>& lists, Int nodes)
      : CheckedArrays<Int>(lists, *lists.lnew, nodes), most_steps_(4 * std::int64_t{nodes} + 10) {
    if (original_rules().follow) most_nodes_ = 4 * SearchLimits::to_follow(nodes).steps;
  }

  Int& lptr(Int slot) const {
    if (++steps_ > most_steps_) throw BrokenLists();
    return CheckedArrays<Int>::lptr(slot);
  }
  Int& lend(Int node) const {
    steps_ = 0;
    if (--most_nodes_ < 0) throw BrokenLists();
    return CheckedArrays<Int>::lend(node);
  }

 private:
  const std::int64_t most_steps_;
  mutable std::int64_t steps_ = 0, most_nodes_ = 64 * std::int64_t{this->nodes()} + 1000;
};

/// Lists that are being edited, and nodes.
template <class Real, class Int>
class GuardedLists : public ListEditor<CountedArrays<Int>> {
 public:
  GuardedLists(const EditedLists<Int>& lists, Int count, const Nodes<Real>& nodes)
      : ListEditor<CountedArrays<Int>>({lists, count}), count_(count), node_(nodes) {}

  Int size() const { return count_; }
  Vector<Real> operator[](Int node) const { return node_[node]; }
  Int slot_of_third(Int /*a*/, Int /*b_of_a*/, Int b, Int c) const { return this->slot_of(b, c); }

 private:
  Int count_;
  Nodes<Real> node_;
};

/// TRFIND: by rounded tests as the original, and where these do not soon end by exact signs.
template <class Real, class Int, class Lists>
class Search {
 public:
  Search(const Vector<Real>& p, const Lists& lists, const Weights<Real>& weights)
      : p_(p), lists_(lists), n_(lists_.size()), weights_(weights) {}

  Location<Int> find(Int start) {
    if (n_ < 3 || !is_finite(p_)) return nowhere;
    const OriginalRules& rules = original_rules();
    Seeds<std::int32_t> fresh_seeds;
    Seeds<std::int32_t>& seeds = rules.follow ? kept_seeds() : fresh_seeds;
    const auto draw = [&](Int n) {  // JRAND's n+1, with which the original reads past LEND, becomes n
      return std::min(n, rules.random<Real>(n, seeds));
    };
    const SearchLimits limits =
        rules.follow ? SearchLimits::to_follow(n_) : SearchLimits{4 * std::int64_t{n_} + 100, 30};
    Int o = start >= 1 && start <= n_ ? start : draw(n_);
    Location<Int> found = nowhere;
    TrfindWalk<Real, Int, Lists, decltype(draw)> walk(p_, lists_, rules.tolerance<Real>(), limits, weights_,
                                                      draw);
    return walk.find(o, found) ? found : walk_exactly(o);
  }

 private:
  static constexpr Location<Int> nowhere{0, 0, 0};

  Real side(Int a, Int b) const { return pstripack::side(lists_[a], lists_[b], p_); }

  // ---- the exact search, for what the rounded walk cannot decide ----

  /// The exact sign of pstripack::side(a, b, c); 0 where one of them is not finite.
  static int exact_left(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c) {
    return is_finite(a) && is_finite(b) && is_finite(c) ? left(as_point(a), as_point(b), as_point(c)) : 0;
  }
  int exact_side(Int a, Int b) const { return exact_left(lists_[a], lists_[b], p_); }

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
    const int turn = exact_left(lists_[a], lists_[b], lists_[c]);
    return turn > 0 || (turn == 0 && ab + bc + ca == 3);
  }

  /// The triangle, turned so that p is closest to the arc i1-i2, and its weights.
  Location<Int> weighed(Int a, Int b, Int c) {
    Location<Int> t{a, b, c};
    if (side(b, c) < side(t.i1, t.i2)) t = {b, c, a};
    if (side(c, a) < side(t.i1, t.i2)) t = {c, a, b};
    weights_.b3 = side(t.i1, t.i2);
    weigh(lists_[t.i1], lists_[t.i2], lists_[t.i3], p_, weights_);
    weights_.b1 = std::max(weights_.b1, Real(0));
    weights_.b2 = std::max(weights_.b2, Real(0));
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
  const Lists& lists_;
  const Int n_;
  const Weights<Real> weights_;
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
  const PlainLists<Real, Int> plain(lists, nodes);
  return Search<Real, Int, PlainLists<Real, Int>>(p, plain, {b1, b2, b3}).find(start);
}

template <class Real, class Int>
Location<Int> trfind_in_edited(Int start, const Vector<Real>& p, const EditedLists<Int>& lists, Int count,
                               const Nodes<Real>& nodes) {
  const GuardedLists<Real, Int> guarded(lists, count, nodes);
  Real b1, b2, b3;
  return Search<Real, Int, GuardedLists<Real, Int>>(p, guarded, {b1, b2, b3}).find(start);
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
  template Location<Int> trfind_in_edited(Int, const Vector<Real>&, const EditedLists<Int>&, Int,           \
                                          const Nodes<Real>&);                                              \
  template Int nearnd(const Vector<Real>&, Int, const ListsView<Int>&, const Nodes<Real>&, Real&);          \
  template NextNearestStatus next_nearest(const ListsView<Int>&, const Nodes<Real>&, Int, Int*, Real&);
PSTRIPACK_SEARCH(float, std::int32_t)
PSTRIPACK_SEARCH(double, std::int32_t)
PSTRIPACK_SEARCH(double, std::int64_t)

}  // namespace pstripack
