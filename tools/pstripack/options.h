#pragma once
// Common parts of the commands: input, output, exit codes.

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "files/clipping.h"
#include "files/mesh.h"
#include "files/nodes.h"
#include "files/writers.h"

namespace program {

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2 };

/// The command chosen on the command line.
using Command = std::function<void()>;

/// "'word' is none of these; did you mean that?"
std::string is_none_of(const std::string& word, const std::vector<std::string>& words);

/// For options that are one of some words.
CLI::Validator one_of(std::vector<std::string> words);

/// The same, for options that become a value.
template <class Enum>
void add_choice(CLI::App& app, const char* name, Enum& value, const std::map<std::string, Enum>& choices,
                const char* text) {
  const auto number_of = [choices](std::string& word) -> std::string {
    if (const auto found = choices.find(word); found != choices.end()) {
      word = std::to_string(static_cast<int>(found->second));
      return "";
    }
    std::vector<std::string> words;
    for (const auto& [choice, number] : choices) words.push_back(choice);
    return is_none_of(word, words);
  };
  app.add_option(name, value, text)->type_name("WORD")->transform(CLI::Validator(number_of, ""));
}

/// "1 node", "2 nodes".
std::string counted(std::size_t n, const std::string& thing);

/// For options that are whole numbers: takes 1e6, too.
CLI::Validator whole_number();

/// What becomes of nodes in the same place: an error; the first one stays; or it gets the mean of their
/// values.
enum class Duplicates { error, first, mean };

/// Numbers between separators; `option` for messages.
std::vector<double> numbers_in(const std::string& option, const std::string& text, char separator,
                               std::size_t count);

/// --region: WEST,EAST,SOUTH,NORTH; east is beyond 180 where it is less than west on the command line.
files::Region region_of(const std::string& text);

/// IN and how to read it.
struct Input {
  std::string file;
  files::ReadOptions read;
  Duplicates duplicates = Duplicates::error;
  bool drop_duplicates = false;  ///< the same as Duplicates::first

  bool drops() const { return drop_duplicates || duplicates != Duplicates::error; }
};
void add_input(CLI::App& app, Input& input);
/// --from, --columns, --coordinates, --units.
void add_reading(CLI::App& app, files::ReadOptions& read);
/// --duplicates, --drop-duplicates.
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

/// Nodes with directions, on one sphere or declared to be directions.
files::Nodes read_places(const std::string& file, const files::ReadOptions& options);

/// Nodes that can be triangulated: read_places, at least three; without duplicates if requested.
files::Nodes read_nodes(const Input& input);

/// Leaves out all but the first of coincident nodes, if the input says so.
void drop_duplicates(files::Nodes& nodes, const Input& input);

/// Adds columns `node` and `line`, the number and line of each node in the input, unless the file has them.
void number_nodes(files::Nodes& nodes);

/// Adds the command to the notes' history.
void add_history(files::Notes& notes);

/// The error for nodes without a triangulation: file, nodes and remedy.
std::runtime_error no_mesh_of(const files::Nodes& nodes, const files::NoMesh& why);

/// Their triangulation, which takes over their columns and notes; errors name file and nodes.
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
  bool is_led = false;  ///< a rank that does the same as rank 0, and says nothing
  int threads = 0;      ///< 0: as OpenMP says
  int ranks = 1;        ///< number of ranks that triangulated
  std::string command;  ///< the command line, for the history of files
};
Global& global();

}  // namespace program
