#pragma once
// Writers of meshes and nodes.

#include <optional>
#include <string>
#include <vector>

#include "files/mesh.h"
#include "files/output_file.h"
#include "files/weights.h"

namespace files {

/// Formats of meshes, of meshes and nodes, and of nodes.
enum class Format {
  ugrid,
  mpas,
  scrip,
  esmf,
  vtu,
  off,
  gmsh,
  fesom,
  lists,
  gmt,
  geojson,
  csv,
  xyz,
  lonlat,
  netcdf,
  raw
};

struct FormatEntry {
  Format format;
  const char* name;
  const char* suffixes;  ///< separated by blanks
  const char* what;
};

/// All formats, in the order of Format, for --help and --to and for the choice by suffix.
const std::vector<FormatEntry>& formats();
bool holds_a_mesh(Format format);
bool holds_nodes(Format format);

/// The format named by --to, else that of the longest suffix of `file` in the table.
std::optional<Format> format_of(const std::string& to, const std::string& file);

/// Writes a triangulation. UGRID, VTU, gmsh, GMT, GeoJSON and CSV also hold its columns.
void write_mesh(OutputFile& file, Format format, const Mesh& mesh);
/// Writes any polygons: ugrid, scrip, esmf, vtu, off, gmt, geojson, csv. Throws std::runtime_error for other
/// formats.
void write_faces(OutputFile& file, Format format, const Faces& faces, const Notes& notes = {});
/// Writes nodes alone: geojson, csv, xyz, lonlat, netcdf, raw. NetCDF also holds density, columns and notes,
/// GeoJSON columns and notes, CSV columns.
void write_nodes(OutputFile& file, Format format, const std::vector<Point>& points,
                 const NodeValues& values = {});

/// Values at places (NaN: missing), and the columns of the places.
struct Field {
  Column value;
  Columns columns;
  Notes notes;

  Columns table() const {
    Columns all{value};
    all.insert(all.end(), columns.begin(), columns.end());
    return all;
  }
};

/// Text: lines of lon lat (degrees), value and columns, `nan` for a missing number. CSV: the same columns.
void write_field(OutputFile& file, const LonLat& places, const Field& field);
void write_csv_field(OutputFile& file, const LonLat& places, const Field& field);
/// NetCDF with CF conventions; a missing value is _FillValue. `grid`: that of the places, or empty.
void write_netcdf_field(OutputFile& file, const LonLat& places, const Grid& grid, const Field& field);

/// The nodes or the places of weights.
struct WeightsEnd {
  LonLat at;                         ///< in degrees
  std::vector<std::size_t> numbers;  ///< of each in the file, from 1; empty: 1, 2, 3 ...
  std::vector<std::size_t> shape;    ///< of all in the file; empty: a list of these
  Grid edges;                        ///< between the cells, if the places are a grid

  std::size_t number(std::size_t i) const { return numbers.empty() ? i + 1 : numbers[i]; }
};

/// Writes weights as ESMF_RegridWeightGen does: the value of place row[k] has the part S[k] of that of node
/// col[k]. Nodes and places that are in the file but not here have the mask 0.
void write_weights(OutputFile& file, const Weights& weights, const WeightsEnd& nodes,
                   const WeightsEnd& places, const std::string& history);

// In netcdf_meshes.cpp.
/// `vectors`: the corners with their given lengths.
void write_ugrid(OutputFile& file, const Faces& faces, const std::vector<Point>& vectors,
                 const std::vector<double>& density = {}, const Notes& notes = {});
void write_scrip(OutputFile& file, const Faces& faces, const Notes& notes = {});
void write_esmf(OutputFile& file, const Faces& faces, const Notes& notes = {});
void write_netcdf_nodes(OutputFile& file, const std::vector<Point>& points, const NodeValues& values);

// In netcdf_mpas.cpp.
struct MpasMesh;
/// `values`: of the cells. Writes the mesh, and beside a file with a name its graph for METIS.
void write_mpas(OutputFile& file, const MpasMesh& mesh, const NodeValues& values);
/// True if the file, not through a pipe, is an MPAS mesh with all lists of neighbours.
bool is_mpas_mesh(const Nodes& nodes);
/// Writes the cells of a limited area of the MPAS mesh in `from`, by `layers` of its cells: all variables, of
/// cells, edges and vertices the rows that stay, in the same order, with new numbers in lists of neighbours;
/// bdyMaskCell, and which rows they were; the graph as write_mpas().
void write_mpas_area(OutputFile& file, const std::string& from, const std::vector<std::int32_t>& layers,
                     const Notes& notes);
/// Nodes at the boundary of the triangulation are left out: they have no whole cells.
void write_mpas(OutputFile& file, const Mesh& mesh);

}  // namespace files
