#include "parallel/levels.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "mesh/delaunay.h"

namespace pstripack {
namespace {

constexpr std::uint32_t kManyNeighbours = 64;  // of a hub

}  // namespace

CoarseMesh::CoarseMesh(const std::vector<Point>& nodes) {
  const std::size_t n = nodes.size();
  if (n < 3) return;
  Workspace workspace(workspace_bytes(n) + 48 * n);
  try {
    const Hull hull = delaunay(nodes.data(), n, workspace);
    std::vector<std::uint32_t> neighbours(n);
    const auto for_each_front = [&](const auto& visit) {
      for (std::size_t t = 0; t < hull.face_count; ++t)
        if (hull.front(t)) visit(hull.faces[t].vertex);
    };
    for_each_front([&](const HullNode* v) {
      for (int i = 0; i < 3; ++i) ++neighbours[v[i]];
    });
    const auto is_hub = [&](HullNode v) { return neighbours[v] > kManyNeighbours; };
    for (HullNode v = 0; v < hull.node_count; ++v)
      if (is_hub(v)) hubs_.push_back(hull.order[v]);
    triangles_.reserve(hull.face_count);
    for_each_front([&](const HullNode* v) {
      if (is_hub(v[0]) || is_hub(v[1]) || is_hub(v[2]))
        ++at_hubs_;
      else
        triangles_.push_back({hull.order[v[0]], hull.order[v[1]], hull.order[v[2]]});
    });
  } catch (const std::domain_error&) {  // all on one great circle
  }
}

Levels::Levels(const CoarseMesh& mesh, const std::vector<Point>& places, const Partition& cells)
    : cell_of_(places.size()), begin_(cells.cells() + 2) {
  cells.cells_of(places.data(), places.size(), cell_of_.data());
  const auto for_each_edge = [&](const auto& visit) {
    for (const auto& t : mesh.triangles())
      for (int i = 0; i < 3; ++i) {
        const CellNumber a = cell_of_[t[i]], b = cell_of_[t[i < 2 ? i + 1 : 0]];
        if (a != b) visit(a, b);
      }
  };
  for_each_edge([&](CellNumber a, CellNumber b) { ++begin_[a + 2], ++begin_[b + 2]; });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  beside_.resize(begin_.back());
  for_each_edge(
      [&](CellNumber a, CellNumber b) { beside_[begin_[a + 1]++] = b, beside_[begin_[b + 1]++] = a; });
  begin_.pop_back();

  // From any cell to a farthest one, twice: from the cell so found, levels are many and narrow.
  const auto count = static_cast<CellNumber>(cells.cells());
  std::vector<std::uint32_t> marked(count);
  std::uint32_t mark = 0;
  for (CellNumber c = 0; c < count; ++c) {
    if (marked[c] != 0) continue;
    const std::size_t before = order_.size();
    CellNumber start = c;
    for (int pass = 0; pass < 3; ++pass) {
      order_.resize(before);
      reach(start, ++mark, marked, order_);
      start = order_.back();
    }
  }

  // Places in that order jump from cell to cell. Means over neighbours do so less, and their level lines are
  // shorter.
  constexpr int kSmoothings = 5;
  std::vector<double> level(count), mean(count);
  for (std::uint32_t k = 0; k < count; ++k) level[order_[k]] = k;
  for (int pass = 0; pass < kSmoothings; ++pass, level.swap(mean))
    for (CellNumber c = 0; c < count; ++c) {
      double sum = level[c];
      for (std::uint32_t k = begin_[c]; k < begin_[c + 1]; ++k) sum += level[beside_[k]];
      mean[c] = sum / (1 + begin_[c + 1] - begin_[c]);
    }
  std::sort(order_.begin(), order_.end(),
            [&](CellNumber a, CellNumber b) { return std::pair(level[a], a) < std::pair(level[b], b); });
}

void Levels::reach(CellNumber start, std::uint32_t mark, std::vector<std::uint32_t>& marked,
                   std::vector<CellNumber>& order) const {
  std::size_t next = order.size();
  const auto meet = [&](CellNumber c) {
    if (marked[c] == mark) return;
    marked[c] = mark;
    order.push_back(c);
  };
  for (meet(start); next < order.size(); ++next) {
    const CellNumber c = order[next];
    for (std::uint32_t k = begin_[c]; k < begin_[c + 1]; ++k) meet(beside_[k]);
  }
}

std::vector<PatchNumber> Levels::slices(int count, const std::vector<std::int64_t>& weight) const {
  const std::int64_t total =
      std::max<std::int64_t>(1, std::accumulate(weight.begin(), weight.end(), std::int64_t{0}));
  std::vector<PatchNumber> slice(order_.size());
  std::int64_t twice_before = 0;  // up to the middle of a cell
  for (const CellNumber c : order_) {
    const double share = static_cast<double>(twice_before + weight[c]) / (2 * static_cast<double>(total));
    slice[c] = std::min(count - 1, static_cast<int>(share * count));
    twice_before += 2 * weight[c];
  }
  return slice;
}

}  // namespace pstripack
