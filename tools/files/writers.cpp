#include "files/writers.h"

#include <algorithm>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace files {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

[[noreturn]] void refuse(const OutputFile& file, Format format, const char* why) {
  for (const FormatEntry& f : formats())
    if (f.format == format) throw std::runtime_error(file.name() + ": " + f.name + " " + why);
  throw std::logic_error("a format that is not in the table");
}

/// First the points, then the faces.
void write_off(TextWriter& out, const Faces& faces, int section) {
  if (section == 0) {
    if (faces.share_of_points.before == 0)
      out.print("OFF\n{} {} 0\n", faces.share_of_points.total(faces.points.size()),
                faces.share_of_faces.total(faces.size()));
    for (const Point& p : faces.points) out.print("{} {} {}\n", p.x, p.y, p.z);
    return;
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    out.print("{}", faces.corners(f));
    for (std::size_t k = faces.begin[f]; k < faces.begin[f + 1]; ++k) out.print(" {}", faces.corner[k] - 1);
    out.print("\n");
  }
}

void write_off(const OutputFile& file, const Faces& faces) {
  TextWriter out(file);
  for (int section = 0; section < sections_of(Format::off); ++section) write_off(out, faces, section);
  out.close();
}

/// The columns, and before them the angles as they were given.
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

/// Without characters that have a meaning in XML or end a string of gmsh.
std::string plain_name(std::string name) {
  for (char& c : name)
    if (std::strchr("<>&\"'\n", c) != nullptr) c = '_';
  return name;
}

void write_gmsh(const OutputFile& file, const Faces& faces) {
  TextWriter out(file);
  out.print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", faces.points.size());
  for (std::size_t i = 0; i < faces.points.size(); ++i)
    out.print("{} {} {} {}\n", i + 1, faces.points[i].x, faces.points[i].y, faces.points[i].z);
  out.print("$EndNodes\n$Elements\n{}\n", faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::int32_t* const c = &faces.corner[3 * f];
    out.print("{} 2 2 1 1 {} {} {}\n", f + 1, c[0], c[1], c[2]);  // a triangle with two tags
  }
  out.print("$EndElements\n");
  const auto write_data = [&](const char* section, const Columns& columns) {
    for (const Column& c : columns) {
      if (c.is_text()) continue;  // gmsh has numbers only
      out.print("${}\n1\n\"{}\"\n1\n0\n3\n0\n1\n{}\n", section, plain_name(c.name), c.size());
      for (std::size_t i = 0; i < c.size(); ++i) out.print("{} {}\n", i + 1, c.numbers[i]);
      out.print("$End{}\n", section);
    }
  };
  write_data("NodeData", with_angles(faces.columns_of_points, faces.given_points));
  write_data("ElementData", faces.columns_of_faces);
  out.close();
}

/// VTK's XML, unstructured, as text.
void write_vtu(const OutputFile& file, const Faces& faces) {
  const bool triangles = faces.most_corners() == 3;
  TextWriter out(file);
  const auto begin = [&](const char* type, const char* name) {
    out.print("<DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">\n", type, name);
  };
  const auto end = [&] { out.print("</DataArray>\n"); };
  out.print(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
      "<Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n",
      faces.points.size(), faces.size());
  for (const Point& p : faces.points) out.print("{} {} {}\n", p.x, p.y, p.z);
  end();
  out.print("</Points>\n<Cells>\n");
  begin("Int32", "connectivity");
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t k = faces.begin[f]; k < faces.begin[f + 1]; ++k)
      out.print(k == faces.begin[f] ? "{}" : " {}", faces.corner[k] - 1);
    out.print("\n");
  }
  end();
  begin("Int64", "offsets");
  for (std::size_t f = 0; f < faces.size(); ++f) out.print("{}\n", faces.begin[f + 1]);
  end();
  begin("UInt8", "types");
  for (std::size_t f = 0; f < faces.size(); ++f) out.print("{}\n", triangles ? 5 : 7);
  end();
  out.print("</Cells>\n");
  const auto write_data = [&](const char* section, const Columns& columns) {
    out.print("<{}>\n", section);
    for (const Column& c : columns) {
      if (c.is_text()) continue;  // many readers of VTK know numbers only
      begin(c.whole ? "Int32" : "Float64", plain_name(c.name).c_str());
      for (const double v : c.numbers) out.print("{}\n", v);
      end();
    }
    out.print("</{}>\n", section);
  };
  write_data("PointData", with_angles(faces.columns_of_points, faces.given_points));
  write_data("CellData", with_angles(faces.columns_of_faces, faces.given_centres));
  out.print("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  out.close();
}

/// In the format that `stripack-compare lists` reads.
void write_lists(const OutputFile& file, const Mesh& mesh) {
  TextWriter out(file);
  const auto all = [&](const std::vector<std::int32_t>& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      out.print(i % 12 == 11 || i + 1 == count ? "{}\n" : "{} ", values[i]);
  };
  const auto slots = static_cast<std::size_t>(mesh.lnew) - 1;
  out.print("{} {}\n", mesh.points.size(), mesh.lnew);
  all(mesh.list, slots);
  all(mesh.lptr, slots);
  all(mesh.lend, mesh.points.size());
  out.close();
}

}  // namespace

const std::vector<FormatEntry>& formats() {
  static const std::vector<FormatEntry> table{
      {Format::ugrid, "ugrid", ".nc .ugrid.nc", "NetCDF, UGRID conventions: start_index 1, _FillValue -1"},
      {Format::mpas, "mpas", ".mpas.nc", "NetCDF, input of MPAS' mesh converter (triangles only)"},
      {Format::scrip, "scrip", ".scrip.nc", "NetCDF, SCRIP grid of the faces"},
      {Format::vtu, "vtu", ".vtu", "VTK unstructured grid, for ParaView"},
      {Format::off, "off", ".off", "Object File Format"},
      {Format::gmsh, "gmsh", ".msh", "gmsh 2.2, text (triangles only)"},
      {Format::lists, "lists", ".lists", "N LNEW, LIST, LPTR, LEND as text (triangles only)"},
      {Format::xyz, "xyz", ".xyz .txt", "nodes: text, lines of x y z"},
      {Format::lonlat, "lonlat", ".lonlat", "nodes: text, lines of lon lat in degrees"},
      {Format::netcdf, "nodes", ".nodes.nc", "nodes: NetCDF, lon, lat and xCell, yCell, zCell"},
      {Format::raw, "raw", ".raw .bin .f64", "nodes: x y z as raw doubles in this machine's byte order"}};
  return table;
}

bool holds_a_mesh(Format format) { return format < Format::xyz; }

bool holds_parts(Format format) {
  return !holds_a_mesh(format) || format == Format::ugrid || format == Format::mpas || format == Format::off;
}

int sections_of(Format format) { return format == Format::off ? 2 : 1; }

void write_part(const OutputFile& file, Format format, const MeshPart& part, int section) {
  if (format == Format::mpas) return write_mpas(file, part);
  if (!holds_a_mesh(format))
    return write_nodes(file, format, part.nodes_here(),
                       {{}, part.density, part.columns, part.notes, part.share_of_nodes});
  if (format == Format::ugrid)
    return write_ugrid(file, triangle_faces(part), part.nodes_here(), part.density, part.notes);
  if (format != Format::off) refuse(file, format, "cannot be written by several ranks");
  TextWriter out(file);
  write_off(out, triangle_faces(part), section);
  out.close();
}

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

void write_faces(const OutputFile& file, Format format, const Faces& faces, const Notes& notes) {
  switch (format) {
    case Format::ugrid:
      return write_ugrid(file, faces, faces.points, {}, notes);
    case Format::scrip:
      return write_scrip(file, faces, notes);
    case Format::vtu:
      return write_vtu(file, faces);
    case Format::off:
      return write_off(file, faces);
    default:
      refuse(file, format, "cannot hold polygons: --to ugrid, scrip, vtu or off can");
  }
}

void write_mesh(const OutputFile& file, Format format, const Mesh& mesh) {
  if (format == Format::mpas) return write_mpas(file, mesh);
  if (format == Format::lists) return write_lists(file, mesh);
  if (!holds_a_mesh(format))
    refuse(file, format, "holds nodes, not a mesh: `pstripack convert` writes nodes");
  Faces faces = triangle_faces(mesh);
  if (format == Format::ugrid || format == Format::vtu || format == Format::gmsh) add_columns(faces, mesh);
  if (format == Format::ugrid) return write_ugrid(file, faces, mesh.points, mesh.density, mesh.notes);
  if (format == Format::gmsh) return write_gmsh(file, faces);
  write_faces(file, format, faces, mesh.notes);
}

void write_nodes(const OutputFile& file, Format format, const std::vector<Point>& points,
                 const std::vector<double>& density, const Notes& notes) {
  write_nodes(file, format, points, {{}, density, {}, notes});
}

void write_nodes(const OutputFile& file, Format format, const std::vector<Point>& points,
                 const NodeValues& values) {
  if (format == Format::netcdf) return write_netcdf_nodes(file, points, values);
  if (holds_a_mesh(format)) refuse(file, format, "holds a mesh, and here are nodes only: use `triangulate`");
  TextWriter out(file);
  if (format == Format::raw) {
    out.write(points.data(), points.size() * sizeof(Point));
  } else if (format == Format::xyz) {
    for (const Point& p : points) out.print("{} {} {}\n", p.x, p.y, p.z);
  } else {
    const LonLat angles = angles_of(points, values.given, true);
    for (std::size_t i = 0; i < points.size(); ++i) out.print("{} {}\n", angles.lon[i], angles.lat[i]);
  }
  out.close();
}

namespace {

/// As text_table.h reads it.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += c;
    result += c == '\n' ? ' ' : c;
  }
  return result + '"';
}

}  // namespace

void write_field(const OutputFile& file, const LonLat& places, const Field& field) {
  TextWriter out(file);
  const auto name = [](const Column& c) {
    return c.units.empty() ? c.name : fmt::format("{} [{}]", c.name, c.units);
  };
  out.print("# lon lat {}", name(field.value));
  for (const Column& c : field.columns) out.print(" {}", name(c));
  out.print("\n");
  for (std::size_t i = 0; i < field.value.size(); ++i) {
    out.print("{} {} {}", places.lon[i], places.lat[i], field.value.numbers[i]);
    for (const Column& c : field.columns)
      if (c.is_text())
        out.print(" {}", quoted(c.texts[i]));
      else
        out.print(" {}", c.numbers[i]);
    out.print("\n");
  }
  out.close();
}

LonLat Grid::places() const {
  LonLat all;
  for (const double y : lat)
    for (const double x : lon) {
      all.lon.push_back(x);
      all.lat.push_back(y);
    }
  return all;
}

}  // namespace files
