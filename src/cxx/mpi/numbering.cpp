#include "mpi/numbering.h"

#include <algorithm>
#include <utility>

#include "geometry/predicates.h"
#include "parallel/agreement.h"
#include "parallel/environment_options.h"
#include "parallel/number_table.h"
#include "parallel/parcels.h"

namespace pstripack {
namespace {

constexpr std::int64_t kNone = Smallest::kNone;

/// The smallest number that occurs twice; kNone if there is none. Sends every number to a rank that it names,
/// so that equal numbers meet: if there are as many numbers as in low..high, to one with a slice of these,
/// which marks each number that has come; else to the rank of its hash.
std::int64_t first_repeated(const LocalNodes& points, const Numbering& numbering, MpiCommunicator& ranks) {
  const auto size = static_cast<std::size_t>(ranks.size()), me = static_cast<std::size_t>(ranks.rank()),
             all = static_cast<std::size_t>(numbering.total);
  const bool is_dense = numbering.high - numbering.low == numbering.total - 1;
  const std::size_t slice = (all + size - 1) / size;
  const auto place = [&](std::size_t i) {
    return static_cast<std::size_t>(value_of(points.number(i)) - numbering.low);
  };
  const auto rank_of = [&](std::size_t i) {
    return is_dense ? place(i) / slice : meeting_rank(points.number(i), size);
  };
  const Parcels here = exchange_in_agreement(ranks, [&] {
    ParcelWriter writer(size);
    for (std::size_t i = 0; i < points.count; ++i) writer.expect<GlobalNumber>(rank_of(i));
    writer.make_room();
    for (std::size_t i = 0; i < points.count; ++i) writer.put(rank_of(i), points.number(i));
    return writer.finish();
  });
  Smallest repeated;
  in_agreement(
      ranks,
      [&] {
        const Items<GlobalNumber> met(here);
        if (!is_dense) {
          std::vector<GlobalNumber> sorted(met.begin(), met.end());
          std::sort(sorted.begin(), sorted.end());
          const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
          if (twice != sorted.end()) repeated.value = value_of(*twice);
          return;
        }
        const std::int64_t first = numbering.low + static_cast<std::int64_t>(me * slice);
        std::vector<bool> has_come(slice);
        for (const GlobalNumber number : met) {
          const auto k = static_cast<std::size_t>(value_of(number) - first);
          if (has_come[k]) repeated.value = std::min(repeated.value, value_of(number));
          has_come[k] = true;
        }
      },
      repeated);
  return repeated.value;
}

bool on_one_line(const Point& a, const Point& b) {
  return same_direction(a, b) || same_direction(a, {-b.x, -b.y, -b.z});
}

}  // namespace

WrongArgument first_different(std::int64_t value, Communicator& ranks) {
  const std::int64_t* const of_rank = ranks.all_gather_one(value);
  for (int r = 1; r < ranks.size(); ++r)
    if (of_rank[r] != of_rank[0]) return {r, of_rank[r]};
  return {};
}

Numbering check_all(const LocalNodes& points, bool wants_report, bool numbers_are_known,
                    MpiCommunicator& ranks) {
  Numbering numbering;
  const auto failed = [&](std::int32_t code, std::int64_t point) {
    numbering.code = code;
    numbering.error_point = point;
    return std::move(numbering);  // a copy could fail on this rank alone
  };
  const std::int64_t* const counts = ranks.all_gather_one(static_cast<std::int64_t>(points.count));
  for (int r = 0; r < ranks.size(); ++r) {
    if (const std::int32_t code = code_of_rank_count(counts[r]); code != 0) {
      numbering.wrong_count = {r, counts[r]};
      return failed(code, 0);
    }
    numbering.total += counts[r];
  }
  if (numbering.total < 3) return failed(PSTRIPACK_TOO_FEW_NODES, 0);

  Smallest low, bad;
  Largest high;
  for (std::size_t i = 0; i < points.count; ++i) {
    low.value = std::min(low.value, value_of(points.number(i)));
    high.value = std::max(high.value, value_of(points.number(i)));
  }
  numbering.check = check_nodes(points.points, points.count);
  for (std::size_t i = numbering.check.first_bad; i < points.count; ++i)
    if (!has_direction(points.points[i])) bad.value = std::min(bad.value, value_of(points.number(i)));
  OfRank0 partition(ranks, options_from_environment(0).partition);
  OnAny reported{ranks.rank() == 0 && wants_report};
  OnAll are_known{numbers_are_known};
  in_agreement(
      ranks, [&] { numbering.ranges = NodeRanges(counts, static_cast<std::size_t>(ranks.size())); }, low,
      high, bad, partition, reported, are_known, numbering.check.lengths_are_one, numbering.check.deviation);
  numbering.is_reported = reported.value;
  numbering.low = low.value;
  numbering.high = high.value;
  numbering.partition = partition.value;
  if (numbering.low < 1) return failed(PSTRIPACK_BAD_NUMBER, numbering.low);
  if (bad.exists()) return failed(PSTRIPACK_BAD_COORDINATE, bad.value);
  if (are_known.value) return numbering;
  const std::int64_t repeated = first_repeated(points, numbering, ranks);
  if (repeated != kNone) return failed(PSTRIPACK_BAD_NUMBER, repeated);
  return numbering;
}

std::optional<Corners> find_corners(const LocalNodes& points, Communicator& ranks) {
  // The first points that span the line, plane or space that all span; of a rank, then of all ranks.
  struct {
    Corners found;
    std::size_t count = 0;
    void add(const SentNode& r) {
      if (count == 0 || (count == 1 && !on_one_line(found[0].point, r.point)) ||
          (count == 2 && left(found[0].point, found[1].point, r.point) != 0))
        found[count++] = r;
    }
  } mine, all;
  for (std::size_t i = 0; i < points.count && mine.count < 3; ++i)
    mine.add({points.points[i], points.number(i)});
  const Parcels of_ranks = ranks.all_gather(mine.found.data(), mine.count * sizeof(SentNode));
  for (const SentNode& r : Items<SentNode>(of_ranks)) all.add(r);
  if (all.count < 3) return std::nullopt;
  return all.found;
}

}  // namespace pstripack
