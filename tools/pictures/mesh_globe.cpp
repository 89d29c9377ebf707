#include "pictures/mesh_globe.h"

#include <cmath>
#include <stdexcept>

#include "stripack/list_queries.h"

namespace pictures {
namespace {

/// The areas of the cells; NaN for those of boundary nodes, which share the rest of the sphere. None if the
/// triangles are not those of Delaunay, so that the cells do not make up the sphere.
std::vector<double> cell_areas(const files::Mesh& mesh, bool must_be_known) {
  std::vector<double> areas;
  try {
    areas = files::voronoi_faces(mesh, false).area;
  } catch (const files::NoMesh&) {
    if (must_be_known) throw;
    return {};
  }
  const pstripack::ListReader<std::int32_t> lists(mesh.lists());
  for (std::int32_t node = 1; node <= lists.size(); ++node)
    if (lists.on_boundary(node)) areas[static_cast<std::size_t>(node) - 1] = NAN;
  return areas;
}

}  // namespace

Globe mesh_globe(const files::Mesh& mesh, const MeshOptions& options) {
  Globe globe;
  globe.title = options.title;
  globe.cells = options.what == MeshOptions::What::cells;
  files::LonLat angles = files::angles_of(mesh.points, mesh.given, true);
  globe.lon = std::move(angles.lon), globe.lat = std::move(angles.lat);
  globe.triangles = files::triangles_of(mesh);
  for (std::int32_t& corner : globe.triangles) --corner;
  globe.areas = cell_areas(mesh, globe.cells);
  globe.shading = mesh_shading(mesh, options);
  if (options.colour == MeshOptions::Colour::value)
    if (const files::Column* const column = files::find(mesh.columns, options.value)) {
      globe.value_name = column->long_name.empty() ? column->name : column->long_name;
      globe.value_unit = column->units;
      globe.numbers = column->numbers;
      if (column->is_text()) globe.words = column->texts;
    }
  if (options.colour == MeshOptions::Colour::owner && globe.cells) {
    globe.value_name = "rank";
    globe.numbers.assign(globe.shading.of_face.begin(), globe.shading.of_face.end());
  }
  if (options.coasts || !options.coast_file.empty()) {
    globe.coasts =
        read_shapefile(options.coast_file.empty() ? natural_earth(kGlobeDetail) : options.coast_file);
  }
  if (options.centre) globe.centre = {options.centre->lon, options.centre->lat};
  globe.radius = options.radius;
  return globe;
}

}  // namespace pictures
