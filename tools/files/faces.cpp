// Voronoi cells, and what Faces alone tell: edges, centroids.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/buffer.h"
#include "base/parallel_for.h"
#include "files/measures.h"
#include "files/mesh.h"
#include "geometry/measures.h"
#include "stripack/triangle_list.h"
#include "stripack/voronoi.h"

namespace files {
namespace {

/// x / sin(x) - 1 for the angle x between two unit vectors: below 0.2 by its series.
double over_sine_minus_1(const Point& p, const Point& q) {
  const double sine = length(cross(p, minus(q, p))), x = std::atan2(sine, dot(p, q)), square = x * x;
  if (x > 0.2) return x / sine - 1;
  double sum = 0;
  for (const double term : {8191.0 / 37362124800, 1414477.0 / 653837184000, 73.0 / 3421440, 127.0 / 604800,
                            31.0 / 15120, 7.0 / 360, 1.0 / 6})
    sum = (sum + term) * square;
  return sum;
}

/// The centroid of a polygon: the direction of the integral of p over it, which is half the sum over its
/// sides, from p to q, of their length in the direction of p x q. Differences from the first corner g, in a
/// frame with g upwards, keep the digits of small and of thin polygons: with p = g + d and q = g + e the
/// sides add (length / sine of length) (d x e + g x (e - d)), and the sum of all e - d is 0.
template <class PointAt>
Point centroid(std::size_t corners, const PointAt& point) {
  const Point g = point(0), east = unit(cross(std::fabs(g.z) < 0.9 ? Point{0, 0, 1} : Point{1, 0, 0}, g)),
              north = cross(g, east);
  const auto in_frame = [&](const Point& p) -> Point {
    const Point d = minus(p, g);
    return {dot(d, east), dot(d, north), -dot(d, d) / 2};
  };
  Point sum{0, 0, 0}, p = g;
  for (std::size_t k = 0; k < corners; ++k) {
    const Point q = point((k + 1) % corners), d = in_frame(p), e = in_frame(q);
    const Point twice = cross(d, e);
    const double more = over_sine_minus_1(p, q);
    sum = {sum.x + (1 + more) * twice.x - more * (e.y - d.y),
           sum.y + (1 + more) * twice.y + more * (e.x - d.x), sum.z + (1 + more) * twice.z};
    p = q;
  }
  const Point moment{sum.x * east.x + sum.y * north.x + sum.z * g.x,
                     sum.x * east.y + sum.y * north.y + sum.z * g.y,
                     sum.x * east.z + sum.y * north.z + sum.z * g.z};
  const Point centre = unit(moment);
  return std::isfinite(centre.x + centre.y + centre.z) ? centre : g;  // all corners are one
}

}  // namespace

Edges edges_of(const Faces& faces) {
  // The side of face f that begins at its corner[slot], between the corners `low` and `high`.
  std::vector<std::tuple<std::int32_t, std::int32_t, std::size_t, std::size_t>> sides;
  sides.reserve(faces.corner.size());
  faces.for_each_corner([&](std::size_t f, std::size_t slot) {
    const auto [low, high] = std::minmax(faces.corner[slot], faces.corner[faces.after(f, slot)]);
    sides.emplace_back(low, high, slot, f);
  });
  std::sort(sides.begin(), sides.end());
  Edges edges;
  edges.of_faces.resize(faces.corner.size());
  for (const auto& [low, high, slot, f] : sides) {
    const std::size_t place = faces.corner[slot] == low ? 0 : 1;  // 0: the face is on the left
    const std::size_t last = edges.nodes.size() - 2;
    const bool is_known = !edges.nodes.empty() && edges.nodes[last] == low && edges.nodes[last + 1] == high &&
                          edges.faces[last + place] < 0;
    if (!is_known) {
      edges.nodes.insert(edges.nodes.end(), {low, high});
      edges.faces.insert(edges.faces.end(), {-1, -1});
    }
    edges.faces[edges.faces.size() - 2 + place] = static_cast<std::int32_t>(f + 1);
    edges.of_faces[slot] = static_cast<std::int32_t>(edges.faces.size() / 2);
  }
  return edges;
}

namespace {

/// Inserts the midpoint of each side of a Voronoi cell that is half a turn: the ends of such a side do not
/// determine its great circle. They occur where nodes lie on one circle: their cells are lunes with two
/// sides. beyond[k]: the node, from 1, across the side that ends at cells.corner[k].
void divide_half_turns(Faces& cells, const std::vector<std::int32_t>& beyond,
                       const pstripack::Directions& nodes, double cosine) {
  std::map<std::array<double, 3>, std::int32_t> middles;  // both cells compute the same bits
  std::vector<std::int32_t> corner;
  std::vector<std::size_t> begin{0};
  for (std::size_t f = 0; f < cells.size(); ++f) {
    for (std::size_t k = cells.begin[f]; k < cells.begin[f + 1]; ++k) {
      corner.push_back(cells.corner[k]);
      const std::size_t end = cells.after(f, k);
      const Point from = cells.point(k), to = cells.point(end);
      if (dot(from, to) >= cosine) continue;
      const Point normal = accurate_difference(direction_of(nodes, static_cast<pstripack::index_t>(f)),
                                               direction_of(nodes, beyond[end] - 1)),
                  middle = unit(cross(unit(normal), minus(from, to)));
      const auto [known, is_new] = middles.try_emplace({middle.x, middle.y, middle.z},
                                                       static_cast<std::int32_t>(cells.points.size() + 1));
      if (is_new) cells.points.push_back(middle);
      corner.push_back(known->second);
    }
    begin.push_back(corner.size());
  }
  cells.corner = std::move(corner);
  cells.begin = std::move(begin);
}

}  // namespace

Faces voronoi_cells(const pstripack::ListsView<std::int32_t>& lists, const pstripack::Directions& nodes,
                    bool far_side_first, double cosine) {
  const std::size_t n = lists.n;
  pstripack::Buffer<std::int32_t> lptr(6 * n - 12), corner(lptr.size());
  std::copy(lists.lptr, lists.lptr + lists.lnew - 1, lptr.begin());
  const std::int32_t boundary = pstripack::boundary_nodes(lists, corner.data()).boundary_nodes;
  std::vector<std::int32_t> far_side(6 * static_cast<std::size_t>(boundary));
  pstripack::Buffer<double> x(2 * n - 4), y(x.size()), z(x.size());
  std::int32_t lnew = lists.lnew, nb = 0;
  const pstripack::VoronoiStatus status =
      pstripack::voronoi_of_directions({n, lists.list, lptr.data(), lists.lend, lnew}, nodes,
                                       {boundary, lptr.data(), &lnew, far_side.data(), corner.data(), &nb,
                                        x.data(), y.data(), z.data(), nullptr});
  if (status != pstripack::VoronoiStatus::done)
    throw NoMesh("the Voronoi diagram failed with code " + std::to_string(static_cast<int>(status)));

  Faces cells;
  cells.points.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) cells.points[i] = {x[i], y[i], z[i]};
  cells.corner.reserve(corner.size()), cells.begin.reserve(n + 1);
  std::vector<std::int32_t> beyond;
  const bool divides = cosine >= -1;
  if (divides) beyond.reserve(corner.size());
  cells.begin.push_back(0);
  const std::int32_t* const first_after = far_side_first ? lptr.data() : lists.lptr;
  for (std::size_t node = 0; node < n; ++node) {
    const std::int32_t first = first_after[static_cast<std::size_t>(lists.lend[node]) - 1];
    std::int32_t slot = first;
    do {
      const auto s = static_cast<std::size_t>(slot) - 1;
      cells.corner.push_back(corner[s]);
      if (divides && slot < lists.lnew) {
        beyond.push_back(std::abs(lists.list[s]));
      } else if (divides) {
        // On the far side: the corner after this node in the triangle on the left of the arc.
        const std::int32_t* const column = far_side.data() + 6 * (static_cast<std::size_t>(corner[s]) - 1);
        const auto here = std::find(column, column + 3, static_cast<std::int32_t>(node) + 1) - column;
        beyond.push_back(column[(here + 1) % 3]);
      }
      slot = lptr[s];
    } while (slot != first);
    cells.begin.push_back(cells.corner.size());
  }
  if (divides) divide_half_turns(cells, beyond, nodes, cosine);
  return cells;
}

std::vector<Point> centroids(const Faces& faces) {
  std::vector<Point> centres(faces.size());
  pstripack::parallel_for(centres.size(), 8 * centres.size(), [&](std::size_t f) {
    centres[f] = centroid(faces.corners(f),
                          [&](std::size_t k) -> const Point& { return faces.point(faces.begin[f] + k); });
  });
  return centres;
}

}  // namespace files
