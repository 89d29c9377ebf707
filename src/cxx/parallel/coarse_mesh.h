#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "geometry/point.h"
#include "parallel/local_numbers.h"

namespace pstripack {

/// The mesh of a few nodes, which stands for that of all.
class CoarseMesh {
 public:
  /// Has no triangle if all nodes are on one great circle. Throws std::bad_alloc.
  explicit CoarseMesh(const std::vector<Point>& nodes);

  // A hub is a node with more than 64 neighbours.
  /// The corners of the triangles without a hub.
  const std::vector<std::array<SampleNode, 3>>& triangles() const { return triangles_; }
  std::size_t triangles_at_hubs() const { return at_hubs_; }

  /// How many triangles without a hub have corners of different owners.
  template <class Owner>
  std::size_t mixed(const Owner& owner) const {
    std::size_t mixed = 0;
    for (const auto& [a, b, c] : triangles_) mixed += owner(a) != owner(b) || owner(b) != owner(c);
    return mixed;
  }

 private:
  std::vector<std::array<SampleNode, 3>> triangles_;
  std::size_t at_hubs_ = 0;
};

}  // namespace pstripack
