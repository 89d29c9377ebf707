#pragma once
// Nodes and meshes read from files.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "files/columns.h"
#include "files/text_table.h"
#include "mesh/triangulation.h"

namespace files {

using pstripack::Point;

enum class Container { detected, text, netcdf, geojson, raw };
enum class Coordinates { detected, xyz, lonlat };
enum class Units { said_or_unmistakable, degrees, radians };

/// Lengths of vectors that differ by at most this part of them are equal: text has six digits or more.
constexpr double kSameLength = 1e-6;

struct ReadOptions {
  Container container = Container::detected;  ///< raw doubles are not detected
  Coordinates coordinates = Coordinates::detected;
  Units units = Units::said_or_unmistakable;  ///< of angles in files that do not say
  bool with_triangles = false;                ///< also read the triangles of UGRID, MPAS and OFF
  bool with_boundary = false;                 ///< also those of MPAS that lack corners
  bool with_columns = false;                  ///< also read the other columns; not of raw doubles
  bool with_cells = false;                    ///< GeoJSON: the nodes of cells that `voronoi` has written
  bool with_values = false;                   ///< also read one value per node; not of raw doubles
  bool may_have_value = false;  ///< a column of values may follow in text without a header; it is not read
  bool only_axes = false;       ///< of a grid no points and angles, which take 40 bytes a node
  bool keep_missing = false;    ///< coordinates may be missing: NaN; else an error
  std::string variable;         ///< its name, or in text its number; empty: the column after the coordinates
  std::vector<std::string> usual_variables =
      {};  ///< without a name, the first of these that a NetCDF file has
  /// Three columns of text without names are x y z only if these have one length or cannot be lon lat; else
  /// they are lon lat value. Without this they are x y z.
  bool lengths_decide = false;
  /// Names, or in text column numbers, separated by commas: lon,lat or x,y,z, then the columns to read.
  /// Empty: the names in the file decide, or else the first columns are read. Of text also fixed widths,
  /// 22-30,13-20, which are then the columns.
  std::string columns;
  TextFormat text = {};
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

/// What may be known about nodes beside their places.
struct NodeValues {
  LonLat given = {};                 ///< longitudes and latitudes as in the file; empty: the file has none
  std::vector<double> density = {};  ///< meshDensity of MPAS; empty: unknown
  Columns columns = {};
  Notes notes = {};
  std::vector<std::int32_t> layers = {};  ///< in a limited area (limited_area.h); empty: in none
  double radius = 1;                      ///< of the sphere in MPAS files
  double nominal = 0;                     ///< width of cells of density 1, radians; 0: unknown
};
NodeValues at_nodes(const NodeValues& values, const std::vector<std::size_t>& nodes);

struct Nodes : NodeValues {
  std::string file;  ///< name in messages
  std::string kind;  ///< "text, lon lat in degrees"
  std::vector<Point> points;
  Grid grid;  ///< the grid, if the nodes are one; else empty
  /// The shape of all nodes in the file, also of those left out later; empty: a list of these nodes.
  std::vector<std::size_t> shape;
  std::vector<std::size_t> numbers;  ///< of each node in the file, if some were left out; else empty
  std::vector<std::size_t> lines;    ///< line or feature of each node in text or GeoJSON, from 1
  const char* lines_are = "line";    ///< "line" or "feature"
  Column value;                      ///< if requested; its name is empty if the file has none
  pstripack::Triangles triangles;    ///< counterclockwise; empty unless requested and present
  /// Of an MPAS mesh with a boundary, if requested: the vertices of all triangles, of which some lack
  /// corners: -1 stands for them.
  std::vector<Point> vertices;
  std::vector<std::string> variables;  ///< all of a NetCDF file
  std::size_t polygons = 0;  ///< faces of more than three corners, which are not read; nor are the triangles

  /// The number of the node in the file, from 1.
  std::size_t number(std::size_t i) const { return numbers.empty() ? i + 1 : numbers[i]; }
  /// "node 17", with its line or feature if known.
  std::string place(std::size_t i) const;
  /// Removes all triangles, and all nodes except those with these increasing indices.
  void keep(const std::vector<std::size_t>& indices);
};

/// Attribute of a UGRID mesh in files of pstripack: the names of three variables, the nodes as vectors.
constexpr auto kNodeVectors = "pstripack_node_vectors";

/// Reads nodes from text `lon lat` or `x y z` (text_table.h), OFF, NetCDF, GeoJSON, or raw doubles in the
/// machine's byte order; `-` is stdin. Vectors keep their lengths. Throws std::runtime_error: one line with
/// file, line or index, and remedy.
Nodes read(const std::string& file, const ReadOptions& options = {});

/// Throws if the contents are of a format that another program converts, and says how.
void refuse_foreign(const std::string& file, const std::string& contents);

/// True if it is a file, no pipe, whose first bytes are those of NetCDF's own formats or of HDF5.
bool is_netcdf(const std::string& file);

// Below: one reader per container.

/// The index of the first latitude beyond a pole by more than the rounding of single precision; their number
/// if there is none.
std::size_t first_beyond_pole(const LonLat& angles);
/// The largest absolute value; 0: there are none.
double largest_of(const std::vector<double>& values);
/// A guess why latitudes are beyond the pole: "; ..." or nothing. `to_exchange`: the value of --columns that
/// exchanges longitudes and latitudes; empty: none does.
std::string hint_beyond_pole(const LonLat& angles, const std::string& to_exchange);

/// The names of all variables of a NetCDF file.
std::vector<std::string> netcdf_variables(const std::string& file);
/// `contents`: the file, if it came through a pipe; empty: read `file`.
Nodes read_netcdf(const std::string& file, const ReadOptions& options, const std::string& contents = "");

/// True if the first character, after blanks, is {.
bool is_geojson(const std::string& contents);
Nodes read_geojson(const std::string& file, const ReadOptions& options, const std::string& contents);

/// Sets the triangles from corners that count from `first`, and reverses clockwise ones. Throws
/// std::runtime_error if a corner is not a node or the corners lie on one great circle.
void set_triangles(Nodes& nodes, const std::vector<long long>& corners, long long first);

}  // namespace files
