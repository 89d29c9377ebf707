#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <mutex>

#include "geometry/parallel_for.h"
#include "geometry/point.h"
#include "geometry/predicates.h"
#include "parallel/node_arrays.h"

namespace pstripack {

/// Of a set of nodes, those that this rank brings: any of them, in any order.
struct LocalNodes {
  NodeArrays points;
  std::size_t count = 0;                  ///< < 2^29
  const std::int64_t* numbers = nullptr;  ///< global numbers from 1; null: first_number, first_number+1, ...
  std::int64_t first_number = 1;
  /// Where every rank can read the nodes of all ranks, in the order of their numbers: these. Then numbers
  /// travel instead of nodes. On all ranks or on none.
  const NodeArrays* of_all_ranks = nullptr;

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

  // As values of which the smallest of all ranks tell what holds of the nodes of all ranks.
  std::int64_t vote_for_lengths() const { return lengths_are_one ? 1 : 0; }
  std::int64_t vote_for_deviation() const {  // the bits of positive numbers are in their order
    std::int64_t bits;
    std::memcpy(&bits, &deviation, sizeof bits);
    return -bits;
  }
  void elect(std::int64_t lengths, std::int64_t of_deviation) {
    lengths_are_one = lengths != 0;
    of_deviation = -of_deviation;
    std::memcpy(&deviation, &of_deviation, sizeof deviation);
  }
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

inline Look look_at(const NodeArrays& nodes, std::size_t n) {
  return nodes.visit([=](const auto& node) { return look_at(n, threads_for(n), node); });
}

}  // namespace pstripack
