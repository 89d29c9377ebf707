#include "methods/interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel_for.h"
#include "geometry/predicates.h"
#include "methods/gradients.h"
#include "methods/sphere.h"
#include "stripack/list_queries.h"
#include "stripack/search.h"

namespace methods {
namespace {

using Reader = pstripack::ListReader<std::int32_t>;

constexpr double kOnBorder = 1e-12;

double square(const Point& d) { return dot(d, d); }

/// Scales the weights so that their sum is 1.
void make_shares(std::vector<Share>& shares) {
  double sum = 0;
  for (const Share& s : shares) sum += s.part;
  for (Share& s : shares) s.part /= sum;
}

}  // namespace

Interpolation::Interpolation(const Triangulated& mesh, std::shared_ptr<const void> owner)
    : owner_(std::move(owner)), mesh_(mesh), first_boundary_node_(Reader(mesh.lists).first_boundary_node()) {
  if (first_boundary_node_ == 0) return;
  Point sum{0, 0, 0};
  for (std::int32_t node = 1; node <= Reader(mesh.lists).size(); ++node) {
    const Point p = at(node);
    sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
  }
  middle_ = unit(sum);
}

/// Walks by exact signs from a triangle near p to the one that contains p, so that the result does not depend
/// on the search that led here. Rounding of the nodes can invert triangles; the number of steps is bounded
/// because the walk might then cycle.
void Interpolation::cross_arcs(const Point& p, Corners& corners) const {
  const Reader reader(mesh_.lists);
  std::int64_t steps = 0;
  for (int k = 0; k < 3 && steps < 2 * std::int64_t{reader.size()};) {
    auto& [a, b, c] = corners;
    if (pstripack::left(at(a), at(b), p) < 0) {
      const std::int32_t slot = reader.slot_of(b, a);  // beyond the arc lies triangle b, a, w
      if (reader.entry(slot) > 0) {
        c = a;
        a = reader.neighbour(reader.next(slot));
        k = 0;
        ++steps;
        continue;
      }
    }
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    ++k;
  }
}

/// False if p is outside. A p within kOnBorder of the border is moved inside. Every start of the search finds
/// the same triangle.
bool Interpolation::find(Point& p, std::int32_t& near, Corners& corners) const {
  const auto locate = [&] {
    double b1, b2, b3;
    const pstripack::Location<std::int32_t> found = pstripack::trfind(
        near, pstripack::Vector<double>{p.x, p.y, p.z}, mesh_.lists, mesh_.nodes, b1, b2, b3);
    if (found.i1 != 0) near = found.i1;
    if (found.i3 == 0) return false;
    corners = {found.i1, found.i2, found.i3};
    cross_arcs(p, corners);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return true;
  };
  if (locate()) return true;
  if (first_boundary_node_ == 0) return false;
  const Point inwards = minus(middle_, p);
  p = unit({p.x + kOnBorder * inwards.x, p.y + kOnBorder * inwards.y, p.z + kOnBorder * inwards.z});
  return locate();
}

bool Interpolation::is_node(const Point& p, std::int32_t near, std::vector<Share>& shares) const {
  const std::int32_t node = descend(p, near);
  if (at(node) == p) shares = {{node, 1}};
  return !shares.empty();
}

bool Interpolation::linear(const Point& p, std::int32_t& near, std::vector<Share>& shares) const {
  shares.clear();
  Point place = p;
  Corners corners;
  if (!find(place, near, corners)) return is_node(p, near, shares);
  const auto& [a, b, c] = corners;
  for (const std::int32_t node : {a, b, c})
    if (at(node) == p) {
      shares = {{node, 1}};
      return true;
    }
  for (const auto& [node, from, to] : {std::array{a, b, c}, {b, c, a}, {c, a, b}}) {
    if (pstripack::left(at(from), at(to), place) != 0) continue;
    // On an arc: compute the same shares in both of its triangles.
    const auto [low, high] = std::minmax(from, to);
    const Point l = cross(place, at(high)), h = cross(place, at(low));
    shares = {{low, std::sqrt(dot(l, l))}, {high, std::sqrt(dot(h, h))}};
    make_shares(shares);
    return true;
  }
  for (const Share& s : {Share{a, volume(place, at(b), at(c))}, Share{b, volume(place, at(c), at(a))},
                         Share{c, volume(place, at(a), at(b))}})
    if (s.part > 0) shares.push_back(s);              // beside an arc a share can be rounded to 0 or below
  if (shares.empty()) shares = {{nearest(p, a), 1}};  // a triangle that is hardly wider than an arc
  make_shares(shares);
  return true;
}

bool Interpolation::is_above(std::int32_t a, std::int32_t b, std::int32_t c, const Point& p) const {
  return pstripack::orientation(at(a), at(b), at(c), p) > 0;
}

/// The natural neighbours of p, counterclockwise: the border of the triangles whose circumscribed caps
/// contain p, by exact signs. These are the faces of the nodes' hull that p sees, so they are connected and
/// without a hole. If two nodes are so close that rounding has pushed one below its neighbours, the walk may
/// not end; then false is returned.
///
///          w          The triangle beyond the arc u->v, which has p on its left.
///        /   \        If p lies above it, w comes in between u and v.
///       v --- u
///          p
///
bool Interpolation::natural_ring(const Point& p, const Corners& corners,
                                 std::vector<std::int32_t>& ring) const {
  const Reader reader(mesh_.lists);
  ring.assign(corners.begin(), corners.end());
  for (std::size_t i = 0; i < ring.size();) {
    const std::int32_t u = ring[i], v = ring[i + 1 < ring.size() ? i + 1 : 0];
    const std::int32_t slot = reader.slot_of(v, u);
    const bool at_border = reader.entry(slot) < 0;
    const std::int32_t w = at_border ? 0 : reader.neighbour(reader.next(slot));
    if (!at_border && is_above(v, u, w, p))
      ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1, w);
    else
      ++i;
    if (ring.size() > static_cast<std::size_t>(reader.size())) return false;
  }
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  return true;
}

/// The area that the cell of `node` would lose to p. `node` comes between `before` and `after` in the ring
/// around p. The area is that of the polygon of the cell's corners on p's side, between two corners of p's
/// own cell.
///
///        new   after       old: circumcentres of the triangles of `node` from `after` to `before`
///     old |
///   p     |  node          new: of p, node, after and of p, before, node
///     old |
///        new   before
///
double Interpolation::lost_area(const Point& p, std::int32_t before, std::int32_t node,
                                std::int32_t after) const {
  const Reader reader(mesh_.lists);
  const Point first = circumcentre(p, at(node), at(after));
  Point last{};
  double area = 0;
  bool has_last = false;
  const auto add = [&](const Point& corner) {
    if (has_last) area += triangle_area(first, last, corner);
    last = corner;
    has_last = true;
  };
  std::int32_t slot = reader.slot_of(node, after);
  for (std::int32_t from = after; from != before;) {
    slot = reader.next(slot);
    const std::int32_t to = reader.neighbour(slot);
    add(circumcentre(at(node), at(from), at(to)));
    from = to;
  }
  add(circumcentre(p, at(before), at(node)));
  return area;
}

bool Interpolation::natural(const Point& p, std::int32_t& near, std::vector<Share>& shares) const {
  shares.clear();
  Point place = p;
  Corners corners;
  if (!find(place, near, corners)) return is_node(p, near, shares);
  // p does not lie above its own triangle: it is so close to a corner that its height is lost in rounding.
  const Corners& c = corners;
  const bool is_corner = at(c[0]) == p || at(c[1]) == p || at(c[2]) == p;
  std::vector<std::int32_t> ring;
  if (is_corner || !is_above(c[0], c[1], c[2], place) || !natural_ring(place, corners, ring))
    return linear(p, near, shares);
  for (std::size_t i = 0, k = ring.size(); i < k; ++i) {
    const double area = lost_area(place, ring[(i + k - 1) % k], ring[i], ring[(i + 1) % k]);
    if (area > 0) shares.push_back({ring[i], area});
  }
  if (shares.empty()) return linear(p, near, shares);
  make_shares(shares);
  return true;
}

/// Steps to nearer neighbours until there is none.
std::int32_t Interpolation::descend(const Point& p, std::int32_t node) const {
  const Reader reader(mesh_.lists);
  for (double best = square(minus(at(node), p));;) {
    const std::int32_t here = node, last = reader.last_slot(here);
    std::int32_t slot = last;
    do {
      slot = reader.next(slot);
      const std::int32_t neighbour = reader.neighbour(slot);
      if (const double d = square(minus(at(neighbour), p)); d < best) best = d, node = neighbour;
    } while (slot != last);
    if (node == here) return node;
  }
}

// The segment from a node to p passes through cells of nearer and nearer nodes, each a neighbour of the
// previous one. Only if the nodes lie in a hemisphere can two boundary nodes be such neighbours without an
// arc in the lists. Their cells meet more than 90 degrees away from both, so a descent that begins less than
// 90 degrees from p ends in the nearest node. If any node is that near, a boundary node is, since every node
// is a sum of positive multiples of boundary nodes. For the same reason, if none is, the nearest node is a
// boundary node.
std::int32_t Interpolation::nearest(const Point& p, std::int32_t near) const {
  const Reader reader(mesh_.lists);
  std::int32_t node = descend(p, near >= 1 && near <= reader.size() ? near : 1);
  const std::int32_t border = first_boundary_node_;
  if (dot(at(node), p) > 0 || border == 0) return node;
  std::int32_t round = border;
  do {
    if (dot(at(round), p) > dot(at(node), p)) node = round;
    round = reader.first_neighbour(round);
  } while (round != border);
  return descend(p, node);
}

double Interpolation::cubic_value(const Point& p, const std::vector<Share>& shares,
                                  const std::vector<double>& values,
                                  const std::vector<Point>& gradients) const {
  double mean = 0, inverse = 0, tangent = 0, first = 0, second = 0;
  for (const auto& [node, part] : shares) {
    const auto i = static_cast<std::size_t>(node) - 1;
    const Point d = minus(p, at(node));
    const double distance_2 = dot(d, d), distance = std::sqrt(distance_2);
    if (distance == 0) return values[i];
    mean += part * values[i];
    inverse += part / distance;
    tangent += part / distance * (values[i] + dot(gradients[i], d));
    first += part * distance;
    second += part * distance_2;
  }
  const double alpha = first / inverse;
  return (alpha * mean + second * (tangent / inverse)) / (alpha + second);
}

Interpolation::Result Interpolation::values_at(const std::vector<Point>& places,
                                               const std::vector<double>& values, Method method,
                                               Outside outside) const {
  constexpr std::size_t kBlock = 512;  // searches restart here, so that threads change no bit
  Result result;
  result.values.resize(places.size());
  const std::size_t blocks = (places.size() + kBlock - 1) / kBlock;
  std::vector<std::size_t> count_outside(blocks);
  const std::vector<Point> slopes = method == Method::cubic ? gradients(mesh_, values) : std::vector<Point>();
  const auto value_of = [&](std::int32_t node) { return values[static_cast<std::size_t>(node) - 1]; };
  const auto block = [&](std::size_t b) {
    std::int32_t near = 1;
    std::vector<Share> shares;
    for (std::size_t i = b * kBlock; i < std::min((b + 1) * kBlock, places.size()); ++i) {
      const Point p = unit(places[i]);
      if (!(method == Method::linear ? linear(p, near, shares) : natural(p, near, shares))) {
        ++count_outside[b];
        result.values[i] = outside == Outside::missing ? std::numeric_limits<double>::quiet_NaN()
                                                       : value_of(near = nearest(p, near));
        continue;
      }
      if (method == Method::cubic) {
        result.values[i] = cubic_value(p, shares, values, slopes);
        continue;
      }
      double sum = 0, low = value_of(shares[0].node), high = low;
      for (const Share& s : shares) {
        const double v = value_of(s.node);
        sum += s.part * v;
        low = std::min(low, v), high = std::max(high, v);
      }
      result.values[i] = std::clamp(sum, low, high);  // rounding may exceed the range
    }
  };
  pstripack::parallel_pieces(blocks, pstripack::threads_for(100 * places.size()),
                             [&](std::size_t first, std::size_t last, int) {
                               for (std::size_t b = first; b < last; ++b) block(b);
                             });
  for (const std::size_t count : count_outside) result.outside += count;
  return result;
}

}  // namespace methods
