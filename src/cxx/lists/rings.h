#pragma once
// The lists of a triangulation as rings: the neighbours of a node side by side, nodes in increasing order.
// Canonical lists have this form already; other lists are copied.

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/buffer.h"
#include "lists/adjacency_lists.h"
#include "lists/eight_entries.h"

namespace pstripack {

/// The pair of consecutive neighbours with which a routine starts at a node.
enum class FirstPair { first_and_second, last_and_first };

/// A hash of t; 0 for 0. Used in sums over triangles that show whether the rings agree: sums of the numbers
/// themselves could agree by chance. splitmix64 would take longer.
template <class Number>
std::uint64_t randomised(Number t) {
  const std::uint64_t product = static_cast<std::uint64_t>(t) * 0x9e3779b97f4a7c15u;
  return product ^ product >> 32;
}

/// The directed arc from a to b is represented by the position, from 0, of b in the ring of a. Nodes count
/// from 1. The caller's lists must outlive the object.
template <class Int>
class Rings {
 public:
  static constexpr Int few_neighbours = 64;  ///< nodes with more are hubs
  static constexpr Int none = -1;            ///< no arc

  /// Reads the lists of n >= 3 nodes. False if they are not closed lists of neighbours 1..n within the slots
  /// 1..6n-12. Touches no other slot, whatever the arrays hold. Throws std::bad_alloc.
  bool read(const ListsView<Int>& lists, int threads);

  Int size() const { return n_; }
  Int arcs() const { return end(n_); }
  Int begin(Int node) const { return node > 1 ? end_[node - 2] : 0; }
  Int end(Int node) const { return end_[node - 1]; }
  Int degree(Int node) const { return end(node) - begin(node); }
  /// The entry of LIST: negative where there is no triangle left of the arc.
  Int entry(Int arc) const { return entry_[arc]; }
  Int target(Int arc) const { return neighbour_in(entry_[arc]); }
  [[gnu::always_inline]] void prefetch(Int arc) const { __builtin_prefetch(entry_ + arc); }
  /// The arcs after and before an arc of a node, counterclockwise. Without branches, because these would be
  /// unpredictable.
  Int after(Int node, Int arc) const { return arc + 1 - (-Int{arc + 1 == end(node)} & degree(node)); }
  Int before(Int node, Int arc) const { return arc - 1 + (-Int{arc == begin(node)} & degree(node)); }
  /// True if arc p is slot p+1 of LIST for all p. slot(p) is the slot of arc p, from 1, in any case.
  bool in_slot_order() const { return slot_.size() == 0; }
  Int slot(Int arc) const { return in_slot_order() ? arc + 1 : slot_[static_cast<std::size_t>(arc)]; }

  /// The arc from b to a, given that there is an arc from a to b; `none` if b does not list a. O(1) on
  /// average over all arcs, however large the hubs are: see tabulate_hubs.
  Int arc_back(Int a, Int b) const {
    const Int first = begin(b);
    if (first <= last_of_eight_) {
      const unsigned equal = equal_of_eight(entry_ + first, a);
      const Int arc = first + __builtin_ctz(equal | 1u << eight);
      if (equal != 0 && arc < end(b)) return arc;
    }
    return arc_back_far(a, b);
  }

  /// Two sets of arcs of a small ring, as bits: bit i stands for the arc begin + i.
  struct Arcs {
    unsigned greater;    ///< arcs that lead to a greater node
    unsigned triangles;  ///< arcs with a triangle on the left whose smallest corner is the ring's node
  };
  /// True if the ring has at most 16 arcs, which can be tested together.
  bool is_small(Int node) const {
    return (degree(node) <= 2 * eight) & (begin(node) <= last_of_eight_ - eight);
  }
  /// Needs is_small(a).
  Arcs arcs_of(Int a) const {
    const Int last = degree(a) - 1;
    const Greater greater = greater_of(entry_ + begin(a), a, last);
    const unsigned neighbours = greater.neighbours & whole(last);
    return {neighbours, greater.entries & (neighbours >> 1 | (neighbours & 1) << last)};
  }
  /// True if there is a triangle left of the arc of a, and a is its smallest corner. Uses entry(arc), which
  /// is negative if there is none.
  bool is_smallest(Int a, Int arc) const { return (entry(arc) > a) & (target(after(a, arc)) > a); }

  /// Calls visit(a, b, c, p, q) for all triangles (a,b,c), counterclockwise, with smallest corner
  /// a = first+1..last, in the order of a and of its ring; p and q are the arcs from a to b and to c. The
  /// arcs p of several small rings are collected before the first is visited, because a loop over the arcs of
  /// one ring would end unpredictably.
  template <FirstPair pairs, class Visit>
  [[gnu::always_inline]] void for_each_triangle(std::size_t first, std::size_t last,
                                                const Visit& visit) const {
    constexpr Int together = 32;
    constexpr bool last_first = pairs == FirstPair::last_and_first;
    std::array<Int, 2 * eight*(together + 1)> node, arc;
    const auto visit_arc = [&](Int a, Int p) {
      const Int q = after(a, p);
      visit(a, entry(p), target(q), p, q);
    };
    const auto end_of_all = static_cast<Int>(last);
    for (Int a = static_cast<Int>(first) + 1; a <= end_of_all;) {
      std::size_t found = 0;
      for (const Int stop = std::min(a + together - 1, end_of_all); a <= stop && is_small(a); ++a) {
        const Int ring = begin(a), last_arc = end(a) - 1;
        unsigned chosen = arcs_of(a).triangles;
        if (last_first) {
          const unsigned is_last = chosen >> (last_arc - ring) & 1;
          arc[found] = last_arc, node[found] = a;
          found += is_last;
          chosen ^= is_last << (last_arc - ring);
        }
        Int from = ring;
        do {
          std::fill_n(node.data() + found, eight, a);
          put_sums(from, positions_of_bits[chosen & 255], arc.data() + found);
          found += ones_of_bits[chosen & 255];
          from += eight;
        } while ((chosen >>= eight) != 0);
      }
      for (std::size_t i = 0; i < found; ++i) visit_arc(node[i], arc[i]);
      if (found > 0 || a > end_of_all || is_small(a)) continue;
      Int stop = end(a);
      if (last_first && is_smallest(a, --stop)) visit_arc(a, stop);
      for (Int p = begin(a); p < stop; ++p)
        if (is_smallest(a, p)) visit_arc(a, p);
      ++a;
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
  /// Compares the entries of a small ring with a. Bits after `last` belong to other memory: ignore them.
  static Greater greater_of(const Int* entry, Int a, Int last) {
    const Greater first = greater_of_eight(entry, a);
    if (last < eight) return first;
    const Greater second = greater_of_eight(entry + eight, a);
    return {first.entries | second.entries << eight, first.neighbours | second.neighbours << eight};
  }
  static unsigned whole(Int last) { return (2u << last) - 1; }

  Int n_ = 0;
  Int last_of_eight_ = -1;  // the last arc that is followed by seven more in memory
  const Int* entry_ = nullptr;
  const Int* end_ = nullptr;
  Buffer<Int> slot_, own_entry_, own_end_;  // empty if the lists are rings already
  Buffer<Int> hub_back_;                    // by arc at a hub: the arc back; empty if there are no hubs
};

}  // namespace pstripack
