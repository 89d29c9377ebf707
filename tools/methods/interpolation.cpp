#include "methods/interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel_for.h"
#include "files/measures.h"
#include "geometry/predicates.h"
#include "geometry/weights.h"
#include "methods/gradients.h"
#include "stripack/list_queries.h"
#include "stripack/search.h"

namespace methods {
namespace {

using pstripack::Direction;
using Reader = pstripack::ListReader<std::int32_t>;

constexpr double kOnBorder = 1e-12;  // of the distance to the middle of the nodes
constexpr double kRounding = 4e-16;  // of a place, in radians
/// Squared distances up to this are compared by differences of directions.
constexpr double kFar = 1e-6;

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

std::size_t blocks_of(std::size_t places) { return (places + kBlock - 1) / kBlock; }

/// Calls visit(block, first place, end) for each block, on several threads.
template <class Visit>
void for_each_block(std::size_t places, const Visit& visit) {
  pstripack::parallel_pieces(blocks_of(places), pstripack::threads_for(100 * places),
                             [&](std::size_t first, std::size_t last, int) {
                               for (std::size_t b = first; b < last; ++b)
                                 visit(b, b * kBlock, std::min((b + 1) * kBlock, places));
                             });
}

/// What geometry/weights.h takes.
pstripack::Corners pointers(const std::array<Direction, 3>& corner) {
  return {&corner[0], &corner[1], &corner[2]};
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
  std::call_once(known_->once, [&] { known_->directions = directions_of(mesh_); });
  return known_->directions.data() - 1;  // nodes count from 1
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
    const int side = pstripack::left(at(a), at(b), place.given);
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
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    ++k;
  }
  if (on_arc[0] != 0) {
    const std::int32_t slot = reader.slot_of(on_arc[1], on_arc[0]);
    if (const std::int32_t w = reader.neighbour(reader.next(slot)); reader.entry(slot) > 0 && w < on_arc[2])
      corners = {on_arc[1], on_arc[0], w};
  }
  return true;
}

/// A triangle near the place, the smallest corner first. True if the search says that it contains the place.
bool Interpolation::search(const Direction& place, std::int32_t& near, Corners& corners) const {
  double b1, b2, b3;
  const pstripack::Location<std::int32_t> found =
      pstripack::trfind(near, pstripack::Vector<double>{place.high.x, place.high.y, place.high.z},
                        mesh_.lists, mesh_.unit, b1, b2, b3);
  if (found.i1 != 0) near = found.i1;
  if (found.i3 != 0) {
    corners = {found.i1, found.i2, found.i3};
  } else {  // the last triangle of `near`, beside the border if there is one
    const Reader reader(mesh_.lists);
    std::int32_t slot = reader.first_slot(near), after = reader.next(slot);
    while (reader.next(after) != reader.first_slot(near)) slot = after, after = reader.next(after);
    corners = {near, reader.neighbour(slot), reader.neighbour(after)};
  }
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return found.i3 != 0;
}

/// The triangle that contains the place, from one near it; false if the place is outside. One within
/// kOnBorder of the border is moved inside.
bool Interpolation::settle(Direction& place, std::int32_t& near, Corners& corners) const {
  const auto is_inside = [&] {
    if (!cross_arcs(place, corners)) return false;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return true;
  };
  if (is_inside()) return true;
  if (first_boundary_node_ == 0) return false;
  const Point& p = place.high;
  const Point inwards = minus(middle_, p);
  const double step = std::min(kOnBorder + kRounding / std::sqrt(square(inwards)), 0.5);
  place = pstripack::direction_of({p.x + step * inwards.x, p.y + step * inwards.y, p.z + step * inwards.z});
  search(place, near, corners);
  return is_inside();
}

bool Interpolation::find(Direction& place, std::int32_t& near, Corners& corners) const {
  search(place, near, corners);
  return settle(place, near, corners);
}

/// True if the place is a corner, which then has the whole share.
bool Interpolation::is_node(const Direction& place, const Corners& corners,
                            std::vector<Share>& shares) const {
  for (const std::int32_t node : corners)
    if (square(minus(mesh_.unit_at(node), place.high)) < 0x1p-98 &&
        pstripack::same_direction(at(node), place.given)) {
      shares = {{node, 1}};
      return true;
    }
  return false;
}

std::array<Direction, 3> Interpolation::directions(const Corners& corners) const {
  return {mesh_.direction(corners[0]), mesh_.direction(corners[1]), mesh_.direction(corners[2])};
}

void Interpolation::linear(const Direction& place, const Corners& corners, std::vector<Share>& shares) const {
  double weights[3];
  const std::array<Direction, 3> at = directions(corners);
  barycentric_weights(place, pointers(at), weights);
  for (std::size_t k = 0; k < 3; ++k)
    if (weights[k] > 0) shares.push_back({corners[k], weights[k]});
  if (shares.size() == 2 && shares[0].node > shares[1].node)
    std::swap(shares[0], shares[1]);  // as in both triangles
}

bool Interpolation::linear(const Point& p, std::int32_t& near, std::vector<Share>& shares) const {
  shares.clear();
  Direction place = pstripack::direction_of(p);
  Corners corners;
  double weights[3];
  if (search(place, near, corners)) {
    const std::array<Direction, 3> at = directions(corners);
    if (find_ordinary_determinants(place, pointers(at), weights)) {
      pstripack::divide_by_sum(weights);
      shares = {{corners[0], weights[0]}, {corners[1], weights[1]}, {corners[2], weights[2]}};
      return true;
    }
  }
  if (!settle(place, near, corners)) return false;
  if (!is_node(place, corners, shares)) linear(place, corners, shares);
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
  Direction place = pstripack::direction_of(p);
  Corners corners;
  if (!find(place, near, corners)) return false;
  if (is_node(place, corners, shares)) return true;
  if (!dig(place, corners, nodes, cavity)) {
    linear(place, corners, shares);
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

/// Steps to nearer neighbours until there is none.
std::int32_t Interpolation::descend(const Direction& place, std::int32_t node) const {
  const Reader reader(mesh_.lists);
  const auto distance = [&](std::int32_t to) {  // squared
    const double rounded = square(minus(mesh_.unit_at(to), place.high));
    return rounded > kFar ? rounded : square(accurate_difference(mesh_.direction(to), place));
  };
  for (double best = distance(node);;) {
    const std::int32_t here = node;
    reader.for_each_neighbour(here, [&](std::int32_t neighbour) {
      if (const double d = distance(neighbour); d < best) best = d, node = neighbour;
    });
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
  const Direction place = pstripack::direction_of(p);
  std::int32_t node = descend(place, near >= 1 && near <= reader.size() ? near : 1);
  const std::int32_t border = first_boundary_node_;
  const auto cosine = [&](std::int32_t to) { return dot(mesh_.unit_at(to), place.high); };
  if (cosine(node) > 0 || border == 0) return node;
  std::int32_t round = border;
  do {
    if (cosine(round) > cosine(node)) node = round;
    round = reader.first_neighbour(round);
  } while (round != border);
  return descend(place, node);
}

double Interpolation::cubic_value(const Point& p, const std::vector<Share>& shares,
                                  const std::vector<double>& values,
                                  const std::vector<Point>& gradients) const {
  const Direction place = pstripack::direction_of(p);
  const Direction* const known = directions();
  double mean = 0, inverse = 0, tangent = 0, first = 0, second = 0;
  for (const auto& [node, part] : shares) {
    const auto i = static_cast<std::size_t>(node) - 1;
    if (part == 1) return values[i];  // the place is the node
    const Point d = accurate_difference(place, known[node]);
    const double distance_2 = dot(d, d), distance = std::sqrt(distance_2);
    mean += part * values[i];
    inverse += part / distance;
    tangent += part / distance * (values[i] + dot(gradients[i], d));
    first += part * distance;
    second += part * distance_2;
  }
  const double alpha = first / inverse;
  return (alpha * mean + second * (tangent / inverse)) / (alpha + second);
}

template <class Use>
std::size_t Interpolation::for_each_place(const std::vector<Point>& places, Method method, Outside outside,
                                          const Use& use) const {
  std::vector<std::size_t> count_outside(blocks_of(places.size()));
  for_each_block(places.size(), [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::int32_t near = 1;
    std::vector<Share> shares;
    for (std::size_t i = begin; i < end; ++i) {
      const Point& p = places[i];
      bool is_inside = false;
      if (method != Method::nearest)
        is_inside = method == Method::linear ? linear(p, near, shares) : natural(p, near, shares);
      if (!is_inside) {
        shares.clear();
        if (method == Method::nearest || outside == Outside::nearest)
          shares.push_back({near = nearest(p, near), 1});
        if (method != Method::nearest) ++count_outside[b];
      }
      use(i, shares);
    }
  });
  return std::accumulate(count_outside.begin(), count_outside.end(), std::size_t{0});
}

Interpolation::Result Interpolation::values_at(const std::vector<Point>& places,
                                               const std::vector<double>& values, Method method,
                                               Outside outside) const {
  Result result;
  result.values.resize(places.size());
  const std::vector<Point> slopes = method == Method::cubic ? gradients(mesh_, values) : std::vector<Point>();
  const auto value_of = [&](std::int32_t node) { return values[static_cast<std::size_t>(node) - 1]; };
  result.outside =
      for_each_place(places, method, outside, [&](std::size_t i, const std::vector<Share>& shares) {
        if (shares.empty()) {
          result.values[i] = std::numeric_limits<double>::quiet_NaN();
        } else if (method == Method::cubic) {
          result.values[i] = cubic_value(places[i], shares, values, slopes);
        } else {
          double sum = 0, low = value_of(shares[0].node), high = low;
          for (const Share& s : shares) {
            const double v = value_of(s.node);
            sum += s.part * v;
            low = std::min(low, v), high = std::max(high, v);
          }
          result.values[i] = std::clamp(sum, low, high);  // rounding may exceed the range
        }
      });
  return result;
}

files::Weights Interpolation::weights_at(const std::vector<Point>& places, Method method,
                                         Outside outside) const {
  files::Weights all;
  all.begin.resize(places.size() + 1);
  std::vector<files::Weights> parts(blocks_of(places.size()));
  all.outside = for_each_place(places, method, outside, [&](std::size_t i, const std::vector<Share>& shares) {
    files::Weights& part = parts[i / kBlock];
    for (const auto& [node, share] : shares) part.node.push_back(node), part.part.push_back(share);
    all.begin[i + 1] = shares.size();
  });
  for (std::size_t i = 0; i < places.size(); ++i) all.begin[i + 1] += all.begin[i];
  all.node.reserve(all.begin.back());
  all.part.reserve(all.begin.back());
  for (files::Weights& part : parts) {
    all.node.insert(all.node.end(), part.node.begin(), part.node.end());
    all.part.insert(all.part.end(), part.part.begin(), part.part.end());
    part = {};
  }
  return all;
}

Interpolation::Nearest Interpolation::nearest_at(const std::vector<Point>& places) const {
  Nearest found{std::vector<std::int32_t>(places.size()), std::vector<double>(places.size())};
  for_each_block(places.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    std::int32_t near = 1;
    for (std::size_t i = begin; i < end; ++i) {
      found.node[i] = near = nearest(places[i], near);
      found.distance[i] = arc_length(mesh_.direction(near), pstripack::direction_of(places[i]));
    }
  });
  return found;
}

}  // namespace methods
