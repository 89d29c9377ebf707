#pragma once
// How regular a mesh of the whole sphere is.

#include <array>
#include <cstddef>
#include <string>

#include "files/mesh.h"
#include "scvt/spread.h"

namespace methods {

struct Quality {
  static constexpr int kMostSides = 9;
  std::array<std::size_t, kMostSides + 1>
      cells{};                ///< by number of sides; the last entry counts all larger ones
  double smallest_angle = 0;  ///< of a triangle, in degrees
  double largest_ratio = 0;   ///< largest ratio of the areas of two neighbouring cells
  double well_centred = 0;    ///< share of the triangles that hold their circumcentre

  /// "5 sides: 12, 6: 630; smallest angle 52.6 degrees; ..."
  std::string text() const;
};

/// Throws files::NoMesh if the nodes lie in a hemisphere. Nodes are vectors of any length.
Quality quality_of(const files::Mesh& mesh);

/// The quality of the mesh of all ranks. Each rank has one of equal slices of the nodes (slice_of in
/// scvt/run.h). Any number of ranks gives the same bits. Collective. Throws AgreedFailure.
Quality quality_of(pstripack::Communicator& ranks, const pstripack::scvt::Neighbourhood& nodes);

}  // namespace methods
