#include "methods/interpolation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel_for.h"
#include "files/measures.h"
#include "geometry/insertion_order.h"
#include "geometry/predicates.h"
#include "geometry/weights.h"
#include "methods/gradients.h"
#include "stripack/list_queries.h"

namespace methods {
namespace {

using pstripack::Direction;
using Reader = pstripack::ListReader<std::int32_t>;

constexpr double kOnBorder = 1e-12;  // of the distance to the middle of the nodes
constexpr double kRounding = 4e-16;  // of a place, in radians

double square(const Point& d) { return dot(d, d); }

/// True if the place lies strictly above the plane of the triangle. The filter takes the sign of the height
/// in geometry/weights.cpp. It uses rounded unit vectors, so each difference to the place has an error of
/// 2^-50; the other roundings are below 32u.
bool is_above(const Direction& a, const Direction& b, const Direction& c, const Direction& place) {
  const Point& p = place.high;
  const Point to_a = minus(a.high, p), to_b = minus(b.high, p), to_c = minus(c.high, p);
  const double aa = square(to_a), bb = square(to_b), cc = square(to_c), most = std::max({aa, bb, cc});
  const double height =
      aa * dot(p, cross(to_b, to_c)) + bb * dot(p, cross(to_c, to_a)) + cc * dot(p, cross(to_a, to_b));
  const double error = most * (12 * 0x1p-50 * std::sqrt(most) + 64 * 0x1p-53 * most);
  if (std::fabs(height) > error) return height > 0;
  return pstripack::orientation_of_directions(a.given, b.given, c.given, place.given) > 0;
}

constexpr std::size_t kBlock = 512;  // places; searches restart in each block, so that threads change no bit

/// The order of the places along a space-filling curve, so that each search begins near its place.
std::vector<std::uint32_t> along_a_curve(const std::vector<Point>& places) {
  std::vector<Point> at;
  at.reserve(places.size());
  for (const Point& p : places) at.push_back(files::unit(p));
  std::vector<std::uint32_t> order(places.size());
  pstripack::Workspace workspace(16 * places.size());
  pstripack::insertion_order(at.data(), at.size(), order.data(), workspace);
  return order;
}

}  // namespace

Interpolation::Interpolation(const Triangulated& mesh, std::shared_ptr<const void> owner)
    : owner_(std::move(owner)), mesh_(mesh), first_boundary_node_(Reader(mesh.lists).first_boundary_node()) {
  if (first_boundary_node_ == 0) return;
  Point sum{0, 0, 0};
  for (std::int32_t node = 1; node <= Reader(mesh.lists).size(); ++node) {
    const Point p = mesh_.unit_at(node);
    sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
  }
  middle_ = files::unit(sum);
}

const pstripack::Direction* Interpolation::directions() const {
  std::call_once(known_->once, [&] {
    std::vector<Direction>& all = known_->directions;
    all.resize(mesh_.lists.n);
    pstripack::parallel_for(all.size(), all.size(), [&](std::size_t i) {
      all[i] = mesh_.direction(static_cast<std::int32_t>(i) + 1);
    });
  });
  return known_->directions.data() - 1;  // nodes count from 1
}

/// The sign of orientation(a, b, place). The filter takes the rounded unit vectors: each is right to 2^-52,
/// so their determinant is right to 3 * 2^-52, and its roundings are below 12 * 2^-53.
int Interpolation::side_of_arc(std::int32_t a, std::int32_t b, const Direction& place) const {
  const double sign = dot(place.high, cross(mesh_.unit_at(a), mesh_.unit_at(b)));
  constexpr double kError = 16 * 0x1p-52;
  if (std::fabs(sign) > kError) return sign > 0 ? 1 : -1;
  return pstripack::left(at(a), at(b), place.given);
}

/// Walks by exact signs from a triangle to the one that contains the place; on an arc, to that of the two
/// whose third corner is the smaller. So the result does not depend on the search that led here. False if the
/// place lies strictly beyond an arc of the border. The walk ends in a Delaunay mesh; in any other, after so
/// many steps.
bool Interpolation::cross_arcs(const Direction& place, Corners& corners) const {
  const Reader reader(mesh_.lists);
  auto& [a, b, c] = corners;
  std::int64_t steps = 0;
  Corners on_arc{};  // a triangle with the place on its first arc
  for (int k = 0; k < 3 && steps < 4 * std::int64_t{reader.size()};) {
    const int side = side_of_arc(a, b, place);
    if (side < 0) {
      const std::int32_t slot = reader.slot_of(b, a);  // beyond the arc lies triangle b, a, w
      if (reader.entry(slot) < 0) return false;
      c = a;
      a = reader.neighbour(reader.next(slot));
      k = 0;
      ++steps;
      on_arc = {};
      continue;
    }
    if (side == 0) on_arc = corners;
    corners = {b, c, a};
    ++k;
  }
  if (on_arc[0] != 0) {
    const std::int32_t slot = reader.slot_of(on_arc[1], on_arc[0]);
    if (const std::int32_t w = reader.neighbour(reader.next(slot)); reader.entry(slot) > 0 && w < on_arc[2])
      corners = {on_arc[1], on_arc[0], w};
  }
  return true;
}

/// The triangle at the arc of the border that is nearest to the place, which sees the arc from `first` on.
void Interpolation::find_nearest_on_border(const Direction& place, std::int32_t first,
                                           Corners& corners) const {
  const Reader reader(mesh_.lists);
  const auto sees = [&](std::int32_t from, std::int32_t to) { return side_of_arc(from, to, place) < 0; };
  const auto distance = [&](std::int32_t from, std::int32_t to) {
    const Direction a = mesh_.direction(from), b = mesh_.direction(to);
    if (is_beyond(place, a, b)) return arc_length(place, a);
    if (is_beyond(place, b, a)) return arc_length(place, b);
    const Point n = cross(a.high, accurate_difference(b, a));
    return std::fabs(dot(n, accurate_difference(place, a))) / std::sqrt(square(n));
  };
  std::int32_t rightmost = first, nearest = 0;
  for (std::int32_t r; (r = reader.last_neighbour(rightmost)) != first && sees(r, rightmost);) rightmost = r;
  double least = std::numeric_limits<double>::infinity();
  std::int32_t r = rightmost;
  do {
    const std::int32_t l = reader.first_neighbour(r);
    const double d = distance(r, l);
    if (d < least || (d == least && r < nearest)) least = d, nearest = r;
    r = l;
  } while (r != rightmost && sees(r, reader.first_neighbour(r)));
  const std::int32_t slot = reader.first_slot(nearest);
  corners = {nearest, reader.neighbour(slot), reader.neighbour(reader.next(slot))};
}

/// The triangle that contains the place, from one at `near`; false if the place is outside. One that would be
/// inside if it were moved by kOnBorder and kRounding has the triangle at the nearest arc of the border.
bool Interpolation::find(const Direction& place, std::int32_t& near, Corners& corners,
                         bool& is_beyond_border) const {
  const Reader reader(mesh_.lists);
  if (near < 1 || near > reader.size()) near = 1;
  const std::int32_t slot = reader.first_slot(near);
  corners = {near, reader.neighbour(slot), reader.neighbour(reader.next(slot))};
  is_beyond_border = !cross_arcs(place, corners);
  near = corners[0];
  if (is_beyond_border) {
    if (first_boundary_node_ == 0) return false;
    const Point &p = place.high, inwards = minus(middle_, p);
    const double step = std::min(kOnBorder + kRounding / std::sqrt(square(inwards)), 0.5);
    const Direction moved =
        pstripack::direction_of({p.x + step * inwards.x, p.y + step * inwards.y, p.z + step * inwards.z});
    if (!cross_arcs(moved, corners)) return false;
    find_nearest_on_border(place, near, corners);
  }
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return true;
}

std::size_t Interpolation::corner_at(const Direction& place, const Corners& corners) const {
  std::size_t k = 0;
  while (k < 3 && !(square(minus(mesh_.unit_at(corners[k]), place.high)) < 0x1p-98 &&
                    pstripack::same_direction(at(corners[k]), place.given)))
    ++k;
  return k;
}

/// The weights of the corners of the triangle that contains the place.
void Interpolation::weigh(const Direction& place, const Corners& corners, double (&weights)[3]) const {
  if (const std::size_t node = corner_at(place, corners); node < 3) {
    for (std::size_t k = 0; k < 3; ++k) weights[k] = k == node ? 1 : 0;
    return;
  }
  const Direction at[] = {mesh_.direction(corners[0]), mesh_.direction(corners[1]),
                          mesh_.direction(corners[2])};
  barycentric_weights(place, {&at[0], &at[1], &at[2]}, weights);
}

/// The corners with weights as shares.
void Interpolation::take(const Corners& corners, const double (&weights)[3], std::vector<Share>& shares) {
  for (std::size_t k = 0; k < 3; ++k)
    if (weights[k] > 0) shares.push_back({corners[k], weights[k]});
  if (shares.size() == 2 && shares[0].node > shares[1].node)
    std::swap(shares[0], shares[1]);  // as in both triangles
}

bool Interpolation::barycentric(const Point& p, std::int32_t& near, Corners& corners,
                                double (&weights)[3]) const {
  const Direction place = pstripack::direction_of(p);
  bool is_beyond_border;
  if (!find(place, near, corners, is_beyond_border)) return false;
  weigh(place, corners, weights);
  return true;
}

bool Interpolation::linear(const Point& p, std::int32_t& near, std::vector<Share>& shares) const {
  shares.clear();
  Corners corners;
  double weights[3];
  if (!barycentric(p, near, corners, weights)) return false;
  take(corners, weights, shares);
  return true;
}

/// The triangles whose circumscribed caps contain a place, by exact signs, and their corners, the natural
/// neighbours. These are the faces of the nodes' hull that it sees, so they are connected and without a hole.
/// False in a mesh that is not that of the directions, if a node would come into the ring twice.
///
///          w          The triangle beyond the arc u->v, which has p on its left.
///        /   \        If p lies above it, w comes in between u and v.
///       v --- u
///          p
///
bool Interpolation::dig(const Direction& place, const Corners& corners, std::vector<std::int32_t>& nodes,
                        pstripack::Cavity& cavity) const {
  const Reader reader(mesh_.lists);
  const Direction* const known = directions();
  nodes.assign(corners.begin(), corners.end());
  cavity.nodes = {{known + corners[0], 1, 0}, {known + corners[1], 2, 0}, {known + corners[2], 0, 0}};
  cavity.triangles = {{0, 1, 2}};
  cavity.arcs.clear();
  bool is_round = false;
  for (std::uint32_t u = 0; !is_round;) {
    const std::uint32_t v = cavity.nodes[u].next;
    const std::int32_t slot = reader.slot_of(nodes[v], nodes[u]);
    const std::int32_t w = reader.entry(slot) < 0 ? 0 : reader.neighbour(reader.next(slot));
    if (w == 0 || !is_above(known[nodes[v]], known[nodes[u]], known[w], place)) {
      u = v;
      is_round = u == 0;
      continue;
    }
    if (std::find(nodes.begin(), nodes.end(), w) != nodes.end()) return false;
    const auto added = static_cast<std::uint32_t>(nodes.size()),
               triangle = static_cast<std::uint32_t>(cavity.triangles.size());
    nodes.push_back(w);
    cavity.arcs.push_back({u, v, cavity.nodes[u].triangle, triangle});
    cavity.triangles.push_back({u, added, v});
    cavity.nodes.push_back({known + w, v, triangle});
    cavity.nodes[u].next = added, cavity.nodes[u].triangle = triangle;
  }
  return true;
}

bool Interpolation::natural(const Point& p, std::int32_t& near, std::vector<Share>& shares) const {
  thread_local std::vector<std::int32_t> nodes;
  thread_local pstripack::Cavity cavity;
  shares.clear();
  const Direction place = pstripack::direction_of(p);
  Corners corners;
  bool is_beyond_border;
  if (!find(place, near, corners, is_beyond_border)) return false;
  if (is_beyond_border || corner_at(place, corners) < 3 || !dig(place, corners, nodes, cavity)) {
    double weights[3];
    weigh(place, corners, weights);
    take(corners, weights, shares);
    return true;
  }
  find_natural_weights(place, cavity);
  const auto first = static_cast<std::uint32_t>(std::min_element(nodes.begin(), nodes.end()) - nodes.begin());
  std::uint32_t node = first;
  do {
    if (cavity.weights[node] > 0) shares.push_back({nodes[node], cavity.weights[node]});
    node = cavity.nodes[node].next;
  } while (node != first);
  return true;
}

/// Steps to nearer neighbours until there is none. Nodes that are as near as this one are joined to it by
/// arcs between such nodes: the place is a corner of the Voronoi diagram, or lies on a side.
Candidate Interpolation::descend(const ByDistance& order, Candidate node) const {
  const Reader reader(mesh_.lists);
  bool has_rival = true;
  for (std::int32_t here = 0; here != node.node;) {
    here = node.node, has_rival = false;
    reader.for_each_neighbour(here, [&](std::int32_t neighbour) {
      const Candidate other = order.at(neighbour);
      if (order.is_farther(other, node)) return;
      if (order(other, node))
        node = other;
      else
        has_rival = true;
    });
  }
  if (!has_rival) return node;
  std::vector<Candidate> as_near{node};
  for (std::size_t i = 0; i < as_near.size(); ++i)
    reader.for_each_neighbour(as_near[i].node, [&](std::int32_t neighbour) {
      const Candidate other = order.at(neighbour);
      if (order.are_as_near(other, node) &&
          std::none_of(as_near.begin(), as_near.end(),
                       [&](const Candidate& c) { return c.node == neighbour; }))
        as_near.push_back(other);
    });
  return *std::min_element(as_near.begin(), as_near.end(), order);
}

// The segment from a node to p passes through cells of nearer and nearer nodes, each a neighbour of the
// previous one. Only if the nodes lie in a hemisphere can two boundary nodes be such neighbours without an
// arc in the lists. Their cells meet more than 90 degrees away from both, so a descent that begins less than
// 90 degrees from p ends in the nearest node. If any node is that near, a boundary node is, since every node
// is a sum of positive multiples of boundary nodes. For the same reason, if none is, the nearest node is a
// boundary node.
std::int32_t Interpolation::nearest(const Point& p, std::int32_t near) const {
  constexpr double kRightAngle = 2 - 1e-14;  // surely less than 90 degrees away
  const Reader reader(mesh_.lists);
  const ByDistance order(mesh_, p);
  Candidate node = descend(order, order.at(near >= 1 && near <= reader.size() ? near : 1));
  const std::int32_t border = first_boundary_node_;
  if (node.square < kRightAngle || border == 0) return node.node;
  std::int32_t round = border;
  do {
    if (const Candidate other = order.at(round); order(other, node)) node = other;
    round = reader.first_neighbour(round);
  } while (round != border);
  return descend(order, node).node;
}

void Interpolation::cubic_terms(const Point& p, std::vector<Share>& shares, std::vector<Point>& ways) const {
  const Direction place = pstripack::direction_of(p);
  const Direction* const known = directions();
  double inverse = 0, first = 0, second = 0;
  ways.clear();
  for (const auto& [node, part] : shares) {
    const Point d = accurate_difference(place, known[node]);
    const double distance_2 = dot(d, d), distance = std::sqrt(distance_2);
    inverse += part / distance;
    first += part * distance;
    second += part * distance_2;
    ways.push_back(d);
  }
  if (shares.size() == 1) {  // the place is the node
    ways[0] = {0, 0, 0};
    return;
  }
  const double alpha = first / inverse, of_means = alpha / (alpha + second),
               of_planes = second / (alpha + second);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    double& part = shares[k].part;
    Point& d = ways[k];
    const double on_plane = of_planes * (part / std::sqrt(dot(d, d)) / inverse);
    part = of_means * part + on_plane;
    d = {on_plane * d.x, on_plane * d.y, on_plane * d.z};
  }
}

void Interpolation::cubic_shares(const Point& p, const GradientTerms& gradients,
                                 std::vector<Share>& shares) const {
  if (shares.size() < 2) return;
  std::vector<Point> ways;
  cubic_terms(p, shares, ways);
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const std::int32_t node = shares[k].node;
    for (const GradientTerm& term : gradients[static_cast<std::size_t>(node) - 1]) {
      const double part = dot(ways[k], term.part);
      shares.push_back({term.node, part});
      shares.push_back({node, -part});
    }
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const Share& a, const Share& b) { return a.node < b.node; });
  std::size_t kept = 0;
  for (const Share& s : shares)
    if (kept > 0 && shares[kept - 1].node == s.node)
      shares[kept - 1].part += s.part;
    else
      shares[kept++] = s;
  shares.resize(kept);
}

template <class Use>
std::size_t Interpolation::for_each_place(const std::vector<Point>& places, Method method, Outside outside,
                                          const Use& use) const {
  const std::vector<std::uint32_t> order = along_a_curve(places);
  const std::size_t blocks = (places.size() + kBlock - 1) / kBlock;
  std::vector<std::size_t> count_outside(blocks);
  pstripack::ErrorsOfThreads errors(blocks);
  pstripack::parallel_for(blocks, 100 * places.size(), [&](std::size_t b) {
    errors.keep(b, [&] {
      std::int32_t near = 1;
      std::vector<Share> shares;
      for (std::size_t k = b * kBlock; k < std::min((b + 1) * kBlock, places.size()); ++k) {
        const Point& p = places[order[k]];
        bool is_inside = false;
        if (method != Method::nearest)
          is_inside = method == Method::linear ? linear(p, near, shares) : natural(p, near, shares);
        if (!is_inside) {
          shares.clear();
          if (method == Method::nearest || outside == Outside::nearest)
            shares.push_back({near = nearest(p, near), 1});
          if (method != Method::nearest) ++count_outside[b];
        }
        use(order[k], shares);
      }
    });
  });
  errors.rethrow();
  return std::accumulate(count_outside.begin(), count_outside.end(), std::size_t{0});
}

Interpolation::Result Interpolation::values_at(const std::vector<Point>& places,
                                               const std::vector<double>& values, Method method,
                                               Outside outside) const {
  Result result;
  result.values.resize(places.size());
  const std::vector<Point> slopes = method == Method::cubic ? gradients(mesh_, values) : std::vector<Point>();
  const auto value_of = [&](std::int32_t node) { return values[static_cast<std::size_t>(node) - 1]; };
  const auto value_at = [&](const Point& place, std::vector<Share>& shares) {
    if (shares.empty()) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0, low = value_of(shares[0].node), high = low;
    if (method == Method::cubic && shares.size() > 1) {
      std::vector<Point> ways;
      cubic_terms(place, shares, ways);
      for (std::size_t k = 0; k < shares.size(); ++k)
        sum += shares[k].part * value_of(shares[k].node) +
               dot(ways[k], slopes[static_cast<std::size_t>(shares[k].node) - 1]);
      return sum;
    }
    for (const Share& s : shares) {
      const double v = value_of(s.node);
      sum += s.part * v;
      low = std::min(low, v), high = std::max(high, v);
    }
    return std::clamp(sum, low, high);  // rounding may exceed the range
  };
  result.outside = for_each_place(places, method, outside, [&](std::size_t i, std::vector<Share>& shares) {
    result.values[i] = value_at(places[i], shares);
  });
  return result;
}

files::Weights Interpolation::weights_at(const std::vector<Point>& places, Method method,
                                         Outside outside) const {
  std::vector<std::vector<Share>> of_places(places.size());
  const GradientTerms gradients = method == Method::cubic ? gradient_terms(mesh_) : GradientTerms();
  files::Weights all;
  all.outside = for_each_place(places, method, outside, [&](std::size_t i, std::vector<Share>& shares) {
    if (method == Method::cubic) cubic_shares(places[i], gradients, shares);
    of_places[i] = shares;
  });
  all.begin.push_back(0);
  for (const std::vector<Share>& shares : of_places) {
    for (const Share& share : shares) all.node.push_back(share.node), all.part.push_back(share.part);
    all.begin.push_back(all.node.size());
  }
  return all;
}

}  // namespace methods
