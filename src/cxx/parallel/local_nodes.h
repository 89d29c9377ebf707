#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "base/parallel_for.h"
#include "geometry/node_arrays.h"
#include "geometry/point.h"
#include "geometry/predicates.h"
#include "parallel/agreement.h"
#include "parallel/global_number.h"
#include "parallel/local_numbers.h"

namespace pstripack {

/// The nodes that this rank brings: any of all nodes, in any order.
struct LocalNodes {
  NodeArrays points;
  std::size_t count = 0;                  ///< < 2^29
  const std::int64_t* numbers = nullptr;  ///< global numbers from 1; null: first_number, first_number+1, ...
  std::int64_t first_number = 1;
  /// The nodes of all ranks, in the order of their numbers, if every rank can read them: then numbers travel
  /// instead of nodes. Set on all ranks or on none.
  const NodeArrays* of_all_ranks = nullptr;

  GlobalNumber number(std::size_t i) const {
    return GlobalNumber{numbers != nullptr ? numbers[i] : first_number + static_cast<std::int64_t>(i)};
  }
};

/// Nodes 0..n-1 are cut into one slice a rank, as equal as possible: the first node of this rank's slice.
inline std::size_t slice_begin(std::size_t n, RankNumber rank, std::size_t ranks) {
  return n / ranks * rank + n % ranks * rank / ranks;
}

/// What one pass over all coordinates finds. After agree_on() the votes hold for the nodes of all ranks.
struct NodeCheck {
  std::size_t first_bad = 0;  ///< the first node (from 0) without a direction; their number if all have one
  OnAll lengths_are_one;
  LargestReal deviation;  ///< difference of the square of a length from 1
  OnAny by_direction;     ///< the mesh of the directions is wanted, whatever the lengths
};

/// Passes over the n nodes point(i) on `threads` threads (see threads_for). Calls point(i) once for each
/// node, and perhaps once more if some length is not 1.
template <class GetPoint>
NodeCheck check_nodes(std::size_t n, int threads, const GetPoint& point) {
  NodeCheck all{n, {}, {}, {}};
  std::mutex mutex;
  parallel_pieces(n, threads, [&](std::size_t first, std::size_t last, int) {
    std::size_t first_bad = n;
    bool lengths_are_one = true;
    double deviation = 0;
    for (std::size_t i = first; i < last; ++i) {
      const Point p = point(i);
      lengths_are_one = lengths_are_one & length_is_one(p);
      deviation = std::max(deviation, std::fabs(dot(p, p) - 1));
    }
    for (std::size_t i = first; i < last && !lengths_are_one && first_bad == n; ++i)
      if (!has_direction(point(i))) first_bad = i;
    const std::lock_guard lock(mutex);
    all.first_bad = std::min(all.first_bad, first_bad);
    all.lengths_are_one.value = all.lengths_are_one.value && lengths_are_one;
    all.deviation.value = std::max(all.deviation.value, deviation);
  });
  return all;
}

inline NodeCheck check_nodes(const NodeArrays& nodes, std::size_t n) {
  return nodes.visit([=](const auto& node) { return check_nodes(n, threads_for(n), node); });
}

}  // namespace pstripack
