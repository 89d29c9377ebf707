#pragma once

#include <vector>

#include "files/mesh.h"
#include "methods/interpolation.h"
#include "methods/triangulated.h"

namespace methods {

/// The triangulation of the directions of nodes.
class TriangulatedNodes {
 public:
  /// Throws files::NoMesh with indices into `nodes`.
  explicit TriangulatedNodes(const std::vector<Point>& nodes);

  Triangulated view() const {
    return {mesh_.lists(), given_.view(), unit_.x.empty() ? given_.view() : unit_.view()};
  }

 private:
  struct Columns {
    void add(const Point& p) { x.push_back(p.x), y.push_back(p.y), z.push_back(p.z); }
    pstripack::Nodes<double> view() const { return {x.data(), y.data(), z.data()}; }
    std::vector<double> x, y, z;
  };
  files::Mesh mesh_;
  Columns given_, unit_;  ///< unit_: empty if the nodes are unit vectors
};

/// Throws files::NoMesh with indices into `nodes`.
Interpolation interpolation_between(const std::vector<Point>& nodes);

}  // namespace methods
