#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/workspace.h"
#include "geometry/insertion_order.h"
#include "geometry/point.h"
#include "parallel/global_number.h"

namespace pstripack {

/// A node on its way between patches or ranks.
struct SentNode {
  Point point;
  GlobalNumber number;
};

/// The nodes that a patch is given: its own ones, then its margin.
struct PatchNodes {
  const SentNode* first;
  std::size_t own, margin;
  std::size_t count() const { return own + margin; }
};

/// Sorts different nodes, at least one, so that neighbours are close.
inline void sort_along_curve(std::vector<SentNode>& nodes) {
  Workspace workspace(16 * nodes.size());
  std::vector<std::uint32_t> order(nodes.size());
  insertion_order(&nodes[0].point, nodes.size(), order.data(), workspace, sizeof(SentNode));
  std::vector<SentNode> sorted;
  for (const std::uint32_t k : order) sorted.push_back(nodes[k]);
  nodes.swap(sorted);
}

}  // namespace pstripack
