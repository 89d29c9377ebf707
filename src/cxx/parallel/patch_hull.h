#pragma once
// The nodes that a patch knows, and their hull.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/workspace.h"
#include "capi/pstripack.h"
#include "geometry/insertion_order.h"
#include "mesh/delaunay.h"
#include "mesh/ring_table.h"
#include "parallel/coincidence.h"
#include "parallel/communicator.h"
#include "parallel/local_numbers.h"
#include "parallel/number_table.h"
#include "parallel/places.h"
#include "parallel/sent_node.h"

namespace pstripack {

/// Int: a type that holds all node numbers. "Node v" is a hull node. The hull grows, but no node changes its
/// HullNode.
template <class Int>
class PatchHull {
 public:
  explicit PatchHull(const Places& places) : places_(places) {}

  /// Memory for set_up() with `nodes` nodes, the leading ones included.
  static std::size_t workspace_bytes(std::size_t nodes) {
    return nodes * sizeof(PatchNode) + bytes_of_arrays(capacity_for(nodes)) + Workspace::kSlack;
  }
  /// Sorts the nodes; `leading` are others, which come first. The workspace must outlive the hull and its
  /// rings, `nodes` only this call. Throws HiddenNode if a quick test finds one, std::bad_alloc, Failure(-4).
  void set_up(const PatchNodes& nodes, const std::vector<SentNode>& leading, Workspace& workspace) {
    own_ = nodes.own;
    const std::size_t first = leading.size();
    built_ = nodes.count() + first;
    if (static_cast<std::int64_t>(built_) > kMostHullNodes) throw Failure(PSTRIPACK_TOO_MANY_NODES);
    order_ = workspace.for_call<PatchNode>(built_);
    leading_ = first + insertion_order(&nodes.first->point, nodes.count(), order_ + first, workspace,
                                       sizeof(SentNode));
    workspace.next_phase();
    lay_out(workspace, capacity_for(built_));
    const auto set = [&](std::size_t v, const SentNode& r) {
      arrays_.nodes[v] = r.point;
      number_[v] = static_cast<Int>(r.number);
    };
    for (std::size_t v = 0; v < first; ++v) {
      order_[v] = static_cast<PatchNode>(nodes.count() + v);
      set(v, leading[v]);
    }
    constexpr std::size_t kAhead = 16;
    for (std::size_t v = first; v < built_; ++v) {
      if (v + kAhead < built_) __builtin_prefetch(nodes.first + order_[v + kAhead]);
      set(v, nodes.first[order_[v]]);
    }
    first_planes_ = arrays_.planes;
    growing_ = GrowingHull::make(arrays_, built_, places_.lengths());
    growing_->look_for_hidden_nodes(leading_);
  }
  /// Makes their hull. Throws HiddenNode, std::bad_alloc.
  void build() {
    growing_->build(leading_);
    for (const auto& [in, out] : growing_->coincident())
      if (number(in) != number(out)) coincident_.emplace_back(number(in), number(out));
  }
  /// Adds a node of another patch, unless it was added before. Returns its hull node, or the one with which
  /// it coincides. Throws HiddenNode, std::bad_alloc.
  HullNode take_in(const SentNode& node) {
    if (const HullNode* const taken = taken_in_.find(node.number)) return *taken;
    make_room();
    const std::size_t before = growing_->node_count();
    const HullNode v = growing_->add(node.point);
    if (v == before)
      number_[v] = static_cast<Int>(node.number);
    else if (number(v) != node.number)
      coincident_.emplace_back(number(v), node.number);
    taken_in_.insert(node.number, v);
    return v;
  }
  /// True if the node of that number was taken in.
  bool has_taken_in(GlobalNumber number) const { return taken_in_.find(number) != nullptr; }

  const Places& places() const { return places_; }
  const GrowingHull& growing() const { return *growing_; }
  const Face& face(HullFace t) const { return arrays_.faces[t]; }
  /// The numbers of different nodes in the same direction, as far as the hull has found them.
  const CoincidentPairs& coincident() const { return coincident_; }

  bool is_own(HullNode v) const { return v < built_ && order_[v] < own_; }
  Point place(HullNode v) const { return places_(arrays_.nodes[v]); }
  GlobalNumber number(HullNode v) const { return GlobalNumber{number_[v]}; }
  SentNode node(HullNode v) const { return {arrays_.nodes[v], number(v)}; }

  /// A corner of a face at node v.
  HullCorner corner(HullNode v) const { return arrays_.corner[v]; }
  /// The corner at the same node in the next face counterclockwise.
  HullCorner counterclockwise(HullCorner corner) const {
    const HullCorner beyond = arrays_.faces[face_of(corner)].neighbour[next_edge(edge_of(corner))];
    return 4 * face_of(beyond) + next_edge(edge_of(beyond));
  }
  /// Calls visit(t, i) for every face t around node v, which is its vertex i.
  template <class Visit>
  void for_each_face_at(HullNode v, const Visit& visit) const {
    const HullCorner first = arrays_.corner[v];
    HullCorner corner = first;
    do {
      visit(face_of(corner), edge_of(corner));
      corner = counterclockwise(corner);
    } while (corner != first);
  }

  bool is_front(HullFace t) const { return growing_->surrounds_centre() || growing_->front(t); }

  /// Calls visit(t) for every face t, front or not, that has an own node and a node v >= first of others for
  /// corners.
  template <class Visit>
  void for_each_face_at_border(std::size_t first, const Visit& visit) const {
    const auto n = static_cast<HullNode>(growing_->node_count());
    for (auto v = static_cast<HullNode>(first); v < n; ++v) {
      if (is_own(v)) continue;
      for_each_face_at(v, [&](HullFace t, std::uint32_t) {
        const auto& corner = arrays_.faces[t].vertex;
        bool has_own = false;
        for (int i = 0; i < 3; ++i) {
          const bool own = is_own(corner[i]);
          if (corner[i] < v && corner[i] >= first && !own) return;  // met there
          has_own = has_own || own;
        }
        if (has_own) visit(t);
      });
    }
  }

  /// After build() and all that was taken in: memory of set_up() for `bytes` that is not needed after
  /// GrowingHull::finish(); null if there is not enough.
  void* room_for_rings(std::size_t bytes) const {
    return bytes <= 2 * built_ * sizeof(Plane) ? first_planes_ : nullptr;
  }

  /// Gives back the pages of what is not needed after finish(), or after the last ring.
  void give_back_planes() const { give_back_pages(first_planes_, first_planes_ + 2 * built_); }
  void give_back_hull() const { give_back_pages(order_, first_planes_); }

  /// Writes the rings of the own nodes, as `finished` has them, to `out`: see Patch::write_rings.
  template <class Visit, class Soon>
  void write_rings(const Hull& finished, Int* out, const Visit& visit, const Soon& soon) const {
    // By value: where visit() writes bytes, they could change anything that is reached through `this`.
    append_rings(
        finished, 0, built_, [order = order_, own = own_](std::size_t v) { return order[v] < own; },
        Numbers<Int, 0>{number_}, [order = order_, soon](std::size_t v) { soon(order[v]); }, out,
        [order = order_, visit](std::size_t v, const Int* place, std::uint32_t count) {
          visit(order[v], place, count);
        });
  }

 private:
  /// Leaves room for nodes that are taken in later. If they are more, make_room() takes memory anew.
  static std::size_t capacity_for(std::size_t nodes) { return nodes + nodes / 16 + 256; }
  static std::size_t bytes_of_arrays(std::size_t capacity) {
    return capacity *
           (sizeof(Point) + sizeof(Int) + 2 * sizeof(Face) + sizeof(HullCorner) + 2 * sizeof(Plane));
  }
  void lay_out(Workspace& workspace, std::size_t capacity) {
    arrays_.capacity = capacity;
    arrays_.nodes = workspace.for_call<Point>(capacity);
    number_ = workspace.for_call<Int>(capacity);
    arrays_.faces = workspace.for_call<Face>(2 * capacity);
    arrays_.corner = workspace.for_call<HullCorner>(capacity);
    arrays_.planes = workspace.for_phase<Plane>(2 * capacity);
  }
  void make_room() {
    const std::size_t n = growing_->node_count(), faces = growing_->face_count();
    if (n < arrays_.capacity) return;
    auto memory = std::make_unique<Workspace>(bytes_of_arrays(2 * arrays_.capacity));
    const HullArrays before = arrays_;
    const Int* const number_before = number_;
    lay_out(*memory, 2 * before.capacity);
    std::copy_n(before.nodes, n, arrays_.nodes);
    std::copy_n(number_before, n, number_);
    std::copy_n(before.faces, faces, arrays_.faces);
    std::copy_n(before.planes, faces, arrays_.planes);
    std::copy_n(before.corner, n, arrays_.corner);
    growing_->move_to(arrays_);
    more_memory_ = std::move(memory);
  }

  Places places_;
  std::size_t own_ = 0, leading_ = 0, built_ = 0;
  /// Which of the nodes of set_up() each hull node < built_ is; >= their count if it is a leading one.
  PatchNode* order_ = nullptr;
  Int* number_ = nullptr;  ///< of each hull node
  HullArrays arrays_;
  std::unique_ptr<GrowingHull> growing_;
  Plane* first_planes_ = nullptr;  ///< those in the workspace, for built_ nodes at least
  CoincidentPairs coincident_;
  NumberTable<HullNode> taken_in_;
  std::unique_ptr<Workspace> more_memory_;  ///< where that of set_up() was too small for what was taken in
};

}  // namespace pstripack
