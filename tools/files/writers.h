#pragma once
// Writers of meshes and nodes.

#include <optional>
#include <string>
#include <vector>

#include "files/mesh.h"
#include "files/output_file.h"

namespace files {

enum class Format { ugrid, mpas, scrip, vtu, off, gmsh, lists, xyz, lonlat, netcdf, raw };

struct FormatEntry {
  Format format;
  const char* name;
  const char* suffixes;  ///< separated by blanks
  const char* what;
};

/// All formats: for --help, --to and the choice by suffix.
const std::vector<FormatEntry>& formats();
bool holds_a_mesh(Format format);
/// True if processes can write it one after the other.
bool holds_parts(Format format);

/// The format named by --to, else that of the longest suffix of `file` in the table.
std::optional<Format> format_of(const std::string& to, const std::string& file);

/// Writes a triangulation. UGRID, VTU and gmsh hold its columns.
void write_mesh(const OutputFile& file, Format format, const Mesh& mesh);
/// A part of a triangulation, behind those before: formats that hold parts. The processes write section 0 one
/// after the other, then section 1, up to sections_of(format).
int sections_of(Format format);
void write_part(const OutputFile& file, Format format, const MeshPart& part, int section);
/// The same for any polygons: ugrid, scrip, vtu, off. Other formats throw std::runtime_error.
void write_faces(const OutputFile& file, Format format, const Faces& faces, const Notes& notes = {});
/// What is known of nodes without a mesh.
struct NodeValues {
  LonLat given;
  std::vector<double> density;
  Columns columns;
  Notes notes;
  Share share = {};
};
/// Writes nodes alone: xyz, lonlat, netcdf, raw. NetCDF also holds density, columns and notes.
void write_nodes(const OutputFile& file, Format format, const std::vector<Point>& points,
                 const NodeValues& values);
void write_nodes(const OutputFile& file, Format format, const std::vector<Point>& points,
                 const std::vector<double>& density = {}, const Notes& notes = {});

/// A value at each place, and the other columns that the places have; NaN: missing.
struct Field {
  Column value;
  Columns columns;
  Notes notes;
};

/// Text: lines of lon lat (degrees), value and columns, `nan` where a number is missing.
void write_field(const OutputFile& file, const LonLat& places, const Field& field);
/// NetCDF, CF conventions: _FillValue where it is missing.
void write_netcdf_field(const OutputFile& file, const LonLat& places, const Field& field);
void write_netcdf_grid(const OutputFile& file, const Grid& grid, const Field& field);

// In netcdf_meshes.cpp.
/// `vectors`: the corners as they were given.
void write_ugrid(const OutputFile& file, const Faces& faces, const std::vector<Point>& vectors,
                 const std::vector<double>& density = {}, const Notes& notes = {});
void write_scrip(const OutputFile& file, const Faces& faces, const Notes& notes = {});
void write_mpas(const OutputFile& file, const Mesh& mesh);
void write_mpas(const OutputFile& file, const MeshPart& part);
void write_netcdf_nodes(const OutputFile& file, const std::vector<Point>& points, const NodeValues& values);

}  // namespace files
