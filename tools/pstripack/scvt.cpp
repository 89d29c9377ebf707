// `pstripack scvt`.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "methods/lloyd.h"
#include "numbers.h"
#include "pstripack/options.h"
#include "pstripack/progress.h"

namespace program {
namespace {

struct Options {
  std::size_t n = 0;
  std::uint64_t seed = 1;
  Input start;
  std::string density, density_file, variable;
  double tolerance = 1e-3;
  std::size_t iterations = 10000, every = 100;
  Output output, checkpoint{"", "", files::Format::netcdf};
};

// Attributes of the output with which another run continues this one.
constexpr auto kIterations = "scvt_iterations", kDensity = "scvt_density", kDensityFile = "scvt_density_file",
               kVariable = "scvt_density_variable";

std::string note(const files::Notes& notes, const char* name) {
  const auto found = notes.find(name);
  return found == notes.end() ? "" : found->second;
}

std::size_t iterations_of(const files::Nodes& start) {
  double iterations = 0;
  const std::string text = note(start.notes, kIterations);
  if (text.empty()) return 0;
  if (!point_sets::parse(text, iterations) || !(iterations >= 0 && iterations < 1e15))
    throw std::runtime_error(
        fmt::format("{}: attribute {}: '{}' is no number of iterations", start.file, kIterations, text));
  return static_cast<std::size_t>(iterations);
}

std::unique_ptr<methods::Density> density_in_file(const Options& options) {
  files::ReadOptions read = options.start.read;
  read.with_values = true;
  read.variable = options.variable;
  files::Nodes nodes = read_places(options.density_file, read);
  drop_duplicates(nodes, options.start);
  for (std::size_t i = 0; i < nodes.value.numbers.size(); ++i)
    if (!(nodes.value.numbers[i] > 0))
      throw std::runtime_error(fmt::format("{}: {}: density {}: must be positive", nodes.file, nodes.place(i),
                                           nodes.value.numbers[i]));
  try {
    return methods::density_between(nodes.points, nodes.value.numbers);
  } catch (const files::NoMesh& e) {
    throw no_mesh_of(nodes, e);
  }
}

std::unique_ptr<methods::Density> make_density(const Options& options) {
  if (!options.density_file.empty()) return density_in_file(options);
  try {
    return methods::density_of(options.density);
  } catch (const std::invalid_argument& e) {
    throw CLI::ValidationError("--density", e.what());
  }
}

/// The density is that of the command line, or else that of the start, or else constant.
void choose_density(Options& options, const files::Notes& notes) {
  if (options.density.empty() && options.density_file.empty()) {
    options.density = note(notes, kDensity);
    options.density_file = note(notes, kDensityFile);
    if (options.variable.empty()) options.variable = note(notes, kVariable);
  }
  if (options.density.empty() && options.density_file.empty()) options.density = "constant";
}

files::Notes notes_of(const Options& options, std::size_t iterations) {
  files::Notes notes{{kIterations, std::to_string(iterations)}};
  if (options.density_file.empty()) notes[kDensity] = options.density;
  if (!options.density_file.empty()) notes[kDensityFile] = options.density_file;
  if (!options.density_file.empty() && !options.variable.empty()) notes[kVariable] = options.variable;
  return notes;
}

void write(const Output& output, const methods::Lloyd& lloyd, const files::Notes& notes) {
  files::OutputFile file(output.file);
  if (files::holds_a_mesh(output.format)) {
    files::Mesh mesh = files::triangulate(lloyd.generators());
    mesh.density = lloyd.densities();
    mesh.notes = notes;
    write_mesh(file, output.format, mesh);
  } else {
    write_nodes(file, output.format, lloyd.generators(), lloyd.densities(), notes);
  }
  file.commit();
}

void scvt(Options& options) {
  if ((options.n > 0) == !options.start.file.empty())
    throw CLI::ValidationError("N", "give either N, for random generators, or --start FILE");
  options.output.choose();
  for (const Output* const output : {&options.output, &options.checkpoint})
    if (!output->file.empty()) files::OutputFile can_be_written(output->file);  // said now, not after hours
  if (!options.checkpoint.file.empty()) options.checkpoint.choose(files::Format::netcdf);

  Progress progress;
  files::Nodes start;
  if (!options.start.file.empty())
    start = progress.step("reading", [&] { return read_nodes(options.start); });
  choose_density(options, start.notes);
  const std::unique_ptr<methods::Density> density =
      progress.step("reading the density", [&] { return make_density(options); });
  const std::size_t before = iterations_of(start);
  const std::string from = options.start.file.empty() ? "the random generators" : start.file;
  try {
    if (options.start.file.empty()) {
      start.points = methods::random_generators(options.n, *density, options.seed);
    } else {
      triangulate(start);  // what is wrong with them is said by their lines
      start.points = files::unit(start.points);
    }
    methods::Lloyd lloyd(std::move(start.points), *density);
    methods::Lloyd::Step step;
    std::size_t iteration = before;
    bool has_converged = false;
    progress.step("iterating", [&] {
      while (iteration < options.iterations && !has_converged) {
        step = lloyd.step();
        ++iteration;
        has_converged = step.move <= options.tolerance;
        progress.now(fmt::format("iteration {}, largest move {:.3g}, energy {:.9g}", iteration, step.move,
                                 step.energy));
        if (!options.checkpoint.file.empty() && (iteration - before) % options.every == 0)
          write(options.checkpoint, lloyd, notes_of(options, iteration));
      }
    });
    progress.step("writing", [&] { write(options.output, lloyd, notes_of(options, iteration)); });
    const std::string reached = iteration == before ? "none was left to do"
                                : has_converged     ? fmt::format("converged to {:g}", options.tolerance)
                                                    : fmt::format("NOT converged to {:g}", options.tolerance);
    progress.finish(fmt::format("{} generators, {} iterations, {}: largest move {:.3g}, energy {:.9g}",
                                lloyd.generators().size(), iteration, reached, step.move, step.energy));
  } catch (const files::NoMesh& e) {
    throw std::runtime_error(from + ": " + e.what());
  }
}

}  // namespace

void add_scvt(CLI::App& app, Command& chosen) {
  CLI::App* const sub = app.add_subcommand(
      "scvt", "spherical centroidal Voronoi tessellation: moves generators to the centroids of their cells");
  const auto options = std::make_shared<Options>();
  sub->add_option("N", options->n, "number of random generators, unless --start is given")
      ->type_name("")
      ->check(CLI::Range(std::size_t{4}, std::size_t{357913943}).description(""));
  sub->add_option("--seed", options->seed, "seed of the random generators")
      ->type_name("NUMBER")
      ->capture_default_str();
  sub->add_option("--start", options->start.file,
                  "initial generators, or the output or checkpoint of a run to continue")
      ->type_name("FILE");
  CLI::Option* const formula =
      sub->add_option("--density", options->density, "see below [that of --start, or constant]")
          ->type_name("FORMULA");
  sub->add_option("--density-file", options->density_file,
                  "density at nodes, linear in between: lines of lon lat value or x y z value, or NetCDF")
      ->type_name("FILE")
      ->excludes(formula);
  sub->add_option("--variable", options->variable,
                  "in the density file: name (NetCDF) or column (text, from 1)")
      ->type_name("NAME");
  sub->add_option("--tolerance", options->tolerance,
                  "stop when no generator moves further than this fraction of the width of its cell")
      ->type_name("NUMBER")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e300).description(""));
  sub->add_option("--iterations", options->iterations,
                  "largest number of iterations, those of the continued run included")
      ->type_name("NUMBER")
      ->capture_default_str();
  sub->add_option("--checkpoint", options->checkpoint.file, "file to write every --every iterations")
      ->type_name("FILE");
  sub->add_option("--every", options->every, "iterations between checkpoints")
      ->type_name("NUMBER")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000000000}).description(""));
  add_reading(*sub, options->start.read);
  add_duplicates(*sub, options->start);
  add_output(*sub, options->output, true);
  sub->footer(R"(Densities:
  constant                            1
  bump                                bump:0,30,30,10,3
  bump:LON,LAT,RADIUS,WIDTH,RATIO     (1 + (RATIO-1) (1 + tanh((RADIUS-d)/WIDTH))/2)^4, d the distance from LON,LAT,
                                      all in degrees: cells within RADIUS are RATIO times narrower than far away

To continue a run, repeat its command with --start CHECKPOINT: NetCDF files hold their iterations and density.
--from, --coordinates and --units apply to both input files.

)" + sub->get_footer());
  sub->callback([=, &chosen] { chosen = [=] { scvt(*options); }; });
}

}  // namespace program
