#pragma once
// SWPTST, OPTIM, DELARC, EDGE: swap and removal of arcs (Renka, ACM TOMS 23 (1997), Algorithm 772).
// For (Real, Int) = (float, int32_t), (double, int32_t), (double, int64_t). The routines allocate nothing and
// always return.

#include <algorithm>

#include "stripack/coordinates_and_areas.h"
#include "stripack/expressions.h"
#include "stripack/list_edit.h"

namespace pstripack {

/// SWPTST: true if node n4 lies strictly above the plane of the counterclockwise triangle n1, n2, n3 in
/// rounded arithmetic, so that the common arc n1-n2 of the two triangles should be swapped. False for NaN.
template <class Real, class Int>
bool swptst(Int n1, Int n2, Int n3, Int n4, const Nodes<Real>& nodes) {
  return height(nodes[n1], nodes[n2], nodes[n3], nodes[n4]) > 0;
}

/// IER of OPTIM. On an error the swaps made before it stay.
enum class OptimStatus {
  done = 0,
  not_all = 1,       ///< the last allowed iteration still made swaps
  bad_argument = 2,  ///< na < 0 or nit < 1; nit = 0
  no_arc = 3,        ///< a column does not hold two neighbours
  not_swapped = 4,   ///< the nodes to be joined were neighbours
  broken = broken_lists
};

template <class Int>
struct OptimFailure {
  Int nit = 0, ier = 0;
};

/// IER of DELARC. Nothing is changed unless it is `done` or `broken`.
enum class DelarcStatus {
  done = 0,
  bad_argument = 1,     ///< lists.n < 4, or io1, io2 not two of its nodes
  not_on_boundary = 2,  ///< no boundary arc
  cuts_off = 3,         ///< the third corner of its triangle is already on the boundary
  no_neighbours = 4,    ///< the two do not list each other
  broken = broken_lists
};

/// IER of EDGE.
enum class EdgeStatus {
  done = 0,
  bad_argument = 1,     ///< in1 < 1, in2 < 1, in1 = in2, lwk < 0; nothing is changed
  too_few_columns = 2,  ///< more than lwk arcs are crossed; only iwk is changed
  not_found = 3,     ///< the walk from in1 to in2 failed: null triangles or broken lists; only iwk is changed
  optim_failed = 4,  ///< the arc is there; OptimFailure has OPTIM's code
  not_optimal = 5,   ///< the arc is there; OPTIM ran out of iterations
  broken = broken_lists,  ///< only iwk is changed, unless several entries are wrong
  not_possible =
      PSTRIPACK_NO_EDGE  ///< nodes on the arc, up to rounding, or triangles that overlap; only iwk is changed
};

/// The same for lists that are being edited; throws BrokenLists.
template <class Real, class Int>
OptimStatus optimize(const CheckedEditor<Int>& lists, const Nodes<Real>& nodes, Int na, Int& nit, Int* iwk) {
  const Int most = nit;
  nit = 0;
  if (na < 0 || most < 1) return OptimStatus::bad_argument;
  if (na == 0) return OptimStatus::done;
  Int known = lists.known_node();
  for (bool swapped = true; swapped;) {
    if (nit == most) return OptimStatus::not_all;
    ++nit;
    swapped = false;
    for (Int* arc = iwk; arc != iwk + 2 * na; arc += 2) {
      const Int u = arc[0], v = arc[1];
      if (u < 1 || v < 1) return OptimStatus::no_arc;
      // g follows v in the list of u, h precedes it: u,v,g and v,u,h are the triangles at the arc.
      const auto [slot, before] = lists.find(u, [&](Int s) { return lists.entry(s) == v; });
      if (lists.neighbour(slot) != v) return OptimStatus::no_arc;
      if (lists.entry(slot) < 0 || lists.entry(before) < 0) continue;  // on the boundary
      const Int g = lists.neighbour(lists.next(slot)), h = lists.neighbour(before);
      known = std::max({known, u, v});
      if (std::max(g, h) > known) {
        lists.between(g, u, h, v);  // throws unless the other list contains them, too
        known = std::max(g, h);
      }
      if (!swptst(g, h, u, v, nodes)) continue;
      if (lists.swap(g, h, u, v) == 0) return OptimStatus::not_swapped;
      arc[0] = g;
      arc[1] = h;
      swapped = true;
    }
  }
  return OptimStatus::done;
}

/// OPTIM: swaps the arcs in the columns of iwk(2,na), each a pair of neighbours, until they are locally
/// optimal, in at most nit iterations through all columns. Updates the columns. nit: on return, the number
/// of iterations made. The routine is not told N: a node number above all those in the columns is used as
/// an index only if two lists agree on it.
template <class Real, class Int>
OptimStatus optim(const Nodes<Real>& nodes, Int na, const EditedLists<Int>& lists, Int& nit, Int* iwk) {
  Int unknown = std::numeric_limits<Int>::max();
  return code_or_broken_lists([&] {
    return optimize(CheckedEditor<Int>({lists, unknown}), nodes, na, nit, iwk);
  });
}

/// DELARC: removes the boundary arc io1-io2 and its triangle.
template <class Int>
DelarcStatus delarc(Int io1, Int io2, const EditedLists<Int>& arrays) {
  const Int n = arrays.n;
  if (n < 4 || io1 < 1 || io1 > n || io2 < 1 || io2 > n || io1 == io2) return DelarcStatus::bad_argument;
  return code_or_broken_lists([&] {
    const CheckedEditor<Int> lists({arrays, *arrays.lnew});
    const auto precedes = [&](Int a, Int b) { return lists.entry(lists.last_slot(b)) == -a; };
    // n1, n2, n3 is the triangle, and the boundary runs from n1 to n2.
    const Int n1 = precedes(io1, io2) ? io1 : io2, n2 = io1 + io2 - n1;
    if (!precedes(n1, n2)) return DelarcStatus::not_on_boundary;
    const Int n3 = lists.neighbour(lists.next(lists.first_slot(n1)));
    if (lists.on_boundary(n3)) return DelarcStatus::cuts_off;
    if (lists.remove_neighbour(n1, n2) < 0) return DelarcStatus::no_neighbours;
    lists.remove_neighbour(n2, n1);
    const Int last = lists.slot_of(n3, n1);
    lists.last_slot(n3) = last;
    lists.entry(last) = -n1;
    return DelarcStatus::done;
  });
}

/// The arcs that p-q crosses are collected in the columns of IWK, in order from p to q, and swapped until p-q
/// is one of them. Lists with one wrong entry are detected before the first swap.
///
///           l --- m --- .
///         /  \   / \   / \          columns (l,r), (m,r), ...: the end left of p-q, the right one;
///       p . . \./. .\./. . q        m is the end that the next column does not share with l-r
///         \    r --- . --- /
///
template <class Real, class Int>
class ArcForcing {
 public:
  ArcForcing(Int in1, Int in2, const Nodes<Real>& nodes, const CheckedEditor<Int>& lists, Int* iwk, Int lwk)
      : p_(in1), q_(in2), node_(nodes), lists_(lists), iwk_(iwk), lwk_(lwk) {}

  /// Makes p-q an arc. `crossed`: the number of columns; `made`: the column of p-q.
  EdgeStatus force(Int& crossed, Int& made) {
    Int l, r;
    if (!find_first(l, r)) {
      std::swap(p_, q_);
      if (!find_first(l, r)) return EdgeStatus::not_found;
    }
    // If the triangles do not cover their convex hull, there may be no triangle where p-q leaves p.
    const bool outside = lists_.entry(lists_.last_slot(p_)) == -r;
    if (const EdgeStatus status = collect(l, r, outside); status != EdgeStatus::done) return status;
    // The swaps depend on the columns alone: simulate them on the columns first, to see whether all are
    // possible and end.
    first_left_ = l;
    first_right_ = r;
    if (outside || !exchange<false>()) return EdgeStatus::not_possible;
    collect_again(l, r);
    exchange<true>();
    crossed = count_;
    made = made_;
    return EdgeStatus::done;
  }

 private:
  bool left(Int a, Int b, Int c) const { return closed_left(node_[a], node_[b], node_[c]); }
  Int& l_of(Int column) const { return iwk_[2 * (column - 1)]; }
  Int& r_of(Int column) const { return iwk_[2 * (column - 1) + 1]; }
  void set(Int column, Int l, Int r) const {
    l_of(column) = l;
    r_of(column) = r;
  }

  /// Finds the arc r-l opposite p that p-q crosses: the first two adjacent neighbours of p between which q
  /// lies.
  bool find_first(Int& l, Int& r) const {
    lists_.degree(p_);  // the list closes
    Int slot = lists_.first_slot(p_);
    const Int first = lists_.neighbour(slot);
    const auto turn = [&] { return lists_.neighbour(slot = lists_.next(slot)); };
    l = first;
    if (!lists_.on_boundary(p_))
      while (!left(q_, p_, l))
        if ((l = turn()) == first) return false;
    do {
      r = l;
      l = turn();
      if (left(p_, q_, l)) {
        if (between(l, r)) return true;
        if (!left(q_, p_, l)) return false;
      }
    } while (l != first);
    return false;
  }

  /// True if l or r lies on q's side of p, and l or r on p's side of q: the arc l-r meets the arc p-q, not
  /// the rest of its great circle.
  bool between(Int l, Int r) const {
    const auto product = [&](Int a, Int b) { return dot(node_[a], node_[b]); };
    const Real c = product(p_, q_), pl = product(p_, l), ql = product(q_, l), pr = product(p_, r),
               qr = product(q_, r);
    return (ql - c * pl >= 0 || qr - c * pr >= 0) && (pl - c * ql >= 0 || pr - c * qr >= 0);
  }

  /// The third corner of the triangle beyond l-r.
  Int beyond(Int l, Int r) const { return lists_.neighbour(lists_.next(lists_.slot_of(l, r))); }

  /// Walks from arc l-r through the triangles to q. The lists of all corners must close and agree on each
  /// triangle: a node m is used as an index only after the lists of l and r both contain it. `outside`: p,r,l
  /// is not a triangle.
  EdgeStatus collect(Int l, Int r, bool outside) {
    Int base = p_, seen = 0;  // seen: l or r, whichever was an end of the previous column
    for (count_ = 0;;) {
      if (count_ == lwk_) return EdgeStatus::too_few_columns;
      set(++count_, l, r);
      const auto [slot, before] = lists_.find(l, [&](Int s) { return lists_.entry(s) == r; });
      if (lists_.entry(slot) != r) return EdgeStatus::not_found;
      const Int m = lists_.neighbour(lists_.next(slot));
      const auto [l_of_r, m_of_r] = lists_.find(r, [&](Int s) { return lists_.entry(s) == l; });
      if (lists_.neighbour(l_of_r) != l || lists_.entry(m_of_r) != m) throw BrokenLists();
      if (count_ > 1 || !outside) {
        if (lists_.entry(before) != base || !lists_.is_side(l_of_r, l, base) ||
            (count_ == 1 && !lists_.is_side(lists_.slot_of(p_, r), r, l)))
          throw BrokenLists();
      }
      if (l != seen) lists_.go_on_to_last(slot, l);
      if (r != seen) lists_.go_on_to_last(l_of_r, r);
      if (m == q_) {
        const Int l_of_q = lists_.slot_of(q_, l);
        if (!lists_.is_side(l_of_q, l, r)) throw BrokenLists();
        lists_.go_on_to_last(l_of_q, q_);
        return EdgeStatus::done;
      }
      Int& replaced = left(p_, q_, m) ? l : r;
      base = replaced;
      replaced = m;
      seen = m == l ? r : l;
    }
  }
  /// The same columns, from lists that `collect` has checked.
  void collect_again(Int l, Int r) {
    for (Int column = 1; column <= count_; ++column) {
      set(column, l, r);
      const Int m = beyond(l, r);
      (left(p_, q_, m) ? l : r) = m;
    }
  }

  int columns_of(Int a, Int b) const {
    int found = 0;
    for (Int column = 1; column <= count_; ++column)
      found += (l_of(column) == a && r_of(column) == b) || (l_of(column) == b && r_of(column) == a);
    return found;
  }

  /// True if l-r can be swapped for m-base; called before each simulated swap. SWAP refuses if m-base is
  /// already an arc: an arc of the lists that p-q does not cross, or one of the columns. This happens if
  /// triangles overlap, by rounding or by earlier changes; Algorithm 772 then continues with columns that
  /// are no longer arcs. Throws BrokenLists if only one end of m-base lists the other, or lists it twice.
  bool can_join(Int m, Int base, Int l, Int r) const {
    if (columns_of(l, r) != 1 || columns_of(m, base) != 0) return false;
    const Int times = lists_.times(m, base);
    if (times > 1 || lists_.times(base, m) != times) throw BrokenLists();
    return times == 0 || was_crossed(m, base);
  }

  /// True if a-b was in a column before the swaps. Repeats the walk to find out.
  bool was_crossed(Int a, Int b) const {
    Int l = first_left_, r = first_right_;
    for (;;) {
      if ((l == a && r == b) || (l == b && r == a)) return true;
      const Int m = beyond(l, r);
      if (m == q_) return false;
      (left(p_, q_, m) ? l : r) = m;
    }
  }

  /// Sweeps over the columns alpha..omega, whose arcs p-q still crosses, until only one remains, which p-q
  /// replaces. New arcs left of p-q go before alpha, new arcs right of it after omega. `base` is the last
  /// corner that a sweep could not pass, left of the columns (side < 0) or right; initially p.
  ///
  ///           l --- m
  ///         /  \   /             if base, r, m, l is convex by the rounded tests, m-base replaces l-r
  ///     base    \ /
  ///         \___ r
  ///
  /// Returns false if a sweep swaps nothing, if too many consecutive sweeps leave the number of columns
  /// unchanged, or if a swap is impossible; in exact arithmetic this requires a node on the arc p-q.
  template <bool kSwap>
  bool exchange() {
    bool possible = true;
    const auto join = [&](Int m, Int base, Int l, Int r) {
      if constexpr (!kSwap)
        possible = possible && can_join(m, base, l, r);
      else if (lists_.swap(m, base, l, r) == 0)
        throw BrokenLists();
    };
    Int alpha = 1, omega = count_, idle = 0;
    for (;;) {
      const Int columns_before = omega - alpha;
      bool changed = false;  // even if the number of columns has not changed
      Int base = p_, side = 0, column = alpha, l = l_of(column), r = r_of(column);
      while (column != omega) {
        Int m = l_of(column + 1);
        if (m == l) {  // m lies right of p-q
          m = r_of(column + 1);
          const bool convex_at_r = left(base, r, m);
          if (convex_at_r && side >= 0) {
            join(m, base, l, r);
            std::copy(&l_of(column + 1), &l_of(omega) + 2, &l_of(column));
            set(omega--, base, m);
            r = m;
            continue;
          }
          if (convex_at_r && left(l, base, m)) {
            join(m, base, l, r);
            set(column, base, m);
            changed = true;
          } else {
            base = r;
            side = 1;
          }
          r = m;
        } else {  // m lies left of it
          const bool convex_at_l = left(l, base, m);
          if (convex_at_l && side <= 0) {
            join(m, base, l, r);
            std::copy_backward(&l_of(alpha), &l_of(column), &l_of(column) + 2);
            set(alpha++, base, m);
          } else if (convex_at_l && left(base, r, m)) {
            join(m, base, l, r);
            set(column, m, base);
            changed = true;
          } else {
            base = l;
            side = -1;
          }
          l = m;
        }
        ++column;
      }
      // The corner beyond the last arc l-r is q.
      if (base == p_) {
        join(q_, p_, l, r);
        set(column, 0, 0);
        made_ = column;
        return possible;
      }
      if (side > 0 && left(base, r, q_)) {
        join(q_, base, l, r);
        set(omega--, base, q_);
      } else if (side < 0 && left(l, base, q_)) {
        join(q_, base, l, r);
        std::copy_backward(&l_of(alpha), &l_of(omega), &l_of(omega) + 2);
        set(alpha++, base, q_);
      }
      if (!possible) return false;
      if (omega - alpha < columns_before)
        idle = 0;
      else if (!changed || ++idle > count_)
        return false;
    }
  }

  Int p_, q_;
  const Nodes<Real> node_;
  const CheckedEditor<Int>& lists_;
  Int* const iwk_;
  const Int lwk_;
  Int first_left_ = 0, first_right_ = 0;  ///< the first column before the swaps
  Int count_ = 0, made_ = 0;
};

/// EDGE: makes in1-in2 an arc by swapping the arcs that it crosses, and then optimises the new arcs beside
/// it. EDGE is not told N, so it cannot detect in1 or in2 above N. lwk: in, columns of iwk; out, number of
/// arcs crossed (unchanged if there are none, and on errors except optim_failed, not_optimal). iwk, on
/// `done`: the arcs left of in1-in2, a column 0, the arcs right of it; or left and right exchanged.
template <class Real, class Int>
EdgeStatus edge(Int in1, Int in2, const Nodes<Real>& nodes, Int& lwk, Int* iwk,
                const EditedLists<Int>& arrays, OptimFailure<Int>& failure) {
  if (in1 < 1 || in2 < 1 || in1 == in2 || lwk < 0) return EdgeStatus::bad_argument;
  Int unknown = std::numeric_limits<Int>::max();
  return code_or_broken_lists([&] {
    const CheckedEditor<Int> lists({arrays, unknown});
    if (lists.are_neighbours(in1, in2)) return EdgeStatus::done;

    Int crossed, made;
    EdgeStatus status = ArcForcing<Real, Int>(in1, in2, nodes, lists, iwk, lwk).force(crossed, made);
    if (status != EdgeStatus::done) return status;

    lwk = crossed;
    for (const bool before : {true, false}) {
      const Int count = before ? made - 1 : crossed - made;
      if (count == 0) continue;
      Int nit = 4 * count;
      const OptimStatus optimized = code_or_broken_lists(
          [&] { return optimize(lists, nodes, count, nit, before ? iwk : iwk + 2 * made); });
      if (optimized == OptimStatus::not_all) status = EdgeStatus::not_optimal;
      if (optimized == OptimStatus::done || optimized == OptimStatus::not_all) continue;
      failure = {nit, static_cast<Int>(optimized)};
      return EdgeStatus::optim_failed;
    }
    return status;
  });
}

}  // namespace pstripack
