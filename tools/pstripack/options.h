#pragma once
// Common parts of the commands: input, output, exit codes.

#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "files/clipping.h"
#include "files/limited_area.h"
#include "files/mesh.h"
#include "files/near_nodes.h"
#include "files/nodes.h"
#include "files/writers.h"
#include "pstripack/reading.h"

namespace program {

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2 };

using Command = std::function<void()>;

/// "1 node", "2 nodes".
std::string counted(std::size_t n, const std::string& thing);

/// Accepts whole numbers, also in the form 1e6.
CLI::Validator whole_number();

/// What to do with nodes in the same place: an error; keep the first one; or keep it with the mean of their
/// values.
enum class Duplicates { error, first, mean };

/// A distance on the sphere, and how it was written.
struct Distance {
  double radians = 0;
  std::string text = "";
};
/// Adds an option that is a number and its unit: 1mm, 2km (on the Earth), 1e-6deg.
void add_distance(CLI::App& app, const char* name, Distance& distance, const char* text);

/// Numbers between separators. `option`: for messages.
std::vector<double> numbers_in(const std::string& option, const std::string& text, char separator,
                               std::size_t count);

/// WEST,EAST,SOUTH,NORTH. An east less than west is meant to be beyond 180 degrees. `option`: for messages.
files::Region region_of(const std::string& text, const std::string& option = "--region");
/// True if the text consists of numbers, so that it names no file.
bool is_box(const std::string& text);

/// --region of a limited area: WEST,EAST,SOUTH,NORTH, circle:KM,LON,LAT, or a file of polygons, and --sides.
/// `radius`: of the sphere, km.
files::LimitedArea limited_area_of(const std::string& text, const std::string& sides,
                                   const files::ReadOptions& read, double radius);
CLI::Option* add_limited_area(CLI::App& app, std::string& text, std::string& sides);
/// Sets the layers of the mesh, and says how many cells are kept.
void keep_area(files::Mesh& mesh, const files::LimitedArea& area);

/// IN and how to read it.
struct Input {
  std::string file;
  files::ReadOptions read;
  Duplicates duplicates = Duplicates::error;
  Distance within;  ///< nodes this near to each other are in the same place

  bool drops() const { return duplicates != Duplicates::error; }
};
void add_input(CLI::App& app, Input& input);
/// --skip-missing: `what` must not be missing.
void add_skip_missing(CLI::App& app, files::ReadOptions& read, const char* what);
/// --duplicates, --duplicates-within.
void add_duplicates(CLI::App& app, Input& input);

/// OUT and its format.
struct Output {
  std::string file = "-", to;
  files::Format format = files::Format::xyz;
  double radius = 0;  ///< of the sphere in MPAS files, metres; 0: not given
  files::Variant variant = {};

  /// Sets `format` by --to, else by the suffix, else to `otherwise`. Throws CLI::ValidationError if none
  /// applies.
  void choose(std::optional<files::Format> otherwise = std::nullopt);
};
void add_output(CLI::App& app, Output& output, bool required);
/// A check of an option: a number in this range; `what` it is for the error. CLI::Range lets nan pass.
std::function<std::string(const std::string&)> number_from(double low, double high, std::string what);
constexpr double kAbove0 = std::numeric_limits<double>::denorm_min(),
                 kLargest = std::numeric_limits<double>::max();
constexpr auto kRadiusOfMpas = "radius of the sphere in an MPAS mesh [that of the input, else 1]";
CLI::Option* add_radius(CLI::App& app, double& radius, const char* text);
/// --edges, --rings.
void add_variant(CLI::App& app, Output& output);

/// Reads nodes, without those whose place is missing if the options say so; throws unless they have
/// directions, and lie on one sphere or --coordinates xyz is given.
files::Nodes read_places(const std::string& file, const files::ReadOptions& options);

/// Removes the nodes for which `is_missing(index)` is true, and says how many had no `what`.
void leave_out(files::Nodes& nodes, const std::function<bool(std::size_t)>& is_missing, const char* what);

/// Reads at least three nodes and removes duplicates if requested.
files::Nodes read_nodes(const Input& input);

/// Removes all but the first of nodes in the same place if the input says so. Throws if nodes are within
/// --duplicates-within and the input does not say so.
void drop_duplicates(files::Nodes& nodes, const Input& input);

/// The indices of these nodes but for the duplicates.
std::vector<std::size_t> without(const std::vector<files::Duplicate>& duplicates, std::size_t nodes);

/// Says how many pairs of nodes are within a millimetre of each other: most likely copies of one node that
/// rounding has moved.
void tell_near_nodes(const files::Nodes& nodes, const pstripack::ListsView<std::int32_t>& lists);

/// Adds columns `node` and `line`, number and line of each node in the input, unless the file has such
/// columns.
void number_nodes(files::Nodes& nodes);

/// Puts the command in front of the history in the notes.
void add_history(files::Notes& notes);

/// The error that names file, nodes and remedy.
std::runtime_error no_mesh_of(const files::Nodes& nodes, const files::NoMesh& why);
/// Runs work(), whose NoMesh becomes that error.
template <class Work>
auto with_nodes(const files::Nodes& nodes, const Work& work) {
  try {
    return work();
  } catch (const files::NoMesh& e) {
    throw no_mesh_of(nodes, e);
  }
}
/// Runs work(), whose errors get the name of the file.
template <class Work>
auto in_file(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(name + ": " + e.what());
  }
}

/// Writes the mesh as the options say. Tells how many nodes an MPAS mesh leaves out.
void write_mesh(files::OutputFile& file, const Output& output, files::Mesh& mesh);

/// The triangulation of the nodes, which gives up its columns and notes to the mesh. Errors name file and
/// nodes.
files::Mesh triangulate(files::Nodes& nodes);

void add_triangulate(CLI::App& app, Command& chosen);
void add_voronoi(CLI::App& app, Command& chosen);
void add_info(CLI::App& app, Command& chosen);
void add_points(CLI::App& app, Command& chosen);
void add_scvt(CLI::App& app, Command& chosen);
void add_interpolate(CLI::App& app, Command& chosen);
void add_convert(CLI::App& app, Command& chosen);
void add_plot(CLI::App& app, Command& chosen);

/// Options of the whole program: --quiet, --threads, ranks.
struct Global {
  bool quiet = false;
  bool is_led = false;    ///< a rank above 0 that runs the same command and prints nothing
  int threads = 0;        ///< 0: as OpenMP says
  int ranks = 1;          ///< number of ranks that triangulated
  int exit_code = kDone;  ///< of a command that does not fail
  std::string command;    ///< the command line, for the history of files
};
Global& global();

}  // namespace program
