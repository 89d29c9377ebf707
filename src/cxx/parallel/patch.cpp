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
  std::vector<Record> leading;
  for (const Record& r : closing) {
    const bool is_known = partition_->knows(id_, hull_.places()(r.point));
    assert(is_known == std::any_of(nodes_.first, nodes_.first + nodes_.count(),
                                   [&](const Record& known) { return known.number == r.number; }));
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
std::size_t Patch<Int>::finish() {
  if (nodes_.own == 0) return 0;
  finished_ = hull_.growing().finish();
  // The corners of all triangles, and for each node one more at the boundary and its count.
  return 3 * finished_.face_count + 2 * finished_.node_count;
}

template class Patch<std::int32_t>;
template class Patch<std::int64_t>;

}  // namespace pstripack
