#include "parallel/deliver.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "base/parallel_for.h"

namespace pstripack {
namespace {

/// Numbers of nodes on their way to one patch.
struct Count {
  std::size_t own = 0, margin = 0;
  std::size_t all() const { return own + margin; }
  void operator+=(const Count& other) { own += other.own, margin += other.margin; }
};

/// What this rank brings, and which rank it is.
struct Here {
  const LocalNodes& nodes;
  const Division& division;
  RankNumber me;
  const PatchRanges& patches() const { return division.patches; }
  bool has(std::size_t q) const { return patches().rank_of(static_cast<PatchNumber>(q)) == me; }
};

/// Where the nodes of this rank belong; margin and count for each thread.
struct Routes {
  struct MarginNode {
    LocalNode node;
    PatchOfNode patch;
  };
  Routes() = default;
  Routes(std::size_t nodes, std::size_t patches, std::size_t threads)
      : owner(nodes), margin(threads), count(threads, std::vector<Count>(patches)), sent(patches) {}
  BlockArray<PatchOfNode> owner;  ///< of each node
  std::vector<std::vector<MarginNode>> margin;
  std::vector<std::vector<Count>> count;  ///< to each patch
  std::vector<Count> sent;                ///< to each patch, by all threads
};

/// Routes the nodes first..last-1, those of one thread.
void route_some(const Here& here, std::size_t first, std::size_t last, std::size_t thread, Routes& routes) {
  const Partition& partition = *here.division.partition;
  const Places& places = here.division.places;
  std::vector<Count>& count = routes.count[thread];
  // Several counters for each patch: with one, each node would wait until the count of the node before is
  // written.
  constexpr std::size_t kTallies = 4;
  std::vector<std::size_t> own(kTallies * count.size());
  constexpr std::size_t kTogether = 256;
  Point room[kTogether];
  double nearest_plane[kTogether];
  for (std::size_t block = first; block < last; block += kTogether) {
    const std::size_t n = std::min(last - block, kTogether);
    const Point* at = here.nodes.points.points(block, n, room);
    if (places.lengths() != Lengths::as_given) {
      std::transform(at, at + n, room, places);
      at = room;
    }
    PatchOfNode* const owner = routes.owner.data() + block;
    partition.owners(at, n, owner, nearest_plane);
    for (std::size_t i = 0; i < n; ++i) ++own[i % kTallies * count.size() + owner[i]];
    partition.for_each_margin(at, n, owner, nearest_plane, [&](std::size_t i, PatchNumber q) {
      ++count[static_cast<std::size_t>(q)].margin;
      routes.margin[thread].push_back({static_cast<LocalNode>(block + i), static_cast<PatchOfNode>(q)});
    });
  }
  for (std::size_t k = 0; k < own.size(); ++k) count[k % count.size()].own += own[k];
}

Routes routes_of(const Here& here, int threads) {
  Routes routes(here.nodes.count, static_cast<std::size_t>(here.patches().count()),
                static_cast<std::size_t>(threads));
  ErrorsOfThreads errors(routes.count.size());
  parallel_pieces(here.nodes.count, threads, [&](std::size_t first, std::size_t last, int piece) {
    const auto t = static_cast<std::size_t>(piece);
    errors.keep(t, [&] { route_some(here, first, last, t, routes); });
  });
  errors.rethrow();
  for (const auto& count : routes.count)
    for (std::size_t q = 0; q < count.size(); ++q) routes.sent[q] += count[q];
  return routes;
}

/// Where the next items for a patch go. Null: they are not wanted.
template <class Item>
struct Target {
  Item *own = nullptr, *margin = nullptr;
};

/// Writes the items item(i) of the nodes i for the patches that are wanted.
template <class Item, class MakeItem>
void write_items(const Routes& routes, const std::vector<Target<Item>>& targets, const MakeItem& item) {
  std::vector<std::vector<Target<Item>>> next(routes.count.size(), targets);  // of each thread
  for (std::size_t t = 1; t < next.size(); ++t)
    for (std::size_t q = 0; q < targets.size(); ++q)
      if (targets[q].own != nullptr)
        next[t][q] = {next[t - 1][q].own + routes.count[t - 1][q].own,
                      next[t - 1][q].margin + routes.count[t - 1][q].margin};
  parallel_pieces(routes.owner.size(), static_cast<int>(next.size()),
                  [&](std::size_t first, std::size_t last, int piece) {
                    std::vector<Target<Item>>& to = next[static_cast<std::size_t>(piece)];
                    for (std::size_t i = first; i < last; ++i)
                      if (Item*& at = to[routes.owner[i]].own; at != nullptr) *at++ = item(i);
                    for (const Routes::MarginNode& h : routes.margin[static_cast<std::size_t>(piece)])
                      if (Item*& at = to[h.patch].margin; at != nullptr) *at++ = item(h.node);
                  });
}

/// The positions of the rings: those of the nodes of each patch from begin[q] on.
BlockArray<std::uint32_t> positions(Routes routes, const std::vector<std::size_t>& begin) {
  std::vector<std::vector<std::size_t>> next(routes.count.size(), begin);  // of each thread
  for (std::size_t t = 1; t < next.size(); ++t)
    for (std::size_t q = 0; q < begin.size(); ++q) next[t][q] = next[t - 1][q] + routes.count[t - 1][q].own;
  static_assert(std::is_same_v<PatchOfNode, std::uint32_t>);  // written in their place
  parallel_pieces(routes.owner.size(), static_cast<int>(next.size()),
                  [&](std::size_t first, std::size_t last, int piece) {
                    std::vector<std::size_t>& at = next[static_cast<std::size_t>(piece)];
                    for (std::size_t i = first; i < last; ++i)
                      routes.owner[i] = static_cast<std::uint32_t>(at[routes.owner[i]]++);
                  });
  return std::move(routes.owner);
}

/// What is sent of a node to a rank that can read the nodes of all ranks: its number.
using Number = std::uint32_t;

/// body(item), where item(i) is the record of node i of this rank.
template <class Body>
auto with_records(const LocalNodes& nodes, const Body& body) {
  return nodes.points.visit([&](const auto& node) {
    return body([&](std::size_t i) { return SentNode{node(i), nodes.number(i)}; });
  });
}

/// A parcel: the counts of each patch of the rank, then for each patch its own nodes and its margin.
template <class Item, class MakeItem>
Parcels parcels_of(const Here& here, const Routes& routes, const MakeItem& item) {
  const PatchRanges& patches = here.patches();
  ParcelWriter writer(patches.ranks());
  std::vector<Target<Item>> to(routes.sent.size());
  const auto for_each_rank = [&](const auto& visit) {  // visit(rank, its first patch, the next rank's)
    for (RankNumber r = 0; r < patches.ranks(); ++r) {
      const auto first = static_cast<std::size_t>(patches.first(r)), end = first + patches.count(r);
      const bool gets_any =
          std::any_of(routes.sent.begin() + patches.first(r), routes.sent.begin() + patches.end(r),
                      [](const Count& count) { return count.all() > 0; });
      if (r != here.me && gets_any) visit(r, first, end);
    }
  };
  for_each_rank([&](RankNumber r, std::size_t first, std::size_t end) {
    writer.expect<Count>(r, end - first);
    for (std::size_t q = first; q < end; ++q) writer.expect<Item>(r, routes.sent[q].all());
  });
  writer.make_room();
  for_each_rank([&](RankNumber r, std::size_t first, std::size_t end) {
    std::copy_n(&routes.sent[first], end - first, writer.room<Count>(r, end - first));
    for (std::size_t q = first; q < end; ++q) {
      to[q].own = writer.room<Item>(r, routes.sent[q].own);
      to[q].margin = writer.room<Item>(r, routes.sent[q].margin);
    }
  });
  write_items(routes, to, item);
  return writer.finish();
}

Parcels parcels_for_others(const Here& here, const Routes& routes) {
  const LocalNodes& nodes = here.nodes;
  if (nodes.of_all_ranks != nullptr)
    return parcels_of<Number>(here, routes,
                              [&](std::size_t i) { return static_cast<Number>(nodes.number(i)); });
  return with_records(nodes, [&](const auto& record) { return parcels_of<SentNode>(here, routes, record); });
}

/// Unpacks n nodes, which are records or the numbers of some of `all`.
void unpack(const unsigned char*& parcel, std::size_t n, const NodeArrays* all, SentNode* to) {
  if (all == nullptr) {
    std::copy_n(next_items<SentNode>(parcel, n), n, to);
    return;
  }
  const Number* const numbers = next_items<Number>(parcel, n);
  all->visit([&](const auto& node) {
    for (std::size_t i = 0; i < n; ++i) to[i] = {node(numbers[i] - 1), GlobalNumber{numbers[i]}};
  });
}

/// Writes the records of each patch here: those that have arrived and, between them, those of this rank's
/// nodes.
void place_nodes(const Here& here, Routes routes, Parcels arrived, Delivery& delivery) {
  const std::size_t ranks = here.patches().ranks(), patches = here.patches().count(here.me);
  const auto first = static_cast<std::size_t>(here.patches().first(here.me));
  std::vector<std::vector<Count>> brought(ranks, std::vector<Count>(patches));  // by each rank
  std::vector<const unsigned char*> parcel;
  std::size_t records = 0;
  for (RankNumber r = 0; r < ranks; ++r) {
    parcel.push_back(arrived.bytes.data() + arrived.begin[r]);
    if (r == here.me)
      std::copy_n(routes.sent.data() + first, patches, brought[r].data());
    else if (arrived.begin[r] < arrived.begin[r + 1])
      std::copy_n(next_items<Count>(parcel[r], patches), patches, brought[r].data());
    for (const Count& count : brought[r]) records += count.all();
  }
  delivery.nodes = BlockArray<SentNode>(records);
  SentNode* at = delivery.nodes.data();
  std::vector<Target<SentNode>> to(routes.sent.size());
  for (PatchHere k = 0; k < patches; ++k) {
    Count all;
    for (const auto& of_rank : brought) all += of_rank[k];
    delivery.of_patch.push_back({at, all.own, all.margin});
    std::vector<std::size_t>& own_from = delivery.addresses.own_from.emplace_back();
    SentNode *own = at, *margin = at + all.own;
    for (RankNumber r = 0; r < ranks; ++r) {
      own_from.push_back(static_cast<std::size_t>(own - at));
      if (r == here.me) {
        to[first + k] = {own, margin};
      } else {
        unpack(parcel[r], brought[r][k].own, here.nodes.of_all_ranks, own);
        unpack(parcel[r], brought[r][k].margin, here.nodes.of_all_ranks, margin);
      }
      own += brought[r][k].own, margin += brought[r][k].margin;
    }
    own_from.push_back(all.own);
    at = margin;
  }
  arrived = {};
  with_records(here.nodes, [&](const auto& record) { write_items(routes, to, record); });
  std::vector<std::size_t>& begin = delivery.addresses.begin;
  begin.push_back(0);
  std::vector<std::size_t> mine;  // where the rings of this rank's nodes begin
  for (std::size_t q = 0; q < to.size(); ++q) {
    const bool is_here = here.has(q);
    mine.push_back(begin[q] + (is_here ? delivery.addresses.own_from[q - first][here.me] : 0));
    begin.push_back(begin[q] + (is_here ? delivery.of_patch[q - first].own : routes.sent[q].own));
  }
  delivery.addresses.position = positions(std::move(routes), mine);
}

}  // namespace

Delivery deliver(const LocalNodes& nodes, const Division& division, Communicator& ranks, int threads) {
  const Here here{nodes, division, static_cast<RankNumber>(ranks.rank())};
  Delivery delivery;
  Routes routes;
  Parcels arrived = exchange_in_agreement(ranks, [&] {
    routes = routes_of(here, threads);
    return parcels_for_others(here, routes);
  });
  delivery.outcome = Outcome::of([&] { place_nodes(here, std::move(routes), std::move(arrived), delivery); });
  return delivery;
}

}  // namespace pstripack
