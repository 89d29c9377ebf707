#pragma once
// What the commands have in common: input, output, exit codes.

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include "files/mesh.h"
#include "files/nodes.h"
#include "files/writers.h"

namespace program {

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2 };

/// What the command line has chosen.
using Command = std::function<void()>;

/// An option that takes one of some words.
template <class Enum>
void add_choice(CLI::App& app, const char* name, Enum& value, const std::map<std::string, Enum>& choices,
                const char* text) {
  app.add_option(name, value, text)
      ->type_name("WORD")
      ->transform(CLI::CheckedTransformer(choices).description(""));
}

/// IN and how to read it.
struct Input {
  std::string file;
  files::ReadOptions read;
  bool drop_duplicates = false;
};
void add_input(CLI::App& app, Input& input);
/// --from, --coordinates, --units.
void add_reading(CLI::App& app, files::ReadOptions& read);
/// Also what to do about nodes that coincide.
void add_duplicates(CLI::App& app, Input& input);

/// OUT and its format.
struct Output {
  std::string file = "-", to;
  files::Format format = files::Format::xyz;

  /// Sets `format`: by --to, by the suffix, or else `otherwise`. Throws CLI::ValidationError where there is
  /// none.
  void choose(std::optional<files::Format> otherwise = std::nullopt);
};
void add_output(CLI::App& app, Output& output, bool required);

/// Nodes with directions, on one sphere or said to be directions.
files::Nodes read_places(const std::string& file, const files::ReadOptions& options);

/// Nodes that can be triangulated: read_places, at least three; without duplicates where the user wants that.
files::Nodes read_nodes(const Input& input);

/// Leaves out all but the first of nodes in one place.
void drop_duplicates(files::Nodes& nodes);

/// What to tell of nodes that have no triangulation: file, nodes and remedy.
std::runtime_error no_mesh_of(const files::Nodes& nodes, const files::NoMesh& why);

/// Their triangulation; errors name file and nodes.
files::Mesh triangulate(const files::Nodes& nodes);

void add_triangulate(CLI::App& app, Command& chosen);
void add_voronoi(CLI::App& app, Command& chosen);
void add_info(CLI::App& app, Command& chosen);
void add_points(CLI::App& app, Command& chosen);
void add_scvt(CLI::App& app, Command& chosen);
void add_interpolate(CLI::App& app, Command& chosen);
void add_convert(CLI::App& app, Command& chosen);
void add_plot(CLI::App& app, Command& chosen);

/// Of the whole program: --quiet, --threads, ranks.
struct Global {
  bool quiet = false;
  int threads = 0;  ///< 0: as OpenMP says
  int ranks = 1;    ///< that have triangulated
};
Global& global();

}  // namespace program
