#include "methods/triangulated_nodes.h"

#include <algorithm>
#include <memory>

#include "files/measures.h"

namespace methods {

TriangulatedNodes::TriangulatedNodes(const std::vector<Point>& nodes) : mesh_(files::triangulate(nodes)) {
  for (const Point& p : nodes) given_.add(p);
  if (std::all_of(nodes.begin(), nodes.end(), pstripack::length_is_one_up_to_rounding)) return;
  for (const Point& p : nodes) unit_.add(files::unit(p));
}

Interpolation interpolation_between(const std::vector<Point>& nodes) {
  const auto owner = std::make_shared<const TriangulatedNodes>(nodes);
  return Interpolation(owner->view(), owner);
}

}  // namespace methods
