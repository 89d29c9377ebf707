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
///
/// Or a part of such a mesh: the stars of some of its nodes. The neighbours of these that have no star here
/// are nodes outside, with the caller's numbers from size() on.
class MovingMesh {
 public:
  /// The mesh with these canonical lists (docs/differences.md) of the nodes p[0..n-1], which
  /// surround the centre; n < 2^29. Of a part: p[n..] are the nodes outside, and there may be so many more
  /// of them later. Parallel. Throws std::bad_alloc.
  MovingMesh(const Point* p, std::size_t n, const std::int32_t* list, const std::int32_t* lend,
             std::size_t outside = 0, std::size_t room = 0);

  /// Stars of nodes that had none: node[i] has the neighbours ring[end[i-1]..end[i]-1], counterclockwise.
  struct MoreStars {
    std::vector<std::uint32_t> node, end, ring;
    std::size_t count(std::size_t i) const { return end[i] - (i == 0 ? 0 : end[i - 1]); }
  };
  /// The part of the same mesh that has the stars of n nodes, with so many arcs, and so many nodes outside.
  /// Of the nodes of `last`, outside or not, k has the number to[k], or is kNobody; of those here that had no
  /// star, `more` has them. Where nodes are is not known yet. Parallel. Throws std::bad_alloc.
  MovingMesh(const MovingMesh& last, std::size_t n, std::size_t arcs, std::size_t outside, std::size_t room,
             const std::uint32_t* to, const MoreStars& more);

  /// For callers that account for memory.
  static std::size_t bytes(std::size_t n, std::size_t arcs, std::size_t all) {
    return workspace_bytes(n, arcs, all);
  }

  std::size_t size() const { return n_; }
  /// Where node k is, the caller's number from 0: to be moved before repair().
  Point& node(std::size_t k) { return nodes_[inside_[k]]; }
  const Point& node(std::size_t k) const { return nodes_[inside_[k]]; }
  void prefetch(std::size_t k) const { __builtin_prefetch(&nodes_[inside_[k]], 1); }

  /// Makes the mesh the Delaunay triangulation of its nodes as they are now, by the predicates on coordinates
  /// with their tie rule, and returns true; flips() is how many arcs had to change. Or returns false, and the
  /// mesh is of no more use: a triangle is not counterclockwise, an arc cannot be flipped, or there is too
  /// much to do. All nodes must have length_is_one. Why the tests suffice: docs/design.md, "Warm start".
  /// Parallel. Throws std::bad_alloc.
  bool repair();
  std::size_t flips() const { return flips_; }

  // repair() in its steps, for parts that together are a mesh. What returns false ends it, as above.

  static constexpr std::uint32_t kNobody = UINT32_MAX;
  /// A triangle, and a direction inside it. Corners that are not here are kNobody.
  struct Mark {
    std::uint32_t corner[3];
    Point towards;
  };
  /// The arc a-b with c on its right and d on its left, as drawn at flip_here().
  struct Quadrangle {
    std::uint32_t a, b, c, d;
  };
  /// A mark among the nodes here.
  bool choose_mark(Mark& mark) const;
  /// Tests every star; the mark is that of all parts. Parallel. Throws std::bad_alloc.
  bool test(const Mark& mark);
  /// Flips arcs until all are locally Delaunay whose quadrangle has no node outside. Those of the others that
  /// are not locally Delaunay are added to `across`, each once: each part with an end of such an arc finds
  /// it. They are tested again after suspect() or flip() only. Throws std::bad_alloc.
  bool flip_inside(std::vector<Quadrangle>& across);
  /// Whether the arc can be flipped.
  bool is_convex(const Quadrangle& q) const;
  /// Puts c-d in the place of a-b as far as the stars here are concerned. Nodes that have no star here and
  /// are in none that changes may be kNobody. Throws std::bad_alloc.
  bool flip(const Quadrangle& q);
  /// The arc a-b may not be locally Delaunay. Throws std::bad_alloc.
  void suspect(std::uint32_t a, std::uint32_t b);
  /// Another node outside; kNobody if there is no room.
  std::uint32_t add_outside(const Point& p);

  /// A node whose neighbours are not those of the lists given last, or in another order: its number and how
  /// many neighbours it has.
  struct Change {
    std::uint32_t node, count;
  };
  /// In increasing order of the nodes. Throws std::bad_alloc.
  std::vector<Change> changes() const;
  std::size_t change_count() const { return changed_.size(); }
  /// Writes the neighbours of node k as they stand in LIST: so many.
  std::size_t degree(std::size_t k) const { return stars_[inside_[k]].count; }
  /// Calls visit(j) for each arc from a node here to the node outside size() + j.
  template <class Visit>
  void for_each_arc_outside(const Visit& visit) const {
    for (std::size_t v = 0; v < n_; ++v)
      for (std::uint32_t i = 0; i < stars_[v].count; ++i)
        if (const std::uint32_t w = rings_[stars_[v].begin + i]; is_outside(w)) visit(w - n_);
  }
  void write_ring(std::size_t k, std::int32_t* list) const;

  /// From now on the lists of the mesh are those given last. Parallel. Throws std::bad_alloc.
  void forget_changes();

 private:
  struct Star {
    std::uint32_t begin, count;
  };
  struct Arc {
    std::uint32_t a, b;
  };

  static constexpr std::uint32_t kFree = UINT32_MAX, kTaken = UINT32_MAX - 1;
  /// In rings_: each ring and its free slot, and room for those that become longer.
  static std::size_t slots(std::size_t n, std::size_t arcs) { return arcs + 2 * n + 100; }
  static std::size_t workspace_bytes(std::size_t n, std::size_t arcs, std::size_t all) {
    return (sizeof(Star) + 1) * n + sizeof(std::uint32_t) * slots(n, arcs) +
           (2 * sizeof(std::uint32_t) + sizeof(Point)) * all;
  }

  MovingMesh(std::size_t n, std::size_t arcs, std::size_t outside, std::size_t room);
  void keep_arrays();
  template <class Count, class Write>
  void lay_rings(const Count& count, const Write& write);
  bool test(std::size_t first, std::size_t last, const Mark& mark, const std::atomic<bool>& stopped,
            std::vector<Arc>& suspects) const;
  bool examine(std::uint32_t v, const Mark& mark, std::vector<Arc>& suspects) const;
  bool is_outside(std::uint32_t v) const { return v >= n_; }
  void suspect_inside(std::uint32_t a, std::uint32_t b);
  bool find(const Arc& arc, Quadrangle& q) const;
  bool is_convex_inside(const Quadrangle& q) const;
  bool flip_here(const Quadrangle& q);
  std::uint32_t place_of(std::uint32_t b, const Star& star) const;
  bool insert(std::uint32_t v, std::uint32_t place, std::uint32_t neighbour);
  void remove(std::uint32_t v, std::uint32_t place);
  void note_change(std::uint32_t v);

  std::size_t n_, all_, most_;      ///< nodes with a star, with those outside, with those there is room for
  const std::size_t arcs_, slots_;  ///< of the stars at the beginning; of rings_
  Workspace workspace_;
  std::uint32_t *order_, *inside_;  ///< the caller's number of node v; node v of the caller's number
  Point* nodes_;                    ///< those outside behind the others
  Star* stars_;
  /// Rings, counterclockwise from anywhere. Free slots behind a ring are kFree; the slot behind these is the
  /// first of another ring, or kTaken. Rings that have become too long for their places are at the end.
  std::uint32_t* rings_;
  std::size_t end_ = 0;
  std::uint8_t* is_changed_;
  std::vector<std::uint32_t> changed_;
  std::vector<Arc> suspects_;  ///< arcs that may not be locally Delaunay, from a node that is not outside
  std::vector<Arc> across_;    ///< those that are not and have a quadrangle with a node outside
  std::size_t flips_ = 0;
  std::size_t work_ = 0;  ///< in slots of rings, that may still be done
};

}  // namespace pstripack
