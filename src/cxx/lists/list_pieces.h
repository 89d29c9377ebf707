#pragma once
// LIST, LPTR and LEND from the rings of consecutive nodes: all of them, or a piece.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/parallel_for.h"
#include "mesh/ring_table.h"

namespace pstripack {

template <std::size_t kCount, class Int, class Entry>
inline void copy_some(const Int* from, Entry* to) {
  for (std::size_t i = 0; i < kCount; ++i) to[i] = static_cast<Entry>(from[i]);
}

/// Copies a ring without touching memory beside it. A ring of 4 to 16 neighbours is copied as two overlapping
/// blocks of fixed length, because the end of a loop would be mispredicted. The mean is six neighbours.
template <class Int, class Entry>
inline void copy_ring(const Int* from, std::size_t count, Entry* to) {
  if (count - 4 <= 4) {
    copy_some<4>(from, to);
    copy_some<4>(from + count - 4, to + count - 4);
  } else if (count - 8 <= 8) {
    copy_some<8>(from, to);
    copy_some<8>(from + count - 8, to + count - 8);
  } else {
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<Entry>(from[i]);
  }
}

/// Writes LPTR of n consecutive nodes, which LEND determines: each slot points to the next one, the last
/// slot of a node to its first. lend[0] belongs to the first of these nodes, whose first slot is first_slot
/// (from 0). lptr[0] is slot 0 of the whole LPTR. threads: from threads_for.
void write_lptr(const std::int32_t* lend, std::size_t n, std::size_t first_slot, std::int32_t* lptr,
                int threads);

/// Writes the rings of nodes first..last-1 of a table one after another, from list[slot] on, and their
/// entries of LEND. list[0] is the slot first_slot (from 0) of the whole LIST.
template <class Rings>
void write_rings(const Rings& rings, std::size_t first, std::size_t last, std::size_t slot,
                 std::size_t first_slot, std::int32_t* list, std::int32_t* lend) {
  constexpr std::size_t kAhead = 16;  // prefetched: rings lie in the order of patches, not of nodes
  for (std::size_t k = first; k < last; ++k) {
    if (k + kAhead < last) rings.prefetch(k + kAhead);
    const auto ring = rings[k];
    copy_ring(ring.begin, ring.count, list + slot);
    slot += ring.count;
    lend[k] = static_cast<std::int32_t>(first_slot + slot);
  }
}

/// Writes LIST and LEND of the nodes of a table, such as RingTable: their rings one after another. list[0] is
/// the slot first_slot (from 0) of the whole LIST. Writes lend[0..rings.size()-1] and
/// list[0..rings.arcs()-1]. threads: from threads_for.
template <class Rings>
void write_piece(const Rings& rings, std::size_t first_slot, std::int32_t* list, std::int32_t* lend,
                 int threads) {
  std::array<std::size_t, 256> begin{};  // where each thread's part begins
  threads = std::min<int>(threads, begin.size() - 1);
  if (threads > 1)
    parallel_pieces(rings.size(), threads, [&](std::size_t first, std::size_t last, int piece) {
      begin[static_cast<std::size_t>(piece) + 1] = rings.arcs(first, last);
    });
  for (std::size_t t = 1; t < begin.size(); ++t) begin[t] += begin[t - 1];
  parallel_pieces(rings.size(), threads, [&](std::size_t first, std::size_t last, int piece) {
    write_rings(rings, first, last, begin[static_cast<std::size_t>(piece)], first_slot, list, lend);
  });
}

}  // namespace pstripack
