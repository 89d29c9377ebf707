#include "parallel/return_rings.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace pstripack {
namespace {

/// The table of ReturnAddresses: where each ring is, and its size.
template <class Int>
struct Table {
  std::unique_ptr<Workspace> memory;
  const Int** place = nullptr;
  std::uint8_t* size_class = nullptr;

  void make_room(std::size_t rings) {
    memory = std::make_unique<Workspace>(rings * (sizeof *place + sizeof *size_class));
    place = memory->template for_call<const Int*>(rings);
    size_class = memory->template for_call<std::uint8_t>(rings);
  }
};

/// Writes the rings of the own nodes of all patches here: into the memory of the hulls or, if `apart`, into
/// memory of their own, which is returned. Then the stars can stay when the hulls are freed.
template <class Int>
std::unique_ptr<Workspace> write_rings(Patches<Int>& patches, const ReturnAddresses& addresses, bool apart,
                                       int threads, Table<Int>& table, std::vector<Buffer<Int>>& more_memory,
                                       StarSums& sums) {
  std::vector<std::size_t> begin{0};
  for (const Patch<Int>& patch : patches.of_rank)
    begin.push_back(begin.back() + patch.entries() + 2 * kBlock);
  std::unique_ptr<Workspace> memory;
  Int* room = nullptr;
  if (apart) {
    memory = std::make_unique<Workspace>(begin.back() * sizeof(Int));
    room = memory->template for_call<Int>(begin.back());
  }
  more_memory.resize(patches.of_rank.size());
  std::vector<StarSums> of_patch(patches.of_rank.size());
  patches.for_each(threads, [&](Patch<Int>& patch, PatchHere k) {
    const std::size_t entries = begin[k + 1] - begin[k];
    Int* out =
        room != nullptr ? room + begin[k] : static_cast<Int*>(patch.room_for_rings(entries * sizeof(Int)));
    if (out == nullptr) {
      more_memory[k] = Buffer<Int>(entries);
      out = more_memory[k].data();
    }
    // By value, as in Patch::write_rings.
    const Int** const place = table.place + addresses.own_begin[k];
    std::uint8_t* const size_class = table.size_class + addresses.own_begin[k];
    of_patch[k] = patch.write_rings(
        out,
        [=](std::size_t i, const Int* ring, std::uint32_t n) {
          place[i] = ring;
          size_class[i] = RingTable<Int>::size_class_of(n);
        },
        [=](std::size_t i) { __builtin_prefetch(place + i, 1); });
  });
  for (const StarSums& patch : of_patch) sums += patch;
  return memory;
}

/// For each rank the rings of the nodes that it brought, patch by patch.
template <class Int>
Parcels rings_for_others(const Table<Int>& table, const ReturnAddresses& addresses, std::size_t size,
                         RankNumber me) {
  const auto for_each_run_of = [&](RankNumber r, const auto& visit) {
    for (PatchHere k = 0; k < addresses.own_from.size() && r != me; ++k)
      visit(addresses.own_begin[k] + addresses.own_from[k][r],
            addresses.own_begin[k] + addresses.own_from[k][r + 1]);
  };
  ParcelWriter writer(size);
  for (RankNumber r = 0; r < size; ++r)
    for_each_run_of(r, [&](std::size_t first, std::size_t last) {
      std::size_t entries = 0;
      for (std::size_t i = first; i < last; ++i)
        entries += 1 + RingTable<Int>::count_of(table.place[i], table.size_class[i]);
      writer.expect<Int>(r, entries);
    });
  writer.make_room(kBlock * sizeof(Int));  // see copy_ring
  if (writer.empty()) return writer.finish();
  for (RankNumber r = 0; r < size; ++r) {
    auto* at = writer.room<Int>(r, 0);
    for_each_run_of(r, [&](std::size_t first, std::size_t last) {
      constexpr std::size_t kAhead = 16;  // they lie in the order of the hulls
      for (std::size_t i = first; i < last; ++i) {
        if (i + kAhead < last) __builtin_prefetch(table.place[i + kAhead]);
        at = copy_ring(table.place[i], at);
      }
    });
  }
  return writer.finish();
}

/// Enters the received rings in the table: those of this rank's nodes in patches of other ranks.
template <class Int>
void enter_received(const Parcels& received, const ReturnAddresses& addresses, const PatchRanges& patches,
                    RankNumber me, Table<Int>& table) {
  for (RankNumber r = 0; r + 1 < received.begin.size(); ++r) {
    if (r == me) continue;
    const Int* at = Items<Int>(received, r).begin();
    for (std::size_t k = addresses.away_begin[static_cast<std::size_t>(patches.first(r))];
         k < addresses.away_begin[static_cast<std::size_t>(patches.end(r))]; ++k) {
      table.place[k] = at;
      table.size_class[k] = RingTable<Int>::size_class_of(static_cast<std::uint32_t>(*at));
      at += 1 + *at;
    }
    assert(at == Items<Int>(received, r).end());
  }
}

/// The neighbours of this rank's nodes that it did not bring itself.
template <class Int>
std::vector<HaloNode> find_outside(const Patches<Int>& patches, const ReturnAddresses& addresses,
                                   const LocalNodes& nodes, Communicator& ranks) {
  const auto size = static_cast<std::size_t>(ranks.size());
  const Parcels incoming = exchange_in_agreement(ranks, [&] {
    struct Missing {
      RankOfNode rank;
      HullNode node;
    };
    std::vector<std::vector<Missing>> of_patch(patches.of_rank.size());
    ParcelWriter writer(size);
    for (PatchHere k = 0; k < of_patch.size(); ++k)
      patches.of_rank[k].for_each_missing_neighbour(addresses.own_from[k], [&](RankNumber r, HullNode v) {
        of_patch[k].push_back({static_cast<RankOfNode>(r), v});
        writer.expect<Record>(r);
      });
    writer.make_room();
    for (PatchHere k = 0; k < of_patch.size(); ++k)
      for (const Missing& m : of_patch[k]) writer.put(m.rank, patches.of_rank[k].node(m.node));
    return writer.finish();
  });
  std::vector<HaloNode> outside;
  in_agreement(ranks, [&] {
    // A patch does not know which nodes this rank brought for other patches.
    const auto is_here = [&](const Record& r) {
      return r.number >= nodes.number(0) && r.number < nodes.number(nodes.count);
    };
    const Items<Record> items(incoming);
    std::vector<Record> all;
    std::remove_copy_if(items.begin(), items.end(), std::back_inserter(all), is_here);
    keep_one_of_each(all);
    outside.reserve(all.size());
    for (const Record& r : all) outside.push_back({r.point, r.number, r.number});
  });
  return outside;
}

/// A test of the program: patches that agree have the stars of all nodes, whose surface is a sphere or a
/// disc. Throws PatchesDoNotPay if not: then one rank triangulates all. Collective.
void check_euler(StarSums sums, const Division& division, Communicator& ranks) {
  if (division.patches.count() == 1) return;
  std::int64_t all[] = {sums.nodes, sums.neighbours, sums.boundary};
  ranks.all_sum(all, std::size(all));
  sums = {all[0], all[1], all[2]};
  const bool is_right =
      sums.nodes == static_cast<std::int64_t>(division.nodes) && sums.are_of_sphere_or_disc();
  assert(is_right);
  if (!is_right) throw PatchesDoNotPay{};  // untested: a bug in our own program
}

}  // namespace

template <class Int>
Stars<Int> return_rings(Patches<Int> patches, ReturnAddresses addresses, const LocalNodes& nodes,
                        const Division& division, Communicator& ranks, const ParallelOptions& options) {
  const auto me = static_cast<RankNumber>(ranks.rank());
  Stars<Int> stars;
  stars.lengths = division.places.lengths();
  Table<Int> table;
  std::unique_ptr<Workspace> entries;
  StarSums sums;
  stars.received = exchange_in_agreement(ranks, [&] {
    stars.memory.reserve(3);  // what is moved there below must not fail
    table.make_room(addresses.own_begin.back());
    entries = write_rings(patches, addresses, options.with_neighbours, options.threads, table,
                          stars.more_memory, sums);
    return rings_for_others(table, addresses, static_cast<std::size_t>(ranks.size()), me);
  });
  check_euler(sums, division, ranks);
  enter_received(stars.received, addresses, division.patches, me, table);
  stars.of_node = RingTable<Int>(nodes.count, addresses.position, table.place, table.size_class);
  if (options.with_neighbours) stars.outside = find_outside(patches, addresses, nodes, ranks);
  stars.memory.push_back(std::move(addresses.memory));
  stars.memory.push_back(std::move(table.memory));
  stars.memory.push_back(std::move(options.with_neighbours ? entries : patches.memory));
  return stars;
}

template Stars<std::int32_t> return_rings(Patches<std::int32_t>, ReturnAddresses, const LocalNodes&,
                                          const Division&, Communicator&, const ParallelOptions&);
template Stars<std::int64_t> return_rings(Patches<std::int64_t>, ReturnAddresses, const LocalNodes&,
                                          const Division&, Communicator&, const ParallelOptions&);

}  // namespace pstripack
