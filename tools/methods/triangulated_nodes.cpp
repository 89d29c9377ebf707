#include "methods/triangulated_nodes.h"

#include <algorithm>
#include <memory>

#include "files/measures.h"

namespace methods {
namespace {

std::vector<Point> directions(const std::vector<Point>& points) {
  std::vector<Point> result(points.size());
  std::transform(points.begin(), points.end(), result.begin(), [](const Point& p) { return files::unit(p); });
  return result;
}

}  // namespace

TriangulatedNodes::TriangulatedNodes(const std::vector<Point>& nodes)
    : mesh_(files::triangulate(directions(nodes))) {
  for (const Point& p : mesh_.points) x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z);
}

Interpolation interpolation_between(const std::vector<Point>& nodes) {
  const auto owner = std::make_shared<const TriangulatedNodes>(nodes);
  return Interpolation(owner->view(), owner);
}

}  // namespace methods
