#pragma once
// A mesh whose nodes have moved a little: tested at their new positions, and repaired by flips.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/workspace.h"
#include "geometry/node_arrays.h"
#include "geometry/predicates.h"

namespace pstripack {

/// True if nodes of this length can be repaired with `confirm`: see MovingMesh::repair().
inline bool has_length_for(Confirm confirm, const Point& p) {
  return confirm == Confirm::directions ? length_is_one_up_to_rounding(p) : length_is_one(p);
}

/// A node of a MovingMesh, as its caller counts: from 0; nodes outside come last.
using MeshNode = std::uint32_t;
/// The same node as the mesh counts: along the insertion curve of the first positions, so that neighbours are
/// close in memory.
using CurveNode = std::uint32_t;

/// The stars of the nodes of a mesh without a boundary, and the current positions of the nodes.
///
/// An object may hold a part of such a mesh: the stars of some of its nodes. Neighbours that have no star
/// here are called nodes outside; their numbers, as the caller counts, are size() and above.
class MovingMesh {
 public:
  /// The mesh of the nodes p[0..n-1] with these canonical lists (docs/differences.md); n < 2^29. The nodes
  /// must surround the centre. For a part of a mesh: p[n..n+outside-1] are the nodes outside, and
  /// add_outside() may add up to `room` more. Parallel. Throws std::bad_alloc.
  MovingMesh(const Point* p, std::size_t n, const std::int32_t* list, const std::int32_t* lend,
             std::size_t outside = 0, std::size_t room = 0);

  /// Stars to be added: node[i] has the neighbours ring[end[i-1]..end[i]-1], counterclockwise; end[-1] counts
  /// as 0.
  struct MoreStars {
    std::vector<MeshNode> node;
    std::vector<std::uint32_t> end;
    std::vector<MeshNode> ring;
    std::size_t count(std::size_t i) const { return end[i] - (i == 0 ? 0 : end[i - 1]); }
  };
  /// Another part of the mesh of which `last` is a part: n nodes with stars that have `arcs` arcs in all,
  /// and `outside` nodes outside. Node k of `last`, outside or not, becomes node to[k]; kNobody if it is
  /// not in this part. `more` has the stars of the nodes that had no star in `last`. Positions are not set:
  /// the caller sets them by node(). Parallel. Throws std::bad_alloc.
  MovingMesh(const MovingMesh& last, std::size_t n, std::size_t arcs, std::size_t outside, std::size_t room,
             const MeshNode* to, const MoreStars& more);

  /// Bytes of a mesh with n stars and `arcs` arcs in them; `all` nodes, those outside and their room
  /// included.
  static std::size_t bytes(std::size_t n, std::size_t arcs, std::size_t all) {
    return workspace_bytes(n, arcs, all);
  }

  std::size_t size() const { return n_; }
  /// Position of node k (the caller's number, from 0), to be set before repair().
  Point& node(std::size_t k) { return nodes_[inside_[k]]; }
  const Point& node(std::size_t k) const { return nodes_[inside_[k]]; }

  /// Sets the positions of the nodes with stars. Parallel.
  struct Moved {
    bool fit;  ///< all have_length_for( `confirm` )
    bool any;  ///< at least one has another position than before
  };
  Moved move(const NodeArrays& nodes, Confirm confirm);

  /// Turns the mesh into the Delaunay triangulation of its nodes at their positions, by the predicates on
  /// coordinates with their tie rule; flips() is then the number of arcs flipped. Returns false if a
  /// triangle is not counterclockwise, an arc cannot be flipped, or a new triangulation is faster; the mesh
  /// must then be discarded. All nodes must have has_length_for(confirm). Why the tests suffice:
  /// docs/internals/design.md, "Warm start". Parallel. Throws std::bad_alloc. Confirm::directions: also false
  /// if the mesh may not be that of the directions.
  bool repair(Confirm confirm = Confirm::nothing);
  std::size_t flips() const { return flips_; }

  // The steps of repair(), for parts that together are a mesh. If one returns false, the mesh must be
  // discarded.

  static constexpr MeshNode kNobody = UINT32_MAX;
  /// What repair() does with `confirm`: to be called before test(). In the end no part may have differs().
  void begin(Confirm confirm) { confirm_ = confirm, differs_ = false; }
  bool differs() const { return differs_; }
  /// A triangle, and a direction strictly inside it. Corners that are not nodes of this part are kNobody.
  struct Mark {
    MeshNode corner[3];
    Point towards;
  };
  /// The arc a-b with c on its right and d on its left, as drawn at flip_here(). In private functions the
  /// four are CurveNodes, as are the corners of a Mark.
  struct Quadrangle {
    MeshNode a, b, c, d;
  };
  /// Chooses a triangle of this part. False if none of a few is suitable.
  bool choose_mark(Mark& mark) const;
  /// Tests every star. All parts must be given the same mark. Parallel. Throws std::bad_alloc.
  bool test(const Mark& mark);
  /// Flips arcs until every arc whose quadrangle has no node outside is locally Delaunay. Appends to
  /// `across`, once each, the other arcs that are not locally Delaunay; every part that has an end of such
  /// an arc finds it. An arc in `across` is tested again only after suspect() or flip(). Throws
  /// std::bad_alloc.
  bool flip_inside(std::vector<Quadrangle>& across);
  bool is_convex(const Quadrangle& q) const;
  /// Replaces a-b by c-d in the stars of this part. A corner that has no star here and is not a new
  /// neighbour of a star here may be kNobody. Throws std::bad_alloc.
  bool flip(const Quadrangle& q);
  /// Notes that the arc a-b may not be locally Delaunay. Throws std::bad_alloc.
  void suspect(MeshNode a, MeshNode b);
  /// Adds a node outside and returns its number; kNobody if there is no room.
  MeshNode add_outside(const Point& p);

  /// A node whose ring differs from that in the lists given last: its number, and its number of neighbours.
  struct Change {
    MeshNode node;
    std::uint32_t count;
  };
  /// All changes, in increasing order of the nodes. Throws std::bad_alloc.
  std::vector<Change> changes() const;
  std::size_t degree(std::size_t k) const { return stars_[inside_[k]].count; }
  /// Calls visit(j) for each arc from a node here to the node outside size() + j.
  template <class Visit>
  void for_each_arc_outside(const Visit& visit) const {
    for (std::size_t v = 0; v < n_; ++v)
      for (std::uint32_t i = 0; i < stars_[v].count; ++i)
        if (const CurveNode w = rings_[stars_[v].begin + i]; is_outside(w)) visit(w - n_);
  }
  /// Writes the degree(k) neighbours of node k as they stand in LIST.
  void write_ring(std::size_t k, std::int32_t* list) const;

  /// From now on, changes are counted from the current rings. Parallel. Throws std::bad_alloc.
  void forget_changes();

 private:
  struct Star {
    std::uint32_t begin, count;
  };
  struct Arc {
    CurveNode a, b;
  };

  static constexpr std::uint32_t kFree = UINT32_MAX, kTaken = UINT32_MAX - 1;
  /// Size of rings_: each ring, its free slot, and room for rings that become longer.
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
  bool examine(CurveNode v, const Mark& mark, std::vector<Arc>& suspects) const;
  bool is_outside(CurveNode v) const { return v >= n_; }
  CurveNode inside(MeshNode k) const { return k == kNobody ? kNobody : inside_[k]; }
  void suspect_inside(CurveNode a, CurveNode b);
  bool find(const Arc& arc, Quadrangle& q);
  bool is_above(CurveNode a, CurveNode b, CurveNode c, CurveNode d, bool& differs) const;
  bool is_convex_inside(const Quadrangle& q) const;
  bool flip_here(const Quadrangle& q);
  std::uint32_t place_of(CurveNode b, const Star& star) const;
  bool insert(CurveNode v, std::uint32_t place, CurveNode neighbour);
  void remove(CurveNode v, std::uint32_t place);
  void note_change(CurveNode v);

  std::size_t n_, all_, most_;      ///< nodes with a star; and nodes outside; and room for more outside
  const std::size_t arcs_, slots_;  ///< arcs of the stars at the beginning; size of rings_
  Workspace workspace_;
  MeshNode* order_;    ///< of each CurveNode
  CurveNode* inside_;  ///< of each MeshNode
  Point* nodes_;       ///< the nodes outside come last
  Star* stars_;
  /// Rings, counterclockwise, starting with any neighbour. Free slots behind a ring hold kFree; the slot
  /// after these is the first of another ring, or holds kTaken. A ring that outgrows its place moves to the
  /// end.
  CurveNode* rings_;
  std::size_t end_ = 0;
  std::uint8_t* is_changed_;
  std::vector<CurveNode> changed_;
  std::vector<Arc> suspects_;  ///< arcs to be tested; a is not outside
  std::vector<Arc> across_;    ///< arcs not locally Delaunay whose quadrangle has a node outside
  std::size_t flips_ = 0;
  std::size_t work_ = 0;  ///< work that may still be done, in slots of rings
  Confirm confirm_ = Confirm::nothing;
  bool differs_ = false;  ///< a test by directions has another result
};

}  // namespace pstripack
