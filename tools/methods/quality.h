#pragma once
// How regular a mesh of the whole sphere is.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "files/mesh.h"

namespace methods {

struct Quality {
  static constexpr int kMostSides = 9;
  std::array<std::size_t, kMostSides + 1>
      cells{};  ///< by number of sides; the last entry counts all larger ones
  double smallest_angle = 180, largest_angle = 0;  ///< of a triangle, in degrees
  double largest_ratio = 0;                        ///< largest ratio of the areas of two neighbouring cells
  std::int64_t obtuse = 0;      ///< triangles that do not hold their circumcentre strictly: exact
  files::Point place{0, 0, 0};  ///< a node of the first of these

  /// "cells by sides: 5: 12, 6: 630; angles 52.6 to 75.9 degrees; ..."
  std::string text() const;
};

/// Of the mesh, or of the limited area in it. Throws files::NoMesh if the nodes lie in a hemisphere. Nodes
/// are vectors of any length.
Quality quality_of(const files::Mesh& mesh);

}  // namespace methods
