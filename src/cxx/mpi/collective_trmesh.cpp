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
#include "parallel/environment_options.h"

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

std::int32_t code_of_count(std::int32_t n) {
  if (n < 3) return kTooFew;
  return n > most_nodes<std::int32_t>() ? kTooMany : 0;
}

/// What a call is about, on every rank.
struct Headline {
  std::int32_t n = 0;
  Point corners[3] = {};  ///< nodes 1 to 3
  PartitionKind partition = PartitionKind::bisection;
  bool wants_cost = false;  ///< rank 0 does

  std::size_t slice(int rank, const Communicator& ranks) const {
    return slice_begin(static_cast<std::size_t>(n), static_cast<std::size_t>(rank),
                       static_cast<std::size_t>(ranks.size()));
  }
};

/// A call by ranks, each of which has a slice of the nodes.
class ByRanks {
 public:
  ByRanks(MpiCommunicator& ranks, Arrays arrays, const TrmeshCall& call, ParallelCost& cost)
      : ranks_(ranks), arrays_(arrays), call_(call), cost_(cost) {}

  /// Collective. The code so far: 0 if the slices can be triangulated.
  TrmeshResult prepare(bool wants_cost);
  std::int32_t n() const { return headline_.n; }
  bool wants_cost() const { return headline_.wants_cost; }
  /// Collective, as triangulate_and_deliver() asks for.
  std::optional<Coincidence> triangulate(std::size_t n);
  void deliver();

  /// Collective. True: the call is done, beginning with the rings of the last one.
  bool begin_with(LastCall& last);
  /// After the cold way: what the next call may need.
  void remember(LastCall& last) noexcept;

 private:
  TrmeshResult take_slice(bool wants_cost);
  TrmeshResult receive_slice(bool wants_cost);
  void find_slices(std::size_t n);
  void deliver(const RingTable<std::int32_t>& rings);
  void take_sample(LastCall& last, const RingTable<std::int32_t>& rings) noexcept;
  /// Looks at this rank's slice, the nodes first.. of the call, and says which has no direction.
  void look(std::size_t first, Smallest& bad) {
    look_ = look_at(nodes_, count_);
    if (look_.first_bad < count_) bad.value = static_cast<std::int64_t>(first + look_.first_bad);
  }

  MpiCommunicator& ranks_;
  const Arrays arrays_;
  const TrmeshCall& call_;
  ParallelCost& cost_;
  Headline headline_;
  // This rank's slice:
  NodeArrays nodes_;
  std::size_t count_ = 0;
  Look look_;
  std::optional<NodeArrays> of_all_ranks_;  ///< where this rank can read them
  Block received_[3];                       ///< x, y, z, where they had to be sent
  // What has been triangulated:
  ParallelOptions options_;
  std::vector<std::size_t> begin_;  ///< of each rank, and the end
  bool knows_slices_ = false;
  bool wants_rings_ = false;  ///< the nodes fit the last call's stars: keep those of this one
  Stars<std::int32_t> stars_;
};

/// Every rank has all nodes.
TrmeshResult ByRanks::take_slice(bool wants_cost) {
  ranks_.set_phase("agree on the arguments");
  const std::int32_t n = headline_.n = call_.n, count_code = code_of_count(n);
  // All pass the same where the smallest is the largest.
  Smallest least_n{n}, least_hash{0}, bad;
  Largest most_n{n}, most_hash;
  OfRank0 partition(ranks_, options_from_environment(0).partition);
  OnAny reported{ranks_.rank() == 0 && wants_cost};
  in_agreement(
      ranks_,
      [&] {
        if (count_code != 0) return;
        const std::size_t bytes = static_cast<std::size_t>(n) * call_.nodes.real_bytes();
        std::uint64_t hash = call_.nodes.real_bytes();
        for (int axis = 0; axis < 3; ++axis) hash = hash_of(call_.nodes.array(axis), bytes, hash);
        least_hash.value = most_hash.value = static_cast<std::int64_t>(hash);
        const std::size_t first = headline_.slice(ranks_.rank(), ranks_);
        nodes_ = call_.nodes.from(first);
        count_ = headline_.slice(ranks_.rank() + 1, ranks_) - first;
        look(first, bad);
        of_all_ranks_ = call_.nodes;
        call_.nodes.copy(0, 3, headline_.corners);
      },
      least_n, most_n, least_hash, most_hash, bad, partition, reported, look_.lengths_are_one,
      look_.deviation);
  headline_.wants_cost = reported.value;
  if (least_n.value != most_n.value || least_hash.value != most_hash.value) return {kRanksDisagree};
  if (count_code != 0) return {count_code};
  headline_.partition = partition.value;
  if (bad.exists()) return {kBadCoordinate, bad.value + 1};
  return {0};
}

/// The nodes are rank 0's, or in memory that all share.
TrmeshResult ByRanks::receive_slice(bool wants_cost) {
  ranks_.set_phase("scatter the nodes");
  const bool is_root = ranks_.rank() == 0;
  if (is_root) {
    headline_.n = call_.n;
    headline_.partition = options_from_environment(0).partition;
    headline_.wants_cost = wants_cost;
    if (code_of_count(call_.n) == 0) call_.nodes.copy(0, 3, headline_.corners);
  }
  ranks_.broadcast(&headline_, sizeof headline_, 0);
  if (const std::int32_t code = code_of_count(headline_.n); code != 0) return {code};

  const std::size_t first = headline_.slice(ranks_.rank(), ranks_), real = call_.nodes.real_bytes();
  count_ = headline_.slice(ranks_.rank() + 1, ranks_) - first;
  const bool by_message = arrays_ == Arrays::on_one_rank, receives = by_message && !is_root;
  std::vector<std::size_t> bytes;
  in_agreement(ranks_, [&] {
    if (receives)
      for (Block& block : received_) block = Block(count_ * real);
    for (int r = 0; r <= ranks_.size(); ++r) bytes.push_back(headline_.slice(r, ranks_) * real);
  });
  for (int axis = 0; axis < 3 && by_message; ++axis)
    ranks_.start_scatter(call_.nodes.array(axis), bytes, received_[axis].data(), receives ? count_ * real : 0,
                         0);
  if (!is_root) ranks_.finish();
  Smallest bad;
  Outcome outcome = Outcome::of([&] {
    if (!by_message) of_all_ranks_ = call_.nodes;
    nodes_ = receives ? NodeArrays(real, received_[0].data(), received_[1].data(), received_[2].data())
                      : call_.nodes.from(first);
    look(first, bad);
  });
  if (is_root) ranks_.finish();
  agree(ranks_, outcome, bad, look_.lengths_are_one, look_.deviation);
  outcome.accept();
  if (bad.exists()) return {kBadCoordinate, bad.value + 1};
  return {0};
}

TrmeshResult ByRanks::prepare(bool wants_cost) {
  const PhaseTimer timer(&cost_, ParallelCost::divide, &ranks_);
  const TrmeshResult result =
      arrays_ == Arrays::on_every_rank ? take_slice(wants_cost) : receive_slice(wants_cost);
  if (result.ier != 0) return result;
  const Point(&corners)[3] = headline_.corners;
  if (left(corners[0], corners[1], corners[2]) == 0) return {kCollinear};
  return {0};
}

/// Of the first n nodes. Collective.
void ByRanks::find_slices(std::size_t n) {
  if (!knows_slices_) {
    in_agreement(ranks_, [&] {
      begin_.resize(static_cast<std::size_t>(ranks_.size()) + 1);
      options_ = options_from_environment(count_);
    });
    knows_slices_ = true;  // all ranks do, or none
    options_.partition = headline_.partition;
    cost_.threads = options_.threads;
  }
  for (std::size_t r = 0; r < begin_.size(); ++r)
    begin_[r] = std::min(n, headline_.slice(static_cast<int>(r), ranks_));
}

std::optional<Coincidence> ByRanks::triangulate(std::size_t n) {
  const auto me = static_cast<std::size_t>(ranks_.rank());
  find_slices(n);
  const std::size_t count = begin_[me + 1] - begin_[me];
  if (n < static_cast<std::size_t>(headline_.n)) {  // again, without a node that coincides
    look_ = look_at(nodes_, count);
    agree_on(look_, ranks_);
    stars_ = {};
  }
  const LocalNodes mine{nodes_, count, nullptr, static_cast<std::int64_t>(begin_[me]) + 1,
                        of_all_ranks_ ? &*of_all_ranks_ : nullptr};
  stars_ = pstripack::triangulate<std::int32_t>(mine, look_, headline_.corners, {1, 2, 3}, ranks_, options_,
                                                &cost_);
  if (stars_.coincident.empty()) return std::nullopt;
  std::optional<Coincidence> first;
  in_agreement(ranks_, [&] { first = first_coincidence(stars_.coincident); });
  return first;
}

void ByRanks::deliver() { deliver(stars_.of_node); }

void ByRanks::deliver(const RingTable<std::int32_t>& rings) {
  ranks_.set_phase("gather the lists");
  const PhaseTimer timer(&cost_, ParallelCost::gather, &ranks_);
  gather_lists(ranks_, rings, begin_, arrays_, 0, call_.lists);
}

bool ByRanks::begin_with(LastCall& last) {
  constexpr int kMostPatience = 64;
  if (last.n != static_cast<std::size_t>(n()) || arrays_ == Arrays::on_one_rank) {
    last = {};
    return false;
  }
  OnAll fits{last.has_sample && warm_start_is_allowed() && last.sample.fits(*of_all_ranks_)},
      have_rings{last.rings != nullptr};
  agree(ranks_, fits, have_rings);
  last.has_sample = false;
  wants_rings_ = fits.value && ++last.patient >= last.patience;
  if (!fits.value || !have_rings.value) {
    last.rings.reset();
    return false;
  }
  bool is_done = false;
  try {
    const PhaseTimer timer(&cost_, ParallelCost::triangulate, &ranks_);
    ranks_.set_phase("move the stars");
    find_slices(last.n);
    is_done = last.rings->move(*of_all_ranks_, begin_, ranks_);
  } catch (const AgreedFailure&) {
    // No memory for it: the cold way has more, without the rings.
  }
  last.patience = is_done ? 1 : std::min(2 * last.patience, kMostPatience);
  last.patient = 0;
  if (!is_done) {
    wants_rings_ = false;
    last.rings.reset();
    return false;
  }
  const MovingStars& stars = last.rings->stars();
  cost_.threads = options_.threads;
  cost_.rounds = stars.rounds();
  cost_.halo = static_cast<std::int64_t>(stars.halo());
  cost_.flips = static_cast<std::int64_t>(stars.flips());
  deliver(last.rings->rings());
  take_sample(last, last.rings->rings());
  return true;
}

void ByRanks::remember(LastCall& last) noexcept {
  constexpr std::size_t kFewest = 1000;  // below, a cold call takes less time than it would be worth
  const auto n = static_cast<std::size_t>(headline_.n);
  if (n < kFewest || arrays_ == Arrays::on_one_rank) return;
  last.n = n;
  take_sample(last, stars_.of_node);
  if (!wants_rings_) return;
  try {
    const std::size_t first = begin_[static_cast<std::size_t>(ranks_.rank())];
    last.rings = std::make_unique<LastRings>(stars_.of_node, first, std::move(stars_.homes));
  } catch (const std::bad_alloc&) {
    // Then the next call goes the cold way as well.
  }
}

/// If there is no memory for it, the next call goes the cold way.
void ByRanks::take_sample(LastCall& last, const RingTable<std::int32_t>& rings) noexcept {
  last.has_sample = false;
  try {
    last.sample = {};
    SampleOfStars::for_each_node(rings.size(), [&](std::size_t k) {
      const Ring<std::int32_t> ring = rings[k];
      if (ring.begin[ring.count - 1] > 0)
        last.sample.add(begin_[static_cast<std::size_t>(ranks_.rank())] + k, ring.begin, ring.count);
    });
    last.has_sample = true;
  } catch (const std::bad_alloc&) {
  }
}

}  // namespace

TrmeshResult collective_trmesh(MpiCommunicator& ranks, Arrays arrays, const TrmeshCall& call, GroupCost* cost,
                               LastCall* last) {
  ParallelCost mine;
  const std::int64_t sent_before = ranks.bytes_sent;
  ByRanks way(ranks, arrays, call, mine);
  TrmeshResult result = way.prepare(cost != nullptr);
  if (result.ier == 0 && (last == nullptr || !way.begin_with(*last))) {
    result = triangulate_and_deliver(way.n(), way);
    if (last != nullptr && result.ier == 0) way.remember(*last);
  }
  if (way.wants_cost()) {
    mine.bytes_sent = ranks.bytes_sent - sent_before;
    const GroupCost all = group_cost(ranks, mine);
    if (cost != nullptr) *cost = all;
  }
  ranks.set_phase("idle");
  return result;
}

}  // namespace pstripack
