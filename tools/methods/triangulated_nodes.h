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

  Triangulated view() const { return {mesh_.lists(), {x_.data(), y_.data(), z_.data()}}; }

 private:
  files::Mesh mesh_;
  std::vector<double> x_, y_, z_;
};

/// Throws files::NoMesh with indices into `nodes`.
Interpolation interpolation_between(const std::vector<Point>& nodes);

}  // namespace methods
