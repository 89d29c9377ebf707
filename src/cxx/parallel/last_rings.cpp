#include "parallel/last_rings.h"

#include <algorithm>
#include <utility>

#include "base/parallel_for.h"
#include "parallel/agreement.h"
#include "parallel/number_table.h"
#include "parallel/ring_parcels.h"

namespace pstripack {
namespace {

using Int = std::int32_t;

}  // namespace

LastRings::LastRings(const RingTable<Int>& rings, std::size_t first_node, std::unique_ptr<const Homes> homes)
    : stay_(2 * (rings.arcs() + 4 * rings.size()) * sizeof(Int)),
      first_node_(first_node),
      homes_(std::move(homes)),
      of_slice_(copied_stars<Int>(rings.size(), [&](std::size_t i) { return rings[i]; })) {}

/// Sends the rings of the slice to the homes of their nodes, and makes those that arrive moving stars.
void LastRings::send_home(const LocalNodes& slice, Communicator& ranks) {
  const auto size = static_cast<std::size_t>(ranks.size()), me = static_cast<std::size_t>(ranks.rank());
  const Parcels arrived = exchange_in_agreement(ranks, [&] {
    const RingTable<Int>& rings = of_slice_.of_node;
    home_.resize(rings.size());
    for (std::size_t i = 0; i < home_.size(); ++i)
      home_[i] = static_cast<RankOfNode>(homes_->rank(slice.points[i]));
    return packed_rings<Int>(size, [&](const auto& visit) {
      for (std::size_t i = 0; i < home_.size(); ++i)
        visit(home_[i], static_cast<Int>(first_node_ + i + 1), rings[i]);
    });
  });
  std::vector<Ring<Int>> rings;
  in_agreement(ranks, [&] {
    for_each_ring<Int>(arrived, [&](Int number, const Ring<Int>& ring) {
      numbers_.push_back(number);
      rings.push_back(ring);
    });
    points_ = BlockArray<Point>(rings.size());
  });

  // From here on nodes are counted through the homes. Those of one slice follow each other at home in the
  // order of the slice, so the slice's rank is told the first.
  const std::int64_t* const counts = ranks.all_gather_one(static_cast<std::int64_t>(rings.size()));
  NodeRanges ranges;
  const Parcels told = exchange_in_agreement(ranks, [&] {
    ranges = NodeRanges(counts, size);
    std::vector<std::vector<std::int64_t>> first(size);
    for (std::size_t k = numbers_.size(); k-- > 0;)
      first[slices_.address(GlobalNumber{numbers_[k]}).rank] = {ranges.first(me) +
                                                                static_cast<std::int64_t>(k)};
    return packed(first);
  });
  std::vector<GlobalNumber> of_slice;
  std::optional<NumberTable<GlobalNumber>> counted, counted_outside;  // by the caller's number
  Stars<Int> stars;
  std::vector<NodeAddress> outside;
  in_agreement(ranks, [&] {
    std::vector<std::int64_t> next(size);
    for (RankNumber r = 0; r < size; ++r)
      for (const std::int64_t first : Items<std::int64_t>(told, r)) next[r] = first;
    for (const RankOfNode home : home_) of_slice.push_back(GlobalNumber{next[home]++});

    counted.emplace(numbers_.size());
    for (std::size_t k = 0; k < numbers_.size(); ++k)
      counted->insert(GlobalNumber{numbers_[k]},
                      GlobalNumber{ranges.first(me) + static_cast<std::int64_t>(k)});
    std::vector<GlobalNumber> named;
    for (const Ring<Int>& ring : rings)
      for (std::uint32_t k = 0; k < ring.count; ++k)
        if (const GlobalNumber b = named_by(ring.begin[k]); counted->find_value(b) == nullptr)
          named.push_back(b);
    std::sort(named.begin(), named.end());
    named.erase(std::unique(named.begin(), named.end()), named.end());
    for (const GlobalNumber b : named) {
      stars.outside.push_back({{}, kNoNumber, b});
      outside.push_back(slices_.address(b));
    }
    counted_outside.emplace(named.size());
  });
  Halo(outside, ranks)
      .fetch<GlobalNumber>(
          ranks, [&](LocalNode i) { return of_slice[i]; },
          [&](OutsideNode j, GlobalNumber number) {
            HaloNode& node = stars.outside[index_of(j)];
            node.counted = number;
            counted_outside->insert(node.number, number);
          });
  in_agreement(ranks, [&] {
    auto nodes = std::move(stars.outside);
    stars = copied_stars<Int>(
        rings.size(), [&](std::size_t k) { return rings[k]; },
        [&](std::size_t, Int e) {
          const GlobalNumber* const here = counted->find_value(named_by(e));
          return static_cast<Int>(here != nullptr ? *here : counted_outside->at(named_by(e)));
        });
    stars.outside = std::move(nodes);
  });
  moving_ = MovingStars::make({points_.data(), numbers_.size(), numbers_.data()}, ranges, stars, ranks);
}

/// Sends the positions of the slice's nodes to their homes, in the order in which their rings were sent.
void LastRings::send_places(const LocalNodes& slice, Communicator& ranks) {
  const Parcels arrived = exchange_in_agreement(ranks, [&] {
    ParcelWriter writer(static_cast<std::size_t>(ranks.size()));
    for (const RankOfNode r : home_) writer.expect<Point>(r);
    writer.make_room();
    slice.points.visit([&](const auto& node) {
      for (std::size_t i = 0; i < home_.size(); ++i) writer.put<Point>(home_[i], node(i));
    });
    return writer.finish();
  });
  const Items<Point> places(arrived);
  std::copy(places.begin(), places.end(), points_.data());
}

bool LastRings::move(const LocalNodes& slice, const std::vector<std::size_t>& begin, Communicator& ranks) {
  const auto size = static_cast<std::size_t>(ranks.size());
  if (moving_ == nullptr) {
    in_agreement(ranks, [&] {
      std::vector<std::int64_t> counts;
      for (RankNumber r = 0; r < size; ++r)
        counts.push_back(static_cast<std::int64_t>(begin[r + 1] - begin[r]));
      slices_ = NodeRanges(counts.data(), size);
    });
    send_home(slice, ranks);
    if (moving_ == nullptr) return false;
  }
  const std::size_t n = numbers_.size();
  if (slice.of_all_ranks == nullptr)
    send_places(slice, ranks);
  else
    parallel_pieces(n, threads_for(n), [&](std::size_t first, std::size_t last, int) {
      slice.of_all_ranks->visit([&](const auto& node) {
        for (std::size_t k = first; k < last; ++k)
          points_[k] = node(static_cast<std::size_t>(numbers_[k]) - 1);
      });
    });
  const LocalNodes home{points_.data(), n, numbers_.data()};
  if (!moving_->repair(home, ranks)) return false;

  const Parcels changed = exchange_in_agreement(ranks, [&] {
    const MovingStars::Changed rings = moving_->take_changed(home);
    return packed_rings<Int>(size, [&](const auto& visit) {
      const Int* at = rings.rings.data();
      for (const LocalNode k : rings.nodes) {
        visit(slices_.address(home.number(k)).rank, static_cast<Int>(numbers_[k]), ring_at(at));
        at += 1 + *at;
      }
    });
  });
  in_agreement(ranks, [&] { replace(changed); });
  return true;
}

/// Puts the changed rings in place of those of the slice.
void LastRings::replace(const Parcels& changed) {
  Stars<Int>& stars = of_slice_;
  const std::size_t entries = Items<Int>(changed).size();
  Buffer<Int> rings(entries + kBlock);
  std::copy_n(Items<Int>(changed).begin(), entries, rings.data());
  for (const Int* at = rings.data(); at < rings.data() + entries; at += 2 + at[1])
    stars.of_node.replace(static_cast<std::size_t>(at[0]) - 1 - first_node_, at + 1);
  stars.more_memory.push_back(std::move(rings));
  replaced_ += entries;
  if (replaced_ <= 8 * stars.of_node.size()) return;  // then the rings that are not used any more are freed
  stars = copied_stars<Int>(stars.of_node.size(), [&](std::size_t i) { return stars.of_node[i]; });
  replaced_ = 0;
}

}  // namespace pstripack
