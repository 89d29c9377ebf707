#pragma once
// Halo: the nodes of other ranks that are neighbours of nodes here. Each comes with its address, so a rank
// asks its owner for what it wants to know.

#include <cstddef>
#include <cstdint>
#include <unordered_set>
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

  /// Calls put(j, value) for each node outside, value being what value(k) returned for it on its owner.
  /// Collective. Throws AgreedFailure.
  template <class Value, class GetValue, class Put>
  void fetch(Communicator& ranks, const GetValue& value, const Put& put) const {
    const Parcels arrived = exchange_in_agreement(ranks, [&] {
      ParcelWriter writer(send_.size());
      for (RankNumber r = 0; r < send_.size(); ++r) writer.expect<Value>(r, send_[r].size());
      writer.make_room();
      for (RankNumber r = 0; r < send_.size(); ++r) {
        Value* room = writer.room<Value>(r, send_[r].size());
        for (const LocalNode k : send_[r]) *room++ = value(k);
      }
      return writer.finish();
    });
    const Value* next = Items<Value>(arrived).begin();
    for (const std::vector<OutsideNode>& from : receive_)
      for (const OutsideNode j : from) put(j, *next++);
  }

  // Node k here and node j, of rank r, have become neighbours; the same is called on both ranks, in the same
  // order. Throw std::bad_alloc.
  /// From now on rank r gets the values of node k, unless it does so already.
  void send(RankNumber r, LocalNode k);
  /// From now on they come; j must be new.
  void receive(RankNumber r, OutsideNode j) { receive_[r].push_back(j); }

 private:
  static std::uint64_t key(RankNumber r, LocalNode k) { return std::uint64_t{r} << 32 | k; }
  std::vector<std::vector<LocalNode>> send_;       ///< to each rank
  std::vector<std::vector<OutsideNode>> receive_;  ///< from each rank
  std::unordered_set<std::uint64_t> sent_;         ///< keys of send_; filled by the first send()
};

/// Fetches point and caller's number of each node outside, and sorts them by number. Collective. Throws
/// AgreedFailure.
void fetch_halo(std::vector<HaloNode>& outside, const LocalNodes& nodes, const NodeRanges& ranges,
                Communicator& ranks);

/// The addresses of these nodes. Throws std::bad_alloc.
std::vector<NodeAddress> addresses_of(const std::vector<HaloNode>& outside, const NodeRanges& ranges);

}  // namespace pstripack
