#include "mpi/collective_trmesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

#include "base/parallel_for.h"
#include "geometry/predicates.h"
#include "lists/limits.h"
#include "mpi/gather_lists.h"
#include "parallel/agreement.h"
#include "parallel/coincidence.h"
#include "parallel/options.h"

namespace pstripack {
namespace {

constexpr std::int32_t kTooFew = -1, kCollinear = -2, kTooMany = -4, kBadCoordinate = -5, kRanksDisagree = -7;

std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 32)) * 0xd6e8feb86659fd93u;
  return bits ^ (bits >> 29);
}

/// 64 bits that depend on every bit of the array. The blocks are hashed one by one and added, so that the
/// number of threads does not matter.
std::uint64_t hash_of(const void* array, std::size_t size, std::uint64_t seed) {
  constexpr std::size_t kBlock = 1 << 16, kLanes = 4, kStep = kLanes * sizeof(std::uint64_t);
  const auto* const bytes = static_cast<const unsigned char*>(array);
  const std::size_t blocks = (size + kBlock - 1) / kBlock;
  std::vector<std::uint64_t> hash(blocks);
  parallel_pieces(blocks, threads_for(size / 64), [&](std::size_t first, std::size_t last, int) {
    for (std::size_t b = first; b < last; ++b) {
      const std::size_t begin = b * kBlock, end = std::min(begin + kBlock, size);
      std::uint64_t lane[kLanes] = {seed, b, size, 1}, word[kLanes];
      for (std::size_t at = begin; at < end; at += kStep) {
        if (end - at < kStep) std::memset(word, 0, sizeof word);
        std::memcpy(word, bytes + at, std::min(kStep, end - at));
        for (std::size_t i = 0; i < kLanes; ++i) {
          lane[i] = (lane[i] ^ word[i]) * 0x9e3779b97f4a7c15u;
          lane[i] ^= lane[i] >> 32;
        }
      }
      hash[b] = mixed(lane[0] + mixed(lane[1] + mixed(lane[2] + mixed(lane[3]))));
    }
  });
  std::uint64_t sum = mixed(seed);
  for (const std::uint64_t h : hash) sum += h;
  return sum;
}

/// This rank's slice of the nodes.
struct Slice {
  NodeArrays nodes;
  std::size_t count = 0;
  Look look;
  std::optional<NodeArrays> of_all_ranks;  ///< where this rank can read them
  Block received[3];                       ///< x, y, z, where they had to be sent

  /// Looks at nodes first.. of the call; returns the first (from 0, of the call) that has no direction.
  template <class Real>
  std::int64_t take(const Real* x, const Real* y, const Real* z, std::size_t how_many, std::size_t first) {
    nodes = NodeArrays(x, y, z);
    count = how_many;
    look = look_at(nodes, count);
    return look.first_bad < count ? static_cast<std::int64_t>(first + look.first_bad) : Smallest::kNone;
  }
};

std::int32_t code_of_count(std::int32_t n) {
  if (n < 3) return kTooFew;
  return n > most_nodes<std::int32_t>() ? kTooMany : 0;
}

/// What a call is about, on every rank.
struct Call {
  std::int32_t n = 0;
  Point corners[3] = {};  ///< nodes 1 to 3
  PartitionKind partition = PartitionKind::bisection;
  bool wants_cost = false;  ///< rank 0 does
};

/// This rank's slice of the nodes, where every rank has them all. The code is that of the call so far.
template <class Real>
TrmeshResult take_slice(MpiCommunicator& ranks, std::int32_t n, const Real* x, const Real* y, const Real* z,
                        bool wants_cost, Call& call, Slice& slice) {
  ranks.set_phase("agree on the arguments");
  call.n = n;
  const std::int32_t count_code = code_of_count(n);
  // All pass the same where the smallest is the largest.
  Smallest least_n{n}, least_hash{0}, bad;
  Largest most_n{n}, most_hash;
  OfRank0 partition(ranks, options_from_environment(0).partition);
  OnAny reported{ranks.rank() == 0 && wants_cost};
  in_agreement(
      ranks,
      [&] {
        if (count_code != 0) return;
        const auto nodes = static_cast<std::size_t>(n);
        const auto size = static_cast<std::size_t>(ranks.size()), me = static_cast<std::size_t>(ranks.rank());
        const std::size_t first = slice_begin(nodes, me, size), last = slice_begin(nodes, me + 1, size);
        std::uint64_t hash = sizeof(Real);
        for (const Real* const array : {x, y, z}) hash = hash_of(array, nodes * sizeof(Real), hash);
        least_hash.value = most_hash.value = static_cast<std::int64_t>(hash);
        bad.value = slice.take(x + first, y + first, z + first, last - first, first);
        slice.of_all_ranks.emplace(x, y, z);
        slice.of_all_ranks->points(0, 3, call.corners);
      },
      least_n, most_n, least_hash, most_hash, bad, partition, reported, slice.look.lengths_are_one,
      slice.look.deviation);
  call.wants_cost = reported.value;
  if (least_n.value != most_n.value || least_hash.value != most_hash.value) return {kRanksDisagree};
  if (count_code != 0) return {count_code};
  call.partition = partition.value;
  if (bad.exists()) return {kBadCoordinate, bad.value + 1};
  return {0};
}

/// This rank's slice of the nodes of rank 0.
template <class Real>
TrmeshResult receive_slice(MpiCommunicator& ranks, Arrays arrays, std::int32_t n, const Real* x,
                           const Real* y, const Real* z, bool wants_cost, Call& call, Slice& slice) {
  ranks.set_phase("scatter the nodes");
  const bool is_root = ranks.rank() == 0;
  if (is_root) {
    call.n = n;
    call.partition = options_from_environment(0).partition;
    call.wants_cost = wants_cost;
    if (code_of_count(n) == 0) NodeArrays(x, y, z).points(0, 3, call.corners);
  }
  ranks.broadcast(&call, sizeof call, 0);
  if (const std::int32_t code = code_of_count(call.n); code != 0) return {code};

  const auto nodes = static_cast<std::size_t>(call.n);
  const auto size = static_cast<std::size_t>(ranks.size()), me = static_cast<std::size_t>(ranks.rank());
  const std::size_t first = slice_begin(nodes, me, size), count = slice_begin(nodes, me + 1, size) - first;
  const bool by_message = arrays == Arrays::on_rank_0;
  std::vector<std::size_t> bytes;
  in_agreement(ranks, [&] {
    if (by_message && !is_root)
      for (Block& block : slice.received) block = Block(count * sizeof(Real));
    for (std::size_t r = 0; r <= size; ++r) bytes.push_back(slice_begin(nodes, r, size) * sizeof(Real));
  });
  const Real* from[] = {x, y, z};
  for (int i = 0; i < 3 && by_message; ++i)
    ranks.start_scatter(from[i], bytes, slice.received[i].data(), is_root ? 0 : count * sizeof(Real), 0);
  if (!is_root) ranks.finish();
  Smallest bad;
  Outcome outcome = Outcome::of([&] {
    if (!by_message) slice.of_all_ranks.emplace(x, y, z);
    for (int i = 0; i < 3; ++i)
      from[i] =
          by_message && !is_root ? reinterpret_cast<const Real*>(slice.received[i].data()) : from[i] + first;
    bad.value = slice.take(from[0], from[1], from[2], count, first);
  });
  if (is_root) ranks.finish();
  agree(ranks, outcome, bad, slice.look.lengths_are_one, slice.look.deviation);
  outcome.accept();
  if (bad.exists()) return {kBadCoordinate, bad.value + 1};
  return {0};
}

/// The lists of the nodes that the ranks have slices of.
TrmeshResult lists_of_slices(MpiCommunicator& ranks, Arrays arrays, const Call& call, Slice& slice,
                             std::int32_t* list, std::int32_t* lptr, std::int32_t* lend, std::int32_t* lnew,
                             ParallelCost& cost) {
  if (left(call.corners[0], call.corners[1], call.corners[2]) == 0) return {kCollinear};

  const auto size = static_cast<std::size_t>(ranks.size()), me = static_cast<std::size_t>(ranks.rank());
  std::vector<std::size_t> begin;
  ParallelOptions options;
  in_agreement(ranks, [&] {
    begin.resize(size + 1);
    options = options_from_environment(slice.count);
  });
  options.partition = call.partition;
  cost.threads = options.threads;
  const auto cut = [&](std::size_t fewer) {
    for (std::size_t r = 0; r <= size; ++r)
      begin[r] = std::min(fewer, slice_begin(static_cast<std::size_t>(call.n), r, size));
  };
  const auto stars_of_slices = [&] {
    ranks.set_phase("triangulate");
    const LocalNodes mine{slice.nodes, begin[me + 1] - begin[me], nullptr,
                          static_cast<std::int64_t>(begin[me]) + 1,
                          slice.of_all_ranks ? &*slice.of_all_ranks : nullptr};
    return triangulate<std::int32_t>(mine, slice.look, call.corners, {1, 2, 3}, ranks, options, &cost);
  };
  cut(static_cast<std::size_t>(call.n));
  Stars<std::int32_t> stars = stars_of_slices();

  TrmeshResult result{0};
  if (!stars.coincident.empty()) {
    // Nodes 1..M-1 do not coincide, and the first three are not on one great circle: M > 3.
    Coincidence first{};
    in_agreement(ranks, [&] { first = first_coincidence(stars.coincident); });
    result = {static_cast<std::int32_t>(first.l), first.l, first.m};
    cut(static_cast<std::size_t>(first.m) - 1);
    slice.look = look_at(slice.nodes, begin[me + 1] - begin[me]);
    agree_on(slice.look, ranks);
    stars = {};
    stars = stars_of_slices();
  }
  ranks.set_phase("gather the lists");
  const PhaseTimer timer(&cost, ParallelCost::gather, &ranks);
  const int root = arrays == Arrays::on_every_rank ? kEveryRank : arrays == Arrays::shared ? kShared : 0;
  gather_lists(ranks, stars.of_node, begin, root, list, lptr, lend, lnew);
  return result;
}

}  // namespace

template <class Real>
TrmeshResult collective_trmesh(MpiCommunicator& ranks, Arrays arrays, std::int32_t n, const Real* x,
                               const Real* y, const Real* z, std::int32_t* list, std::int32_t* lptr,
                               std::int32_t* lend, std::int32_t* lnew, GroupCost* cost) {
  Call call;
  Slice slice;
  ParallelCost mine;
  const std::int64_t sent_before = ranks.bytes_sent;
  TrmeshResult result{0};
  {
    const PhaseTimer timer(&mine, ParallelCost::divide, &ranks);
    result = arrays == Arrays::on_every_rank
                 ? take_slice(ranks, n, x, y, z, cost != nullptr, call, slice)
                 : receive_slice(ranks, arrays, n, x, y, z, cost != nullptr, call, slice);
  }
  if (result.ier == 0) result = lists_of_slices(ranks, arrays, call, slice, list, lptr, lend, lnew, mine);
  if (call.wants_cost) {
    mine.bytes_sent = ranks.bytes_sent - sent_before;
    const GroupCost all = group_cost(ranks, mine);
    if (cost != nullptr) *cost = all;
  }
  ranks.set_phase("idle");
  return result;
}

template TrmeshResult collective_trmesh(MpiCommunicator&, Arrays, std::int32_t, const double*, const double*,
                                        const double*, std::int32_t*, std::int32_t*, std::int32_t*,
                                        std::int32_t*, GroupCost*);
template TrmeshResult collective_trmesh(MpiCommunicator&, Arrays, std::int32_t, const float*, const float*,
                                        const float*, std::int32_t*, std::int32_t*, std::int32_t*,
                                        std::int32_t*, GroupCost*);

}  // namespace pstripack
