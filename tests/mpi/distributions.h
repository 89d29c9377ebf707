#pragma once
// How nodes may be distributed over the ranks.

#include <algorithm>
#include <functional>
#include <vector>

#include "mpi_test.h"

/// The rank of each node (from 0), and whether a rank passes its nodes in reverse.
struct Distribution {
  const char* name;
  std::function<int(std::size_t node, std::size_t nodes)> rank_of_node;
  bool reversed;
};
inline const std::vector<Distribution>& distributions() {
  static const std::vector<Distribution> all = {
      {"slices", [](std::size_t i, std::size_t n) { return int(i * std::size_t(size_of()) / n); }, true},
      {"round robin", [](std::size_t i, std::size_t) { return int(i % std::size_t(size_of())); }, false},
      {"all on the last rank", [](std::size_t, std::size_t) { return size_of() - 1; }, true},
      {"scattered",
       [](std::size_t i, std::size_t) { return int(i * 2654435761u % 1009 % std::size_t(size_of())); }, true},
      {"none on even ranks",
       [](std::size_t i, std::size_t) {
         const std::size_t odd = std::size_t(size_of()) / 2;
         return odd == 0 ? 0 : int(2 * (i % odd) + 1);
       },
       false}};
  return all;
}

/// Those of this rank, in the order in which it passes them.
inline std::vector<std::size_t> nodes_here(const Distribution& d, std::size_t n) {
  std::vector<std::size_t> mine;
  for (std::size_t i = 0; i < n; ++i)
    if (d.rank_of_node(i, n) == rank_of()) mine.push_back(i);
  if (d.reversed) std::reverse(mine.begin(), mine.end());
  return mine;
}
