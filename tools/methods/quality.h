#pragma once
// How regular a mesh of the whole sphere is, as a model that computes on it sees it.

#include <array>
#include <cstddef>
#include <string>

#include "files/mesh.h"
#include "scvt/spread.h"

namespace methods {

struct Quality {
  static constexpr int kMostSides = 9;
  std::array<std::size_t, kMostSides + 1> cells{};  ///< by their number of sides; the last: or more
  double smallest_angle = 0;                        ///< of a triangle, in degrees
  double largest_ratio = 0;  ///< of the areas of two neighbouring cells, the larger over the smaller
  double well_centred = 0;   ///< the share of the triangles that hold their circumcentre

  /// "5 sides: 12, 6: 630; smallest angle 52.6 degrees; ..."
  std::string text() const;
};

/// Throws files::NoMesh if the nodes lie in a hemisphere. Nodes are unit vectors.
Quality quality_of(const files::Mesh& mesh);

/// Of the nodes of all ranks, of which each has one of equal slices (scvt/run.h, slice_of). Same bits for any
/// number of ranks. Collective. Throws AgreedFailure.
Quality quality_of(pstripack::Communicator& ranks, const pstripack::scvt::Neighbourhood& nodes);

}  // namespace methods
