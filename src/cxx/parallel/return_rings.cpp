#include "parallel/return_rings.h"

#include <cassert>
#include <optional>
#include <utility>

namespace pstripack {
namespace {

/// Writes the rings of the own nodes of all patches here: into the memory of the hulls or, if `outside` is
/// given, into memory of their own. Then the stars can stay when the hulls are freed. `outside`: what the
/// rings of this rank's nodes name is added.
template <class Int>
void write_rings(Patches<Int>& patches, const RingAddresses& addresses, RankNumber me, int threads,
                 Stars<Int>& stars, NamedOutside<Int>* outside) {
  struct Part {
    Block memory;
    std::optional<NamedOutside<Int>> outside;
  };
  std::vector<Part> parts(patches.of_rank.size());
  patches.for_each(threads, [&](Patch<Int>& patch, PatchHere k) {
    Part& part = parts[k];
    const std::size_t bytes = (patch.entries() + 2 * kBlock) * sizeof(Int);
    if (patches.memory.gives_back_pages()) patch.give_back_planes();
    auto* out = outside != nullptr ? nullptr : static_cast<Int*>(patch.room_for_rings(bytes));
    if (out == nullptr) {
      part.memory = Block(bytes);
      out = reinterpret_cast<Int*>(part.memory.data());
    }
    // By value, as in PatchHull::write_rings.
    const auto entries = stars.of_node.entries();
    const std::size_t begin = addresses.begin[static_cast<std::size_t>(patch.id())],
                      first = addresses.own_from[k][me], count = addresses.own_from[k][me + 1] - first;
    const auto soon = [=](std::size_t i) { __builtin_prefetch(entries.place + begin + i, 1); };
    NamedOutside<Int>* const names = outside != nullptr ? &part.outside.emplace(*outside) : nullptr;
    patch.write_rings(
        out,
        [=](std::size_t i, const Int* ring, std::uint32_t n) {
          entries.set(begin + i, ring, n);
          if (names != nullptr && i - first < count) names->add_ring(ring);
        },
        soon);
    if (patches.memory.gives_back_pages()) patch.give_back_hull();
  });
  for (Part& part : parts) {
    if (outside != nullptr) outside->add(*part.outside);
    stars.memory.push_back(std::move(part.memory));
  }
}

/// For each rank the rings of the nodes that it brought, patch by patch.
template <class Int>
Parcels rings_for_others(RingTable<Int>& table, const RingAddresses& addresses, const PatchRanges& patches,
                         RankNumber me) {
  const auto rings = table.entries();
  const auto for_each_run_of = [&](RankNumber r, const auto& visit) {
    for (PatchHere k = 0; k < addresses.own_from.size() && r != me; ++k) {
      const std::size_t begin = addresses.begin[static_cast<std::size_t>(patches.first(me)) + k];
      visit(begin + addresses.own_from[k][r], begin + addresses.own_from[k][r + 1]);
    }
  };
  ParcelWriter writer(patches.ranks());
  for (RankNumber r = 0; r < patches.ranks(); ++r)
    for_each_run_of(r, [&](std::size_t first, std::size_t last) {
      std::size_t entries = 0;
      for (std::size_t i = first; i < last; ++i) entries += 1 + rings.count(i);
      writer.expect<Int>(r, entries);
    });
  writer.make_room(kBlock * sizeof(Int));  // see copy_ring
  if (writer.empty()) return writer.finish();
  for (RankNumber r = 0; r < patches.ranks(); ++r) {
    auto* at = writer.room<Int>(r, 0);
    for_each_run_of(r, [&](std::size_t first, std::size_t last) {
      constexpr std::size_t kAhead = 16;  // they lie in the order of the hulls
      for (std::size_t i = first; i < last; ++i) {
        if (i + kAhead < last) __builtin_prefetch(rings.place[i + kAhead]);
        at = copy_ring(rings.place[i], at);
      }
    });
  }
  return writer.finish();
}

/// Enters the received rings in the table: those of this rank's nodes in patches of other ranks.
template <class Int>
void enter_received(const Parcels& received, const RingAddresses& addresses, const PatchRanges& patches,
                    RankNumber me, RingTable<Int>& table, NamedOutside<Int>* outside) {
  for (RankNumber r = 0; r < patches.ranks(); ++r) {
    if (r == me) continue;
    const Int* at = Items<Int>(received, r).begin();
    for (std::size_t k = addresses.begin[static_cast<std::size_t>(patches.first(r))];
         k < addresses.begin[static_cast<std::size_t>(patches.end(r))]; ++k) {
      table.entries().set(k, at);
      at = outside != nullptr ? outside->add_ring(at) : at + 1 + *at;
    }
    assert(at == Items<Int>(received, r).end());
  }
}

}  // namespace

template <class Int>
Stars<Int> return_rings(Patches<Int> patches, RingAddresses addresses, const LocalNodes& nodes,
                        const Division& division, Communicator& ranks, const ParallelOptions& options) {
  const auto me = static_cast<RankNumber>(ranks.rank());
  Stars<Int> stars;
  NamedOutside<Int> named(nodes.number(0), nodes.count);
  NamedOutside<Int>* const outside = options.with_neighbours ? &named : nullptr;
  Parcels received = exchange_in_agreement(ranks, [&] {
    stars.memory.reserve(patches.of_rank.size() + 2);  // what is moved there below must not fail
    stars.of_node = RingTable<Int>(std::move(addresses.position), addresses.begin.back());
    write_rings(patches, addresses, me, options.threads, stars, outside);
    return rings_for_others(stars.of_node, addresses, division.patches, me);
  });
  const auto enter = [&] {
    enter_received(received, addresses, division.patches, me, stars.of_node, outside);
    if (outside != nullptr) stars.outside = outside->nodes();
  };
  if (outside == nullptr) {
    enter();
    stars.memory.push_back(std::move(patches.memory));
  } else {
    in_agreement(ranks, enter);
  }
  stars.memory.push_back(std::move(received.bytes));
  return stars;
}

template Stars<std::int32_t> return_rings(Patches<std::int32_t>, RingAddresses, const LocalNodes&,
                                          const Division&, Communicator&, const ParallelOptions&);
template Stars<std::int64_t> return_rings(Patches<std::int64_t>, RingAddresses, const LocalNodes&,
                                          const Division&, Communicator&, const ParallelOptions&);

}  // namespace pstripack
