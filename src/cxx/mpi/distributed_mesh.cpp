#include "mpi/distributed_mesh.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel_for.h"
#include "geometry/predicates.h"
#include "lists/limits.h"
#include "mpi/gather_lists.h"
#include "parallel/agreement.h"
#include "parallel/coincidence.h"
#include "parallel/environment_options.h"
#include "parallel/number_table.h"
#include "parallel/scattered.h"
#include "trmesh/trmesh.h"

namespace pstripack {
namespace {

/// Points: below, a cold call takes less time than it would be worth.
constexpr std::int64_t kFewestToBeginWith = 1000;
constexpr std::int64_t kNone = Smallest::kNone;
constexpr std::int64_t kMostPoints = std::int64_t{1} << 29;
constexpr std::int32_t kTooFew = -1, kCollinear = -2, kEmpty = -3, kTooMany = -4, kBadCoordinate = -5,
                       kNoSuchRank = -8, kCoincident = -9, kBadNumber = -10;

bool on_one_line(const Point& a, const Point& b) {
  return same_direction(a, b) || same_direction(a, {-b.x, -b.y, -b.z});
}

template <class Int>
std::int64_t absolute(Int number) {
  return number < 0 ? -static_cast<std::int64_t>(number) : static_cast<std::int64_t>(number);
}

/// Calls visit(b, c) for each triangle (number, b, c), counterclockwise, whose smallest corner is `number`.
template <class Int, class Visit>
void for_each_triangle_of(std::int64_t number, const Int* ring, std::size_t count, const Visit& visit) {
  std::int64_t before = ring[count - 1];
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t b = before, c = absolute(ring[i]);
    before = c;
    if (i == 0 && b < 0) continue;  // the gap of a boundary point
    if (number < b && number < c) visit(b, c);
  }
}

}  // namespace

/// What is known of the global numbers, the same on every rank but for `look`.
struct DistributedMesh::Numbering {
  std::int32_t code = 0;
  std::int64_t total = 0;
  std::int64_t low = kNone, high = 0;  ///< smallest and largest
  PartitionKind partition = PartitionKind::bisection;
  Look look;  ///< at this rank's points
};

/// Room for three points of each rank, in the order of the ranks; number 0: none.
struct DistributedMesh::ThreeOfEach {
  ThreeOfEach() = default;
  explicit ThreeOfEach(std::size_t ranks) : nodes(3 * ranks, Record{{}, 0}) {
    for (std::size_t r = 0; r <= ranks; ++r) begin.push_back(3 * r * sizeof(Record));
  }
  std::vector<Record> nodes;
  std::vector<std::size_t> begin;  ///< bytes
};

void DistributedMesh::clear() {
  error_point_[0] = error_point_[1] = 0;
  is_reported_ = false;
  total_ = 0;
  count_ = 0;
  arcs_ = 0;
  number_ = nullptr;
  memory_.reset();
  short_stars_ = {};
  long_stars_ = {};
  moving_.reset();
  sample_.reset();
}

/// Counts, and the codes that a look at each point tells.
DistributedMesh::Numbering DistributedMesh::look_at(std::int64_t n, const Point* points,
                                                    const std::int64_t* number, bool wants_report) {
  Numbering numbering;
  const bool fits = n >= 0 && n < kMostPoints;
  const std::int64_t* const counts = ranks_.all_gather_one(fits ? n : -1);
  for (int r = 0; r < ranks_.size(); ++r) {
    if (counts[r] < 0) {
      numbering.code = kTooMany;
      return numbering;
    }
    numbering.total += counts[r];
  }
  if (numbering.total < 3) {
    numbering.code = kTooFew;
    return numbering;
  }

  Smallest low, bad;
  Largest high;
  for (std::int64_t i = 0; i < n; ++i) {
    low.value = std::min(low.value, number[i]);
    high.value = std::max(high.value, number[i]);
  }
  const auto count = static_cast<std::size_t>(n);
  numbering.look = pstripack::look_at(points, count);
  for (auto i = static_cast<std::int64_t>(numbering.look.first_bad); i < n; ++i)
    if (!has_direction(points[i])) bad.value = std::min(bad.value, number[i]);
  OfRank0 partition(ranks_, options_from_environment(0).partition);
  OnAny reported{ranks_.rank() == 0 && wants_report};
  agree(ranks_, low, high, bad, partition, reported, numbering.look.lengths_are_one,
        numbering.look.deviation);
  is_reported_ = reported.value;
  numbering.low = low.value;
  numbering.high = high.value;
  numbering.partition = partition.value;
  if (numbering.low < 1) {
    numbering.code = kBadNumber;
    error_point_[0] = numbering.low;
  } else if (bad.exists()) {
    numbering.code = kBadCoordinate;
    error_point_[0] = bad.value;
  }
  return numbering;
}

/// The smallest number that occurs twice; kNone if there is none. As many numbers as low..high has are all of
/// them exactly if each occurs once: then sums of a hash tell, and nothing is sent. A false "none" needs sums
/// of 64 bits that are equal by chance.
std::int64_t DistributedMesh::first_repeated(const std::int64_t* number, std::size_t n,
                                             const Numbering& numbering) {
  if (numbering.high - numbering.low != numbering.total - 1) return search_repeated(number, n);
  const auto all = static_cast<std::size_t>(numbering.total), size = static_cast<std::size_t>(ranks_.size()),
             me = static_cast<std::size_t>(ranks_.rank());
  std::uint64_t difference = 0;
  for (std::size_t i = 0; i < n; ++i) difference += scattered(static_cast<std::uint64_t>(number[i]));
  for (std::size_t i = slice_begin(all, me, size); i < slice_begin(all, me + 1, size); ++i)
    difference -= scattered(static_cast<std::uint64_t>(numbering.low) + i);
  const std::int64_t* const differences = ranks_.all_gather_one(static_cast<std::int64_t>(difference));
  std::uint64_t sum = 0;
  for (std::size_t r = 0; r < size; ++r) sum += static_cast<std::uint64_t>(differences[r]);
  return sum == 0 ? kNone : search_repeated(number, n);
}

/// Every number goes to a rank that its hash names; there all that are equal meet.
std::int64_t DistributedMesh::search_repeated(const std::int64_t* number, std::size_t n) {
  const auto size = static_cast<std::size_t>(ranks_.size());
  const auto rank_of = [size](std::int64_t x) {  // by the upper bits: a table takes the lower ones
    return static_cast<std::size_t>((scattered(static_cast<std::uint64_t>(x)) >> 32) * size >> 32);
  };
  const Parcels here = exchange_in_agreement(ranks_, [&] {
    ParcelWriter writer(size);
    for (std::size_t i = 0; i < n; ++i) writer.expect<std::int64_t>(rank_of(number[i]));
    writer.make_room();
    for (std::size_t i = 0; i < n; ++i) writer.put(rank_of(number[i]), number[i]);
    return writer.finish();
  });
  Smallest repeated;
  in_agreement(
      ranks_,
      [&] {
        const Items<std::int64_t> met(here);
        NumberTable<char> table(met.size());
        constexpr std::ptrdiff_t kAhead = 16;
        for (const std::int64_t* at = met.begin(); at < met.end(); ++at) {
          if (met.end() - at > kAhead) table.prefetch(at[kAhead]);
          if (!table.insert(*at, 0).second) repeated.value = std::min(repeated.value, *at);
        }
      },
      repeated);
  return repeated.value;
}

/// Three points that are not on one great circle; false if there are none. Three from each rank are tried
/// first; only where all of those are on one great circle all points are looked at.
bool DistributedMesh::find_corners(const Point* points, std::size_t n, const std::int64_t* number,
                                   ThreeOfEach& sample, Point (&corners)[3], std::int64_t (&numbers)[3]) {
  const auto fits = [&](int found, const Point& p) {
    if (found == 1) return !on_one_line(corners[0], p);
    return found == 0 || left(corners[0], corners[1], p) != 0;
  };

  Record* const share = sample.nodes.data() + 3 * ranks_.rank();
  const std::size_t sampled = std::min<std::size_t>(n, 3);
  for (std::size_t i = 0; i < sampled; ++i) {
    const std::size_t at = sampled > 1 ? (n - 1) * i / (sampled - 1) : 0;
    share[i] = {points[at], number[at]};
  }
  ranks_.all_gather_in_place(sample.nodes.data(), sample.begin);
  int found = 0;
  for (const Record& r : sample.nodes)
    if (r.number != 0 && found < 3 && fits(found, r.point)) {
      corners[found] = r.point;
      numbers[found++] = r.number;
    }

  for (; found < 3; ++found) {
    Record mine{{}, Smallest::kNone};
    for (std::size_t i = 0; i < n; ++i)
      if (number[i] < mine.number && fits(found, points[i])) mine = {points[i], number[i]};
    Smallest first{mine.number};
    agree(ranks_, first);
    if (!first.exists()) return false;
    const Parcels owner = ranks_.all_gather(&mine, mine.number == first.value ? sizeof mine : 0);
    const Record& corner = *Items<Record>(owner).begin();
    corners[found] = corner.point;
    numbers[found] = corner.number;
  }
  return true;
}

template <class Int>
std::int32_t DistributedMesh::triangulate_into(Stars<Int>& stars, const Point* points, std::size_t n,
                                               const std::int64_t* number, const Numbering& numbering,
                                               ParallelCost& cost) {
  ranks_.set_phase("triangulate");
  const LocalNodes nodes{points, n, number};
  Point corners[3];
  std::int64_t numbers[3];
  ThreeOfEach sample;
  ParallelOptions options;
  std::unique_ptr<Workspace> memory;
  std::int64_t* own_number = nullptr;
  {
    const PhaseTimer timer(&cost, ParallelCost::divide, &ranks_);
    in_agreement(ranks_, [&] {
      sample = ThreeOfEach(static_cast<std::size_t>(ranks_.size()));
      options = options_from_environment(n);
      memory = std::make_unique<Workspace>(n * sizeof *number);
      own_number = memory->keep<std::int64_t>(n);
    });
    if (!find_corners(points, n, number, sample, corners, numbers)) return kCollinear;
  }
  options.partition = numbering.partition;
  options.with_neighbours = true;
  options.last = homes_.get();
  cost.threads = options.threads;
  stars = pstripack::triangulate<Int>(nodes, numbering.look, corners, numbers, ranks_, options, &cost);
  if (!stars.coincident.empty()) {
    Coincidence first{};
    in_agreement(ranks_, [&] { first = first_coincidence(stars.coincident); });
    error_point_[0] = first.l;
    error_point_[1] = first.m;
    return kCoincident;
  }

  const PhaseTimer timer(&cost, ParallelCost::lists, &ranks_);
  memory_ = std::move(memory);
  number_ = own_number;
  std::copy(number, number + n, number_);
  homes_ = std::move(stars.homes);
  were_at_home_ = homes_->are_home_to_most(nodes, ranks_.rank());
  count_ = n;
  arcs_ = static_cast<std::int64_t>(stars.of_node.arcs());
  if (!wants_sample_) return 0;
  try {
    sample_ = sample_of(nodes, stars);
  } catch (const std::bad_alloc&) {
    // Then the next call goes the cold way as well.
  }
  return 0;
}

/// Gathers the costs of all ranks. The report is rank 0's.
void DistributedMesh::report_on(ParallelCost& mine, std::int64_t sent_before, Report* report) {
  if (!is_reported_) return;
  mine.bytes_sent = ranks_.bytes_sent - sent_before;
  const GroupCost cost = group_cost(ranks_, mine);
  std::int64_t boundary = 0;
  for_each_star([&](std::size_t, std::size_t count, const auto* ring) { boundary += ring[count - 1] < 0; });
  const std::int64_t* const of_rank = ranks_.all_gather_one(boundary);
  if (report == nullptr) return;
  report->cost = cost;
  report->boundary_points = std::accumulate(of_rank, of_rank + ranks_.size(), std::int64_t{0});
}

/// The stars of the last call, if they fit these points: true, and they are theirs. False: the call has to go
/// the cold way, on every rank. Collective.
bool DistributedMesh::begin_with_last(std::int64_t n, const Point* points, const std::int64_t* number,
                                      Report* report, ParallelCost& cost) {
  constexpr int kMostPatience = 64;
  wants_sample_ = false;
  if (total_ < kFewestToBeginWith) return false;
  const LocalNodes nodes{points, count_, number_};
  OnAll same{n >= 0 && static_cast<std::size_t>(n) == count_ && std::equal(number, number + n, number_) &&
             warm_start_is_allowed()};
  // Points that leave their homes get new ones, which the cold way finds.
  OnAll fits{same.value && sample_ && sample_->fits(points) &&
             (!were_at_home_ || homes_->are_home_to_most(nodes, ranks_.rank()))};
  OnAny reported{ranks_.rank() == 0 && report != nullptr};
  agree(ranks_, same, fits, reported);
  wants_sample_ = same.value;
  if (!fits.value || ++patient_ < patience_) return false;
  bool is_done = false;
  try {
    is_done =
        numbers_are_short_ ? move_stars(nodes, short_stars_, cost) : move_stars(nodes, long_stars_, cost);
  } catch (const AgreedFailure&) {
    // No memory for it: the cold way has more, without the mesh.
  }
  patience_ = is_done ? 1 : std::min(2 * patience_, kMostPatience);
  patient_ = 0;
  if (!is_done) return false;
  is_reported_ = reported.value;
  if (report != nullptr) report->points = total_;
  return true;
}

template <class Int>
bool DistributedMesh::move_stars(const LocalNodes& nodes, Stars<Int>& stars, ParallelCost& cost) {
  ranks_.set_phase("move the stars");
  {
    const PhaseTimer timer(&cost, ParallelCost::divide, &ranks_);
    if (moving_ == nullptr) moving_ = MovingStars::make(nodes, stars, ranks_);
    if (moving_ == nullptr) return false;
  }
  {
    const PhaseTimer timer(&cost, ParallelCost::triangulate, &ranks_);
    if (!moving_->repair(nodes, ranks_)) return false;
  }
  const PhaseTimer timer(&cost, ParallelCost::lists, &ranks_);
  in_agreement(ranks_, [&] {
    moving_->update(nodes, stars);
    sample_ = moving_->sample();
  });
  arcs_ = static_cast<std::int64_t>(stars.of_node.arcs());
  cost.threads = threads_for(nodes.count);
  cost.halo = static_cast<std::int64_t>(stars.outside.size());
  cost.rounds = moving_->rounds();
  cost.flips = static_cast<std::int64_t>(moving_->flips());
  return true;
}

std::int32_t DistributedMesh::triangulate(std::int64_t n, const double* xyz, const std::int64_t* number,
                                          Report* report) {
  // The caller's coordinates are used where they are: they may be most of the memory of the machine.
  static_assert(sizeof(Point) == 3 * sizeof(double));
  const auto* const points = reinterpret_cast<const Point*>(xyz);
  const std::int64_t sent_before = ranks_.bytes_sent;
  ParallelCost mine;
  std::int32_t code = 0;
  try {
    if (!begin_with_last(n, points, number, report, mine)) {
      clear();
      code = triangulate_points(n, points, number, report, mine);
    }
  } catch (...) {
    make_empty();  // or what there was memory for would pass for a mesh
    throw;
  }
  if (code != 0) homes_.reset();
  report_on(mine, sent_before, report);
  ranks_.set_phase("idle");
  return code;
}

std::int32_t DistributedMesh::triangulate_points(std::int64_t n, const Point* points,
                                                 const std::int64_t* number, Report* report,
                                                 ParallelCost& cost) {
  ranks_.set_phase("look at the points");
  Numbering numbering;
  std::int64_t repeated = kNone;
  const auto count = static_cast<std::size_t>(n);
  {
    const PhaseTimer timer(&cost, ParallelCost::divide, &ranks_);
    numbering = look_at(n, points, number, report != nullptr);
    if (report != nullptr) report->points = numbering.total;
    if (numbering.code != 0) return numbering.code;
    repeated = first_repeated(number, count, numbering);
  }
  if (repeated != kNone) {
    error_point_[0] = repeated;
    return kBadNumber;
  }
  numbers_are_dense_ = numbering.low == 1 && numbering.high == numbering.total;
  numbers_are_short_ = numbering.high <= std::numeric_limits<std::int32_t>::max();
  const std::int32_t code = numbers_are_short_
                                ? triangulate_into(short_stars_, points, count, number, numbering, cost)
                                : triangulate_into(long_stars_, points, count, number, numbering, cost);
  if (code == 0) total_ = numbering.total;
  return code;
}

bool DistributedMesh::home(std::int64_t n, const double* xyz, std::int32_t* rank) const {
  const auto* const points = reinterpret_cast<const Point*>(xyz);
  if (!std::all_of(points, points + n, has_direction)) return false;
  for (std::int64_t i = 0; i < n; ++i) rank[i] = homes_->rank(points[i]);
  return true;
}

void DistributedMesh::stars(std::int64_t* begin, std::int64_t* neighbour) const {
  begin[0] = 0;
  for_each_star([&](std::size_t i, std::size_t count, const auto* ring) {
    begin[i + 1] = begin[i] + static_cast<std::int64_t>(count);
    std::copy(ring, ring + count, neighbour + begin[i]);
  });
}

std::int64_t DistributedMesh::triangles() const {
  std::int64_t triangles = 0;
  for_each_star([&](std::size_t i, std::size_t count, const auto* ring) {
    for_each_triangle_of(number_[i], ring, count, [&](std::int64_t, std::int64_t) { ++triangles; });
  });
  return triangles;
}

void DistributedMesh::triangles(std::int64_t* corner) const {
  for_each_star([&](std::size_t i, std::size_t count, const auto* ring) {
    for_each_triangle_of(number_[i], ring, count, [&](std::int64_t b, std::int64_t c) {
      *corner++ = number_[i];
      *corner++ = b;
      *corner++ = c;
    });
  });
}

void DistributedMesh::halo(std::int64_t* number, double* xyz) const {
  for (const auto& [point, name] : outside()) {
    *number++ = name;
    for (const double c : {point.x, point.y, point.z}) *xyz++ = c;
  }
}

void DistributedMesh::local_stars(std::int64_t* begin, std::int32_t* neighbour) const {
  NumberTable<std::int32_t> local(count_ + outside().size());
  std::int32_t next = 0;
  for (std::size_t i = 0; i < count_; ++i) local.insert(number_[i], ++next);
  for (const Record& point : outside()) local.insert(point.number, ++next);
  begin[0] = 0;
  for_each_star([&](std::size_t i, std::size_t count, const auto* ring) {
    begin[i + 1] = begin[i] + static_cast<std::int64_t>(count);
    for (std::size_t k = 0; k < count; ++k) {
      const std::int32_t found = local.at(absolute(ring[k]));
      *neighbour++ = ring[k] < 0 ? -found : found;
    }
  });
}

std::int32_t DistributedMesh::gather(std::int32_t root, const ListArrays& lists, Report* report) {
  const std::int64_t sent_before = ranks_.bytes_sent;
  if (report != nullptr) report->points = total_;
  ParallelCost mine;
  std::int32_t code = 0;
  {
    const PhaseTimer timer(&mine, ParallelCost::gather, &ranks_);
    code = gather_stars(root, lists);
  }
  report_on(mine, sent_before, report);
  ranks_.set_phase("idle");
  return code;
}

std::int32_t DistributedMesh::gather_stars(std::int32_t root, const ListArrays& lists) {
  if (empty()) return kEmpty;
  if (root < kEveryRank || root >= ranks_.size()) return kNoSuchRank;
  if (!numbers_are_dense_) return kBadNumber;
  if (total_ > most_nodes<std::int32_t>()) return kTooMany;
  ranks_.set_phase("gather the lists");
  const auto n = static_cast<std::size_t>(total_), size = static_cast<std::size_t>(ranks_.size()),
             me = static_cast<std::size_t>(ranks_.rank());

  // Stars go to the rank that has the slice of their number: number, count, neighbours.
  const auto rank_of = [&](std::int64_t number) {  // the r with slice_begin(r) < number <= slice_begin(r+1)
    auto r = static_cast<std::size_t>((number - 1) * static_cast<std::int64_t>(size) / total_);
    while (slice_begin(n, r + 1, size) < static_cast<std::size_t>(number)) ++r;
    while (slice_begin(n, r, size) >= static_cast<std::size_t>(number)) --r;
    return r;
  };
  std::vector<std::size_t> begin;
  const Parcels here = exchange_in_agreement(ranks_, [&] {
    for (std::size_t r = 0; r <= size; ++r) begin.push_back(slice_begin(n, r, size));
    BlockArray<std::uint32_t> rank(count_);
    ParcelWriter writer(size);
    for_each_star([&](std::size_t i, std::size_t count, const auto*) {
      rank[i] = static_cast<std::uint32_t>(rank_of(number_[i]));
      writer.expect<std::int32_t>(rank[i], 2 + count);
    });
    writer.make_room();
    for_each_star(short_stars_, [&](std::size_t i, std::size_t count, const std::int32_t* ring) {
      auto* to = writer.room<std::int32_t>(rank[i], 2 + count);  // numbers up to the total are short
      *to++ = static_cast<std::int32_t>(number_[i]);
      *to++ = static_cast<std::int32_t>(count);
      std::copy(ring, ring + count, to);
    });
    return writer.finish();
  });
  const std::size_t slice = begin[me + 1] - begin[me];
  BlockArray<const std::int32_t*> place;
  BlockArray<std::uint32_t> position;
  BlockArray<std::uint8_t> size_class;
  in_agreement(ranks_, [&] {
    place = BlockArray<const std::int32_t*>(slice);
    position = BlockArray<std::uint32_t>(slice);
    size_class = BlockArray<std::uint8_t>(slice);
  });
  using Rings = RingTable<std::int32_t>;
  const Items<std::int32_t> words(here);
  std::uint32_t k = 0;
  for (const std::int32_t* at = words.begin(); at < words.end(); at += 2 + at[1], ++k) {
    place[k] = at + 1;
    size_class[k] = Rings::size_class_of(static_cast<std::uint32_t>(at[1]));
    position[static_cast<std::size_t>(*at) - 1 - begin[me]] = k;
  }
  gather_lists(ranks_, Rings(slice, position.data(), place.data(), size_class.data()), begin,
               root == kEveryRank ? Arrays::on_every_rank : Arrays::on_one_rank, root, lists);
  return 0;
}

}  // namespace pstripack
