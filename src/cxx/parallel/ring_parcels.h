#pragma once
// Rings of nodes that travel between ranks, and rings that are copied to one place.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "parallel/parcels.h"
#include "parallel/return_rings.h"

namespace pstripack {

/// Packs rings, each as the number of its node, its count and its entries. for_each(visit) calls
/// visit(rank, number, count, write) for every ring; write(to) writes its entries.
template <class Int, class ForEach>
Parcels packed_rings(std::size_t ranks, const ForEach& for_each) {
  ParcelWriter writer(ranks);
  for_each(
      [&](RankNumber r, std::int64_t, std::size_t count, const auto&) { writer.expect<Int>(r, 2 + count); });
  writer.make_room();
  for_each([&](RankNumber r, std::int64_t number, std::size_t count, const auto& write) {
    Int* const to = writer.room<Int>(r, 2 + count);
    to[0] = static_cast<Int>(number);
    to[1] = static_cast<Int>(count);
    write(to + 2);
  });
  return writer.finish();
}

/// Calls visit(number, ring) for each packed ring.
template <class Int, class Visit>
void for_each_ring(const Parcels& parcels, const Visit& visit) {
  const Items<Int> words(parcels);
  for (const Int* at = words.begin(); at < words.end(); at += 2 + at[1]) visit(at[0], ring_at(at + 1));
}

/// Copies of the rings ring(i) of nodes 0..n-1, with entries changed by entry(i, e). Throws std::bad_alloc.
template <class Int, class GetRing, class Entry>
Stars<Int> copied_stars(std::size_t n, const GetRing& ring, const Entry& entry) {
  Stars<Int> stars;
  std::size_t entries = 0;
  for (std::size_t i = 0; i < n; ++i) entries += 1 + ring(i).count;
  stars.of_node = RingTable<Int>(n);
  stars.memory.emplace_back((entries + kBlock) * sizeof(Int));  // see copy_ring
  Int* at = reinterpret_cast<Int*>(stars.memory[0].data());
  for (std::size_t i = 0; i < n; ++i) {
    const Ring<Int> r = ring(i);
    stars.of_node.entries().set(i, at, r.count);
    *at++ = static_cast<Int>(r.count);
    at = std::transform(r.begin, r.begin + r.count, at, [&](Int e) { return entry(i, e); });
  }
  return stars;
}

}  // namespace pstripack
