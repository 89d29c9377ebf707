#pragma once
// What the commands have in common: input, output, exit codes.

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "files/nodes.h"
#include "files/writers.h"

namespace program {

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2 };

/// What the command line has chosen.
using Command = std::function<void()>;

/// IN and how to read it.
struct Input {
  std::string file;
  files::ReadOptions read;
  bool drop_duplicates = false;
};
void add_input(CLI::App& app, Input& input);
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

/// Nodes that can be triangulated: at least three, with directions, on one sphere or said to be directions;
/// on --duplicates drop those left that are different.
files::Nodes read_nodes(const Input& input);

/// Their triangulation; errors name file and nodes.
files::Mesh triangulate(const files::Nodes& nodes);

void add_triangulate(CLI::App& app, Command& chosen);
void add_voronoi(CLI::App& app, Command& chosen);
void add_info(CLI::App& app, Command& chosen);
void add_points(CLI::App& app, Command& chosen);
void add_convert(CLI::App& app, Command& chosen);
void add_plot(CLI::App& app, Command& chosen);

/// --quiet and --threads of the whole program.
struct Global {
  bool quiet = false;
  int threads = 0;  ///< 0: as OpenMP says
};
Global& global();

}  // namespace program
