#pragma once
// The lists of a triangulation as rings: for every node its neighbours side by side, nodes in order.
// That is what canonical lists are already; of other lists a copy is made.

#include <cstdint>

#include "base/buffer.h"
#include "lists/adjacency_lists.h"
#include "lists/eight_entries.h"

namespace pstripack {

/// With which pair of consecutive neighbours a routine starts round a node.
enum class FirstPair { first_and_second, last_and_first };

/// An arc is the position, from 0, of b in the ring of a, and stands for the directed arc from a to b.
/// Nodes count from 1. Views the lists, which must outlive it.
template <class Int>
class Rings {
 public:
  static constexpr Int few_neighbours = 64;  ///< nodes with more are hubs
  static constexpr Int none = -1;            ///< no arc

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
  Int target(Int arc) const { return neighbour_in(entry_[arc]); }
  void prefetch(Int arc) const { __builtin_prefetch(entry_ + arc); }
  /// The arcs after and before an arc of a node, counterclockwise. Without branches, which would be
  /// unpredictable.
  Int after(Int node, Int arc) const { return arc + 1 - (-Int{arc + 1 == end(node)} & degree(node)); }
  Int before(Int node, Int arc) const { return arc - 1 + (-Int{arc == begin(node)} & degree(node)); }
  /// True if the arcs are the slots of LIST from the first on; else slot() gives the slot of an arc, from 1.
  bool in_slot_order() const { return slot_.size() == 0; }
  Int slot(Int arc) const { return in_slot_order() ? arc + 1 : slot_[static_cast<std::size_t>(arc)]; }

  /// The arc from b to a, where an arc leads from a to b; `none` if there is none. O(1) on average over all
  /// arcs, however large the hubs are: see tabulate_hubs.
  Int arc_back(Int a, Int b) const {
    const Int first = begin(b);
    if (first <= last_of_eight_) {
      const unsigned equal = equal_of_eight(entry_ + first, a);
      const Int arc = first + __builtin_ctz(equal | 1u << eight);
      if (equal != 0 && arc < end(b)) return arc;
    }
    return arc_back_far(a, b);
  }

  /// The arcs of a small ring, bit by bit from its first.
  struct Arcs {
    unsigned greater;    ///< those that lead to a greater node
    unsigned triangles;  ///< those with a triangle on the left whose smallest corner is the ring's node
  };
  /// True if the ring is so small that all its arcs are looked at together.
  bool is_small(Int node) const { return (degree(node) <= eight) & (begin(node) <= last_of_eight_); }
  /// Needs is_small(a).
  Arcs arcs_of(Int a) const {
    const Greater greater = greater_of_eight(entry_ + begin(a), a);
    const Int last = degree(a) - 1;
    const unsigned neighbours = greater.neighbours & whole(last);
    return {neighbours, greater.entries & (neighbours >> 1 | (neighbours & 1) << last)};
  }
  /// The arcs of node b that lead to the smallest corner a of a triangle (a,b,c) on their right. Needs
  /// is_small(b).
  unsigned arcs_to_smallest(Int b) const {
    const Int* const entries = entry_ + begin(b);
    const Int last = degree(b) - 1;
    const unsigned smaller = ~greater_of_eight(entries, b).neighbours & whole(last);
    return smaller & (descents_of_eight(entries) | unsigned{entries[last] > neighbour_in(entries[0])});
  }
  /// The same for one arc of any ring.
  bool leads_to_smallest(Int b, Int arc) const {
    return (target(arc) < b) & (target(arc) < entry(before(b, arc)));
  }
  /// True if there is a triangle left of the arc of a, and a is its smallest corner.
  bool is_smallest(Int a, Int arc) const {
    return (entry(arc) > a) & (target(after(a, arc)) > a);  // entry: nothing is left of a boundary's last arc
  }

  /// Calls visit(a, b, c, p, q) for all triangles (a,b,c), counterclockwise, with smallest corner
  /// a = first+1..last, in the order of a and of its ring; p and q are the arcs from a to b and to c.
  template <FirstPair pairs, class Visit>
  void for_each_triangle(std::size_t first, std::size_t last, const Visit& visit) const {
    for (Int a = static_cast<Int>(first) + 1; a <= static_cast<Int>(last); ++a) {
      const Int ring = begin(a), end_of_ring = end(a);
      const auto triangle = [&](Int p) {
        const Int q = p + 1 == end_of_ring ? ring : p + 1;
        visit(a, entry(p), target(q), p, q);
      };
      Int p = ring, stop = end_of_ring;
      const bool last_first = pairs == FirstPair::last_and_first && is_smallest(a, end_of_ring - 1);
      if (last_first) triangle(end_of_ring - 1);
      if (pairs == FirstPair::last_and_first) --stop;
      if (is_small(a)) {
        unsigned arcs = arcs_of(a).triangles;
        if (last_first) arcs ^= 1u << (stop - ring);
        for (; arcs != 0; arcs &= arcs - 1) triangle(ring + __builtin_ctz(arcs));
      } else {
        for (; p < stop; ++p)
          if (is_smallest(a, p)) triangle(p);
      }
    }
  }

 private:
  bool are_rings(const ListsView<Int>& lists, int threads) const;
  bool copy(const ListsView<Int>& lists);
  void tabulate_hubs();
  /// arc_back where the arc is not among the first eight of its ring.
  Int arc_back_far(Int a, Int b) const;
  /// The arc in [begin, end) that leads to node a; `none` if there is none.
  Int find(Int a, Int begin, Int end) const;
  static unsigned whole(Int last) { return (2u << last) - 1; }

  Int n_ = 0;
  Int last_of_eight_ = -1;  // the last arc that has seven after it in memory
  const Int* entry_ = nullptr;
  const Int* end_ = nullptr;
  Buffer<Int> slot_, own_entry_, own_end_;  // empty if the lists are rings already
  Buffer<Int> hub_back_;  // opposites of the arcs to nodes with many neighbours; empty without
};

}  // namespace pstripack
