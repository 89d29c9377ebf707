#pragma once
// Halo: the nodes of other ranks that are neighbours of nodes here. Each rank tells once which nodes it has
// outside. From then on both sides know what travels.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/point.h"
#include "parallel/agreement.h"
#include "parallel/communicator.h"
#include "parallel/local_nodes.h"
#include "parallel/node_ranges.h"
#include "parallel/sent_node.h"

namespace pstripack {

/// A node outside: another rank brings it, and a star here names it.
struct HaloNode {
  Point point;
  GlobalNumber counted;  ///< counted through all ranks: see NodeRanges
  GlobalNumber number;   ///< the caller's
};

/// Sends values of nodes from their owners to the ranks that have them outside.
class Halo {
 public:
  Halo() = default;
  /// outside[j] is the address of OutsideNode j, each once; none is here. Collective. Throws AgreedFailure.
  Halo(const std::vector<NodeAddress>& outside, Communicator& ranks);
  /// The same where node j outside has the name names[j]; values for kNobody are dropped. Throws
  /// std::bad_alloc.
  Halo renamed(const std::vector<OutsideNode>& names) const;
  static constexpr OutsideNode kNobody{UINT32_MAX};

  /// Messages of values of so many bytes each.
  struct Transfer {
    std::size_t bytes = 0;
    Parcels outgoing, incoming;
  };
  /// Memory for any number of transfers, one after another. Not collective. Throws std::bad_alloc.
  Transfer transfer(std::size_t bytes, Communicator& ranks) const;
  /// write(k, to) writes the value of node k. All ranks have called transfer(). Collective.
  template <class Write>
  void start(Communicator& ranks, Transfer& transfer, const Write& write) const {
    for (RankNumber r = 0; r < send_.size(); ++r) {
      unsigned char* to = transfer.outgoing.bytes.data() + transfer.outgoing.begin[r];
      for (const LocalNode k : send_[r]) write(k, to), to += transfer.bytes;
    }
    ranks.start(transfer.outgoing, transfer.incoming);
  }
  /// Waits for the values, and calls read(j, value) for each node outside.
  template <class Read>
  void finish(Communicator& ranks, const Transfer& transfer, const Read& read) const {
    ranks.finish();
    const unsigned char* value = transfer.incoming.bytes.data();
    for (const std::vector<OutsideNode>& from : receive_)
      for (const OutsideNode j : from) {
        if (j != kNobody) read(j, value);
        value += transfer.bytes;
      }
  }

  /// Calls put(j, value) for each node outside, value being what value(k) returned for it on its owner.
  /// Collective.
  template <class Value, class GetValue, class Put>
  void fetch(Communicator& ranks, Transfer& transfer, const GetValue& value, const Put& put) const {
    start(ranks, transfer, [&](LocalNode k, void* to) { *static_cast<Value*>(to) = value(k); });
    finish(ranks, transfer,
           [&](OutsideNode j, const void* from) { put(j, *static_cast<const Value*>(from)); });
  }
  /// The same once. Throws AgreedFailure.
  template <class Value, class GetValue, class Put>
  void fetch(Communicator& ranks, const GetValue& value, const Put& put) const {
    Transfer once;
    in_agreement(ranks, [&] { once = transfer(sizeof(Value), ranks); });
    fetch<Value>(ranks, once, value, put);
  }

  // Node k here and node j, of rank r, have become neighbours; the same is called on both ranks, in the same
  // order. Throw std::bad_alloc.
  /// From now on rank r gets the values of node k, unless it does so already.
  void send(RankNumber r, LocalNode k);
  /// From now on they come; j must be new.
  void receive(RankNumber r, OutsideNode j) { receive_[r].push_back(j); }

 private:
  std::vector<std::vector<LocalNode>> send_;       ///< to each rank
  std::vector<std::vector<OutsideNode>> receive_;  ///< from each rank
};

/// Fetches point and caller's number of each node outside, and sorts them by number. The result exchanges
/// their values in this order. Collective. Throws AgreedFailure.
Halo fetch_halo(std::vector<HaloNode>& outside, const LocalNodes& nodes, const NodeRanges& ranges,
                Communicator& ranks);

/// The addresses of these nodes. Throws std::bad_alloc.
std::vector<NodeAddress> addresses_of(const std::vector<HaloNode>& outside, const NodeRanges& ranges);

}  // namespace pstripack
