#pragma once
// LSTPTR, NBCNT and other queries on LIST, LPTR, LEND. Slots and nodes count from 1.

#include <cstddef>

#include "lists/adjacency_lists.h"

namespace pstripack {

/// LSTPTR: the slot of neighbour `wanted` in the list whose last slot is `last`; `last` itself if `wanted`
/// is the last neighbour or not in the list. O(degree): the arguments do not show whether the lists are
/// canonical, where a table of slots would make it O(1).
template <class Int>
Int lstptr(Int last, Int wanted, const Int* list, const Int* lptr) {
  Int slot = lptr[last - 1];
  while (slot != last && list[slot - 1] != wanted) slot = lptr[slot - 1];
  return slot;
}

/// NBCNT: the number of neighbours in the list that `last` belongs to.
template <class Int>
Int nbcnt(Int last, const Int* lptr) {
  Int count = 1;
  for (Int slot = lptr[last - 1]; slot != last; slot = lptr[slot - 1]) ++count;
  return count;
}

/// The lists of a triangulation, indexed by the caller's numbers.
template <class Int>
class ListReader {
 public:
  /// Copies member by member: a caller has just written `lists` in parts of 8 bytes, and reading parts of
  /// 16 bytes would stall (no store forwarding).
  explicit ListReader(const ListsView<Int>& lists)
      : lists_{lists.n, lists.list, lists.lptr, lists.lend, lists.lnew} {}

  const ListsView<Int>& view() const { return lists_; }
  Int size() const { return static_cast<Int>(lists_.n); }
  /// The neighbour in a slot; negative if it is the last one of a boundary node.
  Int entry(Int slot) const { return lists_.list[slot - 1]; }
  Int neighbour(Int slot) const { return entry(slot) < 0 ? -entry(slot) : entry(slot); }
  Int next(Int slot) const { return lists_.lptr[slot - 1]; }
  Int last_slot(Int node) const { return lists_.lend[node - 1]; }
  Int first_slot(Int node) const { return next(last_slot(node)); }
  /// first_slot(node) if the lists are canonical, else any number.
  Int foreseen_first_slot(Int node) const { return node == 1 ? 1 : last_slot(node - 1) + 1; }
  Int first_neighbour(Int node) const { return neighbour(first_slot(node)); }
  Int last_neighbour(Int node) const { return neighbour(last_slot(node)); }
  bool on_boundary(Int node) const { return entry(last_slot(node)) < 0; }
  Int slot_of(Int node, Int wanted) const {
    return lstptr(last_slot(node), wanted, lists_.list, lists_.lptr);
  }

  /// Calls visit(neighbour) for the neighbours of a node of a triangulation, counterclockwise from the first.
  template <class Visit>
  void for_each_neighbour(Int node, const Visit& visit) const {
    const Int last = last_slot(node);
    Int slot = last;
    do {
      slot = next(slot);
      visit(neighbour(slot));
    } while (slot != last);
  }

  [[gnu::always_inline]] void prefetch_list(Int node) const {
    const auto i = static_cast<std::size_t>(last_slot(node) - 1);
    __builtin_prefetch(lists_.list + i);
    __builtin_prefetch(lists_.lptr + i);
  }

  /// The boundary node of smallest number, 0 if the triangles cover the sphere.
  Int first_boundary_node() const {
    for (Int node = 1; node <= size(); ++node)
      if (on_boundary(node)) return node;
    return 0;
  }

 private:
  ListsView<Int> lists_;
};

}  // namespace pstripack
