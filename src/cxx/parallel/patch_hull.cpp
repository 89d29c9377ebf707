#include "parallel/patch_hull.h"

#include <algorithm>

#include "geometry/insertion_order.h"

namespace pstripack {
namespace {

/// Leaves room for nodes that are taken in later. If they are more, make_room() takes memory anew.
std::size_t capacity_for(std::size_t nodes) { return nodes + nodes / 16 + 256; }

}  // namespace

template <class Int>
std::size_t PatchHull<Int>::workspace_bytes(std::size_t nodes) {
  return capacity_for(nodes) * (sizeof(PatchNode) + sizeof(Point) + sizeof(Int) + 2 * sizeof(Face) +
                                sizeof(HullCorner) + 2 * sizeof(Plane)) +
         Workspace::kSlack;
}

template <class Int>
void PatchHull<Int>::set_up(const PatchNodes& nodes, const std::vector<Record>& leading,
                            Workspace& workspace) {
  own_ = nodes.own;
  const std::size_t first = leading.size();
  built_ = nodes.count() + first;
  arrays_.capacity = capacity_for(built_);
  order_ = workspace.for_call<PatchNode>(built_);
  leading_ =
      first + insertion_order(&nodes.first->point, nodes.count(), order_ + first, workspace, sizeof(Record));
  workspace.next_phase();
  arrays_.nodes = workspace.for_call<Point>(arrays_.capacity);
  number_ = workspace.for_call<Int>(arrays_.capacity);
  for (std::size_t v = 0; v < first; ++v) {
    order_[v] = static_cast<PatchNode>(nodes.count() + v);
    arrays_.nodes[v] = leading[v].point;
    number_[v] = static_cast<Int>(leading[v].number);
  }
  constexpr std::size_t kAhead = 16;
  for (std::size_t v = first; v < built_; ++v) {
    if (v + kAhead < built_) __builtin_prefetch(nodes.first + order_[v + kAhead]);
    const Record& r = nodes.first[order_[v]];
    arrays_.nodes[v] = r.point;
    number_[v] = static_cast<Int>(r.number);
  }
  arrays_.faces = workspace.for_call<Face>(2 * arrays_.capacity);
  arrays_.corner = workspace.for_call<HullCorner>(arrays_.capacity);
  arrays_.planes = workspace.for_phase<Plane>(2 * arrays_.capacity);
  first_planes_ = arrays_.planes;
  growing_ = GrowingHull::make(arrays_, built_, places_.lengths());
  growing_->look_for_hidden_nodes(leading_);
}

template <class Int>
void PatchHull<Int>::build() {
  growing_->build(leading_);
  for (const auto& [in, out] : growing_->coincident())
    if (number(in) != number(out)) coincident_.emplace_back(number(in), number(out));
}

template <class Int>
void PatchHull<Int>::make_room() {
  const std::size_t n = growing_->node_count(), faces = growing_->face_count();
  if (n < arrays_.capacity) return;
  HullArrays larger;
  larger.capacity = 2 * arrays_.capacity;
  auto memory = decltype(memory_){Buffer<Point>(larger.capacity), Buffer<Int>(larger.capacity),
                                  Buffer<Face>(2 * larger.capacity), Buffer<Plane>(2 * larger.capacity),
                                  Buffer<HullCorner>(larger.capacity)};
  std::copy(arrays_.nodes, arrays_.nodes + n, memory.nodes.begin());
  std::copy(number_, number_ + n, memory.number.begin());
  std::copy(arrays_.faces, arrays_.faces + faces, memory.faces.begin());
  std::copy(arrays_.planes, arrays_.planes + faces, memory.planes.begin());
  std::copy(arrays_.corner, arrays_.corner + n, memory.corner.begin());
  memory_ = std::move(memory);
  larger.nodes = memory_.nodes.data();
  larger.faces = memory_.faces.data();
  larger.planes = memory_.planes.data();
  larger.corner = memory_.corner.data();
  number_ = memory_.number.data();
  arrays_ = larger;
  growing_->move_to(arrays_);
}

template <class Int>
HullNode PatchHull<Int>::take_in(const Record& node) {
  const auto [taken, is_new] = taken_in_.try_emplace(node.number, 0);
  if (!is_new) return taken->second;
  make_room();
  const std::size_t before = growing_->node_count();
  const HullNode v = growing_->add(node.point);
  if (v == before)
    number_[v] = static_cast<Int>(node.number);
  else if (number(v) != node.number)
    coincident_.emplace_back(number(v), node.number);
  taken->second = v;
  return v;
}

template class PatchHull<std::int32_t>;
template class PatchHull<std::int64_t>;

}  // namespace pstripack
