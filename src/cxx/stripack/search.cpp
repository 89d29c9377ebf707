#include "stripack/search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/floating_point.h"
#include "geometry/double_double.h"
#include "geometry/predicates.h"
#include "stripack/list_queries.h"
#include "stripack/original/original_rules.h"
#include "stripack/random.h"
#include "stripack/trfind_walk.h"

namespace pstripack {
namespace {

/// The caller's lists and nodes, as TrfindWalk reads them.
template <class Real, class Int>
class PlainLists : public ListReader<Int> {
 public:
  PlainLists(const ListsView<Int>& lists, const Nodes<Real>& nodes)
      : ListReader<Int>(lists), node_{nodes.x, nodes.y, nodes.z} {}

  Vector<Real> operator[](Int node) const { return node_[node]; }
  Int slot_of_third(Int /*a*/, Int /*b_of_a*/, Int b, Int c) const { return this->slot_of(b, c); }
  /// True if the list of a node is in the slots first..last, in order, and these are few: as in canonical
  /// lists.
  bool is_in_few_slots(Int node, Int& first, Int& last) const {
    constexpr Int most = 8;
    first = this->foreseen_first_slot(node);
    last = this->last_slot(node);
    if (first < 1 || last <= first || last - first >= most) return false;
    Int elsewhere = this->next(last) ^ first;
    for (Int slot = first; slot < last; ++slot) elsewhere |= this->next(slot) ^ (slot + 1);
    return elsewhere == 0;
  }

 private:
  Nodes<Real> node_;
};

/// Arrays that may not hold valid lists. Throws BrokenLists also if a search takes more steps around one
/// node, or visits more nodes, than any search in valid lists.
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

/// Lists that are being edited, and nodes, as TrfindWalk reads them.
template <class Real, class Int>
class GuardedLists : public ListEditor<CountedArrays<Int>> {
 public:
  GuardedLists(const EditedLists<Int>& lists, Int count, const Nodes<Real>& nodes)
      : ListEditor<CountedArrays<Int>>({lists, count}), count_(count), node_(nodes) {}

  Int size() const { return count_; }
  Vector<Real> operator[](Int node) const {
    if (node < 1 || node > count_) throw BrokenLists();
    return node_[node];
  }
  Int slot_of_third(Int /*a*/, Int /*b_of_a*/, Int b, Int c) const { return this->slot_of(b, c); }
  void prefetch_list(Int /*node*/) const {}  // numbers are checked when they are used
  bool is_in_few_slots(Int /*node*/, Int& /*first*/, Int& /*last*/) const { return false; }

 private:
  Int count_;
  Nodes<Real> node_;
};

/// The weights of a, b, c at p by differences: det(p, b, c) = det(p, b - p, c - p), in double-double, where
/// differences are exact. If their squares might underflow they are multiplied by a power of two: a common
/// factor of the weights.
template <class Real>
[[gnu::noinline]] void weigh_by_differences(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, const Vector<Real>& p,
                                            const Weights<Real>& weights) {
  const Point at = as_point(p), corner[3] = {as_point(a), as_point(b), as_point(c)};
  double most = 0;
  for (const Point& v : corner)
    most = std::max({most, std::fabs(v.x - at.x), std::fabs(v.y - at.y), std::fabs(v.z - at.z)});
  int exponent = 0;
  if (most < 0x1p20 * std::sqrt(std::numeric_limits<Real>::min())) std::frexp(most, &exponent);
  const double scale = std::ldexp(1, std::min(-exponent, 1000));
  struct Side {
    DoubleDouble x, y, z;
    Side(const Point& to, const Point& from, double by)
        : x(scaled_by(two_sum(to.x, -from.x), by)),
          y(scaled_by(two_sum(to.y, -from.y), by)),
          z(scaled_by(two_sum(to.z, -from.z), by)) {}
  };
  const Side o(at, {0, 0, 0}, 1), to_a(corner[0], at, scale), to_b(corner[1], at, scale),
      to_c(corner[2], at, scale);
  const auto det = [&](const Side& e, const Side& f) {
    const DoubleDouble value =
        o.x * (e.y * f.z - e.z * f.y) + o.y * (e.z * f.x - e.x * f.z) + o.z * (e.x * f.y - e.y * f.x);
    return static_cast<Real>(std::max(value.high, 0.0));
  };
  weights.b1 = det(to_b, to_c);
  weights.b2 = det(to_c, to_a);
  weights.b3 = det(to_a, to_b);
}

/// TRFIND: by rounded tests, as the original; by exact signs where these are not certain or do not end soon.
template <class Real, class Int, class Lists>
class Search {
 public:
  /// `rounding` of the weights: a bound, set if they are not by the original's rules.
  Search(const Vector<Real>& p, const Lists& lists, const Weights<Real>& weights, Real& rounding)
      : p_(p), lists_(lists), n_(lists_.size()), weights_(weights), rounding_(rounding) {}

  Location<Int> find(Int start) {
    if (n_ < 3 || !is_finite(p_)) return nowhere;
    const OriginalRules& rules = original_rules();
    Seeds<std::int32_t> fresh_seeds;
    Seeds<std::int32_t>& seeds = rules.follow ? seeds_of_thread() : fresh_seeds;
    const auto draw = [&](Int n) {  // JRAND's n+1, with which the original reads past LEND, becomes n
      return std::min(n, rules.random<Real>(n, seeds));
    };
    const SearchLimits limits =
        rules.follow ? SearchLimits::to_follow(n_) : SearchLimits{4 * std::int64_t{n_} + 100, 30};
    Int o = start >= 1 && start <= n_ ? start : draw(n_);
    Location<Int> found = nowhere;
    TrfindWalk<Real, Int, Lists, decltype(draw)> walk(p_, lists_, rules.tolerance<Real>(), limits, weights_,
                                                      draw);
    if (!walk.find(o, found)) return walk_exactly(o);
    return rules.follow ? found : confirmed(found, o);
  }

 private:
  static constexpr Location<Int> nowhere{0, 0, 0};

  Real side(Int a, Int b) const { return pstripack::side(lists_[a], lists_[b], p_); }

  // ---- the exact search, where the rounded walk fails or is not certain ----

  /// The exact sign of pstripack::side(a, b, c); 0 if one of them is not finite.
  static int exact_left(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c) {
    return is_finite(a) && is_finite(b) && is_finite(c) ? left(as_point(a), as_point(b), as_point(c)) : 0;
  }
  int exact_side(Int a, Int b) const { return exact_left(lists_[a], lists_[b], p_); }

  /// The location that rounded tests found, if it is right; else the right one. The rounded walk may end in a
  /// triangle opposite p: there its tests are as small as their rounding.
  Location<Int> confirmed(const Location<Int>& found, Int o) {
    const auto [i1, i2, i3] = found;
    if (i3 != 0) return is_certain(found) || contains(i1, i2, i3) ? found : walk_exactly(o);
    if (i1 == 0) return walk_exactly(o);
    const Int before = lists_.last_neighbour(i1);
    if (exact_side(before, i1) >= 0) return walk_exactly(o);
    const Location<Int> seen = see_boundary_exactly(before, i1);
    return seen.i1 == seen.i2 ? Location<Int>{i1, i1, 0} : seen;
  }

  /// A bound of the rounding of the weights: each is a sum of six products, none larger than `size`, with
  /// five roundings on the way. If p counts as on the arc i1-i2 it is twice that.
  [[gnu::always_inline]] Real rounding_of_weights(const Location<Int>& found) const {
    const auto largest = [](const Vector<Real>& v) {
      return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    };
    const Real corner =
        std::max({largest(lists_[found.i1]), largest(lists_[found.i2]), largest(lists_[found.i3])});
    return 16 * std::numeric_limits<Real>::epsilon() * (corner * corner * largest(p_));
  }
  /// True if the weights are so large that the triangle contains p whatever their rounding.
  bool is_certain(const Location<Int>& found) {
    rounding_ = rounding_of_weights(found);
    return std::min({weights_.b1, weights_.b2, weights_.b3}) > rounding_;
  }

  /// The visibility walk: leaves triangle (u,v,w) through an arc that has p strictly to its right.
  ///
  ///        w         p lies left of u->v, or on it. In a Delaunay triangulation the walk ends because the
  ///       / \        planes of the triangles passed cut the ray to p ever further out; in others because
  ///      u---v       the steps are counted.
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
        break;  // a null triangle: p lies elsewhere on its great circle
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

  /// True if p lies in the counterclockwise triangle a, b, c. The triangle may be a hemisphere: three nodes
  /// that go all the way around a great circle.
  bool contains(Int a, Int b, Int c) const {
    const int ab = exact_side(a, b), bc = exact_side(b, c), ca = exact_side(c, a);
    if (ab < 0 || bc < 0 || ca < 0 || ab + bc + ca == 0) return false;
    const int turn = exact_left(lists_[a], lists_[b], lists_[c]);
    return turn > 0 || (turn == 0 && ab + bc + ca == 3);
  }

  /// The triangle, rotated so that p is closest to the arc i1-i2. Sets the weights.
  Location<Int> weighed(Int a, Int b, Int c) {
    Location<Int> t{a, b, c};
    if (side(b, c) < side(t.i1, t.i2)) t = {b, c, a};
    if (side(c, a) < side(t.i1, t.i2)) t = {c, a, b};
    weights_.b3 = side(t.i1, t.i2);
    weigh(lists_[t.i1], lists_[t.i2], lists_[t.i3], p_, weights_);
    weights_.b1 = std::max(weights_.b1, Real(0));
    weights_.b2 = std::max(weights_.b2, Real(0));
    rounding_ = rounding_of_weights(t);
    return t;
  }

  /// The run of boundary arcs with p strictly to their right, one of which is r->l.
  Location<Int> see_boundary_exactly(const Int r, const Int l) const {
    Int rightmost = l, leftmost = r, arcs = n_;
    for (Int next; exact_side(rightmost, next = lists_.first_neighbour(rightmost)) < 0; rightmost = next)
      if (next == r || --arcs == 0) return {r, r, 0};
    for (Int next; exact_side(next = lists_.last_neighbour(leftmost), leftmost) < 0 && --arcs > 0;)
      leftmost = next;
    return {rightmost, leftmost, 0};
  }

  const Vector<Real> p_;
  const Lists& lists_;
  const Int n_;
  const Weights<Real> weights_;
  Real& rounding_;
};

/// The natural neighbours of p found so far: the nodes that would become its neighbours if p were inserted.
/// They form a ring around p, and are stored in the order in which they are found. If p lies outside the
/// hull, an entry 0 closes the ring.
template <class Int>
class Candidates {
 public:
  static constexpr int most = 25;

  explicit Candidates(Int first) : count_(1) { node_[0] = first; }

  Int& beyond(int i) { return beyond_[i]; }  ///< the node beyond the arc from i to the next; 0: none

  int count() const { return count_; }
  bool full() const { return count_ == most; }
  Int operator[](int i) const { return node_[i]; }
  int after(int i) const { return next_[i]; }
  int insert(Int node, int i) {
    const int position = count_++;
    node_[position] = node;
    next_[position] = next_[i];
    next_[i] = position;
    return position;
  }

 private:
  Int node_[most] = {};
  Int beyond_[most] = {};
  int next_[most] = {};
  int count_;
};

/// The nodes given to GETNP: a hash table. An empty cell holds 0, which is no node number.
template <class Int>
class GivenNodes {
 public:
  explicit GivenNodes(Int count) {
    constexpr int kCellsANode = 16;  // so many that collisions are rare
    while (std::int64_t{1} << (64 - shift_) < kCellsANode * std::int64_t{count}) --shift_;
    cells_.resize(std::size_t{1} << (64 - shift_));
  }

  /// The cell of the node, or the empty one where it would go. Fibonacci hashing: splitmix64 would take GETNP
  /// 20 % longer.
  Int& operator[](Int node) {
    std::size_t cell = static_cast<std::uint64_t>(node) * 0x9E3779B97F4A7C15 >> shift_;
    while (cells_[cell] != 0 && cells_[cell] != node) cell = (cell + 1) & (cells_.size() - 1);
    return cells_[cell];
  }

 private:
  int shift_ = 60;
  std::vector<Int> cells_;
};

/// Calls visit(neighbour) for the neighbours of a node, the last one first. False if the list runs into a
/// loop instead of closing.
template <class Int, class Visit>
bool each_neighbour(const ListReader<Int>& reader, Int node, const Visit& visit) {
  const Int last = reader.last_slot(node);
  Int slot = last;
  LoopGuard<Int> guard;
  do {
    if (guard.is_loop(slot)) return false;
    visit(reader.neighbour(slot));
    slot = reader.next(slot);
  } while (slot != last);
  return true;
}

/// The node nearest to p, exactly, by steps from `nearest` to nearer neighbours.
///
/// Let v have no nearer neighbour in the Delaunay mesh, and not be nearest. The arc from v to p leaves the
/// Voronoi cell of v through the border with a nearer neighbour in the convex hull, so through one at the
/// back of the hull: both are boundary nodes. Points of such a border are at least 90 degrees from all nodes,
/// so p is outside the triangles. Hence the search must begin at the nearest boundary node if p is outside;
/// `boundary`: one of them then, else 0.
///
/// The mesh is that of the nodes as given, which is that of their directions, but for arcs so short that the
/// rounding of coordinates is as large as what the arc bulges out of its chord. At these all nodes are
/// compared.
template <class Real, class Int>
Int nearest_exactly(const Vector<Real>& p, Int nearest, Int boundary, const ListReader<Int>& reader,
                    const Nodes<Real>& nodes) {
  const Point to = as_point(p);
  const auto look_at = [&](Int node) {
    if (node != nearest && is_finite(nodes[node]) &&
        is_nearer(to, as_point(nodes[node]), as_point(nodes[nearest])))
      nearest = node;
  };
  Int node = boundary;
  for (Int left = boundary == 0 ? 0 : reader.size(); left > 0; --left) {
    look_at(node);
    node = reader.first_neighbour(node);
    if (node == boundary) break;
  }
  bool is_close = false;
  for (Int before = 0; before != nearest;) {
    before = nearest;
    const Point from = as_point(nodes[before]);
    is_close = false;
    if (!each_neighbour(reader, before, [&](Int node) {
          const Point arc = minus(as_point(nodes[node]), from);
          is_close |= dot(arc, arc) < 64 * std::numeric_limits<Real>::epsilon();
          look_at(node);
        }))
      break;
  }
  if (is_close && !same_direction(to, as_point(nodes[nearest])))
    for (Int other = 1; other <= reader.size(); ++other) look_at(other);
  return nearest;
}

/// GETNP where rounding may have exchanged two nodes: compares those that are as near as the one found to
/// within the rounding of cosines, exactly. npts[0..given]: the given nodes and the one found.
template <class Real, class Int>
void confirm_next(const ListsView<Int>& lists, const Nodes<Real>& nodes, Int given, Int* npts,
                  Real& distance) {
  const ListReader<Int> reader(lists);
  const Point centre = as_point(nodes[npts[0]]);
  Int& found = npts[given];
  const double least = dot(centre, as_point(nodes[found])) - 16 * std::numeric_limits<Real>::epsilon();
  for (Int i = 0; i < given; ++i)
    each_neighbour(reader, npts[i], [&](Int node) {
      const Point at = as_point(nodes[node]);
      if (dot(centre, at) < least || std::find(npts, npts + given + 1, node) != npts + given + 1) return;
      if (is_nearer(centre, at, as_point(nodes[found]))) found = node;
    });
  distance = -dot(nodes[found], nodes[npts[0]]);
}

/// GETNP by the cosines of distances.
template <class Real, class Int>
NextNearestStatus nearest_by_cosines(const ListsView<Int>& lists, const Nodes<Real>& nodes, Int given,
                                     Int* npts, Real& distance) {
  GivenNodes<Int> taken(given);
  for (Int i = 0; i < given; ++i) {
    Int& cell = taken[npts[i]];
    if (npts[i] < 1 || cell == npts[i]) return NextNearestStatus::bad_nodes;
    cell = npts[i];
  }
  const ListReader<Int> reader(lists);
  for (Int i = 0; i < given; ++i) reader.prefetch_list(npts[i]);  // half of the time for N = 1e6
  const Vector<Real> centre = nodes[npts[0]];
  Int nearest = 0;
  Real greatest = -2, not_finite = 0;  // NaN if a distance was not finite
  for (Int i = 0; i < given; ++i)
    if (!each_neighbour(reader, npts[i], [&](Int node) {
          if (taken[node] == node) return;
          const Real cosine = dot(nodes[node], centre);
          not_finite += 0 * cosine;
          if (!(cosine > greatest)) return;
          nearest = node;
          greatest = cosine;
        }))
      return NextNearestStatus::broken_lists;
  if (not_finite != 0) return NextNearestStatus::not_finite;
  if (nearest == 0) return NextNearestStatus::none_left;
  npts[given] = nearest;
  distance = -greatest;
  return NextNearestStatus::done;
}

/// TRFIND, without weights by differences. One function for all that search: so the walk is inlined in it.
template <class Real, class Int>
[[gnu::noinline]] Location<Int> locate(Int start, const Vector<Real>& p, const ListsView<Int>& lists,
                                       const Nodes<Real>& nodes, const Weights<Real>& weights,
                                       Real& rounding) {
  const PlainLists<Real, Int> plain(lists, nodes);
  return Search<Real, Int, PlainLists<Real, Int>>(p, plain, weights, rounding).find(start);
}

}  // namespace

template <class Real, class Int>
Location<Int> trfind(Int start, const Vector<Real>& p, const ListsView<Int>& lists, const Nodes<Real>& nodes,
                     Real& b1, Real& b2, Real& b3) {
  Real rounding = 0;
  const Location<Int> found = locate(start, p, lists, nodes, {b1, b2, b3}, rounding);
  if (found.i3 == 0) return found;
  const Real most = std::max(std::max(b1, b2), b3);
  if (most > 0x1p21f * rounding || original_rules().follow) return found;
  weigh_by_differences<Real>(nodes[found.i1], nodes[found.i2], nodes[found.i3], p, {b1, b2, b3});
  // To within rounding p lies on the arc i1-i2.
  if (b3 < std::numeric_limits<Real>::epsilon() * (b1 + b2)) b3 = 0;
  return found;
}

template <class Real, class Int>
Location<Int> trfind_in_edited(Int start, const Vector<Real>& p, const EditedLists<Int>& lists, Int count,
                               const Nodes<Real>& nodes) {
  const GuardedLists<Real, Int> guarded(lists, count, nodes);
  Real b1, b2, b3, rounding;
  return Search<Real, Int, GuardedLists<Real, Int>>(p, guarded, {b1, b2, b3}, rounding).find(start);
}

template <class Real, class Int>
Int nearnd(const Vector<Real>& p, Int start, const ListsView<Int>& lists, const Nodes<Real>& nodes,
           Real& angle) {
  if (std::is_same_v<Real, double> && original_rules().clear_angle) angle = 0;
  const ListReader<Int> reader(lists);
  const Int n = reader.size();
  if (n < 3) return 0;
  Real b1, b2, b3, of_weights;
  const Location<Int> found =
      locate(start >= 1 && start <= n ? start : Int(1), p, lists, nodes, {b1, b2, b3}, of_weights);
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

  // Called as soon as an arc is in the ring, to prefetch the list and the position of the node beyond.
  const auto look_beyond = [&](int u) {
    const Int slot = reader.slot_of(ring[ring.after(u)], ring[u]);
    ring.beyond(u) = reader.entry(slot) < 0 ? 0 : reader.neighbour(reader.next(slot));
    if (ring.beyond(u) == 0) return;
    nodes.prefetch(ring.beyond(u));
    reader.prefetch_list(ring.beyond(u));
  };
  for (int i = 0; i < ring.count(); ++i)
    if (ring[i] != 0) reader.prefetch_list(ring[i]);
  for (int u = 0, v; ring[v = ring.after(u)] != 0; u = v) {
    look_beyond(u);
    if (v == 0) break;
  }

  // Insert the node beyond the arc of neighbours u and v between them if p lies in the cap of that triangle.
  // The result is certain if lengths are 1 to within rounding / 8, and heights and differences of cosines are
  // above `rounding`: their own rounding and what these lengths change are less.
  constexpr Real rounding = 512 * std::numeric_limits<Real>::epsilon();
  const auto is_unit = [](const Vector<Real>& v) { return std::abs(dot(v, v) - 1) < rounding / 8; };
  bool is_certain = found.i3 != 0 && is_unit(p) && is_unit(nodes[found.i1]) && is_unit(nodes[found.i2]) &&
                    is_unit(nodes[found.i3]);
  for (int u = 0, v; ring[v = ring.after(u)] != 0;) {
    if (const Int beyond = ring.beyond(u); beyond != 0) {
      if (ring.full()) break;
      const Real above = height(nodes[ring[v]], nodes[ring[u]], nodes[beyond], p);
      is_certain &= std::abs(above) > rounding;
      is_certain &= is_unit(nodes[beyond]);
      if (above > 0) {
        look_beyond(ring.insert(beyond, u));
        look_beyond(u);
        continue;
      }
    }
    if (v == 0) break;
    u = v;
  }

  Int nearest = ring[0];
  Real cosine = dot(nodes[nearest], p), second = -2;
  for (int i = 1; i < ring.count(); ++i) {
    if (ring[i] == 0) continue;
    const Real other = dot(nodes[ring[i]], p);
    second = std::max(second, std::min(cosine, other));
    if (-other < -cosine) {
      nearest = ring[i];
      cosine = other;
    }
  }
  if (!(is_certain && cosine - second > rounding && !ring.full()) && !original_rules().follow) {
    nearest = nearest_exactly(p, nearest, found.i3 == 0 ? found.i1 : Int(0), reader, nodes);
    cosine = dot(nodes[nearest], p);
  }
  if (cosine > Real(1 - 0x1p-11) && !original_rules().follow) {  // where acos loses more than ten bits
    const Point a = as_point(nodes[nearest]), normal = cross(minus(as_point(p), a), a);
    angle = static_cast<Real>(std::asin(std::min(std::sqrt(dot(normal, normal)), 1.0)));
  } else {
    angle = std::acos(std::min(cosine, Real(1)));
  }
  return nearest;
}

template <class Real, class Int>
NextNearestStatus next_nearest(const ListsView<Int>& lists, const Nodes<Real>& nodes, Int l, Int* npts,
                               Real& distance) {
  if (l < 2) return NextNearestStatus::too_short;
  const Int given = l - 1;
  if (npts[0] < 1) return NextNearestStatus::bad_nodes;
  const NextNearestStatus status =
      in_default_floating_point([&] { return nearest_by_cosines(lists, nodes, given, npts, distance); });
  // The rounding of a cosine is that of an angle of 16 eps / sine at most. Below 7e-4 radians for doubles,
  // where it may be more than 5e-12, and everywhere for floats, exact signs decide.
  constexpr Real close = std::is_same_v<Real, double> ? Real(1 - 0x1p-22) : Real(-2);
  if (status == NextNearestStatus::done && -distance >= close && !original_rules().follow)
    in_default_floating_point([&] { confirm_next(lists, nodes, given, npts, distance); });
  return status;
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
