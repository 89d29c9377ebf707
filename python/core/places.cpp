// Places in a triangulation: the triangle, the nearest node, a value.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel_for.h"
#include "files/measures.h"
#include "geometry/insertion_order.h"
#include "stripack/list_queries.h"
#include "stripack/search.h"
#include "triangulation.h"

namespace bindings {
namespace {

using Reader = pstripack::ListReader<std::int32_t>;

constexpr double kOnBorder = 1e-12;
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

/// The triangle that contains a place; nodes from 0, counterclockwise, the smallest first.
struct Triangulation::Corners {
  std::int32_t node[3];
};

/// Calls visit(i, place, near) for each place that has a direction: a unit vector, and a node near it, from
/// 1, which visit may update. Places are visited along a curve on which neighbours are near each other.
/// Searches start anew in each block of them, so results do not depend on the threads.
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
              if (has_direction(places[first + i])) visit(first + i, known[i], near);
            }
          }
        });
  }
}

/// False if p is outside; p just outside is moved inside.
bool Triangulation::locate(Point& p, std::int32_t& near, Corners& corners) const {
  const auto find = [&] {
    double b1, b2, b3;
    const pstripack::Location<std::int32_t> found =
        pstripack::trfind(near, pstripack::Vector<double>{p.x, p.y, p.z}, lists(), nodes(), b1, b2, b3);
    if (found.i1 != 0) near = found.i1;
    corners = {{found.i1 - 1, found.i2 - 1, found.i3 - 1}};
    std::rotate(corners.node, std::min_element(corners.node, corners.node + 3), corners.node + 3);
    return found.i3 != 0;
  };
  if (find()) return true;
  const Point inwards = minus(middle_, p);
  p = unit({p.x + kOnBorder * inwards.x, p.y + kOnBorder * inwards.y, p.z + kOnBorder * inwards.z});
  return find();
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
  visit_places(places, count, [&](std::size_t i, Point p, std::int32_t& near) {
    Corners found;
    if (!locate(p, near, found)) return;
    const auto& [a, b, c] = found.node;
    const Row* row = std::lower_bound(rows, rows + triangles, a,
                                      [](const Row& r, std::int32_t node) { return r.node[0] < node; });
    while (row < rows + triangles && row->node[0] == a && row->node[1] != b) ++row;
    if (row < rows + triangles && row->node[2] == c) result[i] = static_cast<std::int32_t>(row - rows);
  });
  return result;
}

/// Steps to nearer neighbours, as long as there are any. Nodes from 1.
std::int32_t Triangulation::descend(const Point& p, std::int32_t node) const {
  const Reader reader(lists());
  const auto square_to = [&](std::int32_t other) {
    const Point d = minus(at(other - 1), p);
    return dot(d, d);
  };
  for (double best = square_to(node);;) {
    const std::int32_t here = node, last = reader.last_slot(here);
    std::int32_t slot = last;
    do {
      slot = reader.next(slot);
      const std::int32_t neighbour = reader.neighbour(slot);
      if (const double d = square_to(neighbour); d < best) best = d, node = neighbour;
    } while (slot != last);
    if (node == here) return node;
  }
}

// The segment from a node to p passes through the cells of nearer and nearer nodes, each a neighbour of the
// previous one. Only if the nodes lie in a hemisphere can such neighbours, two nodes of the border, be
// missing from the lists; their cells meet more than 90 degrees away from both. So the descent ends in the
// nearest node if it begins less than 90 degrees away. If there is such a node, there is one on the border,
// since a node is a sum of positive multiples of border nodes. For the same reason, if there is none, the
// nearest node is on the border.
std::int32_t Triangulation::nearest(const Point& p, std::int32_t near) const {
  const std::int32_t node = descend(p, near);
  if (first_boundary_node_ == 0 || dot(at(node - 1), p) > 0) return node;
  const Reader reader(lists());
  std::int32_t best = node, round = first_boundary_node_;
  do {
    if (dot(at(round - 1), p) > dot(at(best - 1), p)) best = round;
    round = reader.first_neighbour(round);
  } while (round != first_boundary_node_);
  return descend(p, best);
}

Buffer<std::int32_t> Triangulation::nearest(const Point* places, std::size_t count) const {
  Buffer<std::int32_t> result(count);
  std::fill(result.begin(), result.end(), -1);
  visit_places(places, count, [&](std::size_t i, const Point& p, std::int32_t& near) {
    near = nearest(p, near);
    result[i] = near - 1;
  });
  return result;
}

Buffer<double> Triangulation::linear(const Point* places, std::size_t count, const double* values,
                                     std::size_t columns) const {
  Buffer<double> result(count * columns);
  std::fill(result.begin(), result.end(), kMissing);
  visit_places(places, count, [&](std::size_t i, const Point& p, std::int32_t& near) {
    Point place = p;
    Corners corners;
    if (!locate(place, near, corners)) return;
    const auto& [a, b, c] = corners.node;
    double weight[3] = {files::volume(place, at(b), at(c)), files::volume(place, at(c), at(a)),
                        files::volume(place, at(a), at(b))};
    double sum = 0;
    for (double& w : weight) sum += w = std::max(w, 0.0);  // rounding may lead across an arc
    for (std::size_t k = 0; k < 3; ++k)  // a node, or a triangle that is hardly more than an arc
      if (const std::int32_t node = corners.node[k];
          at(node) == p || (sum == 0 && nearest(p, near) == node + 1)) {
        std::fill(weight, weight + 3, 0.0);
        weight[k] = sum = 1;
      }
    for (std::size_t column = 0; column < columns; ++column) {
      double value = 0;
      for (std::size_t k = 0; k < 3; ++k)  // weight 0: also of a value that is not finite
        if (weight[k] > 0)
          value += weight[k] / sum * values[static_cast<std::size_t>(corners.node[k]) * columns + column];
      result[i * columns + column] = value;
    }
  });
  return result;
}

}  // namespace bindings
