#include "thesis/stripe.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <tuple>

namespace thesis {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kRoot = 3;  // the first three vertices of a DelaunayTree are huge

/// The vertices around the triangles to be removed, counterclockwise around the remaining ones. A vertex that
/// alone connects two parts of these occurs twice. Empty if the triangles to be removed are not in one piece.
///
///       h ----- h         Triangles with both kinds of corners, h huge, form a ring. The walk leaves each
///      / \     / \        triangle by the edge that leads, counterclockwise, from its h to a real corner:
///     /   \   /   \       from c to b, in the second triangle still b, then to a.
///    a --- b ----- c
///
Chain outline(const DelaunayTree& tree) {
  const auto& history = tree.history();
  const auto is_mixed = [&](const Tri& t) {
    const auto huge = std::count_if(t.vertex.begin(), t.vertex.end(), DelaunayTree::is_huge);
    return huge == 1 || huge == 2;
  };
  index_t start = kNone;
  std::size_t mixed = 0;
  for (index_t t = 0; static_cast<std::size_t>(t) < history.size(); ++t)
    if (tree.is_current(t) && is_mixed(history[static_cast<std::size_t>(t)])) start = t, ++mixed;
  Chain around;
  if (start == kNone) return around;
  index_t t = start;
  do {
    const auto& [vertex, neighbour] = history[static_cast<std::size_t>(t)];
    std::size_t h = 0;
    while (!DelaunayTree::is_huge(vertex[h]) || DelaunayTree::is_huge(vertex[(h + 1) % 3])) ++h;
    const index_t a = vertex[(h + 1) % 3];
    if (around.empty() || around.back() != a) around.push_back(a);
    t = neighbour[(h + 2) % 3];
  } while (--mixed > 0 && t != start);
  if (mixed > 0) return {};
  if (around.size() > 1 && around.front() == around.back()) around.pop_back();
  return around;
}

/// Cuts the outline at its southernmost and northernmost vertices, or at the ends of a row of them.
void cut_into_sides(const Chain& around, const std::vector<Point>& points, double longitude, Stripe& stripe) {
  const Point east{-std::sin(longitude), std::cos(longitude), 0};
  const auto end = [&](double north, double side) {
    const auto key = [&](index_t v) {
      const Point& p = points[static_cast<std::size_t>(v)];
      return std::make_tuple(north * p.z, side * dot(east, p));
    };
    return static_cast<std::size_t>(std::max_element(around.begin(), around.end(),
                                                     [&](index_t v, index_t w) { return key(v) < key(w); }) -
                                    around.begin());
  };
  const auto walk = [&](std::size_t from, std::size_t to) {
    Chain chain{around[from]};
    while (from != to) chain.push_back(around[from = (from + 1) % around.size()]);
    return chain;
  };
  stripe.right = walk(end(-1, 1), end(1, 1));
  stripe.left = walk(end(1, -1), end(-1, -1));
  std::reverse(stripe.left.begin(), stripe.left.end());
}

}  // namespace

int stripe_of(const Point& p, int count) {
  double longitude = std::atan2(p.y, p.x);
  if (longitude < 0) longitude += 2 * kPi;
  return std::min(static_cast<int>(longitude / (2 * kPi / count)), count - 1);
}

double middle(int k, int count) { return (k + 0.5) * (2 * kPi / count); }

std::array<Point, 3> huge_vertices(double longitude) {
  constexpr double kTilt = 0.1, kTurn = -0.1;
  const Point middle{std::cos(longitude), std::sin(longitude), 0}, east{-middle.y, middle.x, 0};
  const Point up{-std::sin(kTilt) * middle.x, -std::sin(kTilt) * middle.y, std::cos(kTilt)};
  const auto at = [&](double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return Point{c * east.x + s * up.x, c * east.y + s * up.y, s * up.z};
  };
  return {at(kTurn), at(kTurn + 2 * kPi / 3), at(kTurn + 4 * kPi / 3)};
}

Nodes pick(const std::vector<Point>& points, int k, int count) {
  Nodes nodes;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (stripe_of(points[i], count) == k) nodes.push_back(static_cast<index_t>(i));
  return nodes;
}

Stripe triangulate(const std::vector<Point>& points, const Nodes& nodes, double longitude) {
  Stripe stripe;
  try {
    const std::array<Point, 3> huge = huge_vertices(longitude);
    DelaunayTree tree(huge[0], huge[1], huge[2]);
    for (const index_t i : nodes) tree.insert(points[static_cast<std::size_t>(i)]);
    const auto node = [&](index_t v) { return nodes[static_cast<std::size_t>(v) - kRoot]; };
    for (index_t t = 0; static_cast<std::size_t>(t) < tree.history().size(); ++t) {
      const auto [a, b, c] = tree.history()[static_cast<std::size_t>(t)].vertex;
      if (tree.is_current(t) && !DelaunayTree::is_huge(a) && !DelaunayTree::is_huge(b) &&
          !DelaunayTree::is_huge(c))
        stripe.triangles.push_back({node(a), node(b), node(c)});
    }
    Chain around = outline(tree);
    for (index_t& v : around) v = node(v);
    if (!around.empty()) cut_into_sides(around, points, longitude, stripe);
  } catch (const std::exception& failure) {
    stripe.failure = failure.what();
  }
  return stripe;
}

}  // namespace thesis
