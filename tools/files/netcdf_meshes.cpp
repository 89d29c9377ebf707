// Writers of NetCDF: UGRID, SCRIP, the input of MPAS' mesh converter, and nodes alone.

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "files/map_rings.h"
#include "files/writers.h"

namespace files {
namespace {

/// A NetCDF file being written: first all definitions, then the values. If another process has begun the
/// file, the definitions are looked up and this process adds its rows.
class Writer {
 public:
  explicit Writer(const OutputFile& file) : name_(file.name()), is_begun_(file.is_begun()) {
    if (is_begun_) {
      check(nc_open(file.path().c_str(), NC_WRITE, &id_));
    } else {
      check(nc_create(file.path().c_str(), NC_CLOBBER | NC_NETCDF4 | NC_CLASSIC_MODEL, &id_));
      check(nc_set_fill(id_, NC_NOFILL, nullptr));
    }
  }
  ~Writer() {
    if (id_ >= 0) nc_abort(id_);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Defines a dimension. `length`: number of rows of this process.
  int dimension(const char* name, std::size_t length, const Share& share = {}) {
    int dimension = 0;
    check(is_begun_ ? nc_inq_dimid(id_, name, &dimension)
                    : nc_def_dim(id_, name, share.total(length), &dimension));
    rows_[dimension] = {share.before, length};
    names_.insert(name);
    return dimension;
  }
  int variable(const char* name, nc_type type, const std::vector<int>& dimensions) {
    int variable = 0;
    check(is_begun_ ? nc_inq_varid(id_, name, &variable)
                    : nc_def_var(id_, name, type, static_cast<int>(dimensions.size()), dimensions.data(),
                                 &variable));
    dimensions_[variable] = dimensions;
    names_.insert(name);
    return variable;
  }
  /// Defines longitudes and latitudes with the units degrees_east and degrees_north that CF requires.
  std::pair<int, int> lon_lat(const char* lon_name, const char* lat_name, const std::vector<int>& of_lon,
                              const std::vector<int>& of_lat) {
    const int lon = angle(lon_name, of_lon, "degrees_east"), lat = angle(lat_name, of_lat, "degrees_north");
    attribute(lon, "standard_name", "longitude");
    attribute(lat, "standard_name", "latitude");
    return {lon, lat};
  }
  /// Defines the density of the nodes. Nothing if `values` is empty.
  int density(const std::vector<double>& values, int nodes) {
    return values.empty() ? -1 : variable("meshDensity", NC_DOUBLE, {nodes});
  }
  /// Defines a variable with these dimensions for each column, numbers or texts of equal length. Renames
  /// columns whose names are taken. `of_mesh`: attributes of each variable.
  std::vector<int> columns(const Columns& all, const std::vector<int>& dimensions, const Notes& of_mesh) {
    std::vector<int> ids;
    for (const Column& c : all) {
      const std::string name = free_name(c.name);
      std::vector<int> shape = dimensions;
      if (c.is_text()) shape.push_back(dimension((name + "_length").c_str(), longest(c)));
      const int id = variable(name.c_str(), c.is_text() ? NC_CHAR : c.whole ? NC_INT : NC_DOUBLE, shape);
      const bool renamed = name != c.name && c.long_name.empty();
      if (renamed || !c.long_name.empty()) attribute(id, "long_name", renamed ? c.name : c.long_name);
      if (!c.units.empty()) attribute(id, "units", c.units);
      if (!c.is_text() && !c.whole) attribute(id, "_FillValue", NC_FILL_DOUBLE);
      for (const auto& [attribute_name, text] : of_mesh) attribute(id, attribute_name.c_str(), text);
      ids.push_back(id);
    }
    return ids;
  }
  void put(const std::vector<int>& ids, const Columns& all) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const Column& c = all[k];
      if (c.is_text()) {
        const std::size_t length = longest(c);
        std::string bytes;
        for (std::size_t i = 0; i < c.size(); ++i) (bytes += c.texts[i]).resize((i + 1) * length);
        const Slab slab = slab_of(ids[k]);
        check(nc_put_vara_text(id_, ids[k], slab.start.data(), slab.count.data(), bytes.data()));
      } else if (c.whole) {
        put(ids[k], std::vector<std::int32_t>(c.numbers.begin(), c.numbers.end()));
      } else if (std::any_of(c.numbers.begin(), c.numbers.end(), [](double v) { return std::isnan(v); })) {
        std::vector<double> filled = c.numbers;
        for (double& v : filled)
          if (std::isnan(v)) v = NC_FILL_DOUBLE;
        put(ids[k], filled);
      } else {
        put(ids[k], c.numbers);
      }
    }
  }
  void attributes(const Notes& notes) {
    for (const auto& [name, text] : notes) attribute(NC_GLOBAL, name.c_str(), text);
  }
  /// Defines a variable of angles in degrees or radians.
  int angle(const char* name, const std::vector<int>& dimensions, const char* units) {
    const int id = variable(name, NC_DOUBLE, dimensions);
    attribute(id, "units", units);
    return id;
  }
  void attribute(int variable, const char* name, const std::string& text) {
    if (!is_begun_) check(nc_put_att_text(id_, variable, name, text.size(), text.data()));
  }
  void attribute(int variable, const char* name, int value) {
    if (!is_begun_) check(nc_put_att_int(id_, variable, name, NC_INT, 1, &value));
  }
  void attribute(int variable, const char* name, double value) {
    if (!is_begun_) check(nc_put_att_double(id_, variable, name, NC_DOUBLE, 1, &value));
  }
  void end_definitions() {
    if (!is_begun_) check(nc_enddef(id_));
  }
  void put(int variable, const std::vector<double>& values) {
    const Slab slab = slab_of(variable);
    check(nc_put_vara_double(id_, variable, slab.start.data(), slab.count.data(), values.data()));
  }
  void put(int variable, const std::vector<std::int32_t>& values) {
    const Slab slab = slab_of(variable);
    check(nc_put_vara_int(id_, variable, slab.start.data(), slab.count.data(), values.data()));
  }
  void put(int x, int y, int z, const std::vector<Point>& points) {
    std::vector<double> values(points.size());
    for (const auto& [variable, component] :
         {std::pair(x, &Point::x), std::pair(y, &Point::y), std::pair(z, &Point::z)}) {
      for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i].*component;
      put(variable, values);
    }
  }
  void close() {
    const int id = id_;
    id_ = -1;
    check(nc_close(id));
  }

 private:
  void check(int status) const {
    if (status != NC_NOERR) throw std::runtime_error(name_ + ": cannot be written: " + nc_strerror(status));
  }
  /// The rows of a variable that this process writes.
  struct Slab {
    std::vector<std::size_t> start, count;
  };
  Slab slab_of(int variable) const {
    Slab slab;
    for (const int dimension : dimensions_.at(variable)) {
      const auto [before, here] = rows_.at(dimension);
      slab.start.push_back(before);
      slab.count.push_back(here);
    }
    return slab;
  }
  static std::size_t longest(const Column& texts) {
    std::size_t most = 1;
    for (const std::string& text : texts.texts) most = std::max(most, text.size());
    return most;
  }
  /// A name that NetCDF allows and no other variable has. Blanks are replaced, since some readers do not
  /// accept them.
  std::string free_name(std::string name) {
    const auto is_plain = [](char c) {
      return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    for (char& c : name)
      if (!is_plain(c)) c = '_';
    if (name.empty() || (name[0] >= '0' && name[0] <= '9')) name = "_" + name;
    while (names_.count(name) > 0) name += "_given";
    return name;
  }
  std::string name_;
  bool is_begun_;
  int id_ = -1;
  std::map<int, std::pair<std::size_t, std::size_t>>
      rows_;                                    ///< of each dimension: rows of earlier processes, own rows
  std::map<int, std::vector<int>> dimensions_;  ///< of each variable
  std::set<std::string> names_;                 ///< of dimensions and variables
};

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
  Writer out(file);
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
  if (faces.corner.size() == faces.size() * width)
    out.put(connectivity, faces.corner);
  else
    out.put(connectivity, padded<std::int32_t>(
                              faces, width, [&](std::size_t k) { return faces.corner[k]; },
                              [](std::int32_t) { return kNone; }));
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

}  // namespace

void write_scrip(const OutputFile& file, const Faces& faces, const Notes& notes) {
  const Faces rings = without_short_sides(faces);
  const std::size_t width = rings.most_corners();
  Writer out(file);
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

  const LonLat of_centres = faces.centres.empty() ? LonLat(centroids(faces), true)
                                                  : angles_of(faces.centres, faces.given_centres, true);
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

namespace {

struct Mpas {
  std::vector<Point> cells, vertices;
  LonLat given;                                 ///< of the cells
  std::vector<std::int32_t> cells_of_vertices;  ///< three cells for each vertex
  std::vector<double> density;
  const Notes& notes;
  Share share_of_cells = {}, share_of_vertices = {};
};

void write(const OutputFile& file, const Mpas& mesh) {
  Writer out(file);
  const int n_cells = out.dimension("nCells", mesh.cells.size(), mesh.share_of_cells);
  const int n_vertices = out.dimension("nVertices", mesh.vertices.size(), mesh.share_of_vertices);
  const int degree = out.dimension("vertexDegree", 3);
  out.attribute(NC_GLOBAL, "on_a_sphere", "YES");
  out.attribute(NC_GLOBAL, "sphere_radius", 1.0);
  out.attribute(NC_GLOBAL, "is_periodic", "NO");
  out.attribute(NC_GLOBAL, "mesh_spec", "1.0");
  out.attribute(NC_GLOBAL, "history", "pstripack");
  out.attributes(mesh.notes);
  struct Variables {
    int x, y, z, lon, lat;
  };
  const auto places = [&](const std::string& of, int dimension) -> Variables {
    const auto name = [&](const char* begin) { return begin + of; };
    return {out.variable(name("x").c_str(), NC_DOUBLE, {dimension}),
            out.variable(name("y").c_str(), NC_DOUBLE, {dimension}),
            out.variable(name("z").c_str(), NC_DOUBLE, {dimension}),
            out.angle(name("lon").c_str(), {dimension}, "rad"),
            out.angle(name("lat").c_str(), {dimension}, "rad")};
  };
  const Variables of_cells = places("Cell", n_cells), of_vertices = places("Vertex", n_vertices);
  const int cells_on_vertex = out.variable("cellsOnVertex", NC_INT, {n_vertices, degree});
  const int density = out.variable("meshDensity", NC_DOUBLE, {n_cells});
  out.end_definitions();

  const auto put = [&](const Variables& to, const std::vector<Point>& points, const LonLat& given) {
    out.put(to.x, to.y, to.z, points);
    LonLat angles = angles_of(points, given, false);
    constexpr double kTurn = 6.2831853071795865;  // MPAS: 0 to 2 pi
    for (double& lon : angles.lon)
      if (lon < 0) lon = lon + kTurn < kTurn ? lon + kTurn : 0;
    out.put(to.lon, angles.lon);
    out.put(to.lat, angles.lat);
  };
  put(of_cells, mesh.cells, mesh.given);
  put(of_vertices, mesh.vertices, {});
  out.put(cells_on_vertex, mesh.cells_of_vertices);
  out.put(density, mesh.density.empty() ? std::vector<double>(mesh.cells.size(), 1) : mesh.density);
  out.close();
}

}  // namespace

void write_mpas(const OutputFile& file, const Mesh& mesh) {
  std::vector<Point> cells = unit(mesh.points);
  std::vector<std::int32_t> triangles = triangles_of(mesh);
  std::vector<Point> vertices = circumcentres(mesh.points, triangles);
  write(file,
        {std::move(cells), std::move(vertices), mesh.given, std::move(triangles), mesh.density, mesh.notes});
}

void write_mpas(const OutputFile& file, const MeshPart& part) {
  std::vector<Point> points = unit(part.points);
  std::vector<Point> vertices = circumcentres(part.points, part.corner);
  points.resize(part.nodes);
  write(file, {std::move(points),
               std::move(vertices),
               {},
               part.corners_by_number(),
               part.density,
               part.notes,
               part.share_of_nodes,
               part.share_of_triangles});
}

void write_netcdf_nodes(const OutputFile& file, const std::vector<Point>& points, const NodeValues& values) {
  Writer out(file);
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
  Writer out(file);
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
  Writer out(file);
  const int n_lat = out.dimension("lat", grid.lat.size()), n_lon = out.dimension("lon", grid.lon.size());
  const auto [lon, lat] = out.lon_lat("lon", "lat", {n_lon}, {n_lat});
  out.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  out.attributes(field.notes);
  const std::vector<int> columns = out.columns({field.value}, {n_lat, n_lon}, {});
  out.end_definitions();
  out.put(lon, grid.lon);
  out.put(lat, grid.lat);
  out.put(columns, {field.value});
  out.close();
}

}  // namespace files
