#include "scvt/spread.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "geometry/hilbert_curve.h"
#include "parallel/agreement.h"
#include "parallel/local_nodes.h"

namespace pstripack::scvt {
namespace {

/// Place of a unit vector along the curve: the face of the cube, then the place on that face.
std::uint64_t place_on_curve(const Point& p) {
  const double x = std::fabs(p.x), y = std::fabs(p.y), z = std::fabs(p.z);
  const auto cell = [](double u) {
    return static_cast<std::uint32_t>(std::min(std::max((u + 1) * 0x1p29, 0.0), 0x1p30 - 1));
  };
  std::uint64_t face;
  double u, v;
  if (x >= y && x >= z)
    face = p.x > 0 ? 0 : 2, u = p.y / p.x, v = p.z / x;
  else if (y >= z)
    face = p.y > 0 ? 1 : 3, u = -p.x / p.y, v = p.z / y;
  else
    face = p.z > 0 ? 4 : 5, u = p.x / z, v = p.y / p.z;
  constexpr int kBlocks = 6;
  return face << (2 * hilbert::kLevels * kBlocks) | hilbert::along_curve(cell(u), cell(v), kBlocks);
}

struct Placed {
  std::uint64_t place;
  Point point;
};
/// Points in one cell are in the order of their coordinates.
bool operator<(const Placed& a, const Placed& b) {
  return std::tie(a.place, a.point.x, a.point.y, a.point.z) <
         std::tie(b.place, b.point.x, b.point.y, b.point.z);
}

std::vector<Placed> sorted(const std::vector<Point>& points) {
  std::vector<Placed> items;
  items.reserve(points.size());
  for (const Point& p : points) items.push_back({place_on_curve(p), p});
  std::sort(items.begin(), items.end());
  return items;
}

}  // namespace

std::int64_t sum_of_all(Communicator& ranks, std::size_t mine) {
  auto sum = static_cast<std::int64_t>(mine);
  ranks.all_sum(&sum, 1);
  return sum;
}

std::int64_t sum_before(Communicator& ranks, std::size_t mine) {
  const std::int64_t* const all = ranks.all_gather_one(static_cast<std::int64_t>(mine));
  return std::accumulate(all, all + ranks.rank(), std::int64_t{0});
}

std::vector<std::uint64_t> bounds(Communicator& ranks, const std::vector<std::int64_t>& targets,
                                  const std::function<std::size_t(std::uint64_t)>& below) {
  std::vector<std::uint64_t> bound;
  std::vector<std::int64_t> count;
  in_agreement(ranks, [&] {
    bound.resize(targets.size());
    count.resize(targets.size());
  });
  for (std::uint64_t bit = std::uint64_t{1} << 62; bit > 0; bit /= 2) {
    for (std::size_t t = 0; t < targets.size(); ++t)
      count[t] = static_cast<std::int64_t>(below(bound[t] + bit));
    ranks.all_sum(count.data(), count.size());
    for (std::size_t t = 0; t < targets.size(); ++t)
      if (count[t] <= targets[t]) bound[t] += bit;
  }
  return bound;
}

Spread along_a_curve(Communicator& ranks, const std::vector<Point>& points) {
  const auto size = static_cast<std::size_t>(ranks.size());
  const auto n = static_cast<std::size_t>(sum_of_all(ranks, points.size()));
  std::vector<Placed> items;
  std::vector<std::int64_t> targets;
  in_agreement(ranks, [&] {
    items = sorted(points);
    for (std::size_t r = 1; r < size; ++r)
      targets.push_back(static_cast<std::int64_t>(slice_begin(n, r, size)));
  });
  if (size > 1) {
    const auto first_at = [&](std::uint64_t place) {
      const auto is_before = [](const Placed& item, std::uint64_t p) { return item.place < p; };
      return static_cast<std::size_t>(std::lower_bound(items.begin(), items.end(), place, is_before) -
                                      items.begin());
    };
    const std::vector<std::uint64_t> begin = bounds(ranks, targets, first_at);
    const Parcels parcels = exchange_in_agreement(ranks, [&] {
      std::vector<std::vector<Placed>> to(size);
      std::size_t first = 0;
      for (std::size_t r = 0; r < size; ++r) {
        const std::size_t last = r + 1 < size ? first_at(begin[r]) : items.size();
        to[r].assign(items.data() + first, items.data() + last);
        first = last;
      }
      return packed(to);
    });
    in_agreement(ranks, [&] {
      const Items<Placed> here(parcels);
      items.assign(here.begin(), here.end());
      std::sort(items.begin(), items.end());
    });
  }
  const std::int64_t before = sum_before(ranks, items.size());
  Spread spread;
  in_agreement(ranks, [&] {
    spread.points.reserve(items.size());
    for (const Placed& item : items) spread.points.push_back(item.point);
    spread.numbers.resize(items.size());
    std::iota(spread.numbers.begin(), spread.numbers.end(), before + 1);
  });
  return spread;
}

std::vector<Point> along_a_curve(const std::vector<Point>& points) {
  SingleProcess alone;
  return along_a_curve(alone, points).points;
}

Rows moved(Communicator& ranks, Rows rows, const std::vector<std::int32_t>& to) {
  const std::size_t width = rows.width;
  const Parcels parcels = exchange_in_agreement(ranks, [&] {
    ParcelWriter writer(static_cast<std::size_t>(ranks.size()));
    for (const std::int32_t r : to) writer.expect<double>(static_cast<std::size_t>(r), width + 1);
    writer.make_room();
    for (std::size_t i = 0; i < to.size(); ++i) {
      double* const room = writer.room<double>(static_cast<std::size_t>(to[i]), width + 1);
      room[0] = static_cast<double>(rows.numbers[i]);  // below 2^53
      std::copy_n(rows.values.data() + i * width, width, room + 1);
    }
    rows = {};
    return writer.finish();
  });
  Rows here{width, {}, {}};
  in_agreement(ranks, [&] {
    const Items<double> items(parcels);
    std::vector<const double*> arrived;
    for (const double* row = items.begin(); row < items.end(); row += width + 1) arrived.push_back(row);
    std::sort(arrived.begin(), arrived.end(), [](const double* a, const double* b) { return *a < *b; });
    here.numbers.reserve(arrived.size());
    here.values.reserve(arrived.size() * width);
    for (const double* row : arrived) {
      here.numbers.push_back(static_cast<std::int64_t>(row[0]));
      here.values.insert(here.values.end(), row + 1, row + 1 + width);
    }
  });
  return here;
}

}  // namespace pstripack::scvt
