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

/// The format named by --to, else that of the longest suffix of `file` in the table.
std::optional<Format> format_of(const std::string& to, const std::string& file);

/// Writes a triangulation.
void write_mesh(const OutputFile& file, Format format, const Mesh& mesh);
/// The same for any polygons: ugrid, scrip, vtu, off. Other formats throw std::runtime_error.
void write_faces(const OutputFile& file, Format format, const Faces& faces);
/// Writes nodes alone: xyz, lonlat, netcdf, raw. NetCDF also holds density and notes.
void write_nodes(const OutputFile& file, Format format, const std::vector<Point>& points,
                 const std::vector<double>& density = {}, const Notes& notes = {});

/// Longitudes and latitudes: of unit vectors, -180 to 180 and -90 to 90 degrees, or in radians.
struct LonLat {
  LonLat() = default;
  LonLat(const std::vector<Point>& points, bool degrees);
  std::vector<double> lon, lat;
};

/// A grid of longitudes and latitudes, in degrees.
struct Grid {
  std::vector<double> lon, lat;
  LonLat places() const;  ///< of all its points, row after row of latitude
};

/// A value at each place; NaN: missing.
struct Field {
  std::string name = "value", units;
  std::vector<double> values;
};

/// Text: lines of lon lat (degrees) value, `nan` where it is missing.
void write_field(const OutputFile& file, const LonLat& places, const Field& field);
/// NetCDF, CF conventions: _FillValue where it is missing.
void write_netcdf_field(const OutputFile& file, const LonLat& places, const Field& field);
void write_netcdf_grid(const OutputFile& file, const Grid& grid, const Field& field);

// In netcdf_meshes.cpp.
void write_ugrid(const OutputFile& file, const Faces& faces, const std::vector<Point>& vectors,
                 const std::vector<double>& density = {}, const Notes& notes = {});
void write_scrip(const OutputFile& file, const Faces& faces);
void write_mpas(const OutputFile& file, const Mesh& mesh);
void write_netcdf_nodes(const OutputFile& file, const std::vector<Point>& points,
                        const std::vector<double>& density, const Notes& notes);

}  // namespace files
