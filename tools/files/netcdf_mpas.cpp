// Writer of MPAS meshes. mpas_mesh.h says what the variables are.

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "files/limited_area.h"
#include "files/mpas_mesh.h"
#include "files/netcdf_file.h"
#include "files/netcdf_writer.h"
#include "files/nodes.h"
#include "files/writers.h"

namespace files {
namespace {

/// Ten letters and digits that name a mesh: a hash (FNV-1a, of words of 8 bytes) of these parts.
std::string file_id_of(std::initializer_list<std::pair<const void*, std::size_t>> parts) {
  std::uint64_t hash = 14695981039346656037u;
  for (const auto& [words, bytes] : parts)
    for (std::size_t i = 0; i + 8 <= bytes; i += 8) {
      std::uint64_t word;
      std::memcpy(&word, static_cast<const char*>(words) + i, 8);
      hash = (hash ^ word) * 1099511628211u;
      hash ^= hash >> 32;
    }
  std::string id;
  for (int i = 0; i < 10; ++i, hash /= 36) id += "abcdefghijklmnopqrstuvwxyz0123456789"[hash % 36];
  return id;
}

/// For METIS, beside MESH.nc or MESH.mpas.nc MESH.graph.info: the number of cells and of edges between two of
/// them, then a line of neighbours for each cell, for which neighbours(cell, take) calls take(neighbour from
/// 1).
template <class Neighbours>
void write_graph(OutputFile& beside, std::size_t cells, const Neighbours& neighbours) {
  if (!beside.has_a_name()) return;
  std::string name = beside.name();
  for (const std::string suffix : {".nc", ".mpas"})
    if (name.size() > suffix.size() && name.compare(name.size() - suffix.size(), suffix.npos, suffix) == 0)
      name.resize(name.size() - suffix.size());
  OutputFile file(name + ".graph.info");
  std::size_t entries = 0;  // two for each edge
  for (std::size_t c = 0; c < cells; ++c) neighbours(c, [&](MpasMesh::Index) { ++entries; });
  file.print("{} {}\n", cells, entries / 2);
  for (std::size_t c = 0; c < cells; ++c) {
    neighbours(c, [&](MpasMesh::Index other) { file.print("{} ", other); });
    file.print("\n");
  }
  file.commit();
}

/// Least over largest; 0 if all are 0.
template <class Number>
double evenness(std::size_t count, const Number& number) {
  double least = number(0), most = least;
  for (std::size_t k = 1; k < count; ++k)
    least = std::min(least, number(k)), most = std::max(most, number(k));
  return most > 0 ? least / most : 0;
}

/// The longitude from 0 to 2 pi.
double from_0(double lon) {
  constexpr double kTurn = 6.2831853071795865;
  return lon >= 0 ? lon : lon + kTurn < kTurn ? lon + kTurn : 0;
}

// ---- a part of a file -----------------------------------------------------------------------------------

constexpr const char *kOf[] = {"Cell", "Edge", "Vertex"}, *kRows[] = {"nCells", "nEdges", "nVertices"},
                     *kLists[] = {"cellsOn", "edgesOn", "verticesOn"};

/// The rows of cells, edges or vertices that stay.
struct Rows {
  std::vector<std::size_t> kept;
  std::vector<MpasMesh::Index> number;  ///< of row i - 1: its number, from 1, among these; 0: left out
  std::vector<MpasMesh::Index> layers;  ///< of those that stay: the least layer of their cells

  /// `cells`: so many of each row; 0: none. `layers_of_cells`: of all.
  Rows(const std::vector<double>& cells, std::size_t width,
       const std::vector<MpasMesh::Index>& layers_of_cells)
      : number(cells.size() / width + 1) {
    for (std::size_t i = 0; i + 1 < number.size(); ++i) {
      MpasMesh::Index least = kLayers + 1;
      for (std::size_t k = i * width; k < (i + 1) * width; ++k)
        if (cells[k] >= 1)
          if (const auto layer = layers_of_cells.at(static_cast<std::size_t>(cells[k]) - 1);
              layer != kLeftOut)
            least = std::min(least, layer);
      if (least > kLayers) continue;
      kept.push_back(i);
      layers.push_back(least);
      number[i + 1] = static_cast<MpasMesh::Index>(kept.size());
    }
  }
};

/// Copies the values of a variable: of its dimension `cut` those rows, if there are some, and indices as
/// `numbers`, if that is set.
void copy_values(const NetcdfFile& from, const NetcdfVariable& v, int to, int variable, std::size_t cut,
                 const Rows* rows, const Rows* numbers) {
  const auto check = [&](int status) { from.check(v.path, status); };
  std::size_t outer = 1, row = 0;  // slabs with all rows; bytes of a row
  check(nc_inq_type(v.group, v.type, nullptr, &row));
  std::vector<std::size_t> start(v.lengths.size()), count = v.lengths, kept = v.lengths;
  for (std::size_t d = 0; d < v.lengths.size(); ++d)
    if (d < cut)
      outer *= std::exchange(count[d], 1), kept[d] = 1;
    else if (d > cut || rows == nullptr)
      row *= count[d];
  if (rows != nullptr) kept[cut] = rows->kept.size();
  std::vector<char> bytes(row * (rows == nullptr ? 1 : count[cut]));
  for (std::size_t slab = 0; slab < outer; ++slab) {
    for (std::size_t d = cut, rest = slab; d-- > 0; rest /= v.lengths[d]) start[d] = rest % v.lengths[d];
    check(nc_get_vara(v.group, v.id, start.data(), count.data(), bytes.data()));
    for (std::size_t k = 0; rows != nullptr && k < rows->kept.size(); ++k)
      std::memmove(bytes.data() + k * row, bytes.data() + rows->kept[k] * row, row);
    auto* const index = reinterpret_cast<MpasMesh::Index*>(bytes.data());
    for (std::size_t k = 0; numbers != nullptr && k < bytes.size() / sizeof *index; ++k)
      index[k] = index[k] > 0 ? numbers->number.at(static_cast<std::size_t>(index[k])) : 0;
    check(nc_put_vara(to, variable, start.data(), kept.data(), bytes.data()));
  }
}

}  // namespace

bool is_mpas_mesh(const Nodes& nodes) {
  for (const char* const of : {"cellsOnCell", "cellsOnEdge", "cellsOnVertex", "edgesOnCell", "edgesOnEdge",
                               "edgesOnVertex", "verticesOnCell", "verticesOnEdge", "nEdgesOnCell"})
    if (std::find(nodes.variables.begin(), nodes.variables.end(), of) == nodes.variables.end()) return false;
  return is_netcdf(nodes.file);
}

void write_mpas_area(OutputFile& file, const std::string& from, const std::vector<std::int32_t>& layers,
                     const Notes& notes) {
  using Index = MpasMesh::Index;
  const ReadOptions options;
  const NetcdfFile all(from, "", options);
  const NetcdfVariable global = all.global();
  const auto table = [&](const char* name) { return all.values(all.variable(name)); };
  std::vector<double> each(layers.size());
  std::iota(each.begin(), each.end(), 1);
  const std::vector<double> of_edges = table("cellsOnEdge"), of_vertices = table("cellsOnVertex");
  const Rows rows[] = {{each, 1, layers}, {of_edges, 2, layers}, {of_vertices, 3, layers}};
  const auto number = [&](double cell) {
    return cell >= 1 ? rows[0].number.at(static_cast<std::size_t>(cell)) : 0;
  };

  NetcdfWriter out(file, NC_64BIT_DATA);
  int count = 0, record = -1;
  nc_inq_unlimdim(global.group, &record);
  nc_inq_ndims(global.group, &count);
  std::map<int, std::size_t> cut;  // dimensions of cells, edges and vertices
  std::vector<int> ids(static_cast<std::size_t>(count));
  nc_inq_dimids(global.group, &count, ids.data(), 0);
  std::map<int, int> dimension;  // of the output, by that of the input
  for (const int id : ids) {
    const std::string name = all.dimension_name(id);
    const auto k = static_cast<std::size_t>(std::find(std::begin(kRows), std::end(kRows), name) - kRows);
    if (k < 3) cut[id] = k;
    dimension[id] = out.dimension(name, k < 3          ? rows[k].kept.size()
                                        : id == record ? NC_UNLIMITED
                                                       : all.length_of(id));
  }
  if (cut.size() < 3) all.fail("expected dimensions nCells, nEdges and nVertices");
  const auto copy_attributes = [&](const NetcdfVariable& v, int to) {
    for (const std::string& name : all.attributes(v)) {
      nc_type type = NC_CHAR;
      nc_inq_atttype(v.group, v.id, name.c_str(), &type);
      if (type == NC_STRING)
        out.attribute(to, name.c_str(), all.text(v, name.c_str()));
      else
        out.attribute(to, name.c_str(), v.group, v.id);
    }
  };
  copy_attributes(global, NC_GLOBAL);
  out.attributes(notes);
  const std::string parent = all.text(global, "file_id");
  out.attribute(NC_GLOBAL, "file_id",
                file_id_of({{layers.data(), 4 * layers.size()}, {parent.data(), parent.size()}}));

  std::set<std::string> own{"boundaryVertex"};
  for (const std::string of : kOf) own.insert({"bdyMask" + of, "mapCulledToBase" + of});
  for (const NetcdfVariable& v : all.variables()) {
    const auto is_cut = [&](int id) { return cut.count(id) > 0; };
    const auto cuts = std::count_if(v.dimensions.begin(), v.dimensions.end(), is_cut);
    if (own.count(v.path) > 0 || v.path.find('/') != v.path.npos || v.type > NC_UINT64 || cuts > 1) continue;
    const auto first = std::find_if(v.dimensions.begin(), v.dimensions.end(), is_cut);
    const Rows* const kept = cuts == 0 ? nullptr : &rows[cut[*first]];
    const Rows* numbers = nullptr;
    for (std::size_t k = 0; k < 3; ++k)
      if (v.type == NC_INT && cuts > 0 &&
          (v.path.rfind(kLists[k], 0) == 0 || v.path == fmt::format("indexTo{}ID", kOf[k])))
        numbers = &rows[k];
    NetcdfWriter::Dimensions of_variable;
    for (const int id : v.dimensions) of_variable.push_back(dimension[id]);
    const int variable = out.define(v.path, v.type, of_variable);
    copy_attributes(v, variable);
    const auto at = static_cast<std::size_t>(cuts == 0 ? 0 : first - v.dimensions.begin());
    out.add([=, &all, &v](int to) { copy_values(all, v, to, variable, at, kept, numbers); });
  }
  for (const auto& [id, of] : cut) {
    const auto add = [&, k = of, to = dimension[id]](const std::string& name, const char* what,
                                                     const auto& value) {
      out.rows<Index>(name, {to}, {{"units", "1"}, {"long_name", what}},
                      [&rows, k, value](std::size_t i, Index* at) { *at = value(rows[k], i); });
    };
    add(std::string("bdyMask") + kOf[of],
        of == 0 ? "0: region, 1 to 7: layers around it" : "least bdyMaskCell of its cells",
        [](const Rows& here, std::size_t i) { return here.layers[i]; });
    add(std::string("mapCulledToBase") + kOf[of], "its place, from 0, in the mesh before the cut",
        [](const Rows& here, std::size_t i) { return static_cast<Index>(here.kept[i]); });
    if (of == 2 && all.find("boundaryVertex") != nullptr)
      add("boundaryVertex", "1: the vertex lies at the boundary",
          [&](const Rows& here, std::size_t i) -> Index {
            const double* const cells = &of_vertices[3 * here.kept[i]];
            return std::any_of(cells, cells + 3, [&](double cell) { return number(cell) == 0; });
          });
  }
  out.write();

  const std::vector<double> sides = table("nEdgesOnCell"), cells = table("cellsOnCell");
  write_graph(file, rows[0].kept.size(), [&](std::size_t c, const auto& take) {
    const std::size_t row = rows[0].kept[c], width = cells.size() / sides.size();
    for (std::size_t k = row * width; k < row * width + static_cast<std::size_t>(sides[row]); ++k)
      if (const Index other = number(cells[k]); other > 0) take(other);
  });
}

// ---- a whole mesh ----------------------------------------------------------------------------------------

void write_mpas(OutputFile& file, const MpasMesh& mesh, const NodeValues& values) {
  using Index = MpasMesh::Index;
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  const double radius = values.radius, square = radius * radius;
  NetcdfWriter out(file, NC_64BIT_DATA);
  const int cells = out.dimension("nCells", mesh.cells.size()),
            edges = out.dimension("nEdges", mesh.cells_on_edge.size()),
            vertices = out.dimension("nVertices", mesh.vertices.size()),
            sides = out.dimension("maxEdges", mesh.most_sides()),
            around = out.dimension("maxEdges2", 2 * mesh.most_sides()), two = out.dimension("TWO", 2),
            three = out.dimension("vertexDegree", 3);
  out.dimension("Time", NC_UNLIMITED);
  out.attribute(NC_GLOBAL, "on_a_sphere", "YES");
  out.attribute(NC_GLOBAL, "sphere_radius", radius);
  out.attribute(NC_GLOBAL, "is_periodic", "NO");
  out.attribute(NC_GLOBAL, "mesh_spec", "1.0");
  out.attribute(NC_GLOBAL, "Conventions", "MPAS");
  out.attributes(values.notes);
  out.attribute(NC_GLOBAL, "source", "pstripack");
  out.attribute(
      NC_GLOBAL, "file_id",
      file_id_of({{mesh.cells.data(), mesh.cells.size() * sizeof(Point)},
                  {mesh.cells_on_vertex.data(), mesh.cells_on_vertex.size() * sizeof(MpasMesh::Three)},
                  {&radius, sizeof radius}}));

  // Variables of numbers, and of tables: row(i, to) sets the values of i, which are 0 before.
  const auto table = [&](auto zero, const std::string& name, const NetcdfWriter::Dimensions& dimensions,
                         const char* units, const std::string& long_name, const auto& row) {
    const int id = out.rows<decltype(zero)>(name, dimensions, {}, row);
    out.attribute(id, "units", units);
    out.attribute(id, "long_name", long_name);
  };
  const auto numbers = [&](const std::string& name, int of, const char* units, const std::string& long_name,
                           const auto& value) {
    using Number = decltype(value(std::size_t{}));
    table(Number{}, name, {of}, units, long_name, [value](std::size_t i, Number* to) { *to = value(i); });
  };
  const auto indices = [&](const std::string& name, int rows, int width, const char* long_name,
                           const auto& all) {
    table(Index{}, name, {rows, width}, "1", long_name, [&all](std::size_t i, Index* to) {
      for (const Index index : all[i]) *to++ = index + 1;
    });
  };
  const auto count_from_1 = [&](const std::string& name, int of, const char* long_name) {
    numbers(name, of, "1", long_name, [](std::size_t i) { return static_cast<Index>(i + 1); });
  };
  const auto places = [&](const std::string& of, const std::string& whose, int rows, const LonLat& known,
                          const auto& point) {
    numbers("lat" + of, rows, "rad", "latitude of the " + whose, [&known, point](std::size_t i) {
      const Point p = point(i);
      return known.empty() ? std::atan2(p.z, std::sqrt(p.x * p.x + p.y * p.y)) : known.lat[i];
    });
    numbers("lon" + of, rows, "rad", "longitude of the " + whose, [&known, point](std::size_t i) {
      const Point p = point(i);
      return from_0(known.empty() ? std::atan2(p.y, p.x) : known.lon[i]);
    });
    for (const auto& [axis, component] :
         {std::pair("x", &Point::x), std::pair("y", &Point::y), std::pair("z", &Point::z)})
      numbers(axis + of, rows, "m", fmt::format("Cartesian {} coordinate of the {}", axis, whose),
              [radius, point, part = component](std::size_t i) { return radius * (point(i).*part); });
  };

  const LonLat given = values.given.empty() ? LonLat() : angles_of(mesh.cells, values.given, false), none;
  const std::vector<double>& density = values.density;
  const double densest =
      density.empty() ? 1 : std::max(1.0, *std::max_element(density.begin(), density.end()));
  places("Cell", "cell", cells, given, [&](std::size_t c) { return mesh.cells[c]; });
  numbers("areaCell", cells, "m2", "area of the cell", [&](std::size_t c) { return square * mesh.areas[c]; });
  numbers("meshDensity", cells, "1", "density: (nominalMinDc / width of the cell)^4",
          [&](std::size_t c) { return density.empty() ? 1 : density[c] / densest; });
  numbers("gridSpacing", cells, "m", "mean distance to the neighbours of the cell", [&](std::size_t c) {
    double sum = 0;
    for (std::size_t j = 0; j < mesh.sides(c); ++j)
      sum += mesh.distances[at(mesh.edges_on_cell[mesh.row(c, j)])];
    return radius * sum / static_cast<double>(mesh.sides(c));
  });
  numbers("cellQuality", cells, "1", "shortest over longest edge of the cell", [&](std::size_t c) {
    return evenness(mesh.sides(c), [&](std::size_t j) { return std::fabs(mesh.outflows[mesh.row(c, j)]); });
  });
  count_from_1("indexToCellID", cells, "number of the cell");
  numbers("nEdgesOnCell", cells, "1", "number of edges of the cell",
          [&](std::size_t c) { return static_cast<Index>(mesh.sides(c)); });
  const auto of_sides = [&](const char* name, const char* long_name, const auto& index) {
    table(Index{}, name, {cells, sides}, "1", long_name, [=, &mesh](std::size_t c, Index* to) {
      for (std::size_t j = 0; j < mesh.sides(c); ++j) to[j] = index(mesh.row(c, j), c) + 1;
    });
  };
  of_sides("cellsOnCell", "cells around the cell",
           [&](std::size_t row, std::size_t c) { return mesh.across(mesh.edges_on_cell[row], c); });
  of_sides("edgesOnCell", "edges of the cell",
           [&](std::size_t row, std::size_t) { return mesh.edges_on_cell[row]; });
  of_sides("verticesOnCell", "vertices of the cell",
           [&](std::size_t row, std::size_t) { return mesh.vertices_on_cell[row]; });

  std::vector<Point> points(mesh.cells_on_edge.size());
  pstripack::parallel_for(points.size(), 10 * points.size(),
                          [&](std::size_t e) { points[e] = mesh.edge_point(e); });
  places("Edge", "edge", edges, none, [&](std::size_t e) { return points[e]; });
  numbers("angleEdge", edges, "rad", "angle from east to the normal of the edge",
          [&](std::size_t e) { return mesh.angle(e, points[e]); });
  numbers("dcEdge", edges, "m", "distance of the cells of the edge",
          [&](std::size_t e) { return radius * mesh.distances[e]; });
  numbers("dvEdge", edges, "m", "length of the edge: distance of its vertices",
          [&](std::size_t e) { return radius * mesh.widths[e]; });
  count_from_1("indexToEdgeID", edges, "number of the edge");
  numbers("nEdgesOnEdge", edges, "1", "number of edges that give the tangential velocity",
          [&](std::size_t e) {
            Index count = 0;
            for (const Index c : mesh.cells_on_edge[e])
              if (c != MpasMesh::kNone) count += static_cast<Index>(mesh.sides(at(c))) - 1;
            return count;
          });
  indices("cellsOnEdge", edges, two, "cells on both sides of the edge", mesh.cells_on_edge);
  indices("verticesOnEdge", edges, two, "vertices at the ends of the edge", mesh.vertices_on_edge);
  table(Index{}, "edgesOnEdge", {edges, around}, "1", "edges that give the tangential velocity",
        [&](std::size_t e, Index* to) {
          mesh.for_each_around(e, [&](Index other, double) { *to++ = other + 1; });
        });
  table(0.0, "weightsOnEdge", {edges, around}, "1", "weights of these edges", [&](std::size_t e, double* to) {
    mesh.for_each_around(e, [&](Index, double weight) { *to++ = weight; });
  });

  places("Vertex", "vertex", vertices, none, [&](std::size_t v) { return mesh.vertices[v]; });
  numbers("areaTriangle", vertices, "m2", "area of the triangle around the vertex",
          [&](std::size_t v) { return square * mesh.triangle_area(v); });
  numbers("triangleQuality", vertices, "1", "shortest over longest side of the triangle", [&](std::size_t v) {
    const MpasMesh::Three& of_v = mesh.edges_on_vertex[v];
    return evenness(of_v[2] == MpasMesh::kNone ? 2 : 3,
                    [&](std::size_t j) { return mesh.distances[at(of_v[j])]; });
  });
  numbers("triangleAngleQuality", vertices, "1", "least over largest angle of the triangle",
          [&](std::size_t v) {
            if (mesh.is_at_boundary(v)) return 0.0;
            const pstripack::Angles angles = mesh.angles(v);
            return evenness(3, [&](std::size_t j) { return angles.at[j]; });
          });
  count_from_1("indexToVertexID", vertices, "number of the vertex");
  numbers("boundaryVertex", vertices, "1", "1: the vertex lies at the boundary",
          [&](std::size_t v) { return Index{mesh.is_at_boundary(v)}; });
  numbers("obtuseTriangle", vertices, "1", "1: the triangle does not hold the vertex",
          [&](std::size_t v) { return Index{!mesh.is_at_boundary(v) && !mesh.angles(v).are_acute}; });
  indices("cellsOnVertex", vertices, three, "cells that meet at the vertex", mesh.cells_on_vertex);
  indices("edgesOnVertex", vertices, three, "edges that meet at the vertex", mesh.edges_on_vertex);
  table(0.0, "kiteAreasOnVertex", {vertices, three}, "m2", "areas that the triangle shares with these cells",
        [&](std::size_t v, double* to) {
          for (const double area : mesh.kites[v]) *to++ = square * area;
        });

  // In a limited area: the least number of the cells.
  const std::vector<Index>& layers = values.layers;
  const auto least = [&](const char* name, int rows, const auto& cells_on) {
    numbers(name, rows, "1", "least bdyMaskCell of its cells", [&](std::size_t i) {
      Index number = kLayers;
      for (const Index c : cells_on[i])
        if (c != MpasMesh::kNone) number = std::min(number, layers[at(c)]);
      return number;
    });
  };
  if (!layers.empty()) {
    numbers(kBdyMaskCell, cells, "1", "0: region, 1 to 7: layers around it",
            [&](std::size_t c) { return layers[c]; });
    least("bdyMaskEdge", edges, mesh.cells_on_edge);
    least("bdyMaskVertex", vertices, mesh.cells_on_vertex);
  }
  const double nominal = radius * values.nominal / std::sqrt(std::sqrt(densest));
  if (nominal > 0)
    table(0.0, "nominalMinDc", {}, "m", "width of cells of density 1",
          [=](std::size_t, double* to) { *to = nominal; });
  out.write();
  write_graph(file, mesh.cells.size(), [&](std::size_t c, const auto& take) {
    for (std::int32_t k = mesh.begin[c]; k < mesh.begin[c + 1]; ++k)
      if (const std::int32_t other = mesh.across(mesh.edges_on_cell[static_cast<std::size_t>(k)], c);
          other >= 0)
        take(other + 1);
  });
}

void write_mpas(OutputFile& file, const Mesh& mesh) {
  std::vector<std::size_t> kept;
  const MpasMesh complete = mpas_mesh(mesh, kept);
  if (kept.empty()) return write_mpas(file, complete, mesh);
  write_mpas(file, complete, at_nodes(mesh, kept));
}

}  // namespace files
