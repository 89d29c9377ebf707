#include "thesis/delaunay_tree.h"

#include <algorithm>
#include <limits>
#include <string>

namespace thesis {

DelaunayTree::DelaunayTree(const Point& a, const Point& b, const Point& c) : points_{a, b, c} {
  add({{0, 1, 2}, {1, 1, 1}});
  add({{0, 2, 1}, {0, 0, 0}});
}

void DelaunayTree::insert(const Point& p) {
  // 2.4 GB: fail here rather than be killed by the system.
  constexpr std::size_t kMostTriangles = std::size_t{1} << 26;
  if (history_.size() > kMostTriangles) throw Failure("the history has grown to 2^26 triangles");
  const index_t t = locate(p);
  const auto v = static_cast<index_t>(points_.size());
  points_.push_back(p);
  split(t, v);
  legalize(v);
}

// As printed: go down the history into the child that contains p. If p lies on a new edge, rounding can
// exclude it from every child; then, which is not in the thesis, go into the child that p is least outside
// of.
index_t DelaunayTree::locate(const Point& p) {
  index_t t = depth_inside(0, p) >= 0 ? 0 : 1;
  while (!is_current(t)) {
    index_t next = kNone;
    double deepest = -std::numeric_limits<double>::infinity();
    for (const index_t child : children(t)) {
      const double depth = child == kNone ? deepest : depth_inside(child, p);
      if (depth > deepest) next = child, deepest = depth;
      if (depth >= 0) break;
    }
    if (next == kNone)
      throw Failure("no triangle of the history contains point " + std::to_string(points_.size() - 2));
    t = next;
  }
  return t;
}

double DelaunayTree::depth_inside(index_t t, const Point& p) const {
  const auto& [a, b, c] = tri(t).vertex;
  return std::min(
      {leftness(p, point(a), point(b)), leftness(p, point(b), point(c)), leftness(p, point(c), point(a))});
}

// Three triangles take the place of t.
//
//               a                          a
//              / \                        /|\                                                      .
//             /   \          ->          / | \                                                     .
//            /  t  \                    / .p. \                                                    .
//           b ----- c                  b ----- c
//
void DelaunayTree::split(index_t t, index_t p) {
  const auto [vertex, neighbour] = tri(t);
  const auto first = static_cast<index_t>(history_.size());
  for (index_t i = 0; i < 3; ++i) {
    // Neighbours of (p, b, c): opposite p that of t opposite a, opposite b the new (p, c, a), opposite c (p,
    // a, b).
    const std::size_t b = (i + 1) % 3, c = (i + 2) % 3;
    add({{p, vertex[b], vertex[c]},
         {neighbour[static_cast<std::size_t>(i)], first + (i + 1) % 3, first + (i + 2) % 3}});
    set_neighbour(neighbour[static_cast<std::size_t>(i)], vertex[b], vertex[c], first + i);
    suspects_.push_back(first + i);
  }
  children(t) = {first, first + 1, first + 2};
}

// Flips until no point lies in the circle of a triangle opposite the new point.
void DelaunayTree::legalize(index_t p) {
  // Each flip adds an edge from p to another vertex, so there are fewer flips than vertices.
  std::size_t flips_left = points_.size();
  while (!suspects_.empty()) {
    const index_t t = suspects_.back();
    suspects_.pop_back();
    const auto [v, n] = tri(t);
    const index_t opposite = n[0];
    if (tri(opposite).vertex[corner_off(opposite, v[1], v[2])] == p) continue;  // on its own circle
    if (!is_inside(point(p), circle_of(opposite))) continue;
    if (flips_left-- == 0)
      throw Failure("rounding: the flips around point " + std::to_string(p - 2) + " do not end");
    flip(t, opposite);
  }
}

// Two triangles at p take the place of t and the one opposite p.
//
//             p                     p
//            / \                   /|\                                                             .
//           / t \                 / | \                                                            .
//          b --- c      ->       b  |  c
//           \   /                 \ | /
//            \ /                   \|/
//             d                     d
//
void DelaunayTree::flip(index_t t, index_t opposite) {
  const auto [v, n] = tri(t);
  const Tri o = tri(opposite);
  const index_t p = v[0], b = v[1], c = v[2];
  const std::size_t k = corner_off(opposite, b, c);  // index of corner d in the opposite triangle (d, c, b)
  const index_t d = o.vertex[k], across_bd = o.neighbour[(k + 1) % 3], across_dc = o.neighbour[(k + 2) % 3];
  const auto left = static_cast<index_t>(history_.size()), right = left + 1;
  add({{p, b, d}, {across_bd, right, n[2]}});
  add({{p, d, c}, {across_dc, n[1], left}});
  set_neighbour(across_bd, b, d, left);
  set_neighbour(n[2], p, b, left);
  set_neighbour(across_dc, d, c, right);
  set_neighbour(n[1], c, p, right);
  children(t) = children(opposite) = {left, right, kNone};
  suspects_.push_back(left);
  suspects_.push_back(right);
}

Circle DelaunayTree::circle_of(index_t t) const {
  const auto& [a, b, c] = tri(t).vertex;
  return circumcircle(point(a), point(b), point(c));
}

index_t DelaunayTree::add(const Tri& tri) {
  history_.push_back(tri);
  child_.push_back({kNone, kNone, kNone});
  return static_cast<index_t>(history_.size() - 1);
}

std::size_t DelaunayTree::corner_off(index_t t, index_t b, index_t c) const {
  const auto& v = tri(t).vertex;
  std::size_t k = 0;
  while (k < 2 && (v[k] == b || v[k] == c)) ++k;
  return k;
}

void DelaunayTree::set_neighbour(index_t t, index_t b, index_t c, index_t neighbour) {
  tri(t).neighbour[corner_off(t, b, c)] = neighbour;
}

}  // namespace thesis
