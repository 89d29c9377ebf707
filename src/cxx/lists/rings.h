#pragma once
// The lists of a triangulation as rings: for every node its neighbours side by side, nodes in order.
// That is what canonical lists are already; of other lists a copy is made.

#include <algorithm>
#include <cstdint>

#include "base/buffer.h"
#include "lists/adjacency_lists.h"

namespace pstripack {

/// With which pair of consecutive neighbours a routine starts round a node.
enum class FirstPair { first_and_second, last_and_first };

/// An arc is the position, from 0, of b in the ring of a, and stands for the directed arc from a to b.
/// Nodes count from 1. Views the lists, which must outlive it.
template <class Int>
class Rings {
 public:
  static constexpr Int few_neighbours = 16;  ///< nodes with more are hubs

  /// An arc from b back to a, and the bounds of the ring of b.
  struct Back {
    Int arc, begin, end;
    bool exists() const { return arc >= 0; }
    /// The arcs after and before it, counterclockwise round b.
    Int next() const { return arc + 1 == end ? begin : arc + 1; }
    Int previous() const { return arc == begin ? end - 1 : arc - 1; }
  };

  /// Reads the lists of n >= 3 nodes; false if they are not closed lists of neighbours 1..n within
  /// the slots 1..6n-12. Touches nothing outside those, whatever the arrays hold. May throw
  /// std::bad_alloc.
  bool read(const ListsView<Int>& lists, int threads);

  Int size() const { return n_; }
  Int arcs() const { return end(n_); }
  Int begin(Int node) const { return node > 1 ? end_[node - 2] : 0; }
  Int end(Int node) const { return end_[node - 1]; }
  Int degree(Int node) const { return end(node) - begin(node); }
  /// The entry of LIST: negative where there is no triangle left of the arc.
  Int entry(Int arc) const { return entry_[arc]; }
  Int target(Int arc) const { return entry_[arc] < 0 ? -entry_[arc] : entry_[arc]; }
  /// The arc's slot in LIST, from 1.
  Int slot(Int arc) const { return slot_.size() ? slot_[static_cast<std::size_t>(arc)] : arc + 1; }

  /// The arc opposite to `arc`, which runs from a to b. O(1): rings of up to few_neighbours are
  /// searched, those of hubs were put in a table by read(), which is O(n) (see there).
  Back back(Int a, Int arc) const {
    const Int b = target(arc);
    const Int b_begin = begin(b), b_end = end(b);
    return {b_end - b_begin <= few_neighbours ? find(a, b_begin, b_end)
                                              : hub_back_[static_cast<std::size_t>(arc)],
            b_begin, b_end};
  }

  /// Calls visit(a, b, c, p, q) for all triangles (a,b,c), counterclockwise, with smallest corner
  /// a = first+1..last, in the order of a and of its ring; p and q are the arcs from a to b and to c.
  template <FirstPair pairs, class Visit>
  void for_each_triangle(std::size_t first, std::size_t last, Visit visit) const {
    for (Int a = static_cast<Int>(first) + 1; a <= static_cast<Int>(last); ++a) {
      const Int ring_begin = begin(a), ring_end = end(a);
      for (Int block = ring_begin; block < ring_end; block += few_neighbours) {
        // Which neighbours are greater is random: first select, without branches, then visit.
        Int selected[few_neighbours];
        int count = 0;
        for (Int arc = block; arc < std::min(ring_end, block + few_neighbours); ++arc) {
          const Int p = pairs == FirstPair::first_and_second ? arc
                        : arc == ring_begin                  ? ring_end - 1
                                                             : arc - 1;
          const Int q = pairs == FirstPair::last_and_first ? arc : arc + 1 == ring_end ? ring_begin : arc + 1;
          selected[count] = arc;
          count += (entry(p) > a) & (target(q) > a);  // entry: nothing left of a boundary node's last arc
        }
        for (int i = 0; i < count; ++i) {
          const Int arc = selected[i];
          const Int p = pairs == FirstPair::first_and_second ? arc
                        : arc == ring_begin                  ? ring_end - 1
                                                             : arc - 1;
          const Int q = pairs == FirstPair::last_and_first ? arc : arc + 1 == ring_end ? ring_begin : arc + 1;
          visit(a, entry(p), target(q), p, q);
        }
      }
    }
  }

 private:
  static constexpr Int none = -1;

  bool are_rings(const ListsView<Int>& lists, int threads) const;
  bool copy(const ListsView<Int>& lists);
  void tabulate_hubs();

  /// The arc in [begin, end) that leads to node a.
  Int find(Int a, Int begin, Int end) const {
    constexpr Int width = 8;
    while (begin + width <= arcs()) {
      // Eight entries at once and without branches: where the match is, is random.
      Int match = width;
      for (Int i = width - 1; i >= 0; --i)
        match = (entry_[begin + i] == a) | (entry_[begin + i] == -a) ? i : match;
      if (match < width) return begin + match < end ? begin + match : none;
      begin += width;
      if (begin >= end) return none;
    }
    for (; begin < end; ++begin)
      if (target(begin) == a) return begin;
    return none;
  }

  Int n_ = 0;
  const Int* entry_ = nullptr;
  const Int* end_ = nullptr;
  Buffer<Int> slot_, own_entry_, own_end_;  // empty if the lists are rings already
  Buffer<Int> hub_back_;  // opposites of the arcs to nodes with many neighbours; empty without
};

}  // namespace pstripack
