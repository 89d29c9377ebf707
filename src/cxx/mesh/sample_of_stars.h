#pragma once
// A quick test whether an earlier mesh may fit new nodes, from a sample of its stars.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/node_arrays.h"

namespace pstripack {

/// Up to 128 stars of a mesh, each of up to 30 neighbours.
class SampleOfStars {
 public:
  /// Calls visit(k) for the nodes k in 0..n-1 whose stars should be added.
  template <class Visit>
  static void for_each_node(std::size_t n, const Visit& visit) {
    constexpr std::size_t kStars = 128;
    const std::size_t wanted = n / 64 < kStars ? n / 64 : kStars;
    for (std::size_t j = 0; j < wanted; ++j) visit(n / wanted * j + n / (2 * wanted));
  }

  /// Adds the star of node k (from 0): ring[0..count-1] are its neighbours, counterclockwise, counted from 1.
  /// Throws std::bad_alloc.
  void add(std::size_t k, const std::int32_t* ring, std::size_t count);

  static constexpr std::uint32_t kGone = UINT32_MAX;
  /// The same stars in a new numbering: node k (from 0) becomes to[k]. Stars with a node for which to[k] is
  /// kGone are left out. Throws std::bad_alloc.
  SampleOfStars renumbered(const std::uint32_t* to) const;

  /// True if all triangles of these stars are counterclockwise and at most one arc in 16 is not locally
  /// Delaunay, as far as rounded arithmetic can tell. False if a length is not 1.
  bool fits(const NodeArrays& nodes) const;

 private:
  static constexpr std::size_t kMost = 30;  ///< stars with more neighbours are left out
  struct Star {
    std::uint32_t node, count;
  };
  std::vector<Star> stars_;
  std::vector<std::int32_t> rings_;
};

}  // namespace pstripack
