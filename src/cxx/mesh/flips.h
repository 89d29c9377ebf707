#pragma once
// A mesh whose nodes have moved a little: tested where it is, and repaired by flips.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/workspace.h"
#include "geometry/predicates.h"

namespace pstripack {

/// The star of every node of a mesh without a boundary, and where the nodes are now. Inside, nodes are
/// numbered along the insertion curve of the places that they had at the beginning, so that neighbours are
/// close together in memory.
class MovingMesh {
 public:
  /// The mesh with these canonical lists (docs/differences.md) of the nodes p[0..n-1], which
  /// surround the centre; n < 2^29. Parallel. Throws std::bad_alloc.
  MovingMesh(const Point* p, std::size_t n, const std::int32_t* list, const std::int32_t* lend);

  /// For callers that account for memory.
  static std::size_t bytes(std::size_t n) { return workspace_bytes(n); }

  std::size_t size() const { return n_; }
  /// Where node k is, the caller's number from 0: to be moved before repair().
  Point& node(std::size_t k) { return nodes_[inside_[k]]; }
  void prefetch(std::size_t k) const { __builtin_prefetch(&nodes_[inside_[k]], 1); }

  /// Makes the mesh the Delaunay triangulation of its nodes as they are now, by the predicates on coordinates
  /// with their tie rule, and returns true; flips() is how many arcs had to change. Or returns false, and the
  /// mesh is of no more use: a triangle is not counterclockwise, an arc cannot be flipped, or there is too
  /// much to do. All nodes must have length_is_one. Why the tests suffice: docs/design.md, "Warm start".
  /// Parallel. Throws std::bad_alloc.
  bool repair();
  std::size_t flips() const { return flips_; }

  /// A node whose neighbours are not those of the lists given last, or in another order: its number and how
  /// many neighbours it has.
  struct Change {
    std::uint32_t node, count;
  };
  /// In increasing order of the nodes. Throws std::bad_alloc.
  std::vector<Change> changes() const;
  std::size_t change_count() const { return changed_.size(); }
  /// Writes the neighbours of node k as they stand in LIST.
  void write_ring(std::size_t k, std::int32_t* list) const;

  /// From now on these are the lists given last. They must be those of the mesh. Parallel.
  void set_lists(const std::int32_t* list, const std::int32_t* lend);

 private:
  struct Star {
    std::uint32_t begin, count;
  };
  struct Arc {
    std::uint32_t a, b;
  };
  /// A triangle, and a direction inside it.
  struct Mark {
    std::uint32_t corner[3];
    Point towards;
  };

  static constexpr std::size_t kSlots = 8;  ///< a node, in rings_
  static constexpr std::uint32_t kFree = UINT32_MAX, kTaken = UINT32_MAX - 1;
  static std::size_t workspace_bytes(std::size_t n) {
    return (2 * sizeof(std::uint32_t) + sizeof(Point) + sizeof(Star) + kSlots * sizeof(std::uint32_t) + 1) *
           n;
  }

  void lay_rings(const std::int32_t* list, const std::int32_t* lend);
  bool choose_mark(Mark& mark) const;
  bool test(std::size_t first, std::size_t last, const Mark& mark, const std::atomic<bool>& stopped,
            std::vector<Arc>& suspects) const;
  bool examine(std::uint32_t v, const Mark& mark, std::vector<Arc>& suspects) const;
  bool flip(std::vector<Arc>& suspects);
  std::uint32_t place_of(std::uint32_t b, const Star& star) const;
  bool insert(std::uint32_t v, std::uint32_t place, std::uint32_t neighbour);
  void remove(std::uint32_t v, std::uint32_t place);
  void note_change(std::uint32_t v);

  std::size_t n_;
  Workspace workspace_;
  std::uint32_t *order_, *inside_;  ///< the caller's number of node v; node v of the caller's number
  Point* nodes_;
  Star* stars_;
  /// Rings, counterclockwise from anywhere. Free slots behind a ring are kFree; the slot behind these is the
  /// first of another ring, or kTaken. Rings that have become too long for their places are at the end.
  std::uint32_t* rings_;
  std::size_t end_ = 0;
  std::uint8_t* is_changed_;
  std::vector<std::uint32_t> changed_;
  std::size_t flips_ = 0;
};

}  // namespace pstripack
