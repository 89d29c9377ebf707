#include "parallel/last_rings.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "base/parallel_for.h"
#include "parallel/agreement.h"
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

/// Sends the rings of the slice to the homes of their nodes.
void LastRings::send_home(const LocalNodes& slice, std::size_t nodes_of_all, Communicator& ranks) {
  const Parcels arrived = exchange_in_agreement(ranks, [&] {
    const RingTable<Int>& rings = of_slice_.of_node;
    home_.resize(rings.size());
    for (std::size_t i = 0; i < home_.size(); ++i)
      home_[i] = static_cast<RankOfNode>(homes_->rank(slice.points[i]));
    return packed_rings<Int>(static_cast<std::size_t>(ranks.size()), [&](const auto& visit) {
      for (std::size_t i = 0; i < home_.size(); ++i)
        visit(home_[i], static_cast<Int>(first_node_ + i + 1), rings[i]);
    });
  });
  in_agreement(ranks, [&] {
    std::vector<Ring<Int>> here;
    std::vector<bool> is_here(nodes_of_all + 1);
    for_each_ring<Int>(arrived, [&](Int number, const Ring<Int>& ring) {
      numbers_.push_back(number);
      here.push_back(ring);
      is_here[static_cast<std::size_t>(number)] = true;
    });
    at_home_ = copied_stars<Int>(here.size(), [&](std::size_t i) { return here[i]; });
    for (const Ring<Int>& ring : here)
      for (std::uint32_t k = 0; k < ring.count; ++k)
        if (const Int b = std::abs(ring.begin[k]); !is_here[static_cast<std::size_t>(b)])
          at_home_.outside.push_back({{}, GlobalNumber{b}});
    keep_one_of_each(at_home_.outside);
    points_ = BlockArray<Point>(here.size());
  });
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
  const bool is_first = moving_ == nullptr;
  if (is_first) send_home(slice, begin.back(), ranks);
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
  if (is_first) moving_ = MovingStars::make(home, at_home_, ranks);
  if (moving_ == nullptr || !moving_->repair(home, ranks)) return false;

  const Parcels changed = exchange_in_agreement(ranks, [&] {
    const std::vector<LocalNode> nodes_here = moving_->update(home, at_home_);
    return packed_rings<Int>(size, [&](const auto& visit) {
      for (const LocalNode k : nodes_here) {
        const auto node = static_cast<std::size_t>(numbers_[k]) - 1;
        const auto r = std::upper_bound(begin.begin(), begin.end(), node) - begin.begin() - 1;
        visit(static_cast<RankNumber>(r), static_cast<Int>(numbers_[k]), at_home_.of_node[k]);
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
