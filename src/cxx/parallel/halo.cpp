#include "parallel/halo.h"

#include <algorithm>

namespace pstripack {

Halo::Halo(const std::vector<NodeAddress>& outside, Communicator& ranks) {
  const auto size = static_cast<std::size_t>(ranks.size());
  const Parcels wanted = exchange_in_agreement(ranks, [&] {
    send_.resize(size);
    receive_.resize(size);
    std::vector<std::vector<LocalNode>> from(size);
    for (std::uint32_t j = 0; j < outside.size(); ++j) {
      from[outside[j].rank].push_back(outside[j].node);
      receive_[outside[j].rank].push_back(OutsideNode{j});
    }
    return packed(from);
  });
  in_agreement(ranks, [&] {
    for (RankNumber r = 0; r < size; ++r) {
      const Items<LocalNode> nodes(wanted, r);
      send_[r].assign(nodes.begin(), nodes.end());
    }
  });
}

void Halo::send(RankNumber r, LocalNode k) {
  if (sent_.empty())
    for (RankNumber to = 0; to < send_.size(); ++to)
      for (const LocalNode node : send_[to]) sent_.insert(key(to, node));
  if (sent_.insert(key(r, k)).second) send_[r].push_back(k);
}

std::vector<NodeAddress> addresses_of(const std::vector<HaloNode>& outside, const NodeRanges& ranges) {
  std::vector<NodeAddress> addresses;
  addresses.reserve(outside.size());
  for (const HaloNode& node : outside) addresses.push_back(ranges.address(node.counted));
  return addresses;
}

void fetch_halo(std::vector<HaloNode>& outside, const LocalNodes& nodes, const NodeRanges& ranges,
                Communicator& ranks) {
  std::vector<NodeAddress> addresses;
  in_agreement(ranks, [&] { addresses = addresses_of(outside, ranges); });
  Halo(addresses, ranks)
      .fetch<SentNode>(
          ranks,
          [&](LocalNode k) {
            return SentNode{nodes.points[k], nodes.number(k)};
          },
          [&](OutsideNode j, const SentNode& node) {
            outside[index_of(j)].point = node.point;
            outside[index_of(j)].number = node.number;
          });
  std::sort(outside.begin(), outside.end(),
            [](const HaloNode& a, const HaloNode& b) { return a.number < b.number; });
}

}  // namespace pstripack
