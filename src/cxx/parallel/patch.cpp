#include "parallel/patch.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "geometry/insertion_order.h"
#include "parallel/number_table.h"

namespace pstripack {

template <class Int>
void Patch<Int>::set_up(const std::vector<Record>& closing, Workspace& workspace) {
  if (nodes_.own == 0) return;
  [[maybe_unused]] const auto all_are = [&](std::size_t first, std::size_t count, bool own) {
    return std::all_of(nodes_.first + first, nodes_.first + first + count, [&](const Record& r) {
      return (partition_->owner(hull_.places()(r.point)) == id_) == own;
    });
  };
  assert(all_are(0, nodes_.own, true) && all_are(nodes_.own, nodes_.halo, false));
  // The halo is looked up by number: whether a node is in it depends on how distances were rounded.
  const Record *const halo = nodes_.first + nodes_.own, *const end = nodes_.first + nodes_.count();
  NumberTable<bool> is_in_halo(closing.size());
  for (const Record& r : closing) is_in_halo.insert(r.number, false);
  for (const Record* r = halo; r < end; ++r) is_in_halo.set(r->number, true);
  std::vector<Record> leading;
  for (const Record& r : closing) {
    const bool is_known = is_in_halo.at(r.number) || partition_->owner(hull_.places()(r.point)) == id_;
    assert(is_known ==
           std::any_of(nodes_.first, end, [&](const Record& known) { return known.number == r.number; }));
    if (!is_known) leading.push_back(r);
  }
  hull_.set_up(nodes_, leading, workspace);
}

template <class Int>
void Patch<Int>::triangulate() {
  if (nodes_.own == 0) return;
  hull_.build();
}

template <class Int>
void Patch<Int>::take_in(std::vector<Record> nodes) {
  if (nodes_.own == 0) return;
  // Each node once: no cell of the curve could tell equal ones apart. Triangles share corners, so many are
  // in.
  NumberTable<bool> met(nodes.size());
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(),
                             [&](const Record& r) {
                               return hull_.find(r.number) != PatchHull<Int>::kNobody ||
                                      !met.insert(r.number, true).second;
                             }),
              nodes.end());
  constexpr std::size_t kMany = 1000;
  if (nodes.size() < kMany) {  // sorting them would take longer than the searches
    for (const Record& r : nodes) hull_.take_in(r);
    return;
  }
  Workspace workspace(16 * nodes.size());
  std::vector<std::uint32_t> order(nodes.size());
  insertion_order(&nodes[0].point, nodes.size(), order.data(), workspace, sizeof(Record));
  for (const std::uint32_t k : order) hull_.take_in(nodes[k]);
}

template <class Int>
void Patch<Int>::finish() {
  assert(known() == listed_ || partition_->patches() == 1);
  if (nodes_.own > 0) finished_ = hull_.growing().finish();
}

template class Patch<std::int32_t>;
template class Patch<std::int64_t>;

}  // namespace pstripack
