#pragma once
// Pictures of a triangulation or of its Voronoi cells.

#include <optional>
#include <string>

#include "files/mesh.h"
#include "parallel/partition.h"
#include "pictures/globe.h"
#include "pictures/view.h"

namespace pictures {

struct MeshOptions {
  enum class What { triangles, cells } what = What::triangles;

  bool lonlat = false;           ///< longitude-latitude map; else orthographic
  std::optional<Spot> centre;    ///< none: the centre of the nodes, or a default if they cover the sphere
  std::optional<double> radius;  ///< in degrees; none: show all nodes
  std::optional<files::Region> region;  ///< show this map instead

  enum class Colour { none, size, degree, owner, value } colour = Colour::none;
  int ranks = 1;  ///< number of ranks, for Colour::owner
  pstripack::PartitionKind partition = pstripack::PartitionKind::bisection;

  std::string value;  ///< name of a column of the mesh, for Colour::value
  Range range;        ///< ends of the colour bar; none: those of the values

  bool dots = false;  ///< draw all nodes as dots

  bool coasts = false;     ///< draw Natural Earth's coast lines
  std::string coast_file;  ///< draw the lines of this shapefile instead
  std::string title;
  double width = 800;  ///< in pixels
};

/// More nodes in view are refused: lines would be closer than pixels and files too large for viewers.
constexpr std::size_t kMostNodesInView = 200000;

/// The picture as SVG. Throws std::runtime_error if too many nodes are in view, or if coast lines or a column
/// are missing.
std::string mesh_picture(const files::Mesh& mesh, const MeshOptions& options);

/// The mesh as a globe, without `lonlat`, `dots` and `width`. Throws as mesh_picture.
Globe mesh_globe(const files::Mesh& mesh, const MeshOptions& options);

}  // namespace pictures
