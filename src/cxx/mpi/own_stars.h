#pragma once
// The stars of the points that this rank has brought to a distributed mesh.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "base/workspace.h"
#include "parallel/agreement.h"
#include "parallel/node_ranges.h"
#include "parallel/number_table.h"
#include "parallel/return_rings.h"

namespace pstripack {

/// The points' global numbers, which the caller gives, and their stars in numbers counted through all ranks
/// (NodeRanges): these tell which point here a neighbour is, or who has it.
class OwnStars {
 public:
  OwnStars() = default;
  /// numbers[i] is the global number of the point whose star is stars.of_node[i]. Throws std::bad_alloc.
  template <class Int>
  OwnStars(BlockArray<std::int64_t> numbers, NodeRanges ranges, RankNumber me, Stars<Int> stars)
      : numbers_(std::move(numbers)), ranges_(std::move(ranges)), first_(ranges_.first(me)) {
    stars_ = std::move(stars);
    find_outside();
  }

  template <class Body>
  auto visit(const Body& body) const {
    return std::visit(body, stars_);
  }
  /// Changes the stars. Throws std::bad_alloc, and what body() throws.
  template <class Body>
  void change(const Body& body) {
    std::visit(body, stars_);
    find_outside();
  }

  std::size_t count() const { return numbers_.size(); }
  const std::int64_t* numbers() const { return numbers_.data(); }
  const NodeRanges& ranges() const { return ranges_; }
  std::size_t arcs() const {
    return visit([](const auto& stars) { return stars.of_node.arcs(); });
  }
  const std::vector<HaloNode>& outside() const {
    return *visit([](const auto& stars) { return &stars.outside; });
  }

  /// Exchanges values of outside().
  const Halo& halo() const {
    return *visit([](const auto& stars) { return &stars.halo; });
  }

  /// Calls body(i, count, write) for each point: it has `count` neighbours, and write(out) writes their
  /// global numbers as they would stand in LIST.
  template <class Body>
  void for_each(const Body& body) const {
    for_each_ring([&](std::size_t i, const auto& ring) {
      body(i, std::size_t{ring.count}, [&](auto* out) { write(ring, out); });
    });
  }

  // The queries of capi/pstripack_mpi.h. Not collective.
  /// What check() finds; the same on every rank.
  struct Checked {
    Smallest wrong;  ///< the smallest number of a point whose star is no cycle or does not fit the others
    bool is_sphere_or_disc = false;
    std::uint64_t fingerprint = 0;  ///< that of the triangles, by number from 0
  };
  /// Compares the stars of all ranks with each other. Collective. Throws AgreedFailure.
  Checked check(Communicator& ranks) const;

  std::int64_t boundary_points() const;
  std::int64_t triangles() const;
  void stars(std::int64_t* begin, std::int64_t* neighbour) const;
  void triangles(std::int64_t* corner) const;
  void halo(std::int64_t* number, double* xyz) const;
  void halo_owners(std::int32_t* rank, std::int32_t* local) const;
  void local_stars(std::int64_t* begin, std::int32_t* neighbour) const;

 private:
  template <class Body>
  void for_each_ring(const Body& body) const {
    visit([&](const auto& stars) {
      constexpr std::size_t kAhead = 16;  // prefetched: rings lie in the order of patches
      for (std::size_t i = 0; i < count(); ++i) {
        if (i + kAhead < count()) stars.of_node.prefetch(i + kAhead);
        body(i, stars.of_node[i]);
      }
    });
  }
  template <class Visit>
  void for_each_triangle(const Visit& visit) const;
  template <class Int>
  bool is_cycle(std::size_t i, const Ring<Int>& ring, std::vector<std::int64_t>& sorted) const;
  void find_outside();

  /// Which node a counted number is: the points here, then those outside.
  std::size_t index(std::int64_t counted) const {
    const auto here = static_cast<std::size_t>(counted - first_);
    if (here < count()) return here;
    return count() + *place_.find(GlobalNumber{counted});
  }
  std::int64_t number(std::size_t index) const {
    return index < count() ? numbers_[index] : value_of(outside()[index - count()].number);
  }
  template <class Int>
  std::int64_t number_of(Int entry) const {
    return entry < 0 ? -number(index(-std::int64_t{entry})) : number(index(entry));
  }
  /// The entry of an inner point's ring that comes first in LIST: that with the smallest global number.
  template <class Int>
  std::uint32_t first_of(const Ring<Int>& ring) const {
    if (ring.begin[ring.count - 1] < 0) return 0;
    std::uint32_t first = 0;
    std::int64_t least = INT64_MAX;
    for (std::uint32_t k = 0; k < ring.count; ++k)
      if (const std::int64_t n = number_of(ring.begin[k]); n < least) least = n, first = k;
    return first;
  }
  template <class Int, class Out>
  void write(const Ring<Int>& ring, Out* out) const {
    for (std::uint32_t k = 0; k < ring.count; ++k) out[k] = static_cast<Out>(number_of(ring.begin[k]));
    Out* const end = out + ring.count;
    if (end[-1] > 0) std::rotate(out, std::min_element(out, end), end);
  }

  BlockArray<std::int64_t> numbers_;
  NodeRanges ranges_;
  std::int64_t first_ = 1;  ///< the counted number of the first point here
  std::variant<Stars<std::int32_t>, Stars<std::int64_t>> stars_;  ///< 64 bits if there are so many points
  NumberTable<std::size_t> place_;                                ///< among outside(), by counted number
};

}  // namespace pstripack
