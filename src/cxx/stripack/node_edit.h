#pragma once
// ADDNOD, DELNOD: nodes are added to and deleted from a triangulation (Renka, ACM TOMS 23 (1997), Algorithm
// 772). For (Real, Int) = (float, int32_t), (double, int32_t), (double, int64_t). The routines allocate
// nothing and always return.

#include <algorithm>

#include "stripack/arc_edit.h"
#include "stripack/coordinates_and_areas.h"
#include "stripack/search.h"

namespace pstripack {

/// IER of ADDNOD; L > 0: node k coincides with node L.
enum class AddnodStatus {
  done = 0,
  too_few_nodes = PSTRIPACK_TOO_FEW_NODES,  ///< k < 4
  collinear = PSTRIPACK_COLLINEAR,  ///< all nodes lie on one great circle, or node k is the zero vector
  too_many_nodes = PSTRIPACK_TOO_MANY_NODES,  ///< 6k-12 does not fit an integer
  not_finite = PSTRIPACK_BAD_COORDINATE,      ///< a coordinate of node k is NaN or infinite
  broken = broken_lists
};

/// IER of DELNOD.
enum class DelnodStatus {
  done = 0,
  bad_argument = 1,     ///< k not in 1..n, n < 4 or lwk < 0; nothing is changed
  too_few_columns = 2,  ///< only lwk is changed: columns needed
  not_linked = 3,       ///< k has fewer than 3 neighbours; or one of them does not list k, and the lists are
                        ///< changed in part, but not LNEW, n, x, y, z
  not_reduced = 4,      ///< an interior node kept more than 3 neighbours although there is a boundary; arcs
                        ///< were exchanged, but LNEW, n, x, y, z are unchanged
  optim_failed = 5,     ///< deleted; OptimFailure has OPTIM's code
  not_optimal = 6,      ///< deleted; OPTIM ran out of iterations
  broken = broken_lists
};

// ---- ADDNOD ----

/// The first of nodes 1..k-1 that has the coordinates of p; 0 if there is none.
template <class Real, class Int>
Int look_through(const Vector<Real>& p, Int k, const Nodes<Real>& nodes) {
  for (Int node = 1; node < k; ++node)
    if (coincide(nodes[node], p)) return node;
  return 0;
}

/// The same in O(1) steps, for a Delaunay triangulation: descends from a node near p to the node nearest to
/// p.
///
/// Why the descent finds it: the way from any other node v to p leaves v's Voronoi cell at a point c and
/// enters that of a node j, which v lists. There |c-j| = |c-v|, and p lies on the ray from v through c, so
/// |p-j| < |p-v|: v has a neighbour nearer to p. This holds whichever diagonal rounding has put into a
/// quadrilateral with corners on a circle: if v does not list j, c is the centre of that circle. Of the
/// points of the circle v is the farthest from p, so the ends of the diagonal, which v lists, are nearer as
/// well.
template <class Real, class Int>
Int descend(const Vector<Real>& p, Int start, const CheckedEditor<Int>& lists, const Nodes<Real>& nodes) {
  const auto distance = [&](Int node) {
    const Vector<Real> a = nodes[node];
    const double x = double{a.x} - p.x, y = double{a.y} - p.y, z = double{a.z} - p.z;
    return x * x + y * y + z * z;
  };
  Int nearest, next = start;
  double least = distance(start);
  do {
    nearest = next;
    const auto look = [&](Int slot) {
      const Int node = lists.neighbour(slot);
      const bool same = coincide(nodes[node], p);
      if (const double d = distance(node); d < least || same) {
        least = d;
        next = node;
      }
      return same;
    };
    look(lists.find(nearest, look).slot);
  } while (next != nearest && !coincide(nodes[next], p));
  return coincide(nodes[next], p) ? next : 0;
}

/// A node that coincides with node k; 0 if there is none. `found`: the location of k.
template <class Real, class Int>
Int copy_of(Int k, const Location<Int>& found, const CheckedEditor<Int>& lists, const Nodes<Real>& nodes) {
  constexpr Int few = 1000;  // scanning these costs a fraction of the search
  const Vector<Real> p = nodes[k];
  if (found.i3 != 0)
    for (const Int node : {found.i1, found.i2, found.i3})
      if (coincide(nodes[node], p)) return node;
  if (k <= few || found.i1 == 0) return look_through(p, k, nodes);
  return descend(p, found.i1, lists, nodes);
}

/// Restores the Delaunay property around node k: tests the arcs u-v opposite k, counterclockwise, and swaps
/// u-v for k-w if k lies in the circumscribed cap of the triangle u,v,w beyond. At most k-1 swaps, since each
/// adds a neighbour to k.
///
///          w
///        /   \                         .
///      v ----- u
///        \   /
///          k
template <class Real, class Int>
void optimize_round(Int k, const CheckedEditor<Int>& lists, const Nodes<Real>& nodes) {
  const Int first = lists.first_slot(k);
  Int u = lists.first_neighbour(k), slot = lists.next(first), v = lists.neighbour(slot);
  Int exchanges = 0;
  for (LoopGuard<Int> guard;;) {
    const Int of_u = lists.slot_of(v, u);
    if (lists.entry(of_u) > 0) {
      const Int w = lists.neighbour(lists.next(of_u));
      if (swptst(w, k, v, u, nodes)) {
        if (const Int of_w = lists.swap(w, k, v, u)) {
          if (++exchanges == k) throw BrokenLists();
          v = w;
          slot = of_w;
          continue;
        }
      }
    }
    if (slot == first || lists.entry(slot) < 0) return;
    guard.pass(slot);
    u = v;
    slot = lists.next(slot);
    v = lists.neighbour(slot);
  }
}

/// ADDNOD: adds node k = lists.n to the triangulation of nodes 1..k-1, which stays a Delaunay triangulation
/// if it was one. The search starts at node `start`; at node k-1 if start < 1, at a random node if start >
/// k-1. The lists are changed only if the result is 0 or, partly, if it is broken_lists. Expected O(1)
/// after the search.
///
/// A node with the coordinates of node k is always found in a Delaunay triangulation; Algorithm 772 misses
/// many on the hull.
template <class Real, class Int>
Int addnod(Int start, const Nodes<Real>& nodes, const EditedLists<Int>& arrays) {
  const Int k = arrays.n;
  const auto code = [](AddnodStatus status) { return static_cast<Int>(status); };
  if (k < 4) return code(AddnodStatus::too_few_nodes);
  if (k > most_nodes<Int>()) return code(AddnodStatus::too_many_nodes);
  const Vector<Real> p = nodes[k];
  if (!is_finite(p)) return code(AddnodStatus::not_finite);

  return code_or_broken_lists([&]() -> Int {
    const CheckedEditor<Int> lists({arrays, *arrays.lnew});
    const Location<Int> found = trfind_in_edited(start < 1 ? k - 1 : start, p, arrays, k - 1, nodes);
    if (const Int same = copy_of(k, found, lists, nodes)) return same;
    const auto [i1, i2, i3] = found;
    if (i1 == 0) return code(AddnodStatus::collinear);
    if (i3 != 0)
      lists.add_inside(k, i1, i2, i3);
    else if (i1 != i2)
      lists.add_outside(k, i1, i2);
    else
      lists.cover_sphere(k, i1);
    optimize_round(k, lists, nodes);
    return code(AddnodStatus::done);
  });
}

// ---- DELNOD ----

/// The deletion of node k. run() has its steps.
template <class Real, class Int>
class Deletion {
 public:
  Deletion(Int k, Int n, Real* x, Real* y, Real* z, const EditedLists<Int>& arrays)
      : k_(k),
        n_(n),
        x_(x),
        y_(y),
        z_(z),
        node_{x, y, z},
        arrays_(arrays),
        lnew_(*arrays.lnew),
        lists_({arrays, lnew_}) {}

  DelnodStatus run(Int& lwk, Int* iwk, Int& n, OptimFailure<Int>& failure) {
    on_boundary_ = lists_.on_boundary(k_);
    neighbours_ = lists_.degree(k_) + (on_boundary_ ? 1 : 0);
    if (neighbours_ < 3) return DelnodStatus::not_linked;
    const Int available = lwk;
    lwk = neighbours_ - 3;
    if (available < lwk) return DelnodStatus::too_few_columns;

    if (neighbours_ > 3) exchange_arcs(iwk);
    if (!on_boundary_ && opens_the_hull()) {
      Int& last = lists_.entry(lists_.last_slot(k_));
      last = -last;
      on_boundary_ = true;
    }
    if (!on_boundary_ && neighbours_ > 3) return DelnodStatus::not_reduced;
    if (!unlink()) return DelnodStatus::not_linked;
    renumber();
    free_own_slots();
    n = n_ - 1;
    *arrays_.lnew = lnew_;
    return optimize_new_arcs(iwk, failure);
  }

 private:
  bool left(Int a, Int b, Int c) const { return closed_left(node_[a], node_[b], node_[c]); }
  /// A node's number after the deletion.
  Int renumbered(Int node) const { return node > k_ ? node - 1 : node; }

  /// Swaps arcs k-m for l-r until k has three neighbours or no arc can be swapped: the quadrilateral must be
  /// convex at k and at m, unless that is a boundary node.
  ///
  ///           m
  ///         / | \                r, m, l follow each other in the list of k; after an exchange the arc
  ///        l  |  r               before is tested again
  ///         \ | /
  ///           k
  void exchange_arcs(Int* iwk) {
    Int first = lists_.first_neighbour(k_), slot = lists_.next(lists_.first_slot(k_));
    Int r = first, m = lists_.neighbour(slot);
    slot = lists_.next(slot);
    for (Int steps = 3 * neighbours_; steps > 0; --steps) {
      const Int l = lists_.neighbour(slot);
      if (on_boundary_ && l == first) return;
      Int of_l = 0;
      if ((on_boundary_ || left(r, l, k_)) && (lists_.on_boundary(m) || left(l, r, m)))
        of_l = lists_.swap(l, r, k_, m);
      if (of_l == 0) {
        r = m;
      } else {
        iwk[2 * new_arcs_] = renumbered(l);
        iwk[2 * new_arcs_ + 1] = renumbered(r);
        ++new_arcs_;
        if (--neighbours_ == 3) return;
        first = lists_.first_neighbour(k_);
        slot = lists_.slot_of(k_, l);
        if (r != first) {
          m = r;
          r = lists_.neighbour(lists_.next(lists_.next(of_l)));
          continue;
        }
      }
      if (m == first) return;
      m = l;
      slot = lists_.next(slot);
    }
    throw BrokenLists();
  }

  /// True if the triangles cover the sphere now but not without k: k has more than three neighbours left, or
  /// does not lie in the triangle of its three neighbours a, b, c.
  bool opens_the_hull() {
    if (neighbours_ == 3) {
      const Int first = lists_.first_slot(k_);
      const Int a = lists_.neighbour(first), b = lists_.neighbour(lists_.next(first)),
                c = lists_.last_neighbour(k_);
      if (!left(a, c, b)) return false;
    }
    for (Int node = 1; node <= n_; ++node)
      if (lists_.on_boundary(node)) return false;
    return true;
  }

  /// Removes k from the lists of its neighbours; `last_` becomes its last slot. False if one does not list k.
  bool unlink() {
    last_ = lists_.last_slot(k_);
    Int slot = last_;
    do {
      slot = lists_.next(slot);
      const Int freed = lists_.remove_neighbour(lists_.neighbour(slot), k_);
      if (freed < 0) return false;
      const Int moved = lnew_;
      if (last_ == moved) last_ = freed;
      if (slot == moved) slot = freed;
      ++own_slots_;
    } while (slot != last_);
    return true;
  }

  void renumber() {
    if (k_ == n_) return;
    for (Real* coordinate : {x_, y_, z_}) std::copy(coordinate + k_, coordinate + n_, coordinate + k_ - 1);
    std::copy(arrays_.lend + k_, arrays_.lend + n_, arrays_.lend + k_ - 1);
    for (Int* entry = arrays_.list; entry != arrays_.list + (lnew_ - 1); ++entry)
      *entry += (*entry < -k_) - (*entry > k_);
  }

  /// Frees the slots of k's own list, in the order last neighbour, first, second, ..., by moving the top slot
  /// into each.
  void free_own_slots() {
    const CheckedEditor<Int> lists({arrays_, lnew_, n_ - 1});
    Int hole = last_;
    for (; own_slots_ > 0; --own_slots_) {
      Int slot = lists.next(hole);  // the other slots of k start here; the last one still points to `last_`
      lists.move_top_to(hole, [&](Int top) {
        // The original does this even to a slot that it has freed.
        if (Int& next = arrays_.lptr[slot - 1]; slot >= top && next == top) next = hole;
        bool own = slot == top && own_slots_ > 1;
        if (slot == top) slot = hole;
        for (Int left = own_slots_ - 1, s = slot; left > 0; --left, s = lists.next(s))
          if (lists.next(s) == top) {
            lists.next(s) = hole;
            own = own || left > 1;
          }
        if (!own) lists.redirect(top, hole);
      });
      hole = slot;
    }
  }

  DelnodStatus optimize_new_arcs(Int* iwk, OptimFailure<Int>& failure) {
    if (new_arcs_ == 0) return DelnodStatus::done;
    Int nit = 4 * new_arcs_;
    const OptimStatus status =
        optimize(CheckedEditor<Int>({arrays_, lnew_, n_ - 1}), node_, new_arcs_, nit, iwk);
    if (status == OptimStatus::done) return DelnodStatus::done;
    if (status == OptimStatus::not_all) return DelnodStatus::not_optimal;
    failure = {nit, static_cast<Int>(status)};
    return DelnodStatus::optim_failed;
  }

  const Int k_, n_;
  Real* const x_;
  Real* const y_;
  Real* const z_;
  const Nodes<Real> node_;
  const EditedLists<Int> arrays_;
  Int lnew_;  // copied to the caller's LNEW when the deletion can no longer fail
  const CheckedEditor<Int> lists_;
  bool on_boundary_ = false;  // k is on the boundary, or treated as if it were
  Int neighbours_ = 0;        // number of neighbours of k, plus one if k is on the boundary
  Int new_arcs_ = 0;          // columns of IWK
  Int last_ = 0, own_slots_ = 0;
};

/// DELNOD: deletes node k; the numbers of higher nodes drop by one in x, y, z, LEND and all lists. n =
/// lists.n, on return one less. lwk: in, columns of iwk; out, columns needed: the number of neighbours of k
/// minus 3 (minus 2 on the boundary). iwk: the arcs that replace those of k. O(degree squared) if k = n,
/// else O(n).
template <class Real, class Int>
DelnodStatus delnod(Int k, Int& n, Real* x, Real* y, Real* z, const EditedLists<Int>& lists, Int& lwk,
                    Int* iwk, OptimFailure<Int>& failure) {
  if (k < 1 || k > n || n < 4 || lwk < 0) return DelnodStatus::bad_argument;
  return code_or_broken_lists(
      [&] { return Deletion<Real, Int>(k, n, x, y, z, lists).run(lwk, iwk, n, failure); });
}

}  // namespace pstripack
