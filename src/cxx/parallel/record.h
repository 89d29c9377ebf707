#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <vector>

#include "geometry/point.h"
#include "parallel/global_number.h"

namespace pstripack {

/// A node on its way between patches or ranks.
struct Record {
  Point point;
  GlobalNumber number;
};

/// The nodes that a patch is given: its own ones, then its halo.
struct PatchNodes {
  const Record* first;
  std::size_t own, halo;
  std::size_t count() const { return own + halo; }
};

/// Many nodes are sorted digit by digit: a hub may have most nodes for neighbours.
inline void sort_by_number(std::vector<Record>& nodes) {
  constexpr std::size_t kMany = 10000;
  constexpr int kBits = 11;
  if (nodes.size() < kMany) {
    std::sort(nodes.begin(), nodes.end(),
              [](const Record& a, const Record& b) { return a.number < b.number; });
    return;
  }
  std::int64_t largest = 0;
  for (const Record& r : nodes) largest = std::max(largest, value_of(r.number));
  std::vector<Record> sorted(nodes.size());
  for (int shift = 0; shift < 64 && largest >> shift > 0; shift += kBits) {
    const auto digit = [&](const Record& r) { return value_of(r.number) >> shift & ((1 << kBits) - 1); };
    std::size_t begin[(1 << kBits) + 1] = {};
    for (const Record& r : nodes) ++begin[digit(r) + 1];
    std::partial_sum(std::begin(begin), std::end(begin), std::begin(begin));
    for (const Record& r : nodes) sorted[begin[digit(r)]++] = r;
    nodes.swap(sorted);
  }
}

/// Sorts by number and keeps each number once.
inline void keep_one_of_each(std::vector<Record>& nodes) {
  sort_by_number(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end(),
                          [](const Record& a, const Record& b) { return a.number == b.number; }),
              nodes.end());
}

}  // namespace pstripack
