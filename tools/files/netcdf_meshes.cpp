// Writers of NetCDF: UGRID, SCRIP, ESMF, and nodes alone.

#include <algorithm>
#include <tuple>
#include <utility>

#include "files/map_rings.h"
#include "files/measures.h"
#include "files/netcdf_writer.h"
#include "files/writers.h"

namespace files {
namespace {

constexpr std::int32_t kNone = -1;

/// Defines indices that count from 1, one for each corner of the faces; smaller faces end with kNone.
int add_corners(NetcdfWriter& out, const std::string& name, const NetcdfWriter::Dimensions& dimensions,
                const Faces& faces, const std::vector<std::int32_t>& values) {
  const std::size_t width = faces.most_corners();
  const int id = out.rows<std::int32_t>(name, dimensions, {}, [&, width](std::size_t f, std::int32_t* to) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(faces.begin[f]);
    const auto corners = static_cast<std::ptrdiff_t>(faces.corners(f));
    std::fill(std::copy(begin, begin + corners, to), to + width, kNone);
  });
  out.attribute(id, "start_index", 1);
  out.attribute(id, "_FillValue", kNone);
  return id;
}

}  // namespace

void write_ugrid(OutputFile& file, const Faces& faces, const std::vector<Point>& vectors,
                 const std::vector<double>& density, const Notes& notes) {
  const bool has_centres = !faces.centres.empty();
  const std::vector<std::int32_t> zero{0};
  const LonLat of_nodes = angles_of(faces.points, faces.given_points, true);
  LonLat of_centres;
  Edges edges;
  NetcdfWriter out(file);
  const int nodes = out.dimension("mesh_nodes", faces.points.size());
  const int n_faces = out.dimension("mesh_faces", faces.size());
  const int corners = out.dimension("mesh_face_corners", faces.most_corners());
  const int mesh = out.variable("mesh", {},
                                {{"cf_role", "mesh_topology"},
                                 {"node_coordinates", "mesh_node_lon mesh_node_lat"},
                                 {"face_dimension", "mesh_faces"},
                                 {kNodeVectors, "mesh_node_x mesh_node_y mesh_node_z"}},
                                zero);
  out.attribute(mesh, "topology_dimension", 2);
  const auto set_role = [&](int variable, const std::string& role, const std::string& name) {
    out.attribute(variable, "cf_role", role);
    out.attribute(mesh, role.c_str(), name);
  };
  set_role(add_corners(out, "mesh_face_nodes", {n_faces, corners}, faces, faces.corner),
           "face_node_connectivity", "mesh_face_nodes");
  if (faces.variant.edges) {
    edges = edges_of(faces);
    const int n_edges = out.dimension("mesh_edges", edges.nodes.size() / 2),
              two = out.dimension("mesh_two", 2);
    out.attribute(mesh, "edge_dimension", "mesh_edges");
    for (const auto& [role, name, values] :
         {std::tuple("edge_node_connectivity", "mesh_edge_nodes", &edges.nodes),
          {"edge_face_connectivity", "mesh_edge_faces", &edges.faces}}) {
      const int id = out.variable(name, {n_edges, two}, {}, *values);
      out.attribute(id, "start_index", 1);
      out.attribute(id, "_FillValue", kNone);
      set_role(id, role, name);
    }
    set_role(add_corners(out, "mesh_face_edges", {n_faces, corners}, faces, edges.of_faces),
             "face_edge_connectivity", "mesh_face_edges");
  }
  out.attribute(NC_GLOBAL, "Conventions", "CF-1.8 UGRID-1.0");
  out.attributes(notes);
  out.lon_lat("mesh_node_lon", "mesh_node_lat", nodes, nodes, of_nodes.lon, of_nodes.lat);
  const Notes on_nodes{
      {"mesh", "mesh"}, {"location", "node"}, {"coordinates", "mesh_node_lon mesh_node_lat"}};
  Notes on_faces{{"mesh", "mesh"}, {"location", "face"}};
  if (has_centres) {
    of_centres = angles_of(faces.centres, faces.given_centres, true);
    out.lon_lat("mesh_face_lon", "mesh_face_lat", n_faces, n_faces, of_centres.lon, of_centres.lat);
    out.attribute(mesh, "face_coordinates", "mesh_face_lon mesh_face_lat");
    on_faces["coordinates"] = "mesh_face_lon mesh_face_lat";
  }
  out.components({"mesh_node_x", "mesh_node_y", "mesh_node_z"}, nodes,
                 {{"long_name", "Cartesian coordinate of the node as it was given"}}, vectors);
  out.density(density, nodes, on_nodes);
  out.columns(faces.columns_of_points, {nodes}, on_nodes);
  out.columns(faces.columns_of_faces, {n_faces}, on_faces);
  out.write();
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

void write_scrip(OutputFile& file, const Faces& faces, const Notes& notes) {
  const Faces rings = without_short_sides(faces);
  const LonLat of_centres = centres_of(faces), of_points = angles_of(faces.points, faces.given_points, true);
  const std::size_t width = rings.most_corners();
  const Notes degrees{{"units", "degrees"}};
  NetcdfWriter out(file);
  const int size = out.dimension("grid_size", faces.size()), corners = out.dimension("grid_corners", width),
            rank = out.dimension("grid_rank", 1);
  const std::vector<std::int32_t> shape{static_cast<std::int32_t>(faces.size())}, mask(faces.size(), 1);
  const std::vector<double> of_faces = areas(faces);
  out.variable("grid_dims", {rank}, {}, shape);
  out.variable("grid_center_lat", {size}, degrees, of_centres.lat);
  out.variable("grid_center_lon", {size}, degrees, of_centres.lon);
  out.variable("grid_imask", {size}, {{"units", "unitless"}}, mask);
  for (const auto& [name, values] :
       {std::pair("grid_corner_lat", &of_points.lat), std::pair("grid_corner_lon", &of_points.lon)})
    out.rows<double>(name, {size, corners}, degrees, [&, width, angles = values](std::size_t f, double* to) {
      double* next = to;
      for (std::size_t k = rings.begin[f]; k < rings.begin[f + 1]; ++k)
        *next++ = (*angles)[static_cast<std::size_t>(rings.corner[k]) - 1];
      std::fill(next, to + width, next[-1]);  // the last corner again, as SCRIP requires
    });
  out.variable("grid_area", {size},
               {{"units", "radians^2"}, {"long_name", "area of the cell on the unit sphere"}}, of_faces);
  out.attributes(notes);
  out.write();
}

void write_esmf(OutputFile& file, const Faces& faces, const Notes& notes) {
  const Faces rings = without_short_sides(faces);
  const LonLat of_centres = centres_of(faces), of_points = angles_of(faces.points, faces.given_points, true);
  const std::vector<std::int32_t> mask(faces.size(), 1);
  const std::vector<double> of_faces = areas(faces);
  NetcdfWriter out(file);
  const int nodes = out.dimension("nodeCount", faces.points.size()),
            elements = out.dimension("elementCount", faces.size()),
            corners = out.dimension("maxNodePElement", rings.most_corners()),
            two = out.dimension("coordDim", 2);
  const auto add_places = [&](const char* name, int of, const LonLat& places) {
    out.rows<double>(name, {of, two}, {{"units", "degrees"}},
                     [&places](std::size_t i, double* to) { to[0] = places.lon[i], to[1] = places.lat[i]; });
  };
  add_places("nodeCoords", nodes, of_points);
  out.attribute(add_corners(out, "elementConn", {elements, corners}, rings, rings.corner), "long_name",
                "Node indices that define the element connectivity");
  out.rows<std::int32_t>(
      "numElementConn", {elements}, {{"long_name", "Number of nodes per element"}},
      [&](std::size_t f, std::int32_t* to) { *to = static_cast<std::int32_t>(rings.corners(f)); });
  add_places("centerCoords", elements, of_centres);
  out.variable("elementArea", {elements},
               {{"units", "radians^2"}, {"long_name", "area of the element on the unit sphere"}}, of_faces);
  out.variable("elementMask", {elements}, {}, mask);
  out.attribute(NC_GLOBAL, "gridType", "unstructured");
  out.attribute(NC_GLOBAL, "version", "0.9");
  out.attributes(notes);
  out.write();
}

void write_netcdf_nodes(OutputFile& file, const std::vector<Point>& points, const NodeValues& values) {
  const bool degrees = values.given.empty() || values.given.degrees;
  const LonLat angles = angles_of(points, values.given, degrees);
  NetcdfWriter out(file);
  const int n = out.dimension("nCells", points.size());
  out.variable("lon", {n}, {{"units", degrees ? "degrees_east" : "radians"}}, angles.lon);
  out.variable("lat", {n}, {{"units", degrees ? "degrees_north" : "radians"}}, angles.lat);
  out.components({"xCell", "yCell", "zCell"}, n, {}, points);
  out.density(values.density, n);
  out.columns(values.columns, {n}, {{"coordinates", "lon lat"}});
  out.attributes(values.notes);
  out.write();
}

void write_netcdf_field(OutputFile& file, const LonLat& places, const Grid& grid, const Field& field) {
  const bool is_grid = !grid.lon.empty();
  const std::vector<double>&lon = is_grid ? grid.lon : places.lon, &lat = is_grid ? grid.lat : places.lat;
  const Columns table = field.table();
  NetcdfWriter out(file);
  NetcdfWriter::Dimensions dimensions;
  if (is_grid) dimensions.push_back(out.dimension("lat", lat.size()));
  dimensions.push_back(out.dimension(is_grid ? "lon" : "point", lon.size()));
  out.lon_lat("lon", "lat", dimensions.back(), dimensions.front(), lon, lat);
  out.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  out.attributes(field.notes);
  out.columns(table, dimensions, is_grid ? Notes{} : Notes{{"coordinates", "lon lat"}});
  out.write();
}

namespace {

/// The nodes, `_a`, or the places, `_b`, of weights: all that are in the file.
struct End {
  std::vector<std::int32_t> shape, mask;
  std::vector<double> lon, lat, frac;  ///< frac: 1 for those that have an entry

  /// `entries`: the numbers of all that have one.
  End(const WeightsEnd& here, const std::vector<std::int32_t>& entries)
      : shape(here.shape.rbegin(), here.shape.rend()) {  // the fastest dimension first
    if (shape.empty()) shape.push_back(static_cast<std::int32_t>(here.at.lon.size()));
    std::size_t size = 1;
    for (const std::int32_t n : shape) size *= static_cast<std::size_t>(n);
    mask.resize(size);
    frac.resize(size);
    lon.resize(size, std::nan(""));
    lat.resize(size, std::nan(""));
    for (std::size_t i = 0; i < here.at.lon.size(); ++i) {
      const std::size_t k = here.number(i) - 1;
      mask[k] = 1, lon[k] = here.at.lon[i], lat[k] = here.at.lat[i];
    }
    for (const std::int32_t number : entries) frac[static_cast<std::size_t>(number) - 1] = 1;
  }

  /// Defines the variables. `edges`: between cells, or empty.
  void add_to(NetcdfWriter& out, const Grid& edges, const std::string& letter,
              const std::string& word) const {
    const bool has_cells = !edges.lon.empty();
    const int rank = out.dimension(word + "_grid_rank", shape.size()),
              n = out.dimension("n_" + letter, mask.size()),
              corners = out.dimension("nv_" + letter, has_cells ? 4 : 1);
    const Notes degrees{{"units", "degrees"}}, unitless{{"units", "unitless"}},
        square{{"units", "square radians"}};
    const std::size_t columns = has_cells ? edges.lon.size() - 1 : 1;
    out.variable(word + "_grid_dims", {rank}, {}, shape);
    out.variable("yc_" + letter, {n}, degrees, lat);
    out.variable("xc_" + letter, {n}, degrees, lon);
    if (has_cells) {
      out.rows<double>("yv_" + letter, {n, corners}, degrees, [&edges, columns](std::size_t i, double* to) {
        to[0] = to[1] = edges.lat[i / columns], to[2] = to[3] = edges.lat[i / columns + 1];
      });
      out.rows<double>("xv_" + letter, {n, corners}, degrees, [&edges, columns](std::size_t i, double* to) {
        to[0] = to[3] = edges.lon[i % columns], to[1] = to[2] = edges.lon[i % columns + 1];
      });
    } else {
      out.variable("yv_" + letter, {n, corners}, degrees, lat);
      out.variable("xv_" + letter, {n, corners}, degrees, lon);
    }
    out.variable("mask_" + letter, {n}, unitless, mask);
    out.rows<double>("area_" + letter, {n}, square, [=, &edges](std::size_t i, double* to) {
      if (!has_cells) return;
      const double south = edges.lat[i / columns] / kRadian, north = edges.lat[i / columns + 1] / kRadian;
      *to = (edges.lon[i % columns + 1] - edges.lon[i % columns]) / kRadian * 2 *
            std::sin((north - south) / 2) * std::cos((north + south) / 2);
    });
    out.variable("frac_" + letter, {n}, unitless, frac);
  }
};

}  // namespace

void write_weights(OutputFile& file, const Weights& weights, const WeightsEnd& nodes,
                   const WeightsEnd& places, const std::string& history) {
  std::vector<std::int32_t> cols, rows;
  for (const std::int32_t node : weights.node)
    cols.push_back(static_cast<std::int32_t>(nodes.number(static_cast<std::size_t>(node) - 1)));
  for (std::size_t i = 0; i + 1 < weights.begin.size(); ++i)
    rows.resize(weights.begin[i + 1], static_cast<std::int32_t>(places.number(i)));
  const End a(nodes, cols), b(places, rows);
  NetcdfWriter out(file);
  a.add_to(out, nodes.edges, "a", "src");
  b.add_to(out, places.edges, "b", "dst");
  const int n_s = out.dimension("n_s", weights.node.size());
  out.variable("col", {n_s}, {}, cols);
  out.variable("row", {n_s}, {}, rows);
  out.variable("S", {n_s}, {}, weights.part);
  // ncremap needs these words; it calls all that is not conservative bilinear, as ESMF does.
  out.attributes({{"title", "weights of pstripack as of the ESMF Offline Regridding Weight Generator"},
                  {"conventions", "NCAR-CSM"},
                  {"normalization", "destarea"},
                  {"map_method", "Bilinear remapping"},
                  {"history", history}});
  out.write();
}

}  // namespace files
