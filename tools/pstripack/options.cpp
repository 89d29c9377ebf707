#include "pstripack/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "pstripack/progress.h"

namespace program {
namespace {

using files::Nodes;

void check_directions(const Nodes& nodes) {
  for (std::size_t i = 0; i < nodes.points.size(); ++i)
    if (!pstripack::has_direction(nodes.points[i]))
      throw std::runtime_error(
          fmt::format("{}: {} is zero or not finite: remove it", nodes.file, nodes.place(i)));
}

/// Three columns whose vectors differ in length by more than 1 % are most likely not x y z.
void check_lengths(const Nodes& nodes) {
  std::size_t shortest = 0, longest = 0;
  std::vector<double> square(nodes.points.size());
  for (std::size_t i = 0; i < square.size(); ++i) {
    square[i] = dot(nodes.points[i], nodes.points[i]);
    if (square[i] < square[shortest]) shortest = i;
    if (square[i] > square[longest]) longest = i;
  }
  const double low = std::sqrt(square[shortest]), high = std::sqrt(square[longest]);
  if (high > 1.01 * low)
    throw std::runtime_error(fmt::format(
        "{}: x y z of lengths {:.4g} ({}) to {:.4g} ({}) are not on one sphere; say --coordinates lonlat if "
        "the first two columns are lon lat, or --coordinates xyz if the vectors are directions",
        nodes.file, low, nodes.place(shortest), high, nodes.place(longest)));
}

std::string suffixes() {
  std::string text;
  for (const files::FormatEntry& f : files::formats())
    text += fmt::format("\n  {:<7} {:<16} {}", f.name, f.suffixes, f.what);
  return text;
}

}  // namespace

Global& global() {
  static Global options;
  return options;
}

void add_input(CLI::App& app, Input& input) {
  app.add_option("IN", input.file, "file of nodes; - is stdin")->required()->type_name("");
  add_reading(app, input.read);
}

void add_reading(CLI::App& app, files::ReadOptions& read) {
  using namespace files;
  add_choice(app, "--from", read.container,
             {{"text", Container::text}, {"netcdf", Container::netcdf}, {"raw", Container::raw}},
             "text, netcdf or raw (doubles in this machine's byte order) [text and netcdf are detected]");
  add_choice(app, "--coordinates", read.coordinates,
             {{"xyz", Coordinates::xyz}, {"lonlat", Coordinates::lonlat}},
             "xyz: three columns, any lengths; lonlat: the first two columns [by the number of columns]");
  add_choice(app, "--units", read.units, {{"degrees", Units::degrees}, {"radians", Units::radians}},
             "degrees or radians, where the file does not say");
}

void add_duplicates(CLI::App& app, Input& input) {
  app.add_flag("--drop-duplicates", input.drop_duplicates,
               "keep the first of nodes in the same place [an error]");
}

void add_output(CLI::App& app, Output& output, bool required) {
  CLI::Option* const option =
      app.add_option("-o,--output", output.file, "file to write; - is stdout")->type_name("FILE");
  if (required)
    option->required();
  else
    option->capture_default_str();
  std::vector<std::string> names;
  for (const files::FormatEntry& f : files::formats()) names.emplace_back(f.name);
  app.add_option("--to", output.to, "format, see below [by the suffix of the file]")
      ->type_name("FORMAT")
      ->check(CLI::IsMember(names).description(""));
  app.footer("Formats and their suffixes:" + suffixes());
}

void Output::choose(std::optional<files::Format> otherwise) {
  std::optional<files::Format> found = files::format_of(to, file);
  if (!found) found = otherwise;
  if (!found) throw CLI::ValidationError("--output", file + ": no format has this suffix: give --to");
  format = *found;
}

Nodes read_places(const std::string& file, const files::ReadOptions& options) {
  Nodes nodes = files::read(file, options);
  check_directions(nodes);
  if (options.coordinates != files::Coordinates::xyz) check_lengths(nodes);
  return nodes;
}

Nodes read_nodes(const Input& input) {
  Nodes nodes = read_places(input.file, input.read);
  if (nodes.points.size() < 3)
    throw std::runtime_error(fmt::format("{}: a triangulation needs at least 3 nodes, here are {}",
                                         nodes.file, nodes.points.size()));
  if (input.drop_duplicates) drop_duplicates(nodes);
  return nodes;
}

void drop_duplicates(Nodes& nodes) {
  std::vector<std::size_t> dropped;
  try {
    dropped = files::duplicates(nodes.points);
  } catch (const files::NoMesh& e) {
    throw no_mesh_of(nodes, e);
  }
  const auto drop = [&](auto& values) {
    if (values.empty()) return;
    std::size_t kept = 0, next = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (next < dropped.size() && dropped[next] == i)
        ++next;
      else
        values[kept++] = values[i];
    values.resize(kept);
  };
  drop(nodes.points);
  drop(nodes.lines);
  drop(nodes.density);
  drop(nodes.values);
  if (!dropped.empty())
    say(fmt::format("{}: {} nodes dropped that coincide with earlier ones", nodes.file, dropped.size()));
}

std::runtime_error no_mesh_of(const Nodes& nodes, const files::NoMesh& why) {
  if (const auto* const coincident = dynamic_cast<const files::CoincidentNodes*>(&why))
    return std::runtime_error(
        fmt::format("{}: {} and {} are in the same place: remove one, or say --drop-duplicates", nodes.file,
                    nodes.place(coincident->first), nodes.place(coincident->second)));
  return std::runtime_error(nodes.file + ": " + why.what());
}

files::Mesh triangulate(const Nodes& nodes) {
  try {
    files::Mesh mesh = files::triangulate(nodes.points);
    mesh.density = nodes.density;
    mesh.notes = nodes.notes;
    return mesh;
  } catch (const files::NoMesh& e) {
    throw no_mesh_of(nodes, e);
  }
}

}  // namespace program
