#include "parallel/deliver.h"

#include <algorithm>
#include <optional>

#include "base/parallel_for.h"

namespace pstripack {
namespace {

/// Numbers of nodes on their way to one patch.
struct Count {
  std::size_t own = 0, halo = 0;
  std::size_t all() const { return own + halo; }
  Count& operator+=(const Count& other) {
    own += other.own, halo += other.halo;
    return *this;
  }
};

/// What this rank brings, and which rank it is.
struct Here {
  const LocalNodes& nodes;
  const Division& division;
  RankNumber me;
  std::size_t ranks;
  const PatchRanges& patches() const { return division.patches; }
};

/// Where the nodes of this rank belong; halo and count for each thread.
struct Routes {
  struct HaloNode {
    LocalNode node;
    PatchOfNode patch;
  };
  Routes(std::size_t nodes, std::size_t patches, std::size_t threads)
      : memory(nodes * sizeof *owner),
        halo(threads),
        count(threads, std::vector<Count>(patches)),
        sent(patches) {}
  Workspace memory;
  PatchOfNode* owner = nullptr;  ///< of each node; null: there is one patch only
  std::vector<std::vector<HaloNode>> halo;
  std::vector<std::vector<Count>> count;  ///< to each patch
  std::vector<Count> sent;                ///< to each patch, by all threads
};

/// Routes the nodes first..last-1, those of one thread.
void route_some(const Here& here, std::size_t first, std::size_t last, std::size_t thread, Routes& routes) {
  const Division& division = here.division;
  const std::size_t patches = routes.sent.size();
  const Partition& partition = *division.partition;
  auto& count = routes.count[thread];
  auto& halo = routes.halo[thread];
  // Several counters for each patch: with one, each node would wait until the count of the node before is
  // written.
  constexpr std::size_t kTallies = 4;
  std::vector<std::size_t> own(kTallies * patches);
  // Most nodes are often deep in the first patch of this rank. That test is faster than finding the owner, so
  // the owner is found for the other nodes only.
  bool most_are_deep = division.patches.count(here.me) > 0;
  const auto home = static_cast<PatchOfNode>(division.patches.first(here.me));
  constexpr std::size_t kTogether = 256;
  Point place[kTogether];
  std::uint32_t which[kTogether];
  PatchOfNode its_owner[kTogether];
  double nearest_plane[kTogether];
  for (std::size_t block = first; block < last; block += kTogether) {
    const std::size_t all = std::min(last - block, kTogether);
    const Point* at = here.nodes.points.points(block, all, place);
    if (division.places.lengths() != Lengths::as_given) {
      for (std::size_t i = 0; i < all; ++i) place[i] = division.places(at[i]);
      at = place;
    }
    PatchOfNode* const owner = routes.owner + block;
    const auto route = [&](std::size_t n, const auto& index) {
      partition.owners(at, n, its_owner, nearest_plane);
      for (std::size_t i = 0; i < n; ++i) {
        ++own[i % kTallies * patches + its_owner[i]];
        owner[index(i)] = its_owner[i];
      }
      partition.for_each_halo(at, n, its_owner, nearest_plane, [&](std::size_t i, PatchNumber q) {
        ++count[static_cast<std::size_t>(q)].halo;
        halo.push_back({static_cast<LocalNode>(block + index(i)), static_cast<PatchOfNode>(q)});
      });
    };
    if (most_are_deep) {
      std::fill(owner, owner + all, home);
      const std::size_t n = partition.not_deep(static_cast<PatchNumber>(home), at, all, which);
      own[home] += all - n;
      for (std::size_t i = 0; i < n; ++i) place[i] = at[which[i]];
      at = place;
      route(n, [&](std::size_t i) { return which[i]; });
      most_are_deep = 2 * n <= all;
    } else {
      route(all, [](std::size_t i) { return i; });
    }
  }
  for (std::size_t k = 0; k < own.size(); ++k) count[k % patches].own += own[k];
}

void find_routes(const Here& here, Routes& routes) {
  const std::size_t nodes = here.nodes.count;
  const std::size_t patches = routes.sent.size(), threads = routes.count.size();
  if (patches == 1) {
    routes.sent[0].own = nodes;
    parallel_pieces(nodes, static_cast<int>(threads), [&](std::size_t first, std::size_t last, int piece) {
      routes.count[static_cast<std::size_t>(piece)][0].own = last - first;
    });
    return;
  }
  routes.owner = routes.memory.for_call<PatchOfNode>(nodes);
  ErrorsOfThreads errors(threads);
  parallel_pieces(nodes, static_cast<int>(threads), [&](std::size_t first, std::size_t last, int piece) {
    const auto t = static_cast<std::size_t>(piece);
    errors.keep(t, [&] { route_some(here, first, last, t, routes); });
  });
  errors.rethrow();
  for (const auto& count : routes.count)
    for (std::size_t q = 0; q < patches; ++q) routes.sent[q] += count[q];
}

/// Where items go: those for patch q to base[q], from begin[q] on. table[q] is the place that the patch's
/// item 0 would have in the table of rings.
template <class Item>
struct Destinations {
  explicit Destinations(std::size_t patches) : base(patches), begin(patches), table(patches) {}
  std::vector<Item*> base;  ///< null: items for this patch are not wanted
  std::vector<Count> begin;
  std::vector<std::size_t> table;
};

/// Writes the items item(i) of the nodes i for the patches that are wanted, and where their rings will be.
template <class Item, class MakeItem>
void write_items(std::size_t nodes, const Routes& routes, const Destinations<Item>& to, const MakeItem& item,
                 std::uint32_t* position) {
  std::vector<std::vector<Count>> next(routes.count.size(), to.begin);  // where each thread goes on
  for (std::size_t t = 1; t < next.size(); ++t) {
    next[t] = next[t - 1];
    for (std::size_t q = 0; q < next[t].size(); ++q) next[t][q] += routes.count[t - 1][q];
  }
  parallel_pieces(nodes, static_cast<int>(next.size()), [&](std::size_t first, std::size_t last, int piece) {
    auto& place = next[static_cast<std::size_t>(piece)];
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t q = routes.owner != nullptr ? routes.owner[i] : 0;
      if (to.base[q] == nullptr) continue;
      const std::size_t at = place[q].own++;
      to.base[q][at] = item(i);
      position[i] = static_cast<std::uint32_t>(to.table[q] + at);
    }
    for (const auto& h : routes.halo[static_cast<std::size_t>(piece)])
      if (to.base[h.patch] != nullptr) to.base[h.patch][place[h.patch].halo++] = item(h.node);
  });
}

/// What is sent of a node to a rank that can read the nodes of all ranks: its number.
using Number = std::uint32_t;

/// body(item), where item(i) is the record of node i of this rank.
template <class Body>
auto with_records(const LocalNodes& nodes, const Body& body) {
  return nodes.points.visit([&](const auto& node) {
    return body([&](std::size_t i) { return Record{node(i), nodes.number(i)}; });
  });
}

/// A parcel: the counts of each patch of the rank, then for each patch its own nodes and its halo.
template <class Item, class MakeItem>
Parcels parcels_of(const Here& here, const Routes& routes, const MakeItem& item,
                   const ReturnAddresses& addresses) {
  const PatchRanges& patches = here.patches();
  ParcelWriter writer(here.ranks);
  Destinations<Item> to(routes.sent.size());
  std::vector<std::size_t> items(here.ranks);
  for (RankNumber r = 0; r < here.ranks; ++r) {
    if (r == here.me) continue;
    for (auto q = static_cast<std::size_t>(patches.first(r)); q < static_cast<std::size_t>(patches.end(r));
         ++q) {
      to.begin[q] = {items[r], items[r] + routes.sent[q].own};
      to.table[q] = addresses.away_begin[q] - to.begin[q].own;
      items[r] += routes.sent[q].all();
    }
    if (items[r] == 0) continue;
    writer.expect<Count>(r, patches.count(r));
    writer.expect<Item>(r, items[r]);
  }
  writer.make_room();
  if (writer.empty()) return writer.finish();
  for (RankNumber r = 0; r < here.ranks; ++r) {
    if (items[r] == 0) continue;
    const auto first = static_cast<std::size_t>(patches.first(r));
    std::copy_n(&routes.sent[first], patches.count(r), writer.room<Count>(r, patches.count(r)));
    std::fill_n(to.base.begin() + patches.first(r), patches.count(r), writer.room<Item>(r, items[r]));
  }
  write_items(here.nodes.count, routes, to, item, addresses.position);
  return writer.finish();
}

Parcels parcels_for_others(const Here& here, const Routes& routes, const ReturnAddresses& addresses) {
  const LocalNodes& nodes = here.nodes;
  if (nodes.of_all_ranks != nullptr)
    return parcels_of<Number>(
        here, routes, [&](std::size_t i) { return static_cast<Number>(nodes.number(i)); }, addresses);
  return with_records(
      nodes, [&](const auto& record) { return parcels_of<Record>(here, routes, record, addresses); });
}

/// What one rank has sent for a patch: its own nodes, then its halo, as records or as numbers.
class Segment {
 public:
  Segment() = default;
  Segment(ParcelReader& reader, Count c, const NodeArrays* all) : count(c), all_(all) {
    if (all != nullptr)
      numbers_ = reader.array<Number>(c.all());
    else
      records_ = reader.array<Record>(c.all());
  }
  /// Its items first..last-1.
  void copy(std::size_t first, std::size_t last, Record* to) const {
    if (numbers_ != nullptr)
      all_->visit([&](const auto& node) {
        for (std::size_t i = first; i < last; ++i) *to++ = {node(numbers_[i] - 1), GlobalNumber{numbers_[i]}};
      });
    else if (records_ != nullptr)
      std::copy(records_ + first, records_ + last, to);
  }
  Count count;

 private:
  const NodeArrays* all_ = nullptr;
  const Record* records_ = nullptr;
  const Number* numbers_ = nullptr;
};

/// For each patch here, what each rank has sent. Nodes of this rank are only counted.
std::vector<std::vector<Segment>> segments_of(const Parcels& arrived, const Here& here,
                                              const Routes& routes) {
  const std::size_t patches = here.patches().count(here.me);
  std::vector<std::vector<Segment>> segments(patches, std::vector<Segment>(here.ranks));
  for (RankNumber r = 0; r < here.ranks; ++r) {
    if (r == here.me || arrived.begin[r + 1] == arrived.begin[r]) continue;
    ParcelReader reader(arrived, r);
    const Count* const counts = reader.array<Count>(patches);
    for (PatchHere k = 0; k < patches; ++k)
      segments[k][r] = Segment(reader, counts[k], here.nodes.of_all_ranks);
  }
  for (PatchHere k = 0; k < patches; ++k)
    segments[k][here.me].count = routes.sent[static_cast<std::size_t>(here.patches().first(here.me)) + k];
  return segments;
}

/// Writes the records of each patch here: those that have arrived and, between them, those of this rank's
/// nodes.
void place_nodes(const Here& here, const Routes& routes, Parcels arrived, Delivery& delivery) {
  const auto segments = segments_of(arrived, here, routes);
  ReturnAddresses& addresses = delivery.addresses;
  std::vector<Count> total;
  std::size_t records = 0;
  addresses.own_begin.push_back(addresses.away_begin.back());
  for (const auto& of_patch : segments) {
    std::vector<std::size_t>& from = addresses.own_from.emplace_back(1, 0);
    Count& all = total.emplace_back();
    for (const Segment& s : of_patch) {
      from.push_back(from.back() + s.count.own);
      all += s.count;
    }
    addresses.own_begin.push_back(addresses.own_begin.back() + all.own);
    records += all.all();
  }
  delivery.memory = std::make_unique<Workspace>(records * sizeof(Record));
  Record* at = delivery.memory->for_call<Record>(records);
  Destinations<Record> to(routes.sent.size());
  for (PatchHere k = 0; k < segments.size(); ++k) {
    const std::size_t q = static_cast<std::size_t>(here.patches().first(here.me)) + k;
    delivery.of_patch.push_back({at, total[k].own, total[k].halo});
    to.base[q] = at;
    to.table[q] = addresses.own_begin[k];
    Record *own = at, *halo = at + total[k].own;
    for (const Segment& s : segments[k]) {
      if (&s == &segments[k][here.me])
        to.begin[q] = {static_cast<std::size_t>(own - at), static_cast<std::size_t>(halo - at)};
      s.copy(0, s.count.own, own);
      s.copy(s.count.own, s.count.all(), halo);
      own += s.count.own, halo += s.count.halo;
    }
    at = halo;
  }
  arrived = {};
  with_records(here.nodes, [&](const auto& record) {
    write_items(here.nodes.count, routes, to, record, addresses.position);
  });
}

}  // namespace

Delivery deliver(const LocalNodes& nodes, const Division& division, Communicator& ranks, int threads) {
  const Here here{nodes, division, static_cast<RankNumber>(ranks.rank()),
                  static_cast<std::size_t>(ranks.size())};
  Delivery delivery;
  std::optional<Routes> routes;
  Parcels arrived = exchange_in_agreement(ranks, [&] {
    const auto count = static_cast<std::size_t>(here.patches().count());
    routes.emplace(nodes.count, count, static_cast<std::size_t>(threads));
    ReturnAddresses& addresses = delivery.addresses;
    addresses.memory = std::make_unique<Workspace>(nodes.count * sizeof *addresses.position);
    addresses.position = addresses.memory->for_call<std::uint32_t>(nodes.count);
    find_routes(here, *routes);
    addresses.away_begin.assign(1, 0);
    for (std::size_t q = 0; q < count; ++q)
      addresses.away_begin.push_back(
          addresses.away_begin.back() +
          (here.patches().rank_of(static_cast<PatchNumber>(q)) == here.me ? 0 : routes->sent[q].own));
    return parcels_for_others(here, *routes, addresses);
  });
  delivery.outcome = Outcome::of([&] { place_nodes(here, *routes, std::move(arrived), delivery); });
  return delivery;
}

}  // namespace pstripack
