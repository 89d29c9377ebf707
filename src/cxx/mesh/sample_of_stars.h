#pragma once
// A look whether a mesh fits other nodes, which every call can afford.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/node_arrays.h"

namespace pstripack {

/// Some stars of a mesh.
class SampleOfStars {
 public:
  /// Calls visit(k) for some of the nodes 0..n-1: those whose stars should be added.
  template <class Visit>
  static void for_each_node(std::size_t n, const Visit& visit) {
    constexpr std::size_t kStars = 128;
    const std::size_t wanted = n / 64 < kStars ? n / 64 : kStars;
    for (std::size_t j = 0; j < wanted; ++j) visit(n / wanted * j + n / (2 * wanted));
  }

  /// The star of node k: `count` neighbours, counterclockwise, numbers from 1. Throws std::bad_alloc.
  void add(std::size_t k, const std::int32_t* ring, std::size_t count);

  static constexpr std::uint32_t kGone = UINT32_MAX;
  /// Those stars all of whose nodes are still there, where node k (from 0) is node to[k] now, or kGone.
  /// Throws std::bad_alloc.
  SampleOfStars renumbered(const std::uint32_t* to) const;

  /// True if all triangles of these stars are counterclockwise and few of their arcs are not locally
  /// Delaunay, as far as rounded arithmetic can tell.
  bool fits(const NodeArrays& nodes) const;

 private:
  static constexpr std::size_t kMost = 30;  ///< neighbours of a node
  struct Star {
    std::uint32_t node, count;
  };
  std::vector<Star> stars_;
  std::vector<std::int32_t> rings_;
};

}  // namespace pstripack
