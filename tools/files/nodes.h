#pragma once
// Nodes and meshes read from files.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "mesh/triangulation.h"

namespace files {

using pstripack::Point;

enum class Container { detected, text, netcdf, raw };
enum class Coordinates { detected, xyz, lonlat };
enum class Units { said_or_unmistakable, degrees, radians };

struct ReadOptions {
  Container container = Container::detected;  ///< raw doubles are never detected
  Coordinates coordinates = Coordinates::detected;
  Units units = Units::said_or_unmistakable;  ///< of angles, if the file does not say
  bool with_triangles = false;                ///< read those of UGRID, MPAS and OFF as well
  bool with_values = false;                   ///< of text and NetCDF: also read one value per node,
  std::string variable;  ///< name (NetCDF) or column (text; empty: the one after the coordinates)
};

/// Attributes of a NetCDF file about its creation: global attributes whose names begin with "scvt_".
using Notes = std::map<std::string, std::string>;

struct Nodes {
  std::string file;  ///< name in messages
  std::string kind;  ///< "text, lon lat in degrees"
  std::vector<Point> points;
  std::vector<std::size_t> lines;       ///< of text: of each node, from 1
  std::vector<double> density;          ///< meshDensity of MPAS, if in the file
  std::vector<double> values;           ///< if requested; NaN: missing
  std::string value_name, value_units;  ///< if in the file
  Notes notes;
  pstripack::Triangles triangles;  ///< counterclockwise; empty unless requested and present

  /// "node 17", with its line if it has one.
  std::string place(std::size_t i) const;
};

/// Reads nodes: text `lon lat` or `x y z` (point_sets/text_file.h), OFF, NetCDF (netcdf_nodes.cpp), raw
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

/// `contents`: bytes that came through a pipe; empty: read the file.
Nodes read_netcdf(const std::string& file, const ReadOptions& options, const std::string& contents = "");

/// Takes the corners, which count from `first`, and reverses clockwise triangles. Throws std::runtime_error
/// on corners that are no nodes or lie on one great circle.
void set_triangles(Nodes& nodes, const std::vector<long long>& corners, long long first);

}  // namespace files
