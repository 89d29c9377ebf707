#include "parallel/patch.h"

namespace pstripack {

template <class Int>
void Patch<Int>::set_up(const std::vector<Record>& closing, Workspace& workspace) {
  if (nodes_.own == 0) return;
  std::vector<Record> leading;
  for (const Record& r : closing)
    if (!partition_->knows(id_, hull_.places()(r.point))) leading.push_back(r);
  hull_.set_up(nodes_, leading, workspace);
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
