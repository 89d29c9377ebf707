#pragma once
// TRFIND's search by rounded tests, step by step as in the original.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "stripack/expressions.h"
#include "stripack/search.h"

namespace pstripack {

/// Limits of a search. The original has none: its search ends soon, or after some restarts, or never.
struct SearchLimits {
  std::int64_t steps;   ///< arcs crossed; a search that makes progress crosses each arc once at most
  std::int64_t starts;  ///< restarts at random nodes

  /// Limits within which a search ends wherever the original's does: a million steps for restarts.
  static SearchLimits to_follow(std::int64_t nodes) { return {4 * nodes + 1'000'000, INT64_MAX}; }
};

template <class Real>
struct Weights {
  Real &b1, &b2, &b3;
};

/// Sets b1 and b2, the weights of a and b. Sets b3 = 0 if p is so close to the arc a-b that it counts as
/// lying on it. Requires b3 = side(a,b,p) >= 0. c: the third corner.
template <class Real>
void weigh(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c, const Vector<Real>& p,
           const Weights<Real>& weights) {
  if (weights.b3 >= std::numeric_limits<Real>::epsilon()) {
    weights.b1 = side(b, c, p);
    weights.b2 = side(c, a, p);
  } else {
    const Real cosine = dot(a, b), to_a = dot(p, a), to_b = dot(p, b);
    weights.b1 = to_a - cosine * to_b;
    weights.b2 = to_b - cosine * to_a;
    weights.b3 = 0;
  }
}

/// TRFIND's search. Names: o is the node from which the search looks; r and l are the right and left end of
/// the arc through which it looks; l_of_o is the slot of l in the list of o; side(a,b) > 0 if p lies left
/// of a->b. Lists has the interface of ListReader and InsertionLists; lists[node] is a position;
/// slot_of_third(o, l_of_o, l, r) is the slot of r in the list of l if o, r, l is a triangle. draw(n)
/// returns a random node of 1..n.
template <class Real, class Int, class Lists, class Draw>
class TrfindWalk {
 public:
  TrfindWalk(const Vector<Real>& p, const Lists& lists, Real tolerance, SearchLimits limits,
             const Weights<Real>& weights, Draw draw)
      : p_(p), lists_(lists), tolerance_(tolerance), left_(limits), weights_(weights), draw_(draw) {}

  /// False if the limits are reached. `found` as TRFIND returns it, all 0 if all nodes are collinear. `o`:
  /// the start node; on return the last node from which the search looked. Writes the same weights as the
  /// original.
  bool find(Int& o, Location<Int>& found) {
    while (affordable()) {
      Int r, l, l_of_o;
      switch (look_out(o, r, l, l_of_o)) {
        case View::wedge:
          switch (walk(o, r, l, l_of_o, found)) {
            case Walk::arrived:
              return true;
            case Walk::left_the_hull:
              return see_boundary(r, l, found);
            case Walk::astray:
              if (--left_.starts < 0) return false;
              o = draw_(lists_.size());
          }
          break;
        case View::outside:
          return see_boundary(r, l, found);
        case View::move_on:
          break;
        case View::collinear:
          found = {0, 0, 0};
          return true;
      }
    }
    return false;
  }
  /// The slot of i1 in the list of i2, for the triangle that find() has found. If no arc was crossed the
  /// slot is not known yet; looking it up reads another list, so this is done on request only.
  Int slot_found() const {
    if (found_.slot != 0) return found_.slot;
    return lists_.slot_of_third(found_.behind, found_.l_of_behind, found_.l, found_.r);
  }

 private:
  enum class View { wedge, outside, move_on, collinear };
  enum class Walk { arrived, left_the_hull, astray };
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

  bool affordable() { return --left_.steps >= 0; }
  Real side(Int a, Int b) const { return pstripack::side(lists_[a], lists_[b], p_); }
  Real dot_p(Int a) const { return pstripack::dot(p_, lists_[a]); }

  /// Finds the same wedge as look_out, by testing all neighbours without a branch between them, so that all
  /// positions are loaded at once and no branch is mispredicted. The list of o must be in slots first..last.
  /// False if there is no wedge or o is on the boundary: then look_out has to search.
  bool find_wedge(Int o, Int first, Int last, Int& r, Int& l, Int& l_of_o) const {
    if (lists_.entry(last) < 0) return false;
    const int count = static_cast<int>(last - first) + 1;
    unsigned right = 0;  // bit i: p lies right of the arc from o to its i-th neighbour
    for (int i = 0; i < count; ++i)
      right |= static_cast<unsigned>(side(o, lists_.neighbour(first + i)) < 0) << i;
    const int not_right = __builtin_ctz(~right | 1u << (count - 1));  // the last one if there is none
    const unsigned right_after = (right & (~1u << not_right)) | (right & 1) << count;
    if (right_after == 0) return false;
    const int i = __builtin_ctz(right_after);
    r = lists_.neighbour(first + i - 1);
    l_of_o = i == count ? first : first + i;
    l = lists_.neighbour(l_of_o);
    return true;
  }

  /// Finds adjacent neighbours r, l of o between which p lies, or a boundary arc r->l with p to its right.
  View look_out(Int& o, Int& r, Int& l, Int& l_of_o) const {
    Int begin, end;
    if (lists_.is_in_few_slots(o, begin, end) && find_wedge(o, begin, end, r, l, l_of_o)) return View::wedge;
    const Int last_slot = lists_.last_slot(o), first_slot = lists_.next(last_slot);
    const Int last = lists_.neighbour(last_slot), first = lists_.neighbour(first_slot);
    Int slot = first_slot;
    r = first;
    if (lists_.entry(last_slot) < 0) {
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
          l_of_o = first_slot;
          return View::wedge;
        }
      }
    }
    do {
      slot = lists_.next(slot);
      l = lists_.neighbour(slot);
      l_of_o = slot;
      if (side(o, l) < 0) return View::wedge;
      r = l;
    } while (r != last);
    l = first;
    l_of_o = first_slot;
    if (side(o, first) < 0) return View::wedge;

    // p is not strictly right of any arc from o: it is collinear with one, or it is o or the antipode of o.
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
  ///
  ///        beyond            m_of_l, the slot of `beyond` in the list of l, follows that of r. The next arc
  ///        is /    \            r-beyond if p lies right of o->beyond, else beyond-l
  ///       l ---- r           .
  ///        \    /
  ///        behind
  Walk walk(Int o, Int& r, Int& l, Int l_of_o, Location<Int>& found) {
    Int behind = o, first_r = r, first_l = l;
    Int r_of_l = 0;
    while ((weights_.b3 = side(r, l)) < 0) {
      if (r_of_l == 0) r_of_l = lists_.slot_of_third(o, l_of_o, l, r);
      if (lists_.entry(r_of_l) < 0) return Walk::left_the_hull;
      const Int m_of_l = lists_.next(r_of_l), beyond = lists_.neighbour(m_of_l);
      lists_.prefetch_list(beyond);  // while we wait for its position
      if (side(o, beyond) < 0) {
        behind = l;
        r_of_l = lists_.slot_of_third(l, m_of_l, beyond, r);
        l = beyond;
        first_r = r;
        if (l == first_l || l == o) return Walk::astray;
      } else {
        behind = r;
        r_of_l = m_of_l;
        r = beyond;
        first_l = l;
        if (r == first_r || r == o) return Walk::astray;
      }
      if (!affordable()) return Walk::astray;
    }
    weigh(lists_[r], lists_[l], lists_[behind], p_, weights_);
    if (weights_.b1 < -tolerance_ || weights_.b2 < -tolerance_) return Walk::astray;
    weights_.b1 = std::max(weights_.b1, Real(0));
    weights_.b2 = std::max(weights_.b2, Real(0));
    found = {r, l, behind};
    found_ = {r, l, behind, l_of_o, r_of_l};
    return Walk::arrived;
  }

  /// True if the boundary node `end` is an end of the visible part of the boundary, given that the arc from
  /// `end` to the next node, `further`, is not strictly visible. Let c be the part of `start` perpendicular
  /// to `end`: p or `further` must lie on the side of c. Otherwise all are nearly collinear and the search
  /// continues.
  bool ends_view(Int start, Int end, Int further) const {
    const Vector<Real> s = lists_[start], e = lists_[end];
    const Real cosine = pstripack::dot(s, e);
    const Vector<Real> c{s.x - cosine * e.x, s.y - cosine * e.y, s.z - cosine * e.z};
    return pstripack::dot(p_, c) >= 0 || pstripack::dot(lists_[further], c) >= 0;
  }

  /// Finds the ends of the part of the boundary visible from p, given one visible arc r->l. False if the
  /// limits are reached.
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

  const Vector<Real> p_;
  const Lists& lists_;
  const Real tolerance_;
  SearchLimits left_;
  const Weights<Real> weights_;
  Draw draw_;
  struct {
    Int r, l, behind, l_of_behind;
    Int slot;  ///< of r in the list of l; 0: not looked for
  } found_{};
};

}  // namespace pstripack
