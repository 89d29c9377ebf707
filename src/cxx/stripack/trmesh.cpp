#include "stripack/trmesh.h"

#include <cmath>
#include <limits>
#include <map>

#include "geometry/parallel_for.h"
#include "mesh/delaunay.h"
#include "stripack/adjacency_lists.h"

namespace pstripack {
namespace {

/// Nodes L < M that coincide, M the smallest such index; indices from 0.
struct Coincidence {
  index_t l, m;
};

/// The first two nodes of each set of coincident nodes are a candidate; the one with the smallest M wins.
Coincidence first_coincidence(const Hull& hull) {
  std::map<index_t, Coincidence> sets;  // by the node that is in the hull
  for (const auto& [in, out] : hull.coincident) {
    const auto [set, is_new] = sets.try_emplace(in, Coincidence{std::min(in, out), std::max(in, out)});
    if (is_new) continue;
    auto& [l, m] = set->second;
    if (out < l)
      m = l, l = out;
    else if (out < m)
      m = out;
  }
  Coincidence best{0, std::numeric_limits<index_t>::max()};
  for (const auto& [in, set] : sets)
    if (set.m < best.m) best = set;
  return best;
}

/// Copies the coordinates; returns the first node (from 0) that has no direction, n if all have one.
template <class Real>
std::size_t copy_nodes(std::size_t n, const Real* x, const Real* y, const Real* z, Point* p) {
  const int threads = threads_for(n);
  std::size_t first_bad = n;
  parallel_pieces(n, threads, [&](std::size_t first, std::size_t last, int) {
    std::size_t bad = n;
    for (std::size_t i = last; i-- > first;) {
      p[i] = {static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
      const bool finite = std::isfinite(p[i].x) && std::isfinite(p[i].y) && std::isfinite(p[i].z);
      if (!finite || p[i] == Point{0, 0, 0}) bad = i;
    }
    if (bad == n) return;
#ifdef _OPENMP
#pragma omp critical(pstripack_first_bad)
#endif
    first_bad = std::min(first_bad, bad);
  });
  return first_bad;
}

}  // namespace

template <class Real, class Int>
TrmeshResult trmesh(Int n, const Real* x, const Real* y, const Real* z, Int* list, Int* lptr, Int* lend,
                    Int* lnew) {
  if (n < 3) return {-1};
  if (n > (std::numeric_limits<Int>::max() - 1) / 6 + 2) return {-4};  // LNEW <= 6n-11 must fit

  const auto nodes = static_cast<std::size_t>(n);
  Workspace workspace(workspace_bytes(nodes));
  Point* const p = workspace.take<Point>(nodes);
  const std::size_t bad = copy_nodes(nodes, x, y, z, p);
  if (bad < nodes) return {-5, static_cast<std::int64_t>(bad) + 1};
  if (left(p[0], p[1], p[2]) == 0) return {-2};

  const Hull hull = delaunay(p, nodes, workspace);
  if (hull.coincident.empty()) {
    *lnew = write_lists(hull, list, lptr, lend, workspace);
    return {0};
  }
  // Nodes 1..M-1 do not coincide, and the first three are not on one great circle: M > 3.
  const auto [l, m] = first_coincidence(hull);
  const auto fewer = static_cast<std::size_t>(m);
  workspace.clear();
  Point* const q = workspace.take<Point>(fewer);
  copy_nodes(fewer, x, y, z, q);
  *lnew = write_lists(delaunay(q, fewer, workspace), list, lptr, lend, workspace);
  return {l + 1, l + 1, m + 1};
}

template TrmeshResult trmesh(std::int32_t, const double*, const double*, const double*, std::int32_t*,
                             std::int32_t*, std::int32_t*, std::int32_t*);
template TrmeshResult trmesh(std::int32_t, const float*, const float*, const float*, std::int32_t*,
                             std::int32_t*, std::int32_t*, std::int32_t*);

}  // namespace pstripack
