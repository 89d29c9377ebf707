#pragma once
// A triangulation or its Voronoi cells, drawn.

#include <optional>
#include <string>

#include "files/mesh.h"
#include "parallel/partition.h"
#include "pictures/view.h"

namespace pictures {

struct MeshOptions {
  enum class What { triangles, cells } what = What::triangles;

  bool lonlat = false;           ///< or else orthographic
  std::optional<Spot> centre;    ///< none: the middle of the nodes, where they do not cover the sphere
  std::optional<double> radius;  ///< degrees; none: all nodes

  enum class Colour { none, size, degree, owner, value } colour = Colour::none;
  int ranks = 1;  ///< of Colour::owner
  pstripack::PartitionKind partition = pstripack::PartitionKind::bisection;

  std::string value;  ///< of Colour::value: the name of a column of the mesh

  bool coasts = false;     ///< those of Natural Earth
  std::string coast_file;  ///< or of this shapefile
  std::string title;
  double width = 800;  ///< pixels
};

/// More nodes than this are refused: lines would be closer than pixels, and files too large for viewers.
constexpr std::size_t kMostNodesInView = 200000;

/// As SVG. Throws std::runtime_error where too many nodes are in view, or coast lines or a column are
/// missing.
std::string mesh_picture(const files::Mesh& mesh, const MeshOptions& options);

}  // namespace pictures
