#pragma once

#include <cstdint>

namespace pstripack {

/// Walks through unchecked lists of a triangulation or Voronoi diagram. It touches no slot outside 1..6n-12.
/// Since each slot is in one list, all walks of one object together take at most 6n-12 steps.
template <class Int>
class ListWalk {
 public:
  ListWalk(Int n, const Int* lptr)
      : slots_(6 * static_cast<std::uint64_t>(n) - 12), left_(slots_), lptr_(lptr) {}

  /// Calls visit(slot, next) for all pairs of consecutive slots of the list with the last slot `last`,
  /// starting with `last` and the first slot. False if the list is not closed; it is then visited up to the
  /// defect.
  template <class Visit>
  bool operator()(Int last, Visit visit) {
    if (!is_slot(last)) return false;
    Int slot = last;
    do {
      const Int next = lptr_[slot - 1];
      if (!is_slot(next) || left_ == 0) return false;
      --left_;
      visit(slot, next);
      slot = next;
    } while (slot != last);
    return true;
  }

 private:
  bool is_slot(Int slot) const { return slot >= 1 && static_cast<std::uint64_t>(slot) <= slots_; }

  std::uint64_t slots_, left_;
  const Int* lptr_;
};

}  // namespace pstripack
