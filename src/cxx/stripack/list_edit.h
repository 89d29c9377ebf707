#pragma once
// INSERT, INTADD, BDYADD, COVSPH, SWAP, DELNB: the steps of which every change of a triangulation consists
// (Renka, ACM TOMS 23 (1997), Algorithm 772). They determine which slot holds which neighbour, and so the
// lists that the other editing routines return.
//
// For Int = int32_t, int64_t. Nodes and slots count from 1; k is the node that is added.

#include <cstddef>
#include <limits>

#include "capi/pstripack.h"
#include "lists/limits.h"

namespace pstripack {

/// A caller's LIST, LPTR, LEND, LNEW, to be changed. n: number of nodes for which there is room; LIST and
/// LPTR have 6n-12 slots. If the routine is not told N (SWAP, OPTIM, EDGE), lnew is null and n the largest
/// Int.
template <class Int>
struct EditedLists {
  Int n;
  Int* list;
  Int* lptr;
  Int* lend;
  Int* lnew;

  static EditedLists unbounded(Int* list, Int* lptr, Int* lend) {
    return {std::numeric_limits<Int>::max(), list, lptr, lend, nullptr};
  }
};

/// Code for lists that are not those of a triangulation: a slot or neighbour is out of range, or a list or
/// the boundary does not close.
constexpr int broken_lists = PSTRIPACK_BAD_LISTS;

/// Thrown where the routine would otherwise read or write outside the arrays, or loop for ever.
struct BrokenLists {};

/// Runs edit() and returns its code; broken_lists if it throws BrokenLists.
template <class Edit>
auto code_or_broken_lists(const Edit& edit) -> decltype(edit()) {
  try {
    return edit();
  } catch (const BrokenLists&) {
    return static_cast<decltype(edit())>(broken_lists);
  }
}

/// Checked access to the arrays: throws BrokenLists if an index is out of range. If N and LNEW are unknown,
/// only numbers below 1 are out of range: SECURITY.md explains what else is checked, and what cannot be.
template <class Int>
class CheckedArrays {
 public:
  using Index = Int;

  /// Counts slots in `lnew`, which is the caller's LNEW or a copy. `nodes`: number of nodes that have
  /// lists, if not n.
  CheckedArrays(const EditedLists<Int>& lists, Int& lnew) : CheckedArrays(lists, lnew, lists.n) {}
  CheckedArrays(const EditedLists<Int>& lists, Int& lnew, Int nodes)
      : lists_(lists), lnew_(lnew), nodes_(nodes) {
    most_slots_ = lists.n <= most_nodes<Int>() ? 6 * lists.n - 12 : std::numeric_limits<Int>::max() - 1;
    in(1, lnew, most_slots_ + 1);
  }

  Int& list(Int slot) const { return lists_.list[in(1, slot, lnew_ - 1) - 1]; }
  Int& lptr(Int slot) const { return lists_.lptr[in(1, slot, lnew_ - 1) - 1]; }
  Int& lend(Int node) const { return lists_.lend[checked_node(node) - 1]; }
  Int lnew() const { return lnew_; }
  void set_lnew(Int lnew) const { lnew_ = lnew; }
  Int nodes() const { return nodes_; }
  Int checked_node(Int node) const { return in(1, node, nodes_); }
  /// Throws unless there is room for `slots` further slots.
  void reserve(Int slots) const { in(0, slots, most_slots_ + 1 - lnew_); }

 private:
  static Int in(Int least, Int value, Int most) {
    if (value < least || value > most) throw BrokenLists();
    return value;
  }

  const EditedLists<Int> lists_;
  Int& lnew_;
  Int nodes_, most_slots_;
};

/// Finds that a walk in lists does not close, after at most three times as many steps as there are different
/// slots on the way (cycle detection: R. P. Brent, BIT 20, 1980).
template <class Int>
class LoopGuard {
 public:
  bool is_loop(Int slot) {
    if (slot == mark_) return true;
    if (++steps_ < lap_) return false;
    mark_ = slot;
    lap_ *= 2;
    steps_ = 0;
    return false;
  }
  /// Throws BrokenLists instead.
  void pass(Int slot) {
    if (is_loop(slot)) throw BrokenLists();
  }

 private:
  Int mark_ = 0;
  std::size_t steps_ = 0, lap_ = 16;
};

template <class Arrays>
class ListEditor {
 public:
  using Int = typename Arrays::Index;

  explicit ListEditor(const Arrays& arrays) : arrays_(arrays) {}

  Int lnew() const { return arrays_.lnew(); }
  /// The largest node number known to exist; 0 if N is unknown.
  Int known_node() const { return arrays_.nodes() < std::numeric_limits<Int>::max() ? arrays_.nodes() : 0; }
  /// The neighbour in a slot; negative if it is the last one of a boundary node.
  Int& entry(Int slot) const { return arrays_.list(slot); }
  Int neighbour(Int slot) const {
    const Int node = entry(slot);
    return arrays_.checked_node(node < -std::numeric_limits<Int>::max() ? 0 : node < 0 ? -node : node);
  }
  Int& next(Int slot) const { return arrays_.lptr(slot); }
  Int& last_slot(Int node) const { return arrays_.lend(node); }
  Int first_slot(Int node) const { return next(last_slot(node)); }
  Int first_neighbour(Int node) const { return neighbour(first_slot(node)); }
  Int last_neighbour(Int node) const { return neighbour(last_slot(node)); }
  bool on_boundary(Int node) const { return entry(last_slot(node)) < 0; }

  struct Place {
    Int slot, before;
  };
  /// The first slot in a node's list, counted from its first neighbour, that satisfies `wanted`, and the slot
  /// before it. The last slot if none satisfies it.
  template <class Wanted>
  Place find(Int node, const Wanted& wanted) const {
    const Int last = last_slot(node);
    Int before = last, slot = next(last);
    for (LoopGuard<Int> guard; slot != last && !wanted(slot); slot = next(slot)) {
      guard.pass(slot);
      before = slot;
    }
    return {slot, before};
  }
  /// LSTPTR.
  Int slot_of(Int node, Int wanted) const {
    return find(node, [&](Int slot) { return entry(slot) == wanted; }).slot;
  }
  bool are_neighbours(Int node, Int other) const { return neighbour(slot_of(node, other)) == other; }
  /// The slot of b in a node's list, in which a, b, c follow each other; throws BrokenLists if they do not.
  Place between(Int a, Int b, Int c, Int node) const {
    const Place place = find(node, [&](Int slot) { return entry(slot) == b; });
    if (entry(place.before) != a || entry(place.slot) != b || neighbour(next(place.slot)) != c)
      throw BrokenLists();
    return place;
  }
  /// True if a slot holds a and the next slot b: then a, b and the owner of the list form a triangle.
  bool is_side(Int slot, Int a, Int b) const {
    return entry(slot) == a && (entry(next(slot)) == b || entry(next(slot)) == -b);
  }
  /// Advances from a slot to the last slot of a node; throws BrokenLists if it is not reached.
  void go_on_to_last(Int slot, Int node) const {
    const Int last = last_slot(node);
    for (LoopGuard<Int> guard; slot != last; slot = next(slot)) guard.pass(slot);
  }
  Int degree(Int node) const {
    Int count = 1;
    find(node, [&](Int) {
      ++count;
      return false;
    });
    return count;
  }
  /// Number of times that a node's list contains another: 0 or 1 in a triangulation.
  Int times(Int node, Int other) const {
    Int count = last_neighbour(node) == other ? 1 : 0;
    find(node, [&](Int slot) {
      if (entry(slot) == other) ++count;
      return false;
    });
    return count;
  }

  // ---- nodes are added ----

  /// INSERT: k becomes the neighbour after the one in slot `before`.
  void insert(Int k, Int before) const {
    arrays_.reserve(1);
    const Int after = next(before);
    next(before) = lnew();
    append(k, after);
  }

  /// INTADD: k in the triangle i1, i2, i3.
  void add_inside(Int k, Int i1, Int i2, Int i3) const {
    arrays_.checked_node(k);
    arrays_.reserve(6);
    const Int before[3] = {slot_of(i1, i2), slot_of(i2, i3), slot_of(i3, i1)};
    for (const Int slot : before) insert(k, slot);
    const Int own = lnew();
    append(i1, own + 1);
    append(i2, own + 2);
    append(i3, own);
    last_slot(k) = own + 2;
  }

  /// BDYADD: k outside the hull, where it sees the boundary from i1, the rightmost node, clockwise to i2.
  ///
  ///               k
  ///           .  / \  .                     the hull is below; i1 keeps its first neighbour and i2 its
  ///       .     /   \     .                 last one, the nodes between become interior ones
  ///   i2 ----- w --- v ----- i1
  ///  /                         \  .
  void add_outside(Int k, Int i1, Int i2) const {
    arrays_.checked_node(k);
    arrays_.reserve(2 * visible_nodes(k, i1, i2));

    const Int last = last_slot(i1), first = next(last);
    const Int v1 = neighbour(last);
    entry(last) = v1;
    next(last) = lnew();
    last_slot(i1) = lnew();
    append(-k, first);
    for (Int v = v1;;) {
      const Int slot = last_slot(v);
      insert(k, slot);
      if (v == i2) break;
      v = entry(slot) = neighbour(slot);
    }

    const Int own = lnew();
    append(i1, own + 1);
    for (Int v = v1; v != i2; v = last_neighbour(v)) append(v, lnew() + 1);
    append(-i2, own);
    last_slot(k) = lnew() - 1;
  }

  /// COVSPH: k sees the whole boundary, of which n0 is a node; afterwards the triangles cover the sphere.
  void cover_sphere(Int k, Int n0) const {
    arrays_.checked_node(k);
    arrays_.reserve(2 * (visible_nodes(k, n0, n0) - 1));

    Int v = n0;
    do {
      const Int slot = last_slot(v);
      insert(k, slot);
      v = entry(slot) = neighbour(slot);
    } while (v != n0);

    const Int own = lnew();
    do {
      append(v, lnew() + 1);
      v = last_neighbour(v);
    } while (v != n0);
    last_slot(k) = lnew() - 1;
    next(last_slot(k)) = own;
  }

  // ---- arcs are swapped and removed ----

  /// SWAP: replaces the diagonal io1-io2 of a quadrilateral by in1-in2. Returns the slot of in1 in the list
  /// of in2; 0, with nothing changed, if these are already neighbours.
  ///
  ///           io2                       io2
  ///          / | \                     /   \                     .
  ///       in1  |  in2      ->       in1 --- in2
  ///          \ | /                     \   /
  ///           io1                       io1
  ///
  /// If N is unknown, writes nothing before the lists of all four nodes have shown both triangles, and only
  /// to slots that held one of the four.
  Int swap(Int in1, Int in2, Int io1, Int io2) const {
    if (known_node() == 0) return swap_in_triangles(in1, in2, io1, io2);
    if (are_neighbours(in1, in2)) return 0;
    const auto after = [&](Int node, Int other) {
      const Int before = slot_of(node, other);
      return Place{next(before), before};
    };
    move(io1, after(io1, in2), slot_of(in1, io1), in2);
    const Place of_io1 = after(io2, in1);
    move(io2, of_io1, slot_of(in2, io2), in1);
    return of_io1.slot;
  }

  /// DELNB: removes nb from the list of n0, not n0 from the list of nb. The top slot moves into the freed
  /// slot. Returns the latter; -2, with nothing changed, if nb is no neighbour of n0.
  Int remove_neighbour(Int n0, Int nb) const {
    const auto [slot, before] = find(n0, [&](Int s) { return entry(s) == nb; });
    const Int last = last_slot(n0);
    if (slot == last) {
      if (neighbour(slot) != nb) return -2;
      if (on_boundary(nb)) entry(before) = -neighbour(before);
      last_slot(n0) = before;
    } else if (on_boundary(nb) && entry(last) > 0) {
      entry(before) = -neighbour(before);
      last_slot(n0) = before;
    }
    next(before) = next(slot);
    move_top_to(slot, [&, hole = slot](Int top) {
      // Search nb's list first: it may use the top slot although n0 no longer lists nb.
      if (!redirect_in(nb, top, hole)) redirect(top, hole);
    });
    return slot;
  }

  /// Moves the top slot to `hole`, which is in no list. redirect(top) must then make what points to `top`
  /// point to `hole`.
  template <class Redirect>
  void move_top_to(Int hole, const Redirect& redirect) const {
    const Int top = lnew() - 1;
    entry(hole) = entry(top);
    next(hole) = next(top);
    if (hole != top) redirect(top);
    arrays_.set_lnew(top);
  }
  /// Redirects the pointers to slot `from` in a node's list to slot `to`. False if `from` is not in that
  /// list.
  bool redirect_in(Int node, Int from, Int to) const {
    const auto [slot, before] = find(node, [&](Int s) { return s == from; });
    if (slot != from) return false;
    if (last_slot(node) == from) last_slot(node) = to;
    next(before == from ? to : before) = to;
    return true;
  }
  /// The same, whichever list `from` is in. The neighbour b in that slot lists the owner of the slot, so
  /// the owner is found in O(degree squared). During a change b may not list the owner: then all slots are
  /// searched.
  void redirect(Int from, Int to) const {
    const Int b = neighbour(from);
    const Int owner = find(b, [&](Int slot) { return redirect_in(neighbour(slot), from, to); }).slot;
    if (owner == last_slot(b) && !redirect_in(neighbour(owner), from, to)) redirect_anywhere(from, to);
  }

 private:
  void append(Int neighbour, Int after) const {
    const Int slot = lnew();
    arrays_.set_lnew(slot + 1);
    entry(slot) = neighbour;
    next(slot) = after;
  }

  /// Number of boundary nodes from i1 clockwise to i2, both included.
  Int visible_nodes(Int k, Int i1, Int i2) const {
    Int count = 1, v = i1;
    do {
      if (!on_boundary(v) || ++count > k) throw BrokenLists();
      v = last_neighbour(v);
    } while (v != i2);
    if (!on_boundary(i2)) throw BrokenLists();
    return count;
  }

  Int swap_in_triangles(Int in1, Int in2, Int io1, Int io2) const {
    Int to_io1 = last_slot(in1);
    const Int to_in2 = find(in1, [&](Int slot) {
                         if (is_side(slot, io1, io2)) to_io1 = slot;
                         return entry(slot) == in2;
                       }).slot;
    if (neighbour(to_in2) == in2) return 0;
    const Int to_io2 = find(in2, [&](Int slot) { return is_side(slot, io2, io1); }).slot;
    if (!is_side(to_io1, io1, io2) || !is_side(to_io2, io2, io1)) throw BrokenLists();
    const Place of_io2 = between(in2, io2, in1, io1), of_io1 = between(in1, io1, in2, io2);
    move(io1, of_io2, to_io1, in2);
    move(io2, of_io1, to_io2, in1);
    return of_io1.slot;
  }

  /// Moves a slot from the list of `node` to another list, after the slot `before`; it then holds c.
  void move(Int node, const Place& place, Int before, Int c) const {
    const Int slot = place.slot;
    next(place.before) = next(slot);
    if (last_slot(node) == slot) last_slot(node) = place.before;
    next(slot) = next(before);
    next(before) = slot;
    entry(slot) = c;
  }

  void redirect_anywhere(Int from, Int to) const {
    Int node = arrays_.nodes();
    while (node >= 1 && last_slot(node) != from) --node;
    if (node >= 1) last_slot(node) = to;
    for (Int slot = 1; slot < lnew() - 1; ++slot)
      if (next(slot) == from) next(slot) = to;
  }

  const Arrays arrays_;
};

template <class Int>
using CheckedEditor = ListEditor<CheckedArrays<Int>>;

// The routines. Each returns 0 or broken_lists. On broken_lists nothing is changed, except by `delnb`.

/// Values of DELNB's LPH other than the freed slot.
constexpr int no_such_node = -1, no_neighbour = -2;

/// Runs change(editor), which counts slots in the caller's LNEW.
template <class Int, class Change>
int edit(const EditedLists<Int>& lists, const Change& change) {
  return code_or_broken_lists([&] {
    change(CheckedEditor<Int>({lists, *lists.lnew}));
    return 0;
  });
}

/// INSERT: ListEditor::insert.
template <class Int>
int insert(Int k, Int lp, const EditedLists<Int>& lists) {
  return edit(lists, [&](const auto& editor) { editor.insert(k, lp); });
}

/// INTADD: ListEditor::add_inside for k = lists.n; i1, i2, i3 is counterclockwise.
template <class Int>
int intadd(Int i1, Int i2, Int i3, const EditedLists<Int>& lists) {
  return edit(lists, [&](const auto& editor) { editor.add_inside(lists.n, i1, i2, i3); });
}

/// BDYADD: ListEditor::add_outside for k = lists.n; i1 and i2 differ.
template <class Int>
int bdyadd(Int i1, Int i2, const EditedLists<Int>& lists) {
  return edit(lists, [&](const auto& editor) { editor.add_outside(lists.n, i1, i2); });
}

/// COVSPH: ListEditor::cover_sphere for k = lists.n.
template <class Int>
int covsph(Int n0, const EditedLists<Int>& lists) {
  return edit(lists, [&](const auto& editor) { editor.cover_sphere(lists.n, n0); });
}

/// SWAP: replaces arc io1-io2, where io1, io2, in1 and io2, io1, in2 are counterclockwise triangles, by
/// in1-in2. `slot`: the slot of in1 in the list of in2; 0, with nothing changed, if they are already
/// neighbours.
template <class Int>
int swap(Int in1, Int in2, Int io1, Int io2, const EditedLists<Int>& lists, Int& slot) {
  Int unknown = std::numeric_limits<Int>::max();
  return code_or_broken_lists([&] {
    slot = CheckedEditor<Int>({lists, unknown}).swap(in1, in2, io1, io2);
    return 0;
  });
}

/// DELNB: removes nb from the list of n0, but not n0 from that of nb. `slot`: the freed slot, into which the
/// top slot moved; or no_such_node or no_neighbour, with nothing changed. O(degree squared); the original
/// searches all slots.
template <class Int>
int delnb(Int n0, Int nb, const EditedLists<Int>& lists, Int& slot) {
  const Int n = lists.n;
  if (n0 < 1 || n0 > n || nb < 1 || nb > n || n < 3) {
    slot = no_such_node;
    return 0;
  }
  return edit(lists, [&](const auto& editor) { slot = editor.remove_neighbour(n0, nb); });
}

}  // namespace pstripack
