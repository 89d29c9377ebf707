#include "methods/triangulated_nodes.h"

#include <algorithm>
#include <memory>

#include "files/measures.h"
#include "files/mesh.h"

namespace methods {
namespace {

struct Columns {
  void add(const Point& p) { x.push_back(p.x), y.push_back(p.y), z.push_back(p.z); }
  pstripack::Nodes<double> view() const { return {x.data(), y.data(), z.data()}; }
  std::vector<double> x, y, z;
};

struct TriangulatedNodes {
  files::Mesh mesh;
  Columns given, unit;  ///< unit: empty if the nodes are unit vectors
};

}  // namespace

Interpolation interpolation_between(const std::vector<Point>& nodes) {
  const auto owner = std::make_shared<TriangulatedNodes>();
  auto& [mesh, given, unit] = *owner;
  mesh = files::triangulate(nodes);
  for (const Point& p : nodes) given.add(p);
  if (!std::all_of(nodes.begin(), nodes.end(), pstripack::length_is_one_up_to_rounding))
    for (const Point& p : nodes) unit.add(files::unit(p));
  return Interpolation({mesh.lists(), given.view(), unit.x.empty() ? given.view() : unit.view()}, owner);
}

}  // namespace methods
