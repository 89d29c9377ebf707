#include "mpi/distributed_mesh.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <numeric>

#include "base/parallel_for.h"
#include "geometry/predicates.h"
#include "lists/limits.h"
#include "mpi/gather_lists.h"
#include "parallel/agreement.h"
#include "parallel/coincidence.h"
#include "parallel/environment_options.h"
#include "parallel/ring_parcels.h"

namespace pstripack {
namespace {

constexpr std::size_t kValueBytes = 8;  ///< of a double, and of an integer that travels

}  // namespace

void DistributedMesh::clear() {
  error_point_[0] = error_point_[1] = 0;
  wrong_argument_ = {};
  total_ = 0;
  is_reported_ = false;
  end_exchanges();
  own_ = {};
  next_.moving.take();
  next_.sample.reset();
}

std::int32_t DistributedMesh::triangulate(std::int64_t n, const double* xyz, const std::int64_t* number,
                                          Report* report, bool by_direction) {
  by_direction_ = by_direction;
  // The caller's coordinates are not copied: they may take most of the memory of the machine.
  static_assert(sizeof(Point) == 3 * sizeof(double));
  const LocalNodes points{reinterpret_cast<const Point*>(xyz), static_cast<std::size_t>(n), number};
  const std::int64_t sent_before = ranks_.bytes_sent;
  end_exchanges();
  ParallelCost mine;
  std::int32_t code = 0;
  try {
    if (!begin_with_last(points, report, mine)) {
      const bool numbers_are_known = !empty() && has_numbers_of_last(points);
      clear();
      code = triangulate_points(points, numbers_are_known, report, mine);
    }
  } catch (...) {
    make_empty();  // what was made so far is not a mesh
    throw;
  }
  if (code != 0) homes_.reset();
  report_on(mine, sent_before, report);
  return code;
}

std::int32_t DistributedMesh::triangulate_points(const LocalNodes& points, bool numbers_are_known,
                                                 Report* report, ParallelCost& cost) {
  Numbering numbering;
  {
    const PhaseTimer timer(&cost, ParallelCost::divide, &ranks_);
    numbering = check_all(points, report != nullptr, numbers_are_known, ranks_);
    numbering.check.by_direction.value = by_direction_;
  }
  if (report != nullptr) report->points = numbering.total;
  is_reported_ = numbering.is_reported;
  error_point_[0] = numbering.error_point;
  wrong_argument_ = numbering.wrong_count;
  if (numbering.code != 0) return numbering.code;
  const std::int32_t code = numbering.total <= INT32_MAX
                                ? triangulate_into<std::int32_t>(points, numbering, cost)
                                : triangulate_into<std::int64_t>(points, numbering, cost);
  if (code == 0) {
    total_ = numbering.total;
    numbers_are_dense_ = numbering.is_dense();
  }
  return code;
}

template <class Int>
std::int32_t DistributedMesh::triangulate_into(const LocalNodes& points, const Numbering& numbering,
                                               ParallelCost& cost) {
  // The numbers that the caller gives are of no use to the ranks; a counted one tells who has the point.
  const auto me = static_cast<RankNumber>(ranks_.rank());
  const NodeRanges& ranges = numbering.ranges;
  const LocalNodes counted{points.points, points.count, nullptr, ranges.first(me)};
  ParallelOptions options;
  BlockArray<std::int64_t> numbers;
  std::optional<Corners> corners;
  {
    const PhaseTimer timer(&cost, ParallelCost::divide, &ranks_);
    in_agreement(ranks_, [&] {
      options = options_from_environment(points.count);
      numbers = BlockArray<std::int64_t>(points.count);
    });
    corners = find_corners(counted, ranks_);
    if (!corners) return PSTRIPACK_COLLINEAR;
  }
  const auto& [a, b, c] = *corners;
  options.partition = numbering.partition;
  options.with_neighbours = true;
  options.last = homes_.get();
  cost.set_threads({options.threads, options.thread_limit});
  Stars<Int> stars = pstripack::triangulate<Int>(counted, numbering.check, {a.point, b.point, c.point},
                                                 {value_of(a.number), value_of(b.number), value_of(c.number)},
                                                 ranks_, options, &cost);
  if (!stars.coincident.empty()) {
    const Coincidence first = first_coincidence_of(stars.coincident, points, ranges);
    error_point_[0] = first.l;
    error_point_[1] = first.m;
    return PSTRIPACK_COINCIDENT;
  }

  const PhaseTimer timer(&cost, ParallelCost::lists, &ranks_);
  std::copy(points.numbers, points.numbers + points.count, numbers.data());
  homes_ = std::move(stars.homes);
  next_.are_at_home = are_at_home(points);
  if (next_.wants_sample) {
    try {
      next_.sample = sample_of(stars, ranges, me);
    } catch (const std::bad_alloc&) {
      // No memory: the next call is cold, too.
    }
  }
  stars.halo = fetch_halo(stars.outside, points, ranges, ranks_);
  in_agreement(ranks_, [&] { own_ = OwnStars(std::move(numbers), ranges, me, std::move(stars)); });
  return 0;
}

/// The same for pairs of counted numbers, in the caller's, which their ranks know. Collective.
Coincidence DistributedMesh::first_coincidence_of(const CoincidentPairs& counted, const LocalNodes& points,
                                                  const NodeRanges& ranges) {
  std::vector<std::int64_t> numbers;
  in_agreement(ranks_, [&] {
    const auto add = [&](GlobalNumber c) {
      const NodeAddress a = ranges.address(c);
      numbers.push_back(a.rank == static_cast<RankOfNode>(ranks_.rank()) ? value_of(points.number(a.node))
                                                                         : 0);
    };
    for (const auto& [a, b] : counted) add(a), add(b);
  });
  ranks_.all_sum(numbers.data(), numbers.size());
  Coincidence first{};
  in_agreement(ranks_, [&] {
    CoincidentPairs pairs;
    for (std::size_t k = 0; k < numbers.size(); k += 2)
      pairs.emplace_back(GlobalNumber{numbers[k]}, GlobalNumber{numbers[k + 1]});
    first = first_coincidence(pairs);
  });
  return first;
}

bool DistributedMesh::has_numbers_of_last(const LocalNodes& points) const {
  return points.count == own_.count() &&
         std::equal(own_.numbers(), own_.numbers() + own_.count(), points.numbers);
}

/// Warm start: repairs the stars of the last call for these points. True if the call is done. False if it
/// must be cold, on every rank. Collective.
bool DistributedMesh::begin_with_last(const LocalNodes& points, Report* report, ParallelCost& cost) {
  next_.wants_sample = false;
  if (total_ < static_cast<std::int64_t>(kFewestForWarmStart)) return false;
  OnAll allowed{warm_start_is_allowed() && points.count < kMostPoints};
  OnAll same{has_numbers_of_last(points)};
  OnAll fits{allowed.value && same.value && next_.sample && next_.sample->fits(points.points)};
  OnAll were_at_home{next_.are_at_home}, are_at_home{allowed.value && this->are_at_home(points)};
  OnAny reported{ranks_.rank() == 0 && report != nullptr};
  std::unique_ptr<MovingStars> moving = next_.moving.take();
  OnAll have_moving{moving != nullptr};  // if not, all ranks make them anew
  agree(ranks_, allowed, same, fits, were_at_home, are_at_home, reported, have_moving);
  if (!allowed.value) return false;
  if (!have_moving.value && same.value) moving.reset();
  std::optional<Relocation> relocation;
  if (!same.value) {
    try {
      const PhaseTimer timer(&cost, ParallelCost::divide, &ranks_);
      relocation = relocation_to(points, fits);
    } catch (const AgreedFailure&) {
      // No memory: then there is no relocation.
    }
    if (!relocation) return false;
  }
  next_.wants_sample = true;
  // If many points leave their homes, or some homes become crowded, the points need new homes, which a cold
  // call finds.
  const bool stay_at_home = !were_at_home.value || are_at_home.value;
  if (!fits.value || !stay_at_home || !patience_.is_enough()) return false;
  bool is_done = false;
  try {
    is_done = move_stars(std::move(moving), std::move(relocation), points, cost);
  } catch (const AgreedFailure&) {
    // No memory: a cold call has more, without the mesh.
  }
  is_done ? patience_.succeed() : patience_.fail();
  if (!is_done) return false;
  is_reported_ = reported.value;
  if (report != nullptr) report->points = total_;
  return true;
}

/// The relocation from the points of the last call to these, if they have the same numbers. `fits`: the
/// sample of stars fits. Collective.
std::optional<Relocation> DistributedMesh::relocation_to(const LocalNodes& points, OnAll& fits) {
  std::optional<Relocation> relocation = Relocation::find(own_.numbers(), own_.ranges(), points, ranks_);
  if (!relocation) return relocation;
  in_agreement(
      ranks_, [&] { fits.value = next_.sample && relocation->sample(*next_.sample).fits(points.points); },
      fits);
  return relocation;
}

/// Moves the stars of the last call to the ranks that have their points now. Collective.
void DistributedMesh::relocate(Relocation& relocation, const LocalNodes& points) {
  BlockArray<std::int64_t> numbers;
  in_agreement(ranks_, [&] {
    numbers = BlockArray<std::int64_t>(points.count);
    std::copy_n(points.numbers, points.count, numbers.data());
  });
  next_.are_at_home = are_at_home(points);
  OwnStars moved;
  own_.visit([&](const auto& last) {
    auto stars = relocation.stars(last, points, ranks_);
    in_agreement(ranks_, [&] {
      moved = OwnStars(std::move(numbers), relocation.ranges(), static_cast<RankNumber>(ranks_.rank()),
                       std::move(stars));
    });
  });
  own_ = std::move(moved);
}

bool DistributedMesh::move_stars(std::unique_ptr<MovingStars> moving, std::optional<Relocation> relocation,
                                 const LocalNodes& points, ParallelCost& cost) {
  {
    const PhaseTimer timer(&cost, ParallelCost::divide, &ranks_);
    if (relocation) relocate(*relocation, points);
    if (relocation || moving == nullptr)
      moving = own_.visit([&](const auto& stars) {
        return MovingStars::make(points, own_.ranges(), stars, ranks_, std::move(moving),
                                 relocation ? &*relocation : nullptr);
      });
    relocation.reset();
    if (moving == nullptr) return false;
  }
  {
    const PhaseTimer timer(&cost, ParallelCost::triangulate, &ranks_);
    if (!moving->repair(points, ranks_, by_direction_ ? Confirm::directions : Confirm::nothing)) return false;
  }
  const PhaseTimer timer(&cost, ParallelCost::lists, &ranks_);
  in_agreement(ranks_, [&] {
    own_.change([&](auto& stars) {
      moving->update(stars);
      next_.sample = sample_of(stars, own_.ranges(), static_cast<RankNumber>(ranks_.rank()));
    });
  });
  cost.set_threads(thread_count(points.count));
  cost.halo = static_cast<std::int64_t>(own_.outside().size());
  cost.rounds = moving->rounds();
  cost.flips = static_cast<std::int64_t>(moving->flips());
  next_.moving.put(std::move(moving));
  return true;
}

/// Gathers the costs of all ranks into `report`. Collective, if rank 0 wants a report.
void DistributedMesh::report_on(ParallelCost& mine, std::int64_t sent_before, Report* report) {
  if (!is_reported_) return;
  mine.bytes_sent = ranks_.bytes_sent - sent_before;
  const GroupCost cost = group_cost(ranks_, mine);
  const std::int64_t* const of_rank = ranks_.all_gather_one(own_.boundary_points());
  if (report == nullptr) return;
  report->cost = cost;
  report->boundary_points = std::accumulate(of_rank, of_rank + ranks_.size(), std::int64_t{0});
}

bool DistributedMesh::home(std::int64_t n, const double* xyz, std::int32_t* rank) const {
  const auto* const points = reinterpret_cast<const Point*>(xyz);
  if (!std::all_of(points, points + n, has_direction)) return false;
  for (std::int64_t i = 0; i < n; ++i) rank[i] = homes_->rank(points[i]);
  return true;
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
  return code;
}

std::int32_t DistributedMesh::begin_exchange(const void* values, std::int64_t width) {
  const auto* const bytes = static_cast<const unsigned char*>(values);
  wrong_argument_ = {};
  Halo::Transfer made;
  Outcome outcome = Outcome::of([&] {
    if (empty() || width < 1) return;
    if (width > static_cast<std::int64_t>(PTRDIFF_MAX / kValueBytes)) throw std::bad_alloc();
    made = own_.halo().transfer(static_cast<std::size_t>(width) * kValueBytes, ranks_);
    exchanges_.reserve(exchanges_.size() + 1);
  });
  Smallest least{width};
  Largest most{width};
  begin(MeshCall::exchange, outcome, least, most);
  if (empty()) return PSTRIPACK_EMPTY_MESH;
  if (least.value < 1 || least.value != most.value) {
    const std::int64_t* const of_rank = ranks_.all_gather_one(width);
    int rank = 0;
    while (least.value < 1 ? of_rank[rank] > 0 : of_rank[rank] == of_rank[0]) ++rank;
    wrong_argument_ = {rank, of_rank[rank]};
    return least.value < 1 ? PSTRIPACK_BAD_SIZE : PSTRIPACK_RANKS_DISAGREE;
  }
  outcome.accept();
  exchanges_.push_back(std::move(made));
  Halo::Transfer& transfer = exchanges_.back();
  own_.halo().start(ranks_, transfer, [&](LocalNode k, void* to) {
    std::memcpy(to, bytes + k * transfer.bytes, transfer.bytes);
  });
  return 0;
}

std::int32_t DistributedMesh::end_exchange(std::int64_t width, void* halo_values, bool is_newest) {
  if (exchanges_.empty()) return PSTRIPACK_EMPTY_MESH;
  const auto exchange = is_newest ? exchanges_.end() - 1 : exchanges_.begin();
  const std::size_t bytes = exchange->bytes;
  if (width != static_cast<std::int64_t>(bytes / kValueBytes)) return PSTRIPACK_BAD_SIZE;
  own_.halo().finish(ranks_, *exchange, [&](OutsideNode j, const void* from) {
    std::memcpy(static_cast<unsigned char*>(halo_values) + index_of(j) * bytes, from, bytes);
  });
  exchanges_.erase(exchange);
  return 0;
}

std::int32_t DistributedMesh::check(std::uint64_t* fingerprint) {
  begin(MeshCall::check);
  error_point_[0] = error_point_[1] = 0;
  if (empty()) return PSTRIPACK_EMPTY_MESH;
  const OwnStars::Checked found = own_.check(ranks_);
  if (found.wrong.exists()) error_point_[0] = found.wrong.value;
  if (found.wrong.exists() || !found.is_sphere_or_disc) return PSTRIPACK_BAD_LISTS;
  if (fingerprint != nullptr) *fingerprint = found.fingerprint;
  return 0;
}

std::int32_t DistributedMesh::gather_stars(std::int32_t root, const ListArrays& lists) {
  if (empty()) return PSTRIPACK_EMPTY_MESH;
  wrong_argument_ = first_different(root, ranks_);
  if (wrong_argument_.rank >= 0) return PSTRIPACK_RANKS_DISAGREE;
  if (root < kEveryRank || root >= ranks_.size()) return PSTRIPACK_BAD_COMM;
  if (!numbers_are_dense_) return PSTRIPACK_BAD_NUMBER;
  if (total_ > most_nodes<std::int32_t>()) return PSTRIPACK_TOO_MANY_NODES;
  const auto n = static_cast<std::size_t>(total_), size = static_cast<std::size_t>(ranks_.size()),
             me = static_cast<std::size_t>(ranks_.rank());

  // Each star goes to the rank whose slice contains its number.
  std::vector<std::size_t> begin;
  const Parcels here = exchange_in_agreement(ranks_, [&] {
    for (std::size_t r = 0; r <= size; ++r) begin.push_back(slice_begin(n, r, size));
    // Numbers up to the total fit 32 bits.
    return packed_rings<std::int32_t>(size, [&](const auto& visit) {
      own_.for_each([&](std::size_t i, std::size_t count, const auto& write) {
        const auto number = static_cast<std::size_t>(own_.numbers()[i]);
        const auto next = std::lower_bound(begin.begin() + 1, begin.end(), number);
        visit(static_cast<RankNumber>(next - begin.begin()) - 1, own_.numbers()[i], count, write);
      });
    });
  });
  RingTable<std::int32_t> rings;
  in_agreement(ranks_, [&] { rings = RingTable<std::int32_t>(begin[me + 1] - begin[me]); });
  for_each_ring<std::int32_t>(here, [&](std::int32_t number, const Ring<std::int32_t>& ring) {
    rings.entries().set(static_cast<std::size_t>(number) - 1 - begin[me], ring.begin - 1, ring.count);
  });
  gather_lists(ranks_, rings, begin, root == kEveryRank ? Arrays::on_every_rank : Arrays::on_one_rank, root,
               lists);
  return 0;
}

}  // namespace pstripack
