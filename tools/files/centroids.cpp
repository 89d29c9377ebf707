#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel_for.h"
#include "files/measures.h"
#include "files/mesh.h"
#include "files/pieces.h"
#include "geometry/measures.h"

namespace files {
namespace {

constexpr double kHalfTurn = -0.9;  ///< cosine of the least angle that is nearly half a turn

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
///
/// `half_turn(k)`: the normal of the side from corner k, if the side is nearly half a turn; else null.
template <class PointAt, class HalfTurn>
Point centroid(std::size_t corners, const PointAt& point, const HalfTurn& half_turn) {
  const Point g = point(0), east = unit(cross(std::fabs(g.z) < 0.9 ? Point{0, 0, 1} : Point{1, 0, 0}, g)),
              north = cross(g, east);
  const auto in_frame = [&](const Point& p) -> Point {
    const Point d = minus(p, g);
    return {dot(d, east), dot(d, north), -dot(d, d) / 2};
  };
  Point sum{0, 0, 0}, p = g;
  for (std::size_t k = 0; k < corners; ++k) {
    const Point q = point((k + 1) % corners), d = in_frame(p), e = in_frame(q);
    if (const Point* const normal = half_turn(k)) {
      const double angle = std::atan2(dot(*normal, cross(p, q)), dot(p, q)),
                   turn = angle < 0 ? angle + 2 * kPi : angle;
      sum = {sum.x + turn * dot(*normal, east) + (e.y - d.y),
             sum.y + turn * dot(*normal, north) - (e.x - d.x), sum.z + turn * dot(*normal, g)};
    } else {
      const Point twice = cross(d, e);
      const double more = over_sine_minus_1(p, q);
      sum = {sum.x + (1 + more) * twice.x - more * (e.y - d.y),
             sum.y + (1 + more) * twice.y + more * (e.x - d.x), sum.z + (1 + more) * twice.z};
    }
    p = q;
  }
  const Point moment{sum.x * east.x + sum.y * north.x + sum.z * g.x,
                     sum.x * east.y + sum.y * north.y + sum.z * g.y,
                     sum.x * east.z + sum.y * north.z + sum.z * g.z};
  const Point centre = unit(moment);
  return std::isfinite(centre.x + centre.y + centre.z) ? centre : g;  // all corners are one
}

}  // namespace

void find_half_turns(Faces& cells, const std::int32_t* beyond, const pstripack::Directions& nodes) {
  cells.for_each_corner([&](std::size_t f, std::size_t k) {
    const std::size_t end = cells.after(f, k);
    if (dot(cells.point(k), cells.point(end)) >= kHalfTurn) return;
    const Point normal = accurate_difference(direction_of(nodes, static_cast<pstripack::index_t>(f)),
                                             direction_of(nodes, beyond[end] - 1));
    cells.half_turns.push_back({f, cells.corner[k], cells.corner[end], unit(normal)});
  });
}

void divide_half_turns(Faces& cells) {
  NumberOfPoint middles;  // both cells compute the same bits
  Faces divided = cells;
  divided.corner.clear();
  auto side = cells.half_turns.begin();
  for (std::size_t f = 0; f < cells.size(); ++f) {
    divided.begin[f] = divided.corner.size();
    for (std::size_t k = cells.begin[f]; k < cells.begin[f + 1]; ++k) {
      divided.corner.push_back(cells.corner[k]);
      if (side == cells.half_turns.end() || side->face != f || side->from != cells.corner[k]) continue;
      const Point &a = cells.points[static_cast<std::size_t>(side->from) - 1],
                  &b = cells.points[static_cast<std::size_t>(side->to) - 1],
                  middle = unit(cross(side->normal, minus(a, b)));
      ++side;
      if (dot(a, b) >= -1 + 1e-12) continue;
      const auto [known, is_new] = middles.try_emplace({middle.x, middle.y, middle.z},
                                                       static_cast<std::int32_t>(divided.points.size() + 1));
      if (is_new) divided.points.push_back(middle);
      divided.corner.push_back(known->second);
    }
  }
  divided.begin.back() = divided.corner.size();
  if (!middles.empty()) cells = std::move(divided);
}

std::vector<Point> centroids(const Faces& faces) {
  std::vector<Point> centres(faces.size());
  pstripack::parallel_for(centres.size(), 8 * centres.size(), [&](std::size_t f) {
    const std::size_t corners = faces.corners(f);
    const auto corner = [&](std::size_t k) { return faces.corner[faces.begin[f] + k]; };
    const auto point = [&](std::size_t k) { return faces.point(faces.begin[f] + k); };
    const auto first = std::lower_bound(faces.half_turns.begin(), faces.half_turns.end(), f,
                                        [](const HalfTurn& h, std::size_t of) { return h.face < of; });
    // divide_half_turns() may have given the side a corner in its middle.
    centres[f] = centroid(corners, point, [&](std::size_t k) -> const Point* {
      const std::size_t before = (k + corners - 1) % corners, after = (k + 1) % corners;
      for (auto h = first; h != faces.half_turns.end() && h->face == f; ++h)
        if ((corner(k) == h->from && (corner(after) == h->to || corner((k + 2) % corners) == h->to)) ||
            (corner(before) == h->from && corner(after) == h->to))
          return &h->normal;
      return nullptr;
    });
  });
  return centres;
}

}  // namespace files
