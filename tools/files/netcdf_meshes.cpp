// Writers of NetCDF: UGRID, SCRIP, ESMF, and nodes alone.

#include <utility>

#include "files/map_rings.h"
#include "files/measures.h"
#include "files/netcdf_writer.h"
#include "files/writers.h"

namespace files {
namespace {

/// A table with one row per face, as wide as the largest face: entry(slot of faces.corner) for its corners,
/// then `rest(last entry)`.
template <class T, class Entry, class Rest>
std::vector<T> padded(const Faces& faces, std::size_t width, const Entry& entry, const Rest& rest) {
  std::vector<T> table;
  table.reserve(faces.size() * width);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t k = faces.begin[f]; k < faces.begin[f + 1]; ++k) table.push_back(entry(k));
    table.resize((f + 1) * width, rest(table.back()));
  }
  return table;
}

}  // namespace

void write_ugrid(const OutputFile& file, const Faces& faces, const std::vector<Point>& vectors,
                 const std::vector<double>& density, const Notes& notes) {
  constexpr std::int32_t kNone = -1;
  const std::size_t width = faces.most_corners();
  const bool has_centres = !faces.centres.empty();
  NetcdfWriter out(file);
  const int nodes = out.dimension("mesh_nodes", faces.points.size(), faces.share_of_points);
  const int n_faces = out.dimension("mesh_faces", faces.size(), faces.share_of_faces);
  const int corners = out.dimension("mesh_face_corners", width);
  const int mesh = out.variable("mesh", NC_INT, {});
  out.attribute(NC_GLOBAL, "Conventions", "CF-1.8 UGRID-1.0");
  out.attribute(mesh, "cf_role", "mesh_topology");
  out.attribute(mesh, "topology_dimension", 2);
  out.attribute(mesh, "node_coordinates", "mesh_node_lon mesh_node_lat");
  out.attribute(mesh, "face_node_connectivity", "mesh_face_nodes");
  if (has_centres) out.attribute(mesh, "face_coordinates", "mesh_face_lon mesh_face_lat");
  out.attribute(mesh, "face_dimension", "mesh_faces");
  const int connectivity = out.variable("mesh_face_nodes", NC_INT, {n_faces, corners});
  out.attribute(connectivity, "cf_role", "face_node_connectivity");
  out.attribute(connectivity, "start_index", 1);
  out.attribute(connectivity, "_FillValue", kNone);
  int edge_nodes = -1, edge_faces = -1, face_edges = -1;
  Edges edges;
  if (faces.with_edges) {
    edges = edges_of(faces);
    const int n_edges = out.dimension("mesh_edges", edges.nodes.size() / 2),
              two = out.dimension("mesh_two", 2);
    const auto indices = [&](const std::string& role, const std::vector<int>& dimensions) {
      const std::string name = "mesh_" + role.substr(0, 4) + "_" + role.substr(5, 4) + "s";
      const int id = out.variable(name.c_str(), NC_INT, dimensions);
      out.attribute(mesh, role.c_str(), name);
      out.attribute(id, "cf_role", role);
      out.attribute(id, "start_index", 1);
      out.attribute(id, "_FillValue", kNone);
      return id;
    };
    out.attribute(mesh, "edge_dimension", "mesh_edges");
    edge_nodes = indices("edge_node_connectivity", {n_edges, two});
    edge_faces = indices("edge_face_connectivity", {n_edges, two});
    face_edges = indices("face_edge_connectivity", {n_faces, corners});
  }
  out.attributes(notes);
  const auto [node_lon, node_lat] = out.lon_lat("mesh_node_lon", "mesh_node_lat", {nodes}, {nodes});
  const auto [face_lon, face_lat] =
      has_centres ? out.lon_lat("mesh_face_lon", "mesh_face_lat", {n_faces}, {n_faces}) : std::pair(-1, -1);
  const int x = out.variable("mesh_node_x", NC_DOUBLE, {nodes});
  const int y = out.variable("mesh_node_y", NC_DOUBLE, {nodes});
  const int z = out.variable("mesh_node_z", NC_DOUBLE, {nodes});
  for (const int component : {x, y, z})
    out.attribute(component, "long_name", "Cartesian coordinate of the node as it was given");
  const int of_density = out.density(density, nodes);
  const Notes of_nodes{
      {"mesh", "mesh"}, {"location", "node"}, {"coordinates", "mesh_node_lon mesh_node_lat"}};
  Notes of_faces{{"mesh", "mesh"}, {"location", "face"}};
  if (has_centres) of_faces["coordinates"] = "mesh_face_lon mesh_face_lat";
  if (!density.empty())
    for (const auto& [name, text] : of_nodes) out.attribute(of_density, name.c_str(), text);
  const std::vector<int> node_columns = out.columns(faces.columns_of_points, {nodes}, of_nodes),
                         face_columns = out.columns(faces.columns_of_faces, {n_faces}, of_faces);
  out.end_definitions();

  out.put(mesh, std::vector<std::int32_t>{0});
  const LonLat node_angles = angles_of(faces.points, faces.given_points, true);
  out.put(node_lon, node_angles.lon);
  out.put(node_lat, node_angles.lat);
  if (has_centres) {
    const LonLat face_angles = angles_of(faces.centres, faces.given_centres, true);
    out.put(face_lon, face_angles.lon);
    out.put(face_lat, face_angles.lat);
  }
  out.put(x, y, z, vectors);
  if (!density.empty()) out.put(of_density, density);
  out.put(node_columns, faces.columns_of_points);
  out.put(face_columns, faces.columns_of_faces);
  const auto put_padded = [&](int variable, const std::vector<std::int32_t>& values) {
    if (values.size() == faces.size() * width) return out.put(variable, values);
    out.put(variable,
            padded<std::int32_t>(
                faces, width, [&](std::size_t k) { return values[k]; }, [](std::int32_t) { return kNone; }));
  };
  put_padded(connectivity, faces.corner);
  if (faces.with_edges) {
    out.put(edge_nodes, edges.nodes);
    out.put(edge_faces, edges.faces);
    put_padded(face_edges, edges.of_faces);
  }
  out.close();
}

namespace {

/// Faces::begin and Faces::corner without corners that rounding alone keeps apart from the one before:
/// remapping programs stumble over such sides. A face with fewer than three others keeps all.
Faces without_short_sides(const Faces& faces) {
  const std::vector<std::int32_t> merged = merged_corners(faces);
  Faces kept;
  kept.begin.push_back(0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::size_t first = kept.begin.back();
    for (std::size_t k = faces.begin[f]; k < faces.begin[f + 1]; ++k)
      if (merged[k] != merged[k == faces.begin[f] ? faces.begin[f + 1] - 1 : k - 1])
        kept.corner.push_back(merged[k]);
    if (kept.corner.size() < first + 3) {
      kept.corner.resize(first);
      for (std::size_t k = faces.begin[f]; k < faces.begin[f + 1]; ++k)
        kept.corner.push_back(faces.corner[k]);
    }
    kept.begin.push_back(kept.corner.size());
  }
  return kept;
}

/// Of each face the longitude and latitude, in degrees, of its node, else of its centroid.
LonLat centres_of(const Faces& faces) {
  return faces.centres.empty() ? LonLat(centroids(faces), true)
                               : angles_of(faces.centres, faces.given_centres, true);
}

}  // namespace

void write_scrip(const OutputFile& file, const Faces& faces, const Notes& notes) {
  const Faces rings = without_short_sides(faces);
  const std::size_t width = rings.most_corners();
  NetcdfWriter out(file);
  const int size = out.dimension("grid_size", faces.size());
  const int corners = out.dimension("grid_corners", width);
  const int rank = out.dimension("grid_rank", 1);
  const int dims = out.variable("grid_dims", NC_INT, {rank});
  const int centre_lat = out.angle("grid_center_lat", {size}, "degrees");
  const int centre_lon = out.angle("grid_center_lon", {size}, "degrees");
  const int imask = out.variable("grid_imask", NC_INT, {size});
  out.attribute(imask, "units", "unitless");
  const int corner_lat = out.angle("grid_corner_lat", {size, corners}, "degrees");
  const int corner_lon = out.angle("grid_corner_lon", {size, corners}, "degrees");
  const int area = out.variable("grid_area", NC_DOUBLE, {size});
  out.attribute(area, "units", "radians^2");
  out.attribute(area, "long_name", "area of the cell on the unit sphere");
  out.attributes(notes);
  out.end_definitions();

  const LonLat of_centres = centres_of(faces);
  const LonLat of_points = angles_of(faces.points, faces.given_points, true);
  out.put(area, areas(faces));
  out.put(dims, std::vector<std::int32_t>{static_cast<std::int32_t>(faces.size())});
  out.put(centre_lat, of_centres.lat);
  out.put(centre_lon, of_centres.lon);
  out.put(imask, std::vector<std::int32_t>(faces.size(), 1));
  for (const auto& [variable, values] :
       {std::pair(corner_lat, &of_points.lat), std::pair(corner_lon, &of_points.lon)})
    out.put(variable,
            padded<double>(  // the last corner again, as SCRIP requires
                rings, width,
                [&, values = values](std::size_t k) {
                  return (*values)[static_cast<std::size_t>(rings.corner[k]) - 1];
                },
                [](double last) { return last; }));
  out.close();
}

void write_esmf(const OutputFile& file, const Faces& faces, const Notes& notes) {
  constexpr std::int32_t kNone = -1;
  const Faces rings = without_short_sides(faces);
  const std::size_t width = rings.most_corners();
  NetcdfWriter out(file);
  const int nodes = out.dimension("nodeCount", faces.points.size()),
            elements = out.dimension("elementCount", faces.size()),
            corners = out.dimension("maxNodePElement", width), two = out.dimension("coordDim", 2);
  const int coordinates = out.angle("nodeCoords", {nodes, two}, "degrees"),
            connectivity = out.variable("elementConn", NC_INT, {elements, corners}),
            count = out.variable("numElementConn", NC_INT, {elements}),
            centres = out.angle("centerCoords", {elements, two}, "degrees"),
            area = out.variable("elementArea", NC_DOUBLE, {elements}),
            mask = out.variable("elementMask", NC_INT, {elements});
  out.attribute(connectivity, "long_name", "Node indices that define the element connectivity");
  out.attribute(connectivity, "start_index", 1);
  out.attribute(connectivity, "_FillValue", kNone);
  out.attribute(count, "long_name", "Number of nodes per element");
  out.attribute(area, "units", "radians^2");
  out.attribute(area, "long_name", "area of the element on the unit sphere");
  out.attribute(NC_GLOBAL, "gridType", "unstructured");
  out.attribute(NC_GLOBAL, "version", "0.9");
  out.attributes(notes);
  out.end_definitions();

  const auto put_places = [&](int variable, const LonLat& places) {
    out.put_rows<double>({variable}, places.lon.size(), 2,
                         [&](std::size_t i, double* to) { to[0] = places.lon[i], to[1] = places.lat[i]; });
  };
  put_places(coordinates, angles_of(faces.points, faces.given_points, true));
  put_places(centres, centres_of(faces));
  out.put(connectivity, padded<std::int32_t>(
                            rings, width, [&](std::size_t k) { return rings.corner[k]; },
                            [](std::int32_t) { return kNone; }));
  out.put_rows<std::int32_t>({count}, faces.size(), 1, [&](std::size_t f, std::int32_t* to) {
    *to = static_cast<std::int32_t>(rings.corners(f));
  });
  out.put(area, areas(faces));
  out.put(mask, std::vector<std::int32_t>(faces.size(), 1));
  out.close();
}

void write_netcdf_nodes(const OutputFile& file, const std::vector<Point>& points, const NodeValues& values) {
  NetcdfWriter out(file);
  const bool degrees = values.given.empty() || values.given.degrees;
  const int n = out.dimension("nCells", points.size(), values.share);
  const int lon = out.angle("lon", {n}, degrees ? "degrees_east" : "radians"),
            lat = out.angle("lat", {n}, degrees ? "degrees_north" : "radians");
  const int x = out.variable("xCell", NC_DOUBLE, {n}), y = out.variable("yCell", NC_DOUBLE, {n}),
            z = out.variable("zCell", NC_DOUBLE, {n}), of_density = out.density(values.density, n);
  const std::vector<int> columns = out.columns(values.columns, {n}, {{"coordinates", "lon lat"}});
  out.attributes(values.notes);
  out.end_definitions();
  const LonLat angles = angles_of(points, values.given, degrees);
  out.put(lon, angles.lon);
  out.put(lat, angles.lat);
  out.put(x, y, z, points);
  if (!values.density.empty()) out.put(of_density, values.density);
  out.put(columns, values.columns);
  out.close();
}

void write_netcdf_field(const OutputFile& file, const LonLat& places, const Field& field) {
  NetcdfWriter out(file);
  const int n = out.dimension("point", places.lon.size());
  const auto [lon, lat] = out.lon_lat("lon", "lat", {n}, {n});
  out.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  out.attributes(field.notes);
  Columns all{field.value};
  all.insert(all.end(), field.columns.begin(), field.columns.end());
  const std::vector<int> columns = out.columns(all, {n}, {{"coordinates", "lon lat"}});
  out.end_definitions();
  out.put(lon, places.lon);
  out.put(lat, places.lat);
  out.put(columns, all);
  out.close();
}

void write_netcdf_grid(const OutputFile& file, const Grid& grid, const Field& field) {
  NetcdfWriter out(file);
  const int n_lat = out.dimension("lat", grid.lat.size()), n_lon = out.dimension("lon", grid.lon.size());
  const auto [lon, lat] = out.lon_lat("lon", "lat", {n_lon}, {n_lat});
  out.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  out.attributes(field.notes);
  Columns all{field.value};
  all.insert(all.end(), field.columns.begin(), field.columns.end());
  const std::vector<int> columns = out.columns(all, {n_lat, n_lon}, {});
  out.end_definitions();
  out.put(lon, grid.lon);
  out.put(lat, grid.lat);
  out.put(columns, all);
  out.close();
}

namespace {

/// The variables of the nodes, `_a`, or of the places, `_b`, of weights.
class WrittenEnd {
 public:
  WrittenEnd(NetcdfWriter& out, const WeightsEnd& end, const std::string& letter, const char* word)
      : out_(out), end_(end), shape_(end.shape.begin(), end.shape.end()) {
    if (shape_.empty()) shape_.push_back(static_cast<std::int32_t>(end.at.lon.size()));
    for (const std::int32_t length : shape_) size_ *= static_cast<std::size_t>(length);
    std::reverse(shape_.begin(), shape_.end());  // the fastest dimension first
    const auto name = [&](const char* text) { return text + letter; };
    const int rank = out.dimension((word + std::string("_grid_rank")).c_str(), shape_.size());
    const int n = out.dimension(name("n_").c_str(), size_);
    const int corners = out.dimension(name("nv_").c_str(), end.edges.lon.empty() ? 1 : 4);
    dims_ = out.variable((word + std::string("_grid_dims")).c_str(), NC_INT, {rank});
    yc_ = out.angle(name("yc_").c_str(), {n}, "degrees");
    xc_ = out.angle(name("xc_").c_str(), {n}, "degrees");
    yv_ = out.angle(name("yv_").c_str(), {n, corners}, "degrees");
    xv_ = out.angle(name("xv_").c_str(), {n, corners}, "degrees");
    mask_ = out.variable(name("mask_").c_str(), NC_INT, {n});
    area_ = out.variable(name("area_").c_str(), NC_DOUBLE, {n});
    frac_ = out.variable(name("frac_").c_str(), NC_DOUBLE, {n});
    out.attribute(mask_, "units", "unitless");
    out.attribute(area_, "units", "square radians");
    out.attribute(frac_, "units", "unitless");
  }

  /// The number in the file of number i here, both from 1.
  std::int32_t number(std::size_t i) const {
    return static_cast<std::int32_t>(end_.numbers.empty() ? i : end_.numbers[i - 1]);
  }

  /// `entries`: the numbers of all nodes or places that have an entry.
  void put(const std::vector<std::int32_t>& entries) const {
    std::vector<std::int32_t> mask(size_, end_.numbers.empty() ? 1 : 0);
    for (const std::size_t number : end_.numbers) mask[number - 1] = 1;
    std::vector<double> frac(size_);
    for (const std::int32_t number : entries) frac[static_cast<std::size_t>(number) - 1] = 1;
    const auto of_all = [&](const std::vector<double>& here) {
      if (end_.numbers.empty()) return here;
      std::vector<double> all(size_, std::nan(""));
      for (std::size_t i = 0; i < here.size(); ++i) all[end_.numbers[i] - 1] = here[i];
      return all;
    };
    const std::vector<double> lat_of_all = of_all(end_.at.lat), lon_of_all = of_all(end_.at.lon);
    out_.put(dims_, shape_);
    out_.put(yc_, lat_of_all);
    out_.put(xc_, lon_of_all);
    out_.put(mask_, mask);
    out_.put(frac_, frac);
    if (end_.edges.lon.empty()) {
      out_.put(yv_, lat_of_all);
      out_.put(xv_, lon_of_all);
      out_.put(area_, std::vector<double>(size_));
      return;
    }
    const auto put_each = [&](int variable, std::size_t width, const auto& row) {
      out_.put_rows<double>({variable}, size_, width, row);
    };
    const auto &lon = end_.edges.lon, &lat = end_.edges.lat;
    const std::size_t columns = lon.size() - 1;
    put_each(yv_, 4, [&](std::size_t i, double* to) {
      const std::size_t row = i / columns;
      to[0] = to[1] = lat[row], to[2] = to[3] = lat[row + 1];
    });
    put_each(xv_, 4, [&](std::size_t i, double* to) {
      const std::size_t column = i % columns;
      to[0] = to[3] = lon[column], to[1] = to[2] = lon[column + 1];
    });
    put_each(area_, 1, [&](std::size_t i, double* to) {
      const double south = lat[i / columns] / kRadian, north = lat[i / columns + 1] / kRadian;
      *to = (lon[i % columns + 1] - lon[i % columns]) / kRadian * 2 * std::sin((north - south) / 2) *
            std::cos((north + south) / 2);
    });
  }

 private:
  NetcdfWriter& out_;
  const WeightsEnd& end_;
  std::vector<std::int32_t> shape_;
  std::size_t size_ = 1;
  int dims_, yc_, xc_, yv_, xv_, mask_, area_, frac_;
};

}  // namespace

void write_weights(const OutputFile& file, const Weights& weights, const WeightsEnd& nodes,
                   const WeightsEnd& places, const std::string& history) {
  NetcdfWriter out(file);
  const WrittenEnd a(out, nodes, "a", "src"), b(out, places, "b", "dst");
  const int n_s = out.dimension("n_s", weights.node.size());
  const int col = out.variable("col", NC_INT, {n_s}), row = out.variable("row", NC_INT, {n_s}),
            part = out.variable("S", NC_DOUBLE, {n_s});
  // ncremap needs these words; it calls all that is not conservative bilinear, as ESMF does.
  out.attribute(NC_GLOBAL, "title",
                "weights of pstripack as of the ESMF Offline Regridding Weight Generator");
  out.attribute(NC_GLOBAL, "conventions", "NCAR-CSM");
  out.attribute(NC_GLOBAL, "normalization", "destarea");
  out.attribute(NC_GLOBAL, "map_method", "Bilinear remapping");
  out.attribute(NC_GLOBAL, "history", history);
  out.end_definitions();
  std::vector<std::int32_t> cols, rows;
  cols.reserve(weights.node.size());
  rows.reserve(weights.node.size());
  for (const std::int32_t node : weights.node) cols.push_back(a.number(static_cast<std::size_t>(node)));
  for (std::size_t i = 1; i < weights.begin.size(); ++i) rows.resize(weights.begin[i], b.number(i));
  a.put(cols);
  b.put(rows);
  out.put(col, cols);
  out.put(row, rows);
  out.put(part, weights.part);
  out.close();
}

}  // namespace files
