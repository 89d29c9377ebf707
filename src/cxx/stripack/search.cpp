#include "stripack/search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/static_rounding.h"
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

/// TRFIND: by rounded tests, as the original; by exact signs where these are not certain or do not end soon.
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

  /// True if the weights are so large that the triangle contains p whatever their rounding: each is a sum of
  /// six products, none larger than `size`, with five roundings on the way.
  bool is_certain(const Location<Int>& found) const {
    const auto largest = [](const Vector<Real>& v) {
      return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    };
    const Real corner =
        std::max({largest(lists_[found.i1]), largest(lists_[found.i2]), largest(lists_[found.i3])});
    const Real size = corner * corner * largest(p_);
    return std::min({weights_.b1, weights_.b2, weights_.b3}) >
           16 * std::numeric_limits<Real>::epsilon() * size;
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

/// Up to this many given nodes GETNP needs no memory from the heap.
constexpr int most_without_memory = 256;

/// The nodes given to GETNP, as a hash table. An empty cell holds 0, which is no node number.
template <class Int>
class NodeTable {
 public:
  /// `cells`: 2^bits of them, all 0.
  NodeTable(const Int* npts, Int* cells, int bits) : npts_(npts), cells_(cells), shift_(64 - bits) {
    insert(0);
  }

  /// Inserts npts[place]; false if it is in the table already.
  bool insert(Int place) {
    const Int node = npts_[place];
    std::size_t cell = hash(node);
    if (cells_[cell] != 0) cell = find(cell, node);
    if (cells_[cell] == node) return false;
    cells_[cell] = node;
    return true;
  }
  /// Without a branch on the result, which would be unpredictable.
  bool contains(Int node) const {
    const std::size_t cell = hash(node);
    const Int found = cells_[cell];
    const bool is_other = found != node;
    if (__builtin_expect((found & -Int{is_other}) != 0, false)) return cells_[find(cell, node)] == node;
    return !is_other;
  }

 private:
  std::size_t hash(Int node) const {
    return static_cast<std::size_t>(static_cast<std::uint64_t>(node) * 0x9E3779B97F4A7C15 >> shift_);
  }
  /// The node's cell, or the empty cell where it would go; searches from `cell` on.
  [[gnu::noinline]] std::size_t find(std::size_t cell, Int node) const {
    const std::size_t last = (std::size_t{1} << (64 - shift_)) - 1;
    while (cells_[cell] != 0 && cells_[cell] != node) cell = (cell + 1) & last;
    return cell;
  }

  const Int* npts_;
  Int* cells_;
  int shift_;
};

/// The nodes given to GETNP, if they are few: compared one by one.
template <class Int, int most>
class FewNodes {
 public:
  explicit FewNodes(const Int* npts) : npts_(npts) { std::fill_n(node_, most, npts[0]); }

  /// Inserts npts[place]; false if it is in the set already.
  bool insert(Int place) {
    if (contains(npts_[place])) return false;
    node_[place] = npts_[place];
    return true;
  }
  bool contains(Int node) const {
    bool found = false;
    for (const Int one : node_) found |= node == one;
    return found;
  }

 private:
  const Int* npts_;
  Int node_[most];
};

/// Calls visit(neighbour) for the neighbours of a node, the last one first. False if the list runs into a
/// loop instead of closing. The next slot is guessed, as in canonical lists, and compared with LPTR: the
/// processor predicts that branch, whereas following LPTR would make it wait for memory.
template <class Int, class Visit>
[[gnu::always_inline]] inline bool each_neighbour(const ListReader<Int>& reader, Int node,
                                                  const Visit& visit) {
  const Int last = reader.last_slot(node);
  Int slot = last, foreseen = reader.foreseen_first_slot(node), passed = 0;
  unsigned jumps = 0, jumps_to_pass = 64;
  do {
    visit(reader.neighbour(slot));
    const Int next = reader.next(slot);
    Int onward = foreseen;
    asm("" : "+r"(onward));  // keeps the compiler from using `next`, which is equal
    if (next == foreseen) {
      slot = onward;
    } else {
      slot = next;
      if (slot == passed) return false;
      if (++jumps == jumps_to_pass) {  // Brent's search for a loop
        passed = slot;
        jumps_to_pass *= 2;
      }
    }
    foreseen = slot + 1;
  } while (slot != last);
  return true;
}

/// Finds, among the nodes passed to compare(), the one nearest to a centre by its cosine; among equal cosines
/// the first. Computes in Number: Real, or StaticallyRounded<Real>, which needs no floating-point
/// environment.
template <class Number, class Real, class Int>
class Nearest {
 public:
  Nearest(const Nodes<Real>& nodes, Int centre) : nodes_(nodes), centre_(position(centre)) {}

  /// Without a branch on distances, which would be unpredictable: so the next call can begin before the
  /// distances have arrived from memory.
  [[gnu::always_inline]] void compare(Int node, bool is_other = true) {
    const Number cosine = is_other ? dot(position(node), centre_) : Number(-2);
    not_finite_ = not_finite_ + Number(0) * cosine;
    nearest_ = is_larger(cosine, cosine_) ? node : nearest_;
    cosine_ = larger(cosine, cosine_);
  }
  /// Sets the environment of Number itself. To save the old environment the processor waits for all
  /// instructions in flight, so these nodes should have been prefetched before. `few`: without a branch.
  /// Many nodes come roughly by distance, so a branch is predictable, and with it the processor need not
  /// wait for positions.
  template <bool few>
  void compare(const Int* begin, const Int* end) {
    in_environment_of<Number>([=] {
      Int nearest = nearest_;
      Number greatest = cosine_, not_finite = not_finite_;
      for (const Int* node = begin; node != end; ++node) {
        const Number cosine = dot(position(*node), centre_);
        not_finite = not_finite + Number(0) * cosine;
        const bool is_nearer = is_larger(cosine, greatest);
        if (few) {
          nearest = is_nearer ? *node : nearest;
          greatest = larger(cosine, greatest);
        } else if (is_nearer) {
          nearest = *node;
          greatest = cosine;
          asm("" : "+r"(nearest));  // keeps the compiler from removing the branch
        }
      }
      nearest_ = nearest;
      cosine_ = greatest;
      not_finite_ = not_finite;
    });
  }
  NextNearestStatus write(Int& node, Real& distance) const {
    if (Real(not_finite_) != 0) return NextNearestStatus::not_finite;
    if (nearest_ == 0) return NextNearestStatus::none_left;
    node = nearest_;
    distance = -Real(cosine_);
    return NextNearestStatus::done;
  }

 private:
  Vector<Number> position(Int node) const {
    const Vector<Real> p = nodes_[node];
    return {p.x, p.y, p.z};
  }

  const Nodes<Real> nodes_;
  const Vector<Number> centre_;
  Int nearest_ = 0;
  Number cosine_ = Real(-2);
  Number not_finite_ = Real(0);  ///< 0; NaN if a distance was not finite
};

/// GETNP by the cosines of distances, for one or two given nodes: few of their neighbours are given nodes, so
/// each neighbour is compared at once. To be called in the environment of Number.
template <class Number, int given, class Real, class Int>
NextNearestStatus nearest_when_met(const ListsView<Int>& lists, const Nodes<Real>& nodes, Int* npts,
                                   Real& distance) {
  const ListReader<Int> reader(lists);
  FewNodes<Int, given> taken(npts);
  for (Int i = 1; i < given; ++i)
    if (npts[i] < 1 || !taken.insert(i)) return NextNearestStatus::bad_nodes;
  for (Int i = 0; i < given; ++i) reader.prefetch_list(npts[i]);

  Nearest<Number, Real, Int> nearest(nodes, npts[0]);
  const auto visit = [&](Int node) __attribute__((always_inline)) {
    // The call for l = 3 will need one of these slots. For two given nodes prefetching costs more than it
    // saves.
    if (given == 1) reader.prefetch_last_slot(node);
    nearest.compare(node, !taken.contains(node));
  };
  for (Int i = 0; i < given; ++i)
    if (!each_neighbour(reader, npts[i], visit)) return NextNearestStatus::broken_lists;
  return nearest.write(npts[given], distance);
}

/// GETNP for more given nodes. `taken`: empty, with room for them. Few and many nodes have an instance of
/// their own, because compilers run out of registers if one instance serves both.
template <class Number, bool few, class Real, class Int, class Taken>
[[gnu::noinline]] NextNearestStatus nearest_of_others(const ListsView<Int>& lists, const Nodes<Real>& nodes,
                                                      Int given, Int* npts, Real& distance, Taken taken) {
  const ListReader<Int> reader(lists);
  for (Int i = 1; i < given; ++i)
    if (npts[i] < 1 || !taken.insert(i)) return NextNearestStatus::bad_nodes;
  for (Int i = 0; i < given; ++i) reader.prefetch_list(npts[i]);

  Nearest<Number, Real, Int> nearest(nodes, npts[0]);
  constexpr int most = 64;
  Int others[most];  // neighbours that are not given nodes, to be compared
  int count = 0;
  // The next call will need one of these slots: callers ask for l = 2, 3, 4...
  const auto prefetch = [&](Int node) {
    if (few) nodes.prefetch(node);
    reader.prefetch_last_slot(node);
  };
  const auto compare = [&]() __attribute__((always_inline)) {
    if (!few) std::for_each(others, others + count, prefetch);
    nearest.template compare<few>(others, others + count);
    count = 0;
  };
  const auto visit = [&](Int node) __attribute__((always_inline)) {
    if (few) prefetch(node);  // if many nodes are given, most neighbours are among them
    others[count] = node;     // overwritten by the next one if this is a given node
    count += !taken.contains(node);
    if (count == most) compare();
  };
  for (Int i = 0; i < given; ++i)
    if (!each_neighbour(reader, npts[i], visit)) return NextNearestStatus::broken_lists;
  compare();
  return nearest.write(npts[given], distance);
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

/// Cells of a NodeTable per node: so many that collisions are rare.
constexpr int cells_a_node = 16;
/// Up to this many given nodes are few.
constexpr int few_nodes = 8;

/// GETNP by the cosines of distances, for 1 to few_nodes given nodes.
template <class Number, class Real, class Int>
NextNearestStatus nearest_of_few(const ListsView<Int>& lists, const Nodes<Real>& nodes, Int given, Int* npts,
                                 Real& distance) {
  if (given == 1)
    return in_environment_of<Number>(
        [&] { return nearest_when_met<Number, 1>(lists, nodes, npts, distance); });
  if (given == 2)
    return in_environment_of<Number>(
        [&] { return nearest_when_met<Number, 2>(lists, nodes, npts, distance); });
  const auto of_others = [&](auto taken) {
    return nearest_of_others<Number, true>(lists, nodes, given, npts, distance, taken);
  };
  if (given <= 4) return of_others(FewNodes<Int, 4>(npts));
  constexpr int bits = 7;
  static_assert(cells_a_node * few_nodes == 1 << bits);
  Int cells[1 << bits] = {};
  return of_others(NodeTable(npts, cells, bits));
}

/// GETNP by the cosines of distances.
template <class Real, class Int>
NextNearestStatus nearest_by_cosines(const ListsView<Int>& lists, const Nodes<Real>& nodes, Int given,
                                     Int* npts, Real& distance) {
  if (given <= few_nodes)
    return StaticallyRounded<Real>::is_available()
               ? nearest_of_few<StaticallyRounded<Real>>(lists, nodes, given, npts, distance)
               : nearest_of_few<Real>(lists, nodes, given, npts, distance);
  int bits = 8;
  while (std::int64_t{1} << bits < cells_a_node * std::int64_t{given}) ++bits;
  const auto of_many = [&](Int* cells) {
    return nearest_of_others<Real, false>(lists, nodes, given, npts, distance, NodeTable(npts, cells, bits));
  };
  if (given > most_without_memory) return of_many(std::vector<Int>(std::size_t{1} << bits).data());
  Int cells[cells_a_node * most_without_memory];
  std::memset(cells, 0, sizeof(Int) << bits);
  return of_many(cells);
}

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
  const NextNearestStatus status = nearest_by_cosines(lists, nodes, given, npts, distance);
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
