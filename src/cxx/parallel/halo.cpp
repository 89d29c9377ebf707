#include "parallel/halo.h"

#include <algorithm>
#include <new>
#include <numeric>

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
  std::vector<LocalNode>& to = send_[r];
  if (std::find(to.begin(), to.end(), k) == to.end()) to.push_back(k);
}

Halo Halo::renamed(const std::vector<OutsideNode>& names) const {
  Halo halo;
  halo.send_ = send_;
  halo.receive_ = receive_;
  for (std::vector<OutsideNode>& from : halo.receive_)
    for (OutsideNode& j : from)
      if (j != kNobody) j = names[index_of(j)];
  return halo;
}

Halo::Transfer Halo::transfer(std::size_t bytes, Communicator& ranks) const {
  const auto begins = [&](const auto& lists) {
    std::vector<std::size_t> begin(static_cast<std::size_t>(ranks.size()) + 1);
    for (RankNumber r = 0; r < lists.size(); ++r) {
      if (lists[r].size() > (PTRDIFF_MAX - begin[r]) / bytes) throw std::bad_alloc();
      begin[r + 1] = begin[r] + lists[r].size() * bytes;
    }
    return begin;
  };
  Transfer transfer{bytes, {{}, begins(send_)}, {{}, begins(receive_)}};
  transfer.outgoing.bytes = Block(transfer.outgoing.begin.back());
  ranks.make_room(transfer.outgoing, transfer.incoming);
  return transfer;
}

std::vector<NodeAddress> addresses_of(const std::vector<HaloNode>& outside, const NodeRanges& ranges) {
  std::vector<NodeAddress> addresses;
  addresses.reserve(outside.size());
  for (const HaloNode& node : outside) addresses.push_back(ranges.address(node.counted));
  return addresses;
}

Halo fetch_halo(std::vector<HaloNode>& outside, const LocalNodes& nodes, const NodeRanges& ranges,
                Communicator& ranks) {
  std::vector<NodeAddress> addresses;
  in_agreement(ranks, [&] { addresses = addresses_of(outside, ranges); });
  const Halo halo(addresses, ranks);
  halo.fetch<SentNode>(
      ranks,
      [&](LocalNode k) {
        return SentNode{nodes.points[k], nodes.number(k)};
      },
      [&](OutsideNode j, const SentNode& node) {
        outside[index_of(j)].point = node.point;
        outside[index_of(j)].number = node.number;
      });
  Halo sorted;
  in_agreement(ranks, [&] {
    std::vector<std::size_t> order(outside.size());
    std::vector<OutsideNode> names(outside.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return outside[a].number < outside[b].number; });
    std::vector<HaloNode> nodes_by_number;
    for (const std::size_t j : order) {
      names[j] = OutsideNode{static_cast<std::uint32_t>(nodes_by_number.size())};
      nodes_by_number.push_back(outside[j]);
    }
    outside.swap(nodes_by_number);
    sorted = halo.renamed(names);
  });
  return sorted;
}

}  // namespace pstripack
