#pragma once
// Nodes and meshes read from files.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "files/columns.h"
#include "mesh/triangulation.h"

namespace files {

using pstripack::Point;

enum class Container { detected, text, netcdf, geojson, raw };
enum class Coordinates { detected, xyz, lonlat };
enum class Units { said_or_unmistakable, degrees, radians };

struct ReadOptions {
  Container container = Container::detected;  ///< raw doubles are never detected
  Coordinates coordinates = Coordinates::detected;
  Units units = Units::said_or_unmistakable;  ///< of angles, if the file does not say
  bool with_triangles = false;                ///< read those of UGRID, MPAS and OFF as well
  bool with_columns = false;                  ///< but of raw doubles: also read the other columns
  bool with_values = false;                   ///< but of raw doubles: also read one value per node,
  std::string variable;  ///< its name, or in text its number; empty: the column after the coordinates
  /// Names or (text) numbers, with commas between them: lon,lat or x,y,z, then the columns to read. Empty: by
  /// the names in the file, or the first ones.
  std::string columns;
  /// Of NetCDF: read only this one of so many equal slices of the nodes, which must be no grid.
  std::size_t part = 0, parts = 1;
};

/// Global attributes of a NetCDF file, or members of GeoJSON: title, history, source, institution,
/// references, comment, and those whose names begin with "scvt_".
using Notes = std::map<std::string, std::string>;
bool is_note(const std::string& name);

/// A grid of longitudes and latitudes, in degrees.
struct Grid {
  std::vector<double> lon, lat;
  LonLat places() const;  ///< of all its points, row after row of latitude
};

struct Nodes {
  std::string file;  ///< name in messages
  std::string kind;  ///< "text, lon lat in degrees"
  std::vector<Point> points;
  std::size_t before = 0;          ///< nodes of the parts before this one
  LonLat given;                    ///< longitudes and latitudes as they are in the file; empty: it has none
  Grid grid;                       ///< of nodes that are one; else empty
  std::vector<std::size_t> lines;  ///< of text and GeoJSON: of each node, from 1
  const char* lines_are = "line";  ///< "line" or "feature"
  std::vector<double> density;     ///< meshDensity of MPAS, if in the file
  Column value;                    ///< if requested; its name is empty if the file has none
  Columns columns;                 ///< if requested: the other columns of the file
  Notes notes;
  pstripack::Triangles triangles;  ///< counterclockwise; empty unless requested and present

  /// "node 17", with its line or feature if it has one.
  std::string place(std::size_t i) const;
  /// Leaves out all nodes but those with these indices, which increase; and triangles.
  void keep(const std::vector<std::size_t>& indices);
};

/// Reads nodes: text `lon lat` or `x y z` (text_table.h), OFF, NetCDF, GeoJSON, raw
/// doubles in the byte order of the machine; `-` is stdin. Vectors keep their lengths. Throws
/// std::runtime_error: one line with file, line or index, and remedy.
Nodes read(const std::string& file, const ReadOptions& options = {});

/// NetCDF's own formats, and HDF5's, by the first bytes.
bool is_netcdf(const std::string& file);

// Below: one reader per container.

/// Longitudes and latitudes in degrees or radians.
struct Angles {
  const double *lon, *lat;
  std::size_t stride;  ///< between one and the next
  bool lon_in_degrees, lat_in_degrees;
};
std::vector<Point> points_of(const Angles& angles, std::size_t n);
/// The first latitude beyond a pole, allowing for single precision; n if there is none.
std::size_t first_beyond_pole(const Angles& angles, std::size_t n);
/// What may be wrong with latitudes beyond the pole: "; ..." or nothing. `to_exchange`: what --columns is
/// told then; empty: it cannot help.
std::string hint_beyond_pole(const Angles& angles, std::size_t n, const std::string& to_exchange);

/// `contents`: bytes that came through a pipe; empty: read the file.
Nodes read_netcdf(const std::string& file, const ReadOptions& options, const std::string& contents = "");

/// An object of JSON: its first character is {.
bool is_geojson(const std::string& contents);
Nodes read_geojson(const std::string& file, const ReadOptions& options, const std::string& contents);

/// Takes the corners, which count from `first`, and reverses clockwise triangles. Throws std::runtime_error
/// on corners that are no nodes or lie on one great circle.
void set_triangles(Nodes& nodes, const std::vector<long long>& corners, long long first);

}  // namespace files
