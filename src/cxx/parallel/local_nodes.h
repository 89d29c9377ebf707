#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "geometry/parallel_for.h"
#include "geometry/point.h"
#include "geometry/predicates.h"

namespace pstripack {

/// Of a set of nodes, those that this rank brings: any of them, in any order.
struct LocalNodes {
  const Point* points = nullptr;
  std::size_t count = 0;                  ///< < 2^29
  const std::int64_t* numbers = nullptr;  ///< global numbers from 1; null: first_number, first_number+1, ...
  std::int64_t first_number = 1;

  std::int64_t number(std::size_t i) const {
    return numbers != nullptr ? numbers[i] : first_number + static_cast<std::int64_t>(i);
  }
};

/// Node numbers 0..n-1 cut into one slice a rank, as equal as they come: rank r has [begin[r], begin[r+1]).
inline std::size_t slice_begin(std::size_t n, std::size_t rank, std::size_t ranks) {
  return n / ranks * rank + n % ranks * rank / ranks;
}

/// What one look at all coordinates tells.
struct Look {
  std::size_t first_bad = 0;    ///< the first node (from 0) without a direction; their number if all have one
  bool lengths_are_one = true;  ///< of all
  double deviation = 0;         ///< the largest difference of the square of a length from 1
};

/// Looks at the n nodes point(i) on so many threads (see threads_for). Each is asked for once, and those
/// after one without a length of 1 perhaps again.
template <class GetPoint>
Look look_at(std::size_t n, int threads, const GetPoint& point) {
  Look all{n, true, 0};
  std::mutex mutex;
  parallel_pieces(n, threads, [&](std::size_t first, std::size_t last, int) {
    Look look{n, true, 0};
    for (std::size_t i = first; i < last; ++i) {
      const Point p = point(i);
      look.lengths_are_one = look.lengths_are_one & length_is_one(p);
      look.deviation = std::max(look.deviation, std::fabs(dot(p, p) - 1));
    }
    for (std::size_t i = first; i < last && !look.lengths_are_one && look.first_bad == n; ++i)
      if (!has_direction(point(i))) look.first_bad = i;
    const std::lock_guard lock(mutex);
    all.first_bad = std::min(all.first_bad, look.first_bad);
    all.lengths_are_one = all.lengths_are_one && look.lengths_are_one;
    all.deviation = std::max(all.deviation, look.deviation);
  });
  return all;
}

inline Look look_at(const Point* points, std::size_t n) {
  return look_at(n, threads_for(n), [=](std::size_t i) { return points[i]; });
}

}  // namespace pstripack
