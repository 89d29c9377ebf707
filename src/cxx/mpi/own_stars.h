#pragma once
// The stars of the points that this rank has brought to a distributed mesh.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "base/workspace.h"
#include "parallel/return_rings.h"

namespace pstripack {

/// The points' global numbers, and their stars in global numbers. Rings are as in Stars::of_node.
class OwnStars {
 public:
  OwnStars() = default;
  /// numbers[i] is the global number of the point whose star is stars.of_node[i].
  template <class Int>
  OwnStars(BlockArray<std::int64_t> numbers, Stars<Int> stars)
      : numbers_(std::move(numbers)), stars_(std::move(stars)) {}

  template <class Body>
  auto visit(const Body& body) const {
    return std::visit(body, stars_);
  }
  template <class Body>
  auto visit(const Body& body) {
    return std::visit(body, stars_);
  }

  std::size_t count() const { return numbers_.size(); }
  const std::int64_t* numbers() const { return numbers_.data(); }
  std::size_t arcs() const {
    return visit([](const auto& stars) { return stars.of_node.arcs(); });
  }
  const std::vector<Record>& outside() const {
    return *visit([](const auto& stars) { return &stars.outside; });
  }

  /// Calls body(i, count, first) for each point: its neighbours are first[0..count-1].
  template <class Body>
  void for_each(const Body& body) const {
    visit([&](const auto& stars) {
      constexpr std::size_t kAhead = 16;  // prefetched: rings lie in the order of patches
      for (std::size_t i = 0; i < count(); ++i) {
        if (i + kAhead < count()) stars.of_node.prefetch(i + kAhead);
        const auto ring = stars.of_node[i];
        body(i, static_cast<std::size_t>(ring.count), ring.begin);
      }
    });
  }

  // The queries of capi/pstripack_mpi.h. Not collective.
  std::int64_t boundary_points() const;
  std::int64_t triangles() const;
  void stars(std::int64_t* begin, std::int64_t* neighbour) const;
  void triangles(std::int64_t* corner) const;
  void halo(std::int64_t* number, double* xyz) const;
  /// Throws std::bad_alloc, having written nothing.
  void local_stars(std::int64_t* begin, std::int32_t* neighbour) const;

 private:
  BlockArray<std::int64_t> numbers_;
  std::variant<Stars<std::int32_t>, Stars<std::int64_t>> stars_;  ///< 64 bits if a number needs them
};

}  // namespace pstripack
