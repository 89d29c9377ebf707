// `pstripack points`.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "families.h"
#include "files/nearest.h"
#include "point_sets.h"
#include "pstripack/options.h"

namespace program {
namespace {

struct PointsOptions {
  std::string name;
  std::size_t n = 0;
  std::uint64_t seed = 1;
  Output output;
};

std::string families() {
  std::string text =
      "Families with their default parameter, if any (cap:0.01 gives another; lengths in radians), and "
      "the\nnumber of nodes for N:";
  for (const point_sets::Family& f : point_sets::registry())
    text += fmt::format("\n  {:<17} {:<12} {}", f.name + (f.parameter.empty() ? "" : ":" + f.parameter),
                        f.nodes, f.what);
  return text + "\n\n";
}

void write(PointsOptions& options) {
  options.output.choose(files::Format::xyz);
  if (!files::holds_nodes(options.output.format)) {
    // By its suffix, .nc is a UGRID mesh, which cannot hold nodes alone.
    if (options.output.format != files::Format::ugrid || !options.output.to.empty())
      throw CLI::ValidationError(
          "--output", "points are nodes, not a mesh: give --to xyz, lonlat, nodes, csv, geojson or raw");
    options.output.format = files::Format::netcdf;
  }
  std::vector<files::Point> points;
  try {
    points = point_sets::make(options.name, options.n, options.seed);
  } catch (const std::invalid_argument& e) {
    const std::string name = options.name.substr(0, options.name.find(':'));
    std::vector<std::string> names;
    for (const point_sets::Family& f : point_sets::registry()) names.push_back(f.name);
    const bool is_known = std::find(names.begin(), names.end(), name) != names.end();
    throw CLI::ValidationError("NAME", e.what() + (is_known ? "" : files::did_you_mean(name, names)));
  }
  files::OutputFile file(options.output.file);
  write_nodes(file, options.output.format, points);
  file.commit();
}

}  // namespace

void add_points(CLI::App& app, Command& chosen) {
  CLI::App* const sub = app.add_subcommand("points", "test nodes of many kinds");
  const auto options = std::make_shared<PointsOptions>();
  option(*sub, "NAME", options->name, "family of nodes, see below")->required();
  option(*sub, "N", options->n, "number of nodes; grids take the nearest number they can have")
      ->required()
      ->transform(whole_number())
      ->check(CLI::Range(std::size_t{3}, std::size_t{357913943}).description(""));
  option(*sub, "--seed NUMBER", options->seed, "seed of random families")->capture_default_str();
  add_output(*sub, options->output, false);
  sub->footer(families() + sub->get_footer());
  sub->callback([=, &chosen] { chosen = [=] { write(*options); }; });
}

}  // namespace program
