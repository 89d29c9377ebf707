#include "mesh/hidden_nodes.h"

#include <algorithm>
#include <cmath>

#include "mesh/delaunay.h"

namespace pstripack {
namespace {

constexpr std::size_t kMany = 4096, kPlaces = 16, kAround = 32;

// A node on the sphere between neighbours at the distances g and h rises above them by about g h / 2. Its
// closeness is g^2 h^2. Lengths that differ by less than this height hide nothing; how much they differ
// is estimated from a sample of nodes, and rounding is 2^-46 at most. Nodes in one cell of the curve are
// in any order: neighbours are looked for up to kReach places ahead, then up to kAside places to both
// sides.
constexpr std::size_t kReach = 3, kAside = 8;

double closeness_that_hides(const Point* nodes, std::size_t n) {
  double deviation = 0x1p-48;
  for (std::size_t v = 0; v < n; v += n / 1024 + 1)
    deviation = std::max(deviation, std::fabs(dot(nodes[v], nodes[v]) - 1));
  return 8 * deviation * (8 * deviation);
}

double square_between(const Point& a, const Point& b) {
  const Point d = minus(b, a);
  return dot(d, d);
}

double closeness_of(std::size_t v, const Point* nodes, std::size_t n, std::size_t first) {
  double least = 1, second = 1;
  for (std::size_t u = std::max(v, first + kAside) - kAside; u < std::min(v + kAside + 1, n); ++u) {
    const double square = square_between(nodes[u], nodes[v]);
    if (square == 0) continue;  // v itself, or in its place
    second = std::min(second, std::max(least, square));
    least = std::min(least, square);
  }
  return least * second;
}

/// A triangulation of at most 64 nodes, four of which are the corners of the whole set.
class SmallSet {
 public:
  SmallSet(const Point* whole, const HullNode (&corners)[4]) {
    for (const HullNode v : corners) add(whole[v]);
  }
  void add(const Point& p) {
    if (count_ < kMost) nodes_[count_++] = p;
  }
  /// Throws HiddenNode.
  void triangulate() {
    Face faces[2 * kMost];
    Plane planes[2 * kMost];
    HullCorner corner[kMost];
    const auto some = GrowingHull::make({kMost, nodes_, faces, planes, corner}, count_, Lengths::as_given);
    some->build(0);
    some->finish();
  }

 private:
  static constexpr std::size_t kMost = 64;
  Point nodes_[kMost];
  std::size_t count_ = 0;
};

}  // namespace

std::vector<std::size_t> closest_nodes(const Point* nodes, std::size_t n, std::size_t first) {
  if (n - first < kMany) return {};
  const double close = closeness_that_hides(nodes, n);
  struct Place {
    double closeness;
    std::size_t node;
  } closest[kPlaces];  // a heap, the least close in front
  std::fill(closest, closest + kPlaces, Place{close, 0});
  const auto closer = [](const Place& a, const Place& b) { return a.closeness < b.closeness; };
  for (std::size_t v = first; v + kReach < n; ++v) {
    double least = square_between(nodes[v], nodes[v + 1]);
    for (std::size_t k = 2; k <= kReach; ++k) least = std::min(least, square_between(nodes[v], nodes[v + k]));
    if (!(least * least < closest[0].closeness)) continue;
    const double closeness = closeness_of(v, nodes, n, first);
    if (!(closeness < closest[0].closeness)) continue;
    std::pop_heap(closest, closest + kPlaces, closer);
    closest[kPlaces - 1] = {closeness, v};
    std::push_heap(closest, closest + kPlaces, closer);
  }
  std::sort(closest, closest + kPlaces, closer);
  std::vector<std::size_t> found;
  for (const Place& p : closest)
    if (p.closeness < close) found.push_back(p.node);
  return found;
}

void triangulate_around(const std::vector<std::size_t>& closest, const Point* nodes, std::size_t n,
                        std::size_t first, const HullNode (&corners)[4]) {
  const auto around = [&](std::size_t v) {  // kAround successive nodes
    return nodes + std::min(std::max(v, first + kAround / 2) - kAround / 2, n - kAround);
  };
  for (const std::size_t v : closest) {
    SmallSet some(nodes, corners);
    std::for_each_n(around(v), kAround, [&](const Point& p) { some.add(p); });
    some.triangulate();
  }
}

}  // namespace pstripack
