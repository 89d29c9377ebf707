#include "mpi/collective_trmesh.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <iterator>
#include <optional>
#include <vector>

#include "base/parallel_for.h"
#include "base/splitmix64.h"
#include "geometry/predicates.h"
#include "lists/limits.h"
#include "mpi/numbering.h"
#include "parallel/agreement.h"
#include "parallel/coincidence.h"
#include "parallel/environment_options.h"
#include "trmesh/warm_start.h"

namespace pstripack {
namespace {

/// Hash of the first n nodes, 64 bits: a sum over the nodes, so that the number of threads does not matter.
std::uint64_t hash_of(const NodeArrays& nodes, std::size_t n) {
  std::atomic<std::uint64_t> sum{splitmix64(nodes.real_bytes())};
  nodes.visit([&](const auto& node) {
    parallel_pieces(n, threads_for(n / 4), [&](std::size_t first, std::size_t last, int) {
      std::uint64_t of_piece = 0;
      for (std::size_t i = first; i < last; ++i) {
        const Point p = node(i);
        std::uint64_t hash = i, words[3];
        std::memcpy(words, &p, sizeof p);
        for (const std::uint64_t word : words) {
          hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
          hash ^= hash >> 32;
        }
        of_piece += hash;
      }
      sum += of_piece;
    });
  });
  return sum;
}

struct CallHeader {
  std::int32_t n = 0;
  Point corners[3] = {};  ///< nodes 1 to 3
  PartitionKind partition = PartitionKind::bisection;
  bool wants_cost = false;  ///< rank 0 does

  std::size_t slice(int rank, const Communicator& ranks) const {
    return slice_begin(static_cast<std::size_t>(n), static_cast<std::size_t>(rank),
                       static_cast<std::size_t>(ranks.size()));
  }
};

/// A call, and the slice of its nodes that this rank has: nodes first..first+count-1 (from 0).
struct Share {
  TrmeshResult result{0};  ///< so far; ier = 0 if the slices can be triangulated
  CallHeader header;
  NodeArrays nodes;
  std::size_t first = 0, count = 0;
  NodeCheck check;
  std::optional<NodeArrays> of_all_ranks;  ///< all nodes, if this rank can read them
  Block received[3];                       ///< x, y, z, if they were sent to this rank

  void set_slice(const Communicator& ranks) {
    first = header.slice(ranks.rank(), ranks);
    count = header.slice(ranks.rank() + 1, ranks) - first;
  }
  /// Checks the slice. `bad`: the first node of the call (from 0) that is zero or not finite.
  void check_slice(Smallest& bad) {
    check = check_nodes(nodes, count);
    if (check.first_bad < count) bad.value = static_cast<std::int64_t>(first + check.first_bad);
  }
};

/// The result where ranks disagree in N or in the hash of the coordinates. Collective.
TrmeshResult disagreement(std::int32_t n, std::int64_t hash, MpiCommunicator& ranks) {
  if (const WrongArgument other = first_different(n, ranks); other.rank >= 0)
    return {PSTRIPACK_RANKS_DISAGREE, other.value, other.rank};
  return {PSTRIPACK_RANKS_DISAGREE, n, first_different(hash, ranks).rank};
}

/// For Arrays::on_every_rank, where every rank has all nodes. Collective.
Share take_slice(const TrmeshCall& call, bool wants_cost, MpiCommunicator& ranks) {
  Share share;
  CallHeader& header = share.header;
  const std::int32_t n = header.n = call.n, count_code = code_of_count(n);
  // All ranks pass the same arguments if the smallest hash is the largest.
  Smallest least_n{n}, least_hash{0}, bad;
  Largest most_n{n}, most_hash;
  OfRank0 partition(ranks, options_from_environment(0).partition);
  OnAny reported{ranks.rank() == 0 && wants_cost};
  std::int64_t hash = 0;
  in_agreement(
      ranks,
      [&] {
        if (count_code != 0) return;
        hash = static_cast<std::int64_t>(hash_of(call.nodes, static_cast<std::size_t>(n)));
        least_hash.value = most_hash.value = hash;
        share.set_slice(ranks);
        share.nodes = call.nodes.from(share.first);
        share.check_slice(bad);
        share.of_all_ranks = call.nodes;
        call.nodes.copy(0, 3, header.corners);
      },
      least_n, most_n, least_hash, most_hash, bad, partition, reported, share.check.lengths_are_one,
      share.check.deviation);
  header.wants_cost = reported.value;
  header.partition = partition.value;
  if (least_n.value != most_n.value || least_hash.value != most_hash.value)
    share.result = disagreement(n, hash, ranks);
  else if (count_code != 0)
    share.result = {count_code};
  else if (bad.exists())
    share.result = {PSTRIPACK_BAD_COORDINATE, bad.value + 1};
  return share;
}

/// For Arrays::on_one_rank and shared. Collective.
Share receive_slice(const TrmeshCall& call, Arrays arrays, bool wants_cost, MpiCommunicator& ranks) {
  const bool is_root = ranks.rank() == 0;
  Share share;
  CallHeader& header = share.header;
  if (is_root) {
    header.n = call.n;
    header.partition = options_from_environment(0).partition;
    header.wants_cost = wants_cost;
    if (code_of_count(call.n) == 0) call.nodes.copy(0, 3, header.corners);
  }
  ranks.broadcast(&header, sizeof header, 0);
  share.result = {code_of_count(header.n)};
  if (share.result.ier != 0) return share;

  share.set_slice(ranks);
  const std::size_t real = call.nodes.real_bytes();
  const bool by_message = arrays == Arrays::on_one_rank, receives = by_message && !is_root;
  std::vector<std::size_t> bytes;
  in_agreement(ranks, [&] {
    if (receives)
      for (Block& block : share.received) block = Block(share.count * real);
    for (int r = 0; r <= ranks.size(); ++r) bytes.push_back(header.slice(r, ranks) * real);
  });
  for (int axis = 0; axis < 3 && by_message; ++axis)
    ranks.start_scatter(call.nodes.array(axis), bytes, share.received[axis].data(), share.count * real, 0);
  if (!is_root) ranks.finish();
  Smallest bad;
  Outcome outcome = Outcome::of([&] {
    if (!by_message) share.of_all_ranks = call.nodes;
    share.nodes = receives ? NodeArrays(real, share.received[0].data(), share.received[1].data(),
                                        share.received[2].data())
                           : call.nodes.from(share.first);
    share.check_slice(bad);
  });
  if (is_root) ranks.finish();
  agree(ranks, outcome, bad, share.check.lengths_are_one, share.check.deviation);
  outcome.accept();
  if (bad.exists()) share.result = {PSTRIPACK_BAD_COORDINATE, bad.value + 1};
  return share;
}

/// This rank's share of the call. Collective. Throws AgreedFailure.
Share share_of(const TrmeshCall& call, Arrays arrays, bool wants_cost, MpiCommunicator& ranks,
               ParallelCost& cost) {
  const PhaseTimer timer(&cost, ParallelCost::divide, &ranks);
  Share share = arrays == Arrays::on_every_rank ? take_slice(call, wants_cost, ranks)
                                                : receive_slice(call, arrays, wants_cost, ranks);
  const Point(&corners)[3] = share.header.corners;
  if (share.result.ier == 0 && left(corners[0], corners[1], corners[2]) == 0)
    share.result = {PSTRIPACK_COLLINEAR};
  return share;
}

/// A call carried out by ranks, each of which has a slice of the nodes.
class ByRanks {
 public:
  /// `share`: as share_of(), with result 0. Collective. Throws AgreedFailure.
  ByRanks(MpiCommunicator& ranks, Arrays arrays, const ListArrays& lists, Share& share, ParallelCost& cost)
      : ranks_(ranks), arrays_(arrays), lists_(lists), share_(share), cost_(cost) {
    in_agreement(ranks_, [&] {
      begin_.resize(static_cast<std::size_t>(ranks_.size()) + 1);
      options_ = options_from_environment(share_.count);
    });
    options_.partition = share_.header.partition;
    cost_.set_threads({options_.threads, options_.thread_limit});
  }

  /// Collective, as triangulate_and_write() asks for.
  std::optional<Coincidence> triangulate(std::size_t n) {
    const auto me = static_cast<std::size_t>(ranks_.rank());
    for (std::size_t r = 0; r < begin_.size(); ++r)
      begin_[r] = std::min(n, share_.header.slice(static_cast<int>(r), ranks_));
    const std::size_t count = begin_[me + 1] - begin_[me];
    if (n < this->n()) {  // the second try, without nodes that coincide
      share_.check = check_nodes(share_.nodes, count);
      agree_on(share_.check, ranks_);
      stars_ = {};
    }
    stars_ = pstripack::triangulate<std::int32_t>(slice(count), share_.check, share_.header.corners,
                                                  {1, 2, 3}, ranks_, options_, &cost_);
    if (stars_.coincident.empty()) return std::nullopt;
    std::optional<Coincidence> first;
    in_agreement(ranks_, [&] { first = first_coincidence(stars_.coincident); });
    return first;
  }
  void write() {
    const PhaseTimer timer(&cost_, ParallelCost::gather, &ranks_);
    gather_lists(ranks_, stars_.of_node, begin_, arrays_, 0, lists_);
  }

 private:
  std::size_t n() const { return static_cast<std::size_t>(share_.header.n); }
  /// The first `count` nodes of this rank's slice.
  LocalNodes slice(std::size_t count) const {
    return {share_.nodes, count, nullptr, static_cast<std::int64_t>(share_.first) + 1,
            share_.of_all_ranks ? &*share_.of_all_ranks : nullptr};
  }

  MpiCommunicator& ranks_;
  const Arrays arrays_;
  const ListArrays& lists_;
  Share& share_;
  ParallelCost& cost_;
  ParallelOptions options_;
  // The last triangulation:
  std::vector<std::size_t> begin_;  ///< by rank: the begin of its slice; then the number of nodes
  Stars<std::int32_t> stars_;
};

/// With more ranks a cold call takes less time than a warm one on each of them.
constexpr int kMostRanksForWarmStart = 8;

/// Every rank makes the mesh from its own one of an earlier call. False, with nothing written, unless all
/// have done so. Collective.
bool begin_with(WarmStart& warm_start, const ListArrays& lists, MpiCommunicator& ranks, ParallelCost& cost) {
  OnAll found{warm_start.find_mesh(&cost)};
  agree(ranks, found);
  if (!found.value || ranks.rank() != 0) cost.flips = found.value ? 0 : -1;  // rank 0 counts them
  if (found.value) warm_start.write(lists, &cost);
  return found.value;
}

}  // namespace

TrmeshResult collective_trmesh(MpiCommunicator& ranks, Arrays arrays, const TrmeshCall& call,
                               GroupCost* cost) {
  ParallelCost mine;
  const std::int64_t sent_before = ranks.bytes_sent;
  Share share = share_of(call, arrays, cost != nullptr, ranks, mine);
  TrmeshResult result = share.result;
  if (result.ier == 0) {
    std::optional<WarmStart> warm_start;
    if (arrays == Arrays::on_every_rank && ranks.size() <= kMostRanksForWarmStart)
      warm_start.emplace(call.nodes, static_cast<std::size_t>(call.n));
    if (!warm_start || !begin_with(*warm_start, call.lists, ranks, mine)) {
      ByRanks way(ranks, arrays, call.lists, share, mine);
      result = triangulate_and_write(share.header.n, way);
      if (warm_start && result.ier == 0) warm_start->remember(call.lists);
    }
  }
  if (share.header.wants_cost) {
    mine.bytes_sent = ranks.bytes_sent - sent_before;
    const GroupCost all = group_cost(ranks, mine);
    if (cost != nullptr) *cost = all;
  }
  return result;
}

}  // namespace pstripack
