// Queries at places: the triangle, the nearest node, an interpolated value.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel_for.h"
#include "geometry/insertion_order.h"
#include "methods/gradients.h"
#include "triangulation.h"

namespace bindings {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

/// Calls visit(i, place, near) for each place that has a direction. `near` is a node near it, from 1, which visit may update. Places are visited along a space-filling curve. Searches
/// restart in each block of places, so results do not depend on the number of threads.
template <class Visit>
void Triangulation::visit_places(const Point* places, std::size_t count, const Visit& visit) const {
  constexpr std::size_t kBlock = 512, kMost = std::size_t{1} << 28;
  for (std::size_t first = 0; first < count; first += kMost) {
    const std::size_t part = std::min(count - first, kMost);
    Buffer<Point> known(part);
    for (std::size_t i = 0; i < part; ++i) {
      const Point& p = places[first + i];
      known[i] = has_direction(p) ? direction(p) : Point{0, 0, 1};
    }
    Buffer<std::uint32_t> order(part);
    pstripack::Workspace workspace(16 * part);
    pstripack::insertion_order(known.data(), part, order.data(), workspace);
    const std::size_t blocks = (part + kBlock - 1) / kBlock;
    pstripack::parallel_pieces(
        blocks, pstripack::threads_for(20 * part), [&](std::size_t begin, std::size_t end, int) {
          for (std::size_t block = begin; block < end; ++block) {
            std::int32_t near = 1;
            for (std::size_t k = block * kBlock; k < std::min((block + 1) * kBlock, part); ++k) {
              const std::size_t i = order[k];
              if (has_direction(places[first + i])) visit(first + i, places[first + i], near);
            }
          }
        });
  }
}

Buffer<std::int32_t> Triangulation::find(const Point* places, std::size_t count, const std::int32_t* corners,
                                         std::size_t triangles) const {
  struct Row {
    std::int32_t node[3];
  };
  static_assert(sizeof(Row) == 3 * sizeof(std::int32_t));
  const auto* const rows = reinterpret_cast<const Row*>(corners);
  Buffer<std::int32_t> result(count);
  std::fill(result.begin(), result.end(), -1);
  visit_places(places, count, [&](std::size_t i, const Point& p, std::int32_t& near) {
    methods::Interpolation::Corners found;
    if (!interpolation_->triangle(p, near, found)) return;
    const std::int32_t a = found[0] - 1, b = found[1] - 1, c = found[2] - 1;
    const Row* row = std::lower_bound(rows, rows + triangles, a,
                                      [](const Row& r, std::int32_t node) { return r.node[0] < node; });
    while (row < rows + triangles && row->node[0] == a && row->node[1] != b) ++row;
    if (row < rows + triangles && row->node[2] == c) result[i] = static_cast<std::int32_t>(row - rows);
  });
  return result;
}

Buffer<std::int32_t> Triangulation::nearest(const Point* places, std::size_t count) const {
  Buffer<std::int32_t> result(count);
  std::fill(result.begin(), result.end(), -1);
  visit_places(places, count, [&](std::size_t i, const Point& p, std::int32_t& near) {
    near = interpolation_->nearest(p, near);
    result[i] = near - 1;
  });
  return result;
}

Buffer<double> Triangulation::interpolate(Method method, const Point* places, std::size_t count,
                                          const double* values, std::size_t columns) const {
  Buffer<double> result(count * columns);
  std::fill(result.begin(), result.end(), kMissing);
  const auto visit_shares = [&](const auto& visit) {
    visit_places(places, count, [&](std::size_t i, const Point& p, std::int32_t& near) {
      thread_local std::vector<methods::Share> shares;
      if (method == Method::linear ? interpolation_->linear(p, near, shares)
                                   : interpolation_->natural(p, near, shares))
        visit(i, p, shares);
    });
  };
  if (method != Method::cubic) {
    visit_shares([&](std::size_t i, const Point&, const std::vector<methods::Share>& shares) {
      for (std::size_t column = 0; column < columns; ++column) {
        double value = 0;
        for (const auto& [node, part] : shares)
          value += part * values[(static_cast<std::size_t>(node) - 1) * columns + column];
        result[i * columns + column] = value;
      }
    });
    return result;
  }
  std::vector<double> of_nodes(n_);
  for (std::size_t column = 0; column < columns; ++column) {
    for (std::size_t i = 0; i < n_; ++i) of_nodes[i] = values[i * columns + column];
    const std::vector<Point> slopes = methods::gradients(view(), of_nodes);
    visit_shares([&](std::size_t i, const Point& p, const std::vector<methods::Share>& shares) {
      result[i * columns + column] = interpolation_->cubic_value(p, shares, of_nodes, slopes);
    });
  }
  return result;
}

}  // namespace bindings
