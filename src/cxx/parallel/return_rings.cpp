#include "parallel/return_rings.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "parallel/number_table.h"

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
    place = memory->template keep<const Int*>(rings);
    size_class = memory->template keep<std::uint8_t>(rings);
  }
};

/// Writes the rings of the own nodes of all patches here: into the memory of the hulls or, if `apart`, into
/// memory of their own, which is returned. Then the stars can stay when the hulls are freed.
template <class Int>
std::unique_ptr<Workspace> write_rings(Patches<Int>& patches, const ReturnAddresses& addresses, bool apart,
                                       int threads, Table<Int>& table,
                                       std::vector<Buffer<Int>>& more_memory) {
  std::vector<std::size_t> begin(patches.of_rank.size() + 1, 0);
  patches.for_each(threads,
                   [&](Patch<Int>& patch, PatchHere k) { begin[k + 1] = patch.finish() + 2 * kBlock; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::unique_ptr<Workspace> memory;
  Int* room = nullptr;
  if (apart) {
    memory = std::make_unique<Workspace>(begin.back() * sizeof(Int));
    room = memory->template keep<Int>(begin.back());
  }
  more_memory.resize(patches.of_rank.size());
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
    patch.write_rings(
        out,
        [=](std::size_t i, const Int* ring, std::uint32_t n) {
          place[i] = ring;
          size_class[i] = RingTable<Int>::size_class_of(n);
        },
        [=](std::size_t i) { __builtin_prefetch(place + i, 1); });
  });
  return memory;
}

// ---- hubs: the patches have runs of their rings, which their owners join ------------------------------

/// The head of a run, some successive neighbours of a hub; their records follow.
struct RunHead {
  GlobalNumber hub;
  std::int64_t owner, count;  ///< owner: a PatchNumber
};

/// The runs that patches here have, for the owners of the hubs: how many, their heads, then their nodes.
template <class Int>
Parcels runs_at_hubs(const Patches<Int>& patches, const Division& division, std::size_t size) {
  std::vector<std::vector<RunHead>> heads(size);
  std::vector<std::vector<Record>> nodes(size);
  for (const Patch<Int>& patch : patches.of_rank)
    patch.for_each_run_at_hubs([&](const Record& hub, PatchNumber owner, const std::vector<Record>& run) {
      const RankNumber r = division.patches.rank_of(owner);
      heads[r].push_back({hub.number, owner, static_cast<std::int64_t>(run.size())});
      nodes[r].insert(nodes[r].end(), run.begin(), run.end());
    });
  ParcelWriter writer(size);
  for (RankNumber r = 0; r < size; ++r) {
    writer.expect<std::int64_t>(r);
    writer.expect<RunHead>(r, heads[r].size());
    writer.expect<Record>(r, nodes[r].size());
  }
  writer.make_room();
  for (RankNumber r = 0; r < size; ++r) {
    writer.put(r, static_cast<std::int64_t>(heads[r].size()));
    std::copy(heads[r].begin(), heads[r].end(), writer.room<RunHead>(r, heads[r].size()));
    std::copy(nodes[r].begin(), nodes[r].end(), writer.room<Record>(r, nodes[r].size()));
  }
  return writer.finish();
}

/// The ring of a hub of patch k here, in parts: neighbours as they lie in the runs.
struct HubRing {
  struct Part {
    const Record* first;
    std::size_t count;
  };
  PatchHere patch;
  GlobalNumber hub, first;  ///< first: neighbour
  bool is_at_boundary;
  std::vector<Part> parts;
};

template <class Int>
std::vector<HubRing> joined_runs(const Patches<Int>& patches, const Parcels& runs) {
  std::vector<HubRing> rings;
  std::unordered_map<GlobalNumber, std::unordered_map<GlobalNumber, HubRing::Part>> of_hub;
  for (RankNumber r = 0; r + 1 < runs.begin.size(); ++r) {
    ParcelReader reader(runs, r);
    const auto count_of_runs = static_cast<std::size_t>(reader.next<std::int64_t>());
    const RunHead* const heads = reader.array<RunHead>(count_of_runs);
    for (std::size_t i = 0; i < count_of_runs; ++i) {
      const RunHead& head = heads[i];
      const auto count = static_cast<std::size_t>(head.count);
      const Record* const first = reader.array<Record>(count);
      auto& of_first = of_hub[head.hub];
      if (of_first.empty()) {
        const auto k = static_cast<PatchHere>(head.owner - patches.of_rank[0].id());
        const GlobalNumber begin = patches.of_rank[k].first_boundary_neighbour(head.hub);
        rings.push_back({k, head.hub, begin != kNoNumber ? begin : first->number, begin != kNoNumber, {}});
      }
      of_first[first->number] = {first, count};
    }
  }
  // The last of a run is the first of the next; the last neighbour of a boundary node is that of none.
  for (HubRing& ring : rings) {
    const auto& of_first = of_hub[ring.hub];
    auto run = of_first.find(ring.first);
    do {
      const HubRing::Part& part = run->second;
      run = of_first.find(part.first[part.count - 1].number);
      ring.parts.push_back({part.first, part.count - (run != of_first.end())});
    } while (run != of_first.end() && run->first != ring.first);
  }
  return rings;
}

/// Writes the rings of hubs and enters them in the table, in place of those from the hulls of the owners.
template <class Int>
void write_hub_rings(const Patches<Int>& patches, const ReturnAddresses& addresses,
                     const std::vector<HubRing>& rings, Table<Int>& table,
                     std::vector<Buffer<Int>>& more_memory) {
  std::size_t entries = kBlock;  // see copy_kept_ring
  for (const HubRing& ring : rings) {
    ++entries;
    for (const HubRing::Part& part : ring.parts) entries += part.count;
  }
  Buffer<Int> memory(entries);
  Int* out = memory.data();
  for (const HubRing& ring : rings) {
    Int *const count = out++, *const begin = out;
    for (const HubRing::Part& part : ring.parts)
      for (std::size_t i = 0; i < part.count; ++i) *out++ = static_cast<Int>(part.first[i].number);
    if (ring.is_at_boundary)
      out[-1] = -out[-1];
    else
      std::rotate(begin, std::min_element(begin, out), out);
    *count = static_cast<Int>(out - begin);
    const std::size_t i =
        addresses.own_begin[ring.patch] + patches.of_rank[ring.patch].index_of_hub(ring.hub);
    table.place[i] = count;
    table.size_class[i] = RingTable<Int>::size_class_of(static_cast<std::uint32_t>(*count));
  }
  more_memory.push_back(std::move(memory));
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
  writer.make_room(kBlock * sizeof(Int));  // see copy_kept_ring
  if (writer.empty()) return writer.finish();
  for (RankNumber r = 0; r < size; ++r) {
    auto* at = writer.room<Int>(r, 0);
    for_each_run_of(r, [&](std::size_t first, std::size_t last) {
      constexpr std::size_t kAhead = 16;  // they lie in the order of the hulls
      for (std::size_t i = first; i < last; ++i) {
        if (i + kAhead < last) __builtin_prefetch(table.place[i + kAhead]);
        at = copy_kept_ring(table.place[i], at);
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
  }
}

/// Sorts records by number and keeps each number once, but none of `own`.
void keep_one_of_each_but(const LocalNodes& own, std::vector<Record>& all) {
  keep_one_of_each(all);
  NumberFilter filter(all.size());
  for (const Record& r : all) filter.add(r.number);
  std::vector<GlobalNumber> some;
  for (std::size_t i = 0; i < own.count; ++i)
    if (filter.may_have(own.number(i))) some.push_back(own.number(i));
  std::sort(some.begin(), some.end());
  auto next = some.begin();  // both are sorted
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const Record& r) {
                             while (next != some.end() && *next < r.number) ++next;
                             return next != some.end() && *next == r.number;
                           }),
            all.end());
}

/// The same for records in parts. A hub may have most nodes of the mesh for neighbours: then a table with a
/// place for each number between the least and the largest takes less time than sorting.
template <class ForEachPart>
std::vector<Record> one_of_each_but(const LocalNodes& own, const ForEachPart& for_each_part) {
  std::size_t count = 0;
  std::int64_t least = INT64_MAX, largest = 0;
  for_each_part([&](const HubRing::Part& part) {
    count += part.count;
    for (const Record* r = part.first; r < part.first + part.count; ++r) {
      least = std::min(least, value_of(r->number));
      largest = std::max(largest, value_of(r->number));
    }
  });
  std::vector<Record> all;
  all.reserve(count);
  constexpr std::size_t kMany = 10000, kPlacesEach = 8;
  if (count < kMany || static_cast<std::size_t>(largest - least) >= kPlacesEach * count) {
    for_each_part(
        [&](const HubRing::Part& part) { all.insert(all.end(), part.first, part.first + part.count); });
    keep_one_of_each_but(own, all);
    return all;
  }
  std::vector<const Record*> table(static_cast<std::size_t>(largest - least) + 1);
  const auto place = [=](GlobalNumber n) { return static_cast<std::size_t>(value_of(n) - least); };
  for_each_part([&](const HubRing::Part& part) {
    for (const Record* r = part.first; r < part.first + part.count; ++r) table[place(r->number)] = r;
  });
  for (std::size_t i = 0; i < own.count; ++i)
    if (place(own.number(i)) < table.size()) table[place(own.number(i))] = nullptr;
  for (const Record* const r : table)
    if (r != nullptr) all.push_back(*r);
  return all;
}

/// The neighbours of this rank's nodes that it did not bring itself.
template <class Int>
std::vector<Record> find_outside(const Patches<Int>& patches, const ReturnAddresses& addresses,
                                 const std::vector<HubRing>& hub_rings, const LocalNodes& nodes,
                                 Communicator& ranks) {
  const auto size = static_cast<std::size_t>(ranks.size()), me = static_cast<RankNumber>(ranks.rank());
  const auto for_each_hub_neighbour = [&](const auto& visit) {
    for (const HubRing& ring : hub_rings) {
      const auto& from = addresses.own_from[ring.patch];
      const std::size_t i = patches.of_rank[ring.patch].index_of_hub(ring.hub);
      const auto r =
          static_cast<RankNumber>(std::upper_bound(from.begin(), from.end(), i) - from.begin()) - 1;
      for (const HubRing::Part& part : ring.parts) visit(r, part);
    }
  };
  const Parcels incoming = exchange_in_agreement(ranks, [&] {
    std::vector<std::vector<Record>> neighbours(size);
    for (PatchHere k = 0; k < patches.of_rank.size(); ++k)
      patches.of_rank[k].for_each_missing_neighbour(
          me, addresses.own_from[k],
          [&](RankNumber r, const Record& node) { neighbours[r].push_back(node); });
    for_each_hub_neighbour([&](RankNumber r, const HubRing::Part& part) {
      if (r != me) neighbours[r].insert(neighbours[r].end(), part.first, part.first + part.count);
    });
    return packed(neighbours);
  });
  const auto for_each_part = [&](const auto& visit) {
    const Items<Record> items(incoming);
    visit(HubRing::Part{items.begin(), items.size()});
    for_each_hub_neighbour([&](RankNumber r, const HubRing::Part& part) {
      if (r == me) visit(part);
    });
  };
  std::vector<Record> outside;
  in_agreement(ranks, [&] {
    // A patch does not know which nodes this rank brought for other patches, nor does a hub; where there are
    // none, it knows all.
    const bool knows_all =
        addresses.away_begin.back() == 0 && patches.of_rank.size() == 1 && hub_rings.empty();
    outside = one_of_each_but(knows_all ? LocalNodes{} : nodes, for_each_part);
  });
  return outside;
}

}  // namespace

template <class Int>
Stars<Int> return_rings(Certified<Int> certified, ReturnAddresses addresses, const LocalNodes& nodes,
                        const Division& division, Communicator& ranks, const ParallelOptions& options) {
  const auto me = static_cast<RankNumber>(ranks.rank());
  Patches<Int>& patches = certified.patches;
  Stars<Int> stars;
  stars.lengths = division.places.lengths();
  Table<Int> table;
  std::unique_ptr<Workspace> entries;
  Parcels runs;
  std::vector<HubRing> hub_rings;
  if (certified.has_hubs)
    runs = exchange_in_agreement(
        ranks, [&] { return runs_at_hubs(patches, division, static_cast<std::size_t>(ranks.size())); });
  stars.received = exchange_in_agreement(ranks, [&] {
    stars.homes = std::make_unique<Homes>(division, options, loads_of(patches), std::move(certified.hubs));
    stars.memory.reserve(3);  // what is moved there below must not fail
    table.make_room(addresses.own_begin.back());
    entries =
        write_rings(patches, addresses, options.with_neighbours, options.threads, table, stars.more_memory);
    if (certified.has_hubs) {
      hub_rings = joined_runs(patches, runs);
      write_hub_rings(patches, addresses, hub_rings, table, stars.more_memory);
    }
    return rings_for_others(table, addresses, static_cast<std::size_t>(ranks.size()), me);
  });
  enter_received(stars.received, addresses, division.patches, me, table);
  stars.of_node = RingTable<Int>(nodes.count, addresses.position, table.place, table.size_class);
  if (options.with_neighbours) stars.outside = find_outside(patches, addresses, hub_rings, nodes, ranks);
  stars.memory.push_back(std::move(addresses.memory));
  stars.memory.push_back(std::move(table.memory));
  stars.memory.push_back(std::move(options.with_neighbours ? entries : patches.memory));
  return stars;
}

template Stars<std::int32_t> return_rings(Certified<std::int32_t>, ReturnAddresses, const LocalNodes&,
                                          const Division&, Communicator&, const ParallelOptions&);
template Stars<std::int64_t> return_rings(Certified<std::int64_t>, ReturnAddresses, const LocalNodes&,
                                          const Division&, Communicator&, const ParallelOptions&);

}  // namespace pstripack
