#include "thesis/defects.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "capi/pstripack.h"
#include "mesh/validate.h"
#include "our_checks.h"
#include "parallel/cost.h"

namespace thesis {
namespace {

using pstripack::Coordinates;
using pstripack::index_t;

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Edge 3*t + i of triangle t lies opposite its corner i, from corner i+1 to corner i+2.
std::size_t next(std::size_t edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }
std::size_t previous(std::size_t edge) { return edge % 3 == 0 ? edge + 2 : edge - 1; }
index_t corner(const Triangles& triangles, std::size_t edge) { return triangles[edge / 3][edge % 3]; }

/// For each edge the same edge in its other triangle, or kNone.
struct Twins {
  std::vector<std::size_t> of;
  std::size_t boundary = 0, non_manifold = 0;
};

Twins find_twins(std::size_t n, const Triangles& triangles) {
  std::vector<std::size_t> begin(n + 1, 0), edges(3 * triangles.size());
  const auto start = [&](std::size_t edge) { return corner(triangles, next(edge)); };
  const auto end = [&](std::size_t edge) { return corner(triangles, previous(edge)); };
  for (std::size_t e = 0; e < edges.size(); ++e) ++begin[static_cast<std::size_t>(start(e)) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::size_t> at(begin.begin(), begin.end() - 1);
  for (std::size_t e = 0; e < edges.size(); ++e) edges[at[static_cast<std::size_t>(start(e))]++] = e;
  const auto find = [&](index_t from, index_t to, std::size_t& first) {
    std::size_t count = 0;
    const auto v = static_cast<std::size_t>(from);
    for (std::size_t k = begin[v]; k < begin[v + 1]; ++k)
      if (end(edges[k]) == to) first = edges[k], ++count;
    return count;
  };
  Twins twins{std::vector<std::size_t>(edges.size(), kNone)};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    std::size_t same = kNone, twin = kNone;
    const std::size_t on_this_side = find(start(e), end(e), same), beyond = find(end(e), start(e), twin);
    if (on_this_side == 1 && beyond == 1)
      twins.of[e] = twin;
    else if (on_this_side == 1 && beyond == 0)
      ++twins.boundary;
    else if (e == same && (beyond == 0 || start(e) < end(e)))
      ++twins.non_manifold;
  }
  return twins;
}

double area(const std::vector<Point>& points, const Triangles& triangles) {
  long double sum = 0;
  for (const auto& [i, j, k] : triangles) {
    const Point &a = points[static_cast<std::size_t>(i)], &b = points[static_cast<std::size_t>(j)],
                &c = points[static_cast<std::size_t>(k)];
    sum += 2 * std::atan2(dot(a, cross(minus(b, a), minus(c, a))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  }
  return static_cast<double>(sum);
}

/// Rounding of coordinates can move a node this far off the plane of cocircular nodes.
constexpr double kTie = 1e-14;

/// The height of d above the plane of a, b, c.
double height(const std::vector<Point>& points, index_t a, index_t b, index_t c, index_t d) {
  const auto from_a = [&](index_t v) {
    return minus(points[static_cast<std::size_t>(v)], points[static_cast<std::size_t>(a)]);
  };
  const Point normal = cross(from_a(b), from_a(c));
  return dot(normal, from_a(d)) / std::sqrt(dot(normal, normal));
}

}  // namespace

Triangles delaunay_triangles(const std::vector<Point>& points) {
  const std::size_t n = points.size();
  std::vector<double> x, y, z;
  for (const Point& p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  std::vector<std::int32_t> list(n < 3 ? 0 : 6 * n - 12), lptr(list.size()), lend(n);
  std::int32_t lnew = 0;
  const int ier = pstripack_trmesh(static_cast<std::int32_t>(n), x.data(), y.data(), z.data(), list.data(),
                                   lptr.data(), lend.data(), &lnew);
  const comparison::Checked checked = comparison::check(points, ier, list, lptr, lend, lnew);
  if (ier != 0 || !checked.verdict)
    throw std::runtime_error("these nodes have no triangulation: IER = " + std::to_string(ier) +
                             checked.verdict.message);
  return checked.triangles;
}

Expected expected(const std::vector<Point>& points) {
  const Triangles triangles = delaunay_triangles(points);
  return {triangles.size(), area(points, triangles)};
}

Defects find_defects(const std::vector<Point>& points, const Triangles& triangles, double expected_area) {
  const Coordinates predicates(points.data(), points.size());
  const Twins twins = find_twins(points.size(), triangles);
  Defects found;
  std::vector<bool> used(points.size(), false);
  for (const auto& [a, b, c] : triangles) {
    for (const index_t v : {a, b, c}) used[static_cast<std::size_t>(v)] = true;
    if (predicates.left(a, b, c) <= 0) ++found.inverted;
  }
  for (const bool u : used)
    if (!u) ++found.missing_nodes;
  found.boundary_arcs = twins.boundary;
  found.non_manifold_arcs = twins.non_manifold;
  for (std::size_t e = 0; e < twins.of.size(); ++e) {
    if (twins.of[e] == kNone || twins.of[e] < e) continue;
    const index_t a = corner(triangles, e), b = corner(triangles, next(e)),
                  c = corner(triangles, previous(e)), d = corner(triangles, twins.of[e]);
    if (!predicates.above(a, b, c, d)) continue;
    ++found.non_delaunay_arcs;
    if (height(points, a, b, c, d) < kTie) ++found.ties;
  }
  found.uncovered_area = expected_area - area(points, triangles);
  found.verdict =
      pstripack::is_valid(points.data(), points.size(), triangles.data(), triangles.size()).message;
  return found;
}

//          a                    a
//         / \                  /|\          Edge t, opposite a, and its twin u, opposite d, turn from b c
//        / t \                / | \         into a d. Corner c of the upper triangle becomes d, corner b of
//       b --- c      ->      b  |  c        the lower one a: two of the four outer edges keep their places.
//        \ u /                \ | /
//         \ /                  \|/          Flips cannot go on for ever: each lifts the surface towards the
//          d                    d           hull of the nodes, and there are finitely many surfaces.
//
Repair repair(const std::vector<Point>& points, Triangles& triangles) {
  const double start = pstripack::clock_seconds(CLOCK_THREAD_CPUTIME_ID);
  const Coordinates predicates(points.data(), points.size());
  std::vector<std::size_t> twin = find_twins(points.size(), triangles).of;
  const auto link = [&](std::size_t e, std::size_t f) {
    twin[e] = f;
    if (f != kNone) twin[f] = e;
  };
  const auto is_delaunay = [&](std::size_t e) {
    return twin[e] == kNone || !predicates.above(corner(triangles, e), corner(triangles, next(e)),
                                                 corner(triangles, previous(e)), corner(triangles, twin[e]));
  };
  Repair done;
  std::vector<std::size_t> suspects(twin.size());
  std::iota(suspects.begin(), suspects.end(), 0);
  while (!suspects.empty()) {
    const std::size_t t = suspects.back(), u = twin[t];
    suspects.pop_back();
    if (is_delaunay(t)) continue;
    const index_t a = corner(triangles, t), b = corner(triangles, next(t)),
                  c = corner(triangles, previous(t)), d = corner(triangles, u);
    if (predicates.left(a, b, d) <= 0 || predicates.left(d, c, a) <= 0) continue;
    triangles[t / 3][previous(t) % 3] = d;
    triangles[u / 3][previous(u) % 3] = a;
    const std::size_t across_ca = twin[next(t)], across_bd = twin[next(u)];
    link(t, across_bd);
    link(u, across_ca);
    link(next(t), next(u));
    ++done.flips;
    for (const std::size_t e : {t, u, previous(t), previous(u)}) suspects.push_back(e);
  }
  for (std::size_t e = 0; e < twin.size(); ++e)
    if (twin[e] != kNone && e < twin[e] && !is_delaunay(e)) ++done.stuck;
  done.cpu_seconds = pstripack::clock_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
  return done;
}

}  // namespace thesis
