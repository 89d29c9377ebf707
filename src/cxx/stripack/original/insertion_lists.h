#pragma once
// The triangulation that TRMESH builds node by node: STRIPACK's INTADD, BDYADD, COVSPH, SWAP and the swap
// loop of ADDNOD, which together determine which neighbour gets which slot of LIST.
//
// The layout differs from LIST, LPTR and LEND, because memory access dominates the time:
//   - a slot's neighbour and next slot lie side by side, and so do a node's position and last slot;
//   - the two slots of an arc, that of b in the list of a and that of a in the list of b, are 2i and 2i+1.
//     STRIPACK's swap moves both from one arc to another. So no list is ever searched: if (a,b,c) is a
//     triangle,
//
//                   c                   slot of b in the list of a:  s
//                  / \                  slot of c in the list of a:  next(s)
//                 /   \                 slot of a in the list of c:  twin(next(s))
//                a --> b                slot of b in the list of c:  next(twin(next(s)))
//                   s                   .
//
//   - each slot's position in LIST is recorded when the slot comes into use.

#include <cstddef>

#include "base/workspace.h"
#include "stripack/expressions.h"

namespace pstripack {

/// Nodes and slots count from 1, but slots are not those of LIST.
template <class Real, class Int>
class InsertionLists {
 public:
  /// Room for n nodes. Throws std::bad_alloc.
  explicit InsertionLists(Int n)
      : node_(static_cast<std::size_t>(n) + 1),
        slot_(6 * static_cast<std::size_t>(n)),
        place_(6 * static_cast<std::size_t>(n)) {}

  /// Stores the coordinates of a node before it is inserted.
  void place(Int node, const Vector<Real>& position) { node_[index(node)].position = position; }

  Int size() const { return size_; }
  const Vector<Real>& operator[](Int node) const { return node_[index(node)].position; }
  /// The neighbour in a slot; negative if it is the last one of a boundary node.
  Int entry(Int slot) const { return slot_[index(slot)].entry; }
  Int neighbour(Int slot) const { return entry(slot) < 0 ? -entry(slot) : entry(slot); }
  Int next(Int slot) const { return slot_[index(slot)].next; }
  /// The slot of a in the list of b, where `slot` is that of b in the list of a.
  static Int twin(Int slot) { return slot ^ 1; }
  /// The slot of c in the list of b, given the slot of b in the list of a, where a, c, b is a triangle.
  Int slot_of_third(Int /*a*/, Int b_of_a, Int /*b*/, Int /*c*/) const { return next(twin(b_of_a)); }
  Int last_slot(Int node) const { return node_[index(node)].last_slot; }
  Int first_slot(Int node) const { return next(last_slot(node)); }
  Int first_neighbour(Int node) const { return neighbour(first_slot(node)); }
  Int last_neighbour(Int node) const { return neighbour(last_slot(node)); }
  template <class Visit>
  void for_each_neighbour(Int node, const Visit& visit) const {
    const Int last = last_slot(node);
    Int slot = last;
    do {
      slot = next(slot);
      visit(neighbour(slot));
    } while (slot != last);
  }

  [[gnu::always_inline]] void prefetch(Int node) const { __builtin_prefetch(&node_[index(node)]); }
  bool is_in_few_slots(Int /*node*/, Int& /*first*/, Int& /*last*/) const { return false; }
  [[gnu::always_inline]] void prefetch_list(Int node) const {
    __builtin_prefetch(&slot_[index(last_slot(node))]);
  }

  void start(bool is_counterclockwise) {
    const Int corner[3] = {is_counterclockwise ? Int{1} : Int{2}, is_counterclockwise ? Int{2} : Int{1}, 3};
    for (Int i = 0; i < 3; ++i) {
      const Int a = corner[i], b = corner[(i + 1) % 3];
      const Int to_b = 2 * i + kFirst, to_a = twin(to_b), to_c = twin(2 * ((i + 2) % 3) + kFirst);
      slot_[index(to_b)] = {b, to_c};
      slot_[index(to_a)] = {-a, 2 * ((i + 1) % 3) + kFirst};
      node_[index(a)].last_slot = to_c;
      place_[index(to_b)] = 2 * a - 1;
      place_[index(to_a)] = 2 * b;
    }
    size_ = 3;
    end_ = 6 + kFirst;
  }

  /// INTADD: the next node, k, lies in the triangle left of a->b. b_of_a: the slot of b in the list of a.
  ///
  ///            c
  ///           /|\        new slots, in the order of LIST: k in the lists of a, b, c;
  ///          / k \       a, b, c in the list of k
  ///         /.' '.\      .
  ///        a-------b
  void insert_inside(Int b_of_a) {
    const Int k = ++size_, first = end_;
    const Int c_of_a = next(b_of_a), b_of_c = next(twin(c_of_a));
    append(k, b_of_a);
    append(k, twin(b_of_c));
    append(k, twin(c_of_a));
    finish_list(k, first);
  }

  /// BDYADD: the next node, k, lies outside and sees the boundary from `rightmost` clockwise to `leftmost`,
  /// which differ.
  ///
  ///                    k
  ///                .  / \  .
  ///             .    /   \    .
  ///     leftmost----v2---v1----rightmost     v1 and v2 become interior
  void insert_outside(Int rightmost, Int leftmost) {
    const Int k = ++size_, first = end_;
    Int last = last_slot(rightmost);
    Int v = open(last);
    append(-k, last);
    node_[index(rightmost)].last_slot = first;
    for (;; v = open(last)) {
      last = last_slot(v);
      append(k, last);
      if (v == leftmost) break;
    }
    finish_list(k, first);
    slot_[index(last_slot(k))].entry = -leftmost;
  }

  /// COVSPH: the next node sees the whole boundary; `start` is any boundary node. Then the triangles cover
  /// the sphere.
  void cover(Int start) {
    const Int k = ++size_, first = end_;
    Int v = start;
    do {
      const Int last = last_slot(v);
      append(k, last);
      v = open(last);
    } while (v != start);
    finish_list(k, first);
  }

  /// The swaps of ADDNOD that restore the Delaunay property around the last node, k: tests the arcs opposite
  /// k, counterclockwise. False if the number of swaps exceeds that of slots.
  ///
  ///           v                   v
  ///          /|\                 / \        if w is above the plane of (k,u,v): k-w for u-v;
  ///         k | w     ->        k---w       then the arcs u-w and w-v are opposite to k
  ///          \|/                 \ /        .
  ///           u                   u
  bool restore_delaunay() {
    const Int k = size_;
    const Vector<Real> position = (*this)[k];
    const Int first = first_slot(k);
    Int u_of_k = first, v_of_k = next(first);
    Int u = neighbour(u_of_k), v = neighbour(v_of_k);
    for (Int swaps = 0; swaps < end_;) {
      const Int u_of_v = next(twin(v_of_k));
      if (entry(u_of_v) >= 0) {
        const Int w_of_v = next(u_of_v), w = neighbour(w_of_v);
        if (height((*this)[w], position, (*this)[v], (*this)[u]) > 0 && !are_adjacent(k, w)) {
          swap(u_of_k, v_of_k, u, v, w);
          ++swaps;
          v = w;
          v_of_k = twin(u_of_v);
          continue;
        }
      }
      if (v_of_k == first || entry(v_of_k) < 0) return true;
      u = v;
      u_of_k = v_of_k;
      v_of_k = next(v_of_k);
      v = neighbour(v_of_k);
    }
    return false;
  }

  std::size_t slots() const { return index(end_ - kFirst); }
  /// Writes LIST and LPTR, with slots() entries, and LEND.
  void write(Int* list, Int* lptr, Int* lend) const {
    for (Int s = kFirst; s < end_; ++s) {
      const std::size_t to = index(place_[index(s)] - 1);
      list[to] = entry(s);
      lptr[to] = place_[index(next(s))];
    }
    for (Int k = 1; k <= size_; ++k) lend[k - 1] = place_[index(last_slot(k))];
  }

 private:
  static constexpr Int kFirst = 2;  ///< the first slot
  struct Node {
    Vector<Real> position;
    Int last_slot;
  };
  struct Slot {
    Int entry, next;
  };

  static std::size_t index(Int i) { return static_cast<std::size_t>(i); }

  /// A new arc: the slot with to_k (k or -k) goes after `slot`; the slot back is linked later, by
  /// finish_list.
  void append(Int to_k, Int slot) {
    Slot& before = slot_[index(slot)];
    slot_[index(end_)] = {to_k, before.next};
    before.next = end_;
    slot_[index(end_ + 1)] = {neighbour(twin(slot)), 0};
    end_ += 2;
  }
  /// Links the list of k: the slots back of the arcs from slot `first` on.
  void finish_list(Int k, Int first) {
    const Int count = (end_ - first) / 2, place = first - kFirst + 1;
    for (Int i = 0; i < count; ++i) {
      const Int to_k = first + 2 * i, back = twin(to_k);
      slot_[index(back)].next = back + 2;
      place_[index(to_k)] = place + i;
      place_[index(back)] = place + count + i;
    }
    slot_[index(end_ - 1)].next = twin(first);
    node_[index(k)].last_slot = end_ - 1;
  }
  /// Makes a boundary node, given by its last slot, interior; returns the boundary node before it.
  Int open(Int last) { return slot_[index(last)].entry = neighbour(last); }

  bool are_adjacent(Int a, Int b) const {
    // Step through both lists alternately, so that a node with many neighbours does not matter.
    const Int last_of_a = last_slot(a), last_of_b = last_slot(b);
    Int of_a = last_of_a, of_b = last_of_b;
    do {
      of_a = next(of_a);
      of_b = next(of_b);
      if (neighbour(of_a) == b || neighbour(of_b) == a) return true;
    } while (of_a != last_of_a && of_b != last_of_b);
    return false;
  }

  /// SWAP: replaces u-v by k-w, where k is the last node. u_of_k, v_of_k: slots of u and v in the list of k.
  void swap(Int u_of_k, Int v_of_k, Int u, Int v, Int w) {
    const Int k_of_v = twin(v_of_k), u_of_v = next(k_of_v), v_of_u = twin(u_of_v);
    const Int v_of_w = twin(next(u_of_v)), w_of_u = twin(next(v_of_w));
    unlink(u_of_v, k_of_v, v);
    link(u_of_v, size_, v_of_w);
    unlink(v_of_u, w_of_u, u);
    link(v_of_u, w, u_of_k);
  }
  void unlink(Int slot, Int before, Int node) {
    slot_[index(before)].next = next(slot);
    if (last_slot(node) == slot) node_[index(node)].last_slot = before;
  }
  void link(Int slot, Int entry, Int before) {
    slot_[index(slot)] = {entry, next(before)};
    slot_[index(before)].next = slot;
  }

  BlockArray<Node> node_;
  BlockArray<Slot> slot_;
  BlockArray<Int> place_;  ///< by slot: its position in LIST
  Int size_ = 0, end_ = kFirst;
};

}  // namespace pstripack
