#pragma once
// Rings of nodes that travel between ranks, and rings that are copied to one place.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "parallel/parcels.h"
#include "parallel/return_rings.h"

namespace pstripack {

/// Packs rings, each as the number of its node, its count and its entries, changed by entry(e).
/// for_each(visit) calls visit(rank, number, ring) for every ring.
template <class Int, class ForEach, class Entry>
Parcels packed_rings(std::size_t ranks, const ForEach& for_each, const Entry& entry) {
  ParcelWriter writer(ranks);
  for_each(
      [&](RankNumber r, Int, const Ring<Int>& ring) { writer.expect<Int>(r, 2 + std::size_t{ring.count}); });
  writer.make_room();
  for_each([&](RankNumber r, Int number, const Ring<Int>& ring) {
    Int* const to = writer.room<Int>(r, 2 + std::size_t{ring.count});
    to[0] = number;
    to[1] = static_cast<Int>(ring.count);
    std::transform(ring.begin, ring.begin + ring.count, to + 2, entry);
  });
  return writer.finish();
}
template <class Int, class ForEach>
Parcels packed_rings(std::size_t ranks, const ForEach& for_each) {
  return packed_rings<Int>(ranks, for_each, [](Int e) { return e; });
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
  auto memory = std::make_unique<Workspace>(n * (sizeof(std::uint32_t) + sizeof(Int*) + 1));
  auto* const position = memory->for_call<std::uint32_t>(n);
  auto** const place = memory->for_call<const Int*>(n);
  auto* const size_class = memory->for_call<std::uint8_t>(n);
  Buffer<Int> rings(entries + kBlock);  // see copy_ring
  Int* at = rings.data();
  for (std::size_t i = 0; i < n; ++i) {
    const Ring<Int> r = ring(i);
    position[i] = static_cast<std::uint32_t>(i);
    place[i] = at;
    size_class[i] = RingTable<Int>::size_class_of(r.count);
    *at++ = static_cast<Int>(r.count);
    at = std::transform(r.begin, r.begin + r.count, at, [&](Int e) { return entry(i, e); });
  }
  stars.of_node = RingTable<Int>(n, position, place, size_class);
  stars.memory.push_back(std::move(memory));
  stars.more_memory.push_back(std::move(rings));
  return stars;
}
template <class Int, class GetRing>
Stars<Int> copied_stars(std::size_t n, const GetRing& ring) {
  return copied_stars<Int>(n, ring, [](std::size_t, Int e) { return e; });
}

}  // namespace pstripack
