#include "files/writers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "files/map_rings.h"
#include "files/text_file.h"

namespace files {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

[[noreturn]] void refuse(OutputFile& file, Format format, const char* why) {
  fail(file.name(), "{} {}", formats()[static_cast<std::size_t>(format)].name, why);
}

/// The corners of a face, counted from 0.
std::vector<std::int32_t> corners_from_0(const Faces& faces, std::size_t f) {
  const std::int32_t* const all = faces.corner.data();
  std::vector<std::int32_t> corners(all + faces.begin[f], all + faces.begin[f + 1]);
  for (std::int32_t& corner : corners) --corner;
  return corners;
}

void write_off(OutputFile& file, const Faces& faces) {
  file.print("OFF\n{} {} 0\n", faces.points.size(), faces.size());
  for (const Point& p : faces.points) file.print("{} {} {}\n", p.x, p.y, p.z);
  for (std::size_t f = 0; f < faces.size(); ++f)
    file.print("{} {}\n", faces.corners(f), fmt::join(corners_from_0(faces, f), " "));
}

/// The columns, preceded by the given longitudes and latitudes.
Columns with_angles(const Columns& columns, const LonLat& given) {
  Columns all;
  if (!given.empty()) {
    const char* const units = given.degrees ? "degrees" : "radians";
    all.push_back({"lon", "longitude as it was given", units, given.lon});
    all.push_back({"lat", "latitude as it was given", units, given.lat});
  }
  for (const Column& c : columns)
    if (find(all, c.name) == nullptr) all.push_back(c);
  return all;
}

/// Removes characters that XML reserves or that end a string of gmsh.
std::string plain_name(std::string name) {
  for (char& c : name)
    if (std::strchr("<>&\"'\n", c) != nullptr) c = '_';
  return name;
}

void write_gmsh(OutputFile& file, const Faces& faces) {
  file.print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", faces.points.size());
  for (std::size_t i = 0; i < faces.points.size(); ++i)
    file.print("{} {} {} {}\n", i + 1, faces.points[i].x, faces.points[i].y, faces.points[i].z);
  file.print("$EndNodes\n$Elements\n{}\n", faces.size());
  const std::int32_t* const corners = faces.corner.data();
  for (std::size_t f = 0; f < faces.size(); ++f)  // type 2, a triangle, with two tags
    file.print("{} 2 2 1 1 {}\n", f + 1, fmt::join(corners + 3 * f, corners + 3 * f + 3, " "));
  file.print("$EndElements\n");
  const auto write_data = [&](const char* section, const Columns& columns) {
    for (const Column& c : columns) {
      if (c.is_text()) continue;  // gmsh stores numbers only
      file.print("${}\n1\n\"{}\"\n1\n0\n3\n0\n1\n{}\n", section, plain_name(c.name), c.size());
      for (std::size_t i = 0; i < c.size(); ++i) file.print("{} {}\n", i + 1, c.numbers[i]);
      file.print("$End{}\n", section);
    }
  };
  write_data("NodeData", with_angles(faces.columns_of_points, faces.given_points));
  write_data("ElementData", faces.columns_of_faces);
}

/// VTK's XML format for unstructured grids, as text.
void write_vtu(OutputFile& file, const Faces& faces) {
  const bool triangles = faces.most_corners() == 3;
  const auto begin = [&](const char* type, const char* name) {
    file.print("<DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">\n", type, name);
  };
  const auto end = [&] { file.print("</DataArray>\n"); };
  file.print(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
      "<Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n",
      faces.points.size(), faces.size());
  for (const Point& p : faces.points) file.print("{} {} {}\n", p.x, p.y, p.z);
  end();
  file.print("</Points>\n<Cells>\n");
  begin("Int32", "connectivity");
  for (std::size_t f = 0; f < faces.size(); ++f) file.print("{}\n", fmt::join(corners_from_0(faces, f), " "));
  end();
  begin("Int64", "offsets");
  for (std::size_t f = 0; f < faces.size(); ++f) file.print("{}\n", faces.begin[f + 1]);
  end();
  begin("UInt8", "types");
  for (std::size_t f = 0; f < faces.size(); ++f) file.print("{}\n", triangles ? 5 : 7);
  end();
  file.print("</Cells>\n");
  const auto write_data = [&](const char* section, const Columns& columns) {
    file.print("<{}>\n", section);
    for (const Column& c : columns) {
      if (c.is_text()) continue;  // many readers of VTK accept numbers only
      begin(c.whole ? "Int32" : "Float64", plain_name(c.name).c_str());
      for (const double v : c.numbers) file.print("{}\n", v);
      end();
    }
    file.print("</{}>\n", section);
  };
  write_data("PointData", with_angles(faces.columns_of_points, faces.given_points));
  write_data("CellData", with_angles(faces.columns_of_faces, faces.given_centres));
  file.print("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

/// The format that `stripack-compare lists` reads.
void write_lists(OutputFile& file, const Mesh& mesh) {
  const auto all = [&](const std::vector<std::int32_t>& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      file.print(i % 12 == 11 || i + 1 == count ? "{}\n" : "{} ", values[i]);
  };
  const auto slots = static_cast<std::size_t>(mesh.lnew) - 1;
  file.print("{} {}\n", mesh.points.size(), mesh.lnew);
  all(mesh.list, slots);
  all(mesh.lptr, slots);
  all(mesh.lend, mesh.points.size());
}

/// Nodes with 1 at the boundary, else 0, and in a file beside them the triangles.
void write_fesom(OutputFile& file, const Mesh& mesh) {
  const std::string nodes = "nod2d.out";
  if (!file.has_a_name() || !ends_with("/" + file.name(), nodes))
    refuse(file, Format::fesom, "has files called nod2d.out and elem2d.out: say -o nod2d.out");
  const LonLat angles = angles_of(mesh.points, mesh.given, true);
  file.print("{}\n", mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    file.print("{} {} {} {}\n", i + 1, wrapped(angles.lon[i]), angles.lat[i],
               mesh.list[static_cast<std::size_t>(mesh.lend[i]) - 1] < 0 ? 1 : 0);
  OutputFile beside(file.name().substr(0, file.name().size() - nodes.size()) + "elem2d.out");
  const std::vector<std::int32_t> triangles = triangles_of(mesh);
  beside.print("{}\n", triangles.size() / 3);
  for (std::size_t k = 0; k < triangles.size(); k += 3)
    beside.print("{} {} {}\n", triangles[k], triangles[k + 1], triangles[k + 2]);
  beside.commit();
}

/// The table of a CSV file. A row of a cell: the coordinates and columns of its node. A row of a triangle:
/// the numbers of its corners in the input, node1 to node3, and its columns.
Columns table_of(const Faces& faces) {
  if (!faces.centres.empty())
    return with_angles(faces.columns_of_faces, angles_of(faces.centres, faces.given_centres, true));
  Columns table;
  const Column* const numbers = find(faces.columns_of_points, "node");
  for (std::size_t k = 0; k < 3; ++k) {
    Column& column = table.emplace_back(whole_numbers(fmt::format("node{}", k + 1), "", {}));
    for (std::size_t i = k; i < faces.corner.size(); i += 3)
      column.numbers.push_back(numbers == nullptr
                                   ? faces.corner[i]
                                   : numbers->numbers[static_cast<std::size_t>(faces.corner[i]) - 1]);
  }
  table.insert(table.end(), faces.columns_of_faces.begin(), faces.columns_of_faces.end());
  return table;
}

Columns table_of(const std::vector<Point>& points, const NodeValues& values) {
  Columns columns = values.columns;
  if (values.given.empty())
    for (const auto& [name, component] :
         {std::pair("x", &Point::x), std::pair("y", &Point::y), std::pair("z", &Point::z)}) {
      Column column{name};
      for (const Point& p : points) column.numbers.push_back(p.*component);
      columns.push_back(std::move(column));
    }
  return with_angles(columns, angles_of(points, values.given, true));
}

/// The text in double quotes; a `mark` precedes the characters `marked`.
std::string quoted(const std::string& text, std::string_view marked, char mark) {
  std::string result = "\"";
  for (const char c : text) {
    if (marked.find(c) != marked.npos) result += mark;
    result += c;
  }
  return result + '"';
}

/// text_table.h reads line by line.
std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// Quotes the text if RFC 4180 requires it.
std::string csv_text(const std::string& text) {
  const std::string line = on_one_line(text);
  const bool has_end_blanks = !line.empty() && (line.front() == ' ' || line.back() == ' ');
  return has_end_blanks || line.find_first_of(",;\"\t#") != line.npos ? quoted(line, "\"", '"') : line;
}

std::string blank_text(const std::string& text) { return quoted(on_one_line(text), "\"", '"'); }
std::string gmt_text(const std::string& text) { return quoted(on_one_line(text), "\"|\\", '\\'); }
std::string json_text(const std::string& text) {
  using nlohmann::json;
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Row i of the column; `missing` stands for NaN. `as_written`: numbers as they stand in the input.
void print_cell(OutputFile& out, const Column& column, std::size_t i, std::string (*text)(const std::string&),
                const char* missing, bool as_written = false) {
  if (column.is_text() || (as_written && !column.texts.empty()))
    out.print("{}", text(column.texts[i]));
  else if (std::isnan(column.numbers[i]))
    out.print("{}", missing);
  else
    out.print("{}", column.numbers[i]);
}

/// The cells of row i, each but the first after the separator.
void print_row(OutputFile& out, const Columns& table, std::size_t i, const char* separator,
               std::string (*text)(const std::string&), const char* missing, bool as_written = false) {
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (k > 0) out.print("{}", separator);
    print_cell(out, table[k], i, text, missing, as_written);
  }
}

/// The header line has units in the form that text_table.h reads. A missing value is an empty cell.
void write_csv(OutputFile& file, const Columns& table) {
  std::vector<std::string> names;
  for (const Column& c : table) {
    const bool has_units = !c.units.empty() && !ends_with(c.name, "_" + c.units) && c.units != "degrees";
    names.push_back(csv_text(has_units ? c.name + " [" + c.units + "]" : c.name));
  }
  file.print("{}\n", fmt::join(names, ","));
  for (std::size_t i = 0; i < table[0].size(); ++i) {
    print_row(file, table, i, ",", csv_text, "", true);
    file.print("\n");
  }
}

/// One line per feature (RFC 7946). `write_geometry(file, i)` writes the geometry of feature i.
template <class WriteGeometry>
void write_features(OutputFile& file, const Columns& table, const Notes& notes,
                    const WriteGeometry& write_geometry) {
  std::vector<std::string> names;
  for (const Column& c : table) names.push_back(json_text(c.name));
  file.print("{{\"type\":\"FeatureCollection\",");
  for (const auto& [name, text] : notes) file.print("{}:{},", json_text(name), json_text(text));
  file.print("\"features\":[");
  for (std::size_t i = 0; i < table[0].size(); ++i) {
    file.print("{}\n{{\"type\":\"Feature\",\"properties\":{{", i == 0 ? "" : ",");
    for (std::size_t k = 0; k < table.size(); ++k) {
      file.print("{}{}:", k == 0 ? "" : ",", names[k]);
      print_cell(file, table[k], i, json_text, "null");
    }
    file.print("}},\"geometry\":");
    write_geometry(i);
    file.print("}}");
  }
  file.print("\n]}}\n");
}

/// A Polygon or a MultiPolygon; null if there is none.
void write_polygons(OutputFile& out, const std::vector<MapRing>& parts) {
  if (parts.empty()) return out.print("null");
  const bool is_one = parts.size() == 1;
  out.print("{{\"type\":\"{}Polygon\",\"coordinates\":{}", is_one ? "" : "Multi", is_one ? "" : "[");
  for (std::size_t k = 0; k < parts.size(); ++k) {
    out.print(k > 0 ? ",[[" : "[[");
    for (std::size_t j = 0; j <= parts[k].size(); ++j) {
      const MapCorner& c = parts[k][j % parts[k].size()];
      out.print(j > 0 ? ",[{},{}]" : "[{},{}]", c.x(), c.lat);
    }
    out.print("]]");
  }
  out.print(is_one ? "}}" : "]}}");
}

/// Counterclockwise polygons, unless the variant says otherwise, cut at the dateline; null if all corners
/// coincide.
void write_geojson(OutputFile& file, const Faces& faces, const Notes& notes) {
  const MapLines lines(faces);
  write_features(file, table_of(faces), notes, [&](std::size_t f) {
    std::vector<MapRing> polygons = lines.polygons(f);
    for (MapRing& ring : polygons)
      if (faces.variant.clockwise) std::reverse(ring.begin(), ring.end());
    write_polygons(file, polygons);
  });
}

/// GMT's multi-segment files: one segment per polygon, with values as in its OGR/GMT format.
void write_gmt(OutputFile& file, const Faces& faces) {
  const Columns table = table_of(faces);
  const LonLat angles = angles_of(faces.points, faces.given_points, true);
  std::vector<std::string> names, types;
  for (const Column& c : table) {
    names.push_back(plain_name(c.name));
    types.emplace_back(c.is_text() ? "string" : c.whole ? "integer" : "double");
  }
  file.print("# @VGMT1.0 @GPOLYGON @Je4326\n# @N{}\n# @T{}\n# FEATURE_DATA\n", fmt::join(names, "|"),
             fmt::join(types, "|"));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    file.print(">\n# @D");
    print_row(file, table, f, "|", gmt_text, "NaN");
    file.print("\n# @P\n");
    for (std::size_t k = faces.begin[f]; k <= faces.begin[f + 1]; ++k) {
      const std::size_t slot = k < faces.begin[f + 1] ? k : faces.begin[f];
      const auto i = static_cast<std::size_t>(faces.corner[slot]) - 1;
      file.print("{}\t{}\n", angles.lon[i], angles.lat[i]);
    }
  }
}

}  // namespace

const std::vector<FormatEntry>& formats() {
  static const std::vector<FormatEntry> table{
      {Format::ugrid, "ugrid", ".nc .ugrid.nc", "NetCDF, UGRID conventions: start_index 1, _FillValue -1"},
      {Format::mpas, "mpas", ".mpas.nc",
       "NetCDF (CDF-5), complete mesh of MPAS, and .graph.info (triangles only)"},
      {Format::scrip, "scrip", ".scrip.nc", "NetCDF, SCRIP grid of the faces"},
      {Format::esmf, "esmf", ".esmf.nc", "NetCDF, ESMF unstructured grid of the faces"},
      {Format::vtu, "vtu", ".vtu", "VTK unstructured grid, for ParaView"},
      {Format::off, "off", ".off", "Object File Format"},
      {Format::gmsh, "gmsh", ".msh", "gmsh 2.2, text (triangles only)"},
      {Format::fesom, "fesom", ".nod2d.out", "nodes for FESOM, and .elem2d.out beside (triangles only)"},
      {Format::lists, "lists", ".lists", "N LNEW, LIST, LPTR, LEND as text (triangles only)"},
      {Format::gmt, "gmt", ".gmt", "GMT multi-segment polygons, values as in OGR/GMT"},
      {Format::geojson, "geojson", ".geojson .json",
       "GeoJSON (RFC 7946): polygons cut at the dateline; or nodes"},
      {Format::csv, "csv", ".csv", "table with a row for each triangle, cell or node"},
      {Format::xyz, "xyz", ".xyz .txt", "nodes: text, lines of x y z"},
      {Format::lonlat, "lonlat", ".lonlat", "nodes: text, lines of lon lat in degrees"},
      {Format::netcdf, "nodes", ".nodes.nc", "nodes: NetCDF, lon, lat and xCell, yCell, zCell"},
      {Format::raw, "raw", ".raw .bin .f64", "nodes: x y z as raw doubles in this machine's byte order"}};
  return table;
}

bool holds_a_mesh(Format format) { return format < Format::xyz; }
bool holds_nodes(Format format) { return format >= Format::geojson; }

std::optional<Format> format_of(const std::string& to, const std::string& file) {
  std::optional<Format> found;
  std::size_t longest = 0;
  for (const FormatEntry& f : formats()) {
    if (to == f.name) return f.format;
    std::istringstream suffixes(f.suffixes);
    for (std::string suffix; suffixes >> suffix;)
      if (ends_with(file, suffix) && suffix.size() > longest) found = f.format, longest = suffix.size();
  }
  return found;
}

void write_faces(OutputFile& file, Format format, const Faces& faces, const Notes& notes) {
  if (format == Format::ugrid) return write_ugrid(file, faces, faces.points, {}, notes);
  if (format == Format::scrip) return write_scrip(file, faces, notes);
  if (format == Format::esmf) return write_esmf(file, faces, notes);
  if (format == Format::vtu) return write_vtu(file, faces);
  if (format == Format::off) return write_off(file, faces);
  if (format == Format::gmt) return write_gmt(file, faces);
  if (format == Format::geojson) return write_geojson(file, faces, notes);
  if (format == Format::csv) return write_csv(file, table_of(faces));
  refuse(file, format, "cannot hold polygons: --to ugrid, scrip, esmf, vtu, off, gmt, geojson or csv can");
}

void write_mesh(OutputFile& file, Format format, const Mesh& mesh) {
  if (mesh.longest > 0 && (format == Format::mpas || format == Format::lists || format == Format::fesom))
    refuse(file, format, "holds whole triangulations: leave out --longest");
  if (format == Format::mpas) return write_mpas(file, mesh);
  if (format == Format::lists) return write_lists(file, mesh);
  if (format == Format::fesom) return write_fesom(file, mesh);
  if (!holds_a_mesh(format))
    refuse(file, format, "holds nodes, not a mesh: `pstripack convert` writes nodes");
  Faces faces = triangle_faces(mesh);
  if (format != Format::off && format != Format::scrip && format != Format::esmf) add_columns(faces, mesh);
  if (format == Format::ugrid) return write_ugrid(file, faces, mesh.points, mesh.density, mesh.notes);
  if (format == Format::gmsh) return write_gmsh(file, faces);
  write_faces(file, format, faces, mesh.notes);
}

void write_nodes(OutputFile& file, Format format, const std::vector<Point>& points,
                 const NodeValues& values) {
  if (format == Format::netcdf) return write_netcdf_nodes(file, points, values);
  if (format == Format::csv) return write_csv(file, table_of(points, values));
  if (format == Format::geojson) {
    const LonLat angles = angles_of(points, values.given, true);
    return write_features(file, table_of(points, values), values.notes, [&](std::size_t i) {
      file.print("{{\"type\":\"Point\",\"coordinates\":[{},{}]}}", wrapped(angles.lon[i]), angles.lat[i]);
    });
  }
  if (holds_a_mesh(format)) refuse(file, format, "holds a mesh, and here are nodes only: use `triangulate`");
  if (format == Format::raw) {
    file.write(points.data(), points.size() * sizeof(Point));
  } else if (format == Format::xyz) {
    for (const Point& p : points) file.print("{} {} {}\n", p.x, p.y, p.z);
  } else {
    const LonLat angles = angles_of(points, values.given, true);
    for (std::size_t i = 0; i < points.size(); ++i) file.print("{} {}\n", angles.lon[i], angles.lat[i]);
  }
}

void write_field(OutputFile& file, const LonLat& places, const Field& field) {
  const auto name = [](const Column& c) {
    return c.units.empty() ? c.name : fmt::format("{} [{}]", c.name, c.units);
  };
  const Columns table = field.table();
  file.print("# lon lat");
  for (const Column& c : table) file.print(" {}", name(c));
  file.print("\n");
  for (std::size_t i = 0; i < field.value.size(); ++i) {
    file.print("{} {} ", places.lon[i], places.lat[i]);
    print_row(file, table, i, " ", blank_text, "nan");
    file.print("\n");
  }
}

void write_csv_field(OutputFile& file, const LonLat& places, const Field& field) {
  write_csv(file, with_angles(field.table(), places));
}

}  // namespace files
