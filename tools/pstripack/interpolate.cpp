// `pstripack interpolate`.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "methods/triangulated_nodes.h"
#include "numbers.h"
#include "pstripack/options.h"
#include "pstripack/progress.h"

namespace program {
namespace {

using methods::Interpolation;

enum class Outside { missing, nearest, error };

struct Options {
  Input input;
  bool skip_missing = false;
  std::string points, grid, region;
  double step = 0;
  Interpolation::Method method = Interpolation::Method::linear;
  Outside outside = Outside::missing;
  std::string output, to;
};

std::vector<double> numbers_in(const std::string& option, const std::string& text, char separator,
                               std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    double value = 0;
    if (!point_sets::parse(text.substr(begin, end - begin), value))
      throw CLI::ValidationError(option, "'" + text + "' is not " + std::to_string(count) + " numbers");
    numbers.push_back(value);
    begin = end + 1;
  }
  if (numbers.size() != count)
    throw CLI::ValidationError(option, "'" + text + "' is not " + std::to_string(count) + " numbers");
  return numbers;
}

/// The centres of `count` equal parts of low to high.
std::vector<double> centres(double low, double high, std::size_t count) {
  std::vector<double> c(count);
  for (std::size_t i = 0; i < count; ++i)
    c[i] = low + (high - low) * (2 * static_cast<double>(i) + 1) / (2 * static_cast<double>(count));
  return c;
}

/// How many of --grid-step fit.
double parts(double extent, double step) {
  const double count = std::round(extent / step);
  if (count < 1 || std::fabs(count * step - extent) > 1e-6 * extent)
    throw CLI::ValidationError("--grid-step", fmt::format("{} degrees are no multiple of {}", extent, step));
  return count;
}

files::Grid grid_of(const Options& options) {
  const std::vector<double> r = options.region.empty() ? std::vector<double>{-180, 180, -90, 90}
                                                       : numbers_in("--region", options.region, ',', 4);
  if (!(r[0] < r[1] && r[1] - r[0] <= 360 && r[2] < r[3] && r[2] >= -90 && r[3] <= 90))
    throw CLI::ValidationError("--region", "expected WEST,EAST,SOUTH,NORTH in degrees, in this order");
  std::vector<double> counts;
  if (!options.grid.empty())
    counts = numbers_in("--to-grid", options.grid, 'x', 2);
  else
    counts = {parts(r[3] - r[2], options.step), parts(r[1] - r[0], options.step)};
  for (const double count : counts)
    if (!(count >= 1 && count == std::floor(count)) || counts[0] * counts[1] > 1e10)
      throw CLI::ValidationError("--to-grid", "expected NLATxNLON, for example 180x360");
  return {centres(r[0], r[1], static_cast<std::size_t>(counts[1])),
          centres(r[2], r[3], static_cast<std::size_t>(counts[0]))};
}

bool is_netcdf(const Options& options) {
  const auto ends_with = [&](const std::string& suffix) {
    const std::string& file = options.output;
    return file.size() > suffix.size() &&
           file.compare(file.size() - suffix.size(), suffix.size(), suffix) == 0;
  };
  if (!options.to.empty()) return options.to == "netcdf";
  if (ends_with(".nc")) return true;
  if (options.output != "-" && !ends_with(".txt"))
    throw CLI::ValidationError("--output",
                               options.output + ": neither .nc nor .txt: give --to netcdf or --to text");
  return false;
}

/// Leaves out nodes without value, or throws.
void see_to_missing(files::Nodes& nodes, bool skip) {
  std::vector<std::size_t> kept;
  const std::vector<double>& values = nodes.value.numbers;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i]))
      kept.push_back(i);
    else if (!skip)
      throw std::runtime_error(
          fmt::format("{}: {} has no value: remove it, or say --skip-missing", nodes.file, nodes.place(i)));
  }
  if (kept.size() == values.size()) return;
  say(fmt::format("{}: {} without value left out", nodes.file, counted(values.size() - kept.size(), "node")));
  nodes.keep(kept);
}

files::Nodes read_values(Options& options) {
  options.input.read.with_values = true;
  files::Nodes nodes = read_places(options.input.file, options.input.read);
  see_to_missing(nodes, options.skip_missing);
  drop_duplicates(nodes, options.input);
  return nodes;
}

/// The places, with the columns of their file and, if they were given by vectors, x y z.
files::Nodes read_points(const Options& options) {
  files::ReadOptions read;
  read.units = options.input.read.units;
  read.with_columns = true;
  files::Nodes places = read_places(options.points, read);
  if (!places.given.empty()) return places;
  for (const auto& [name, component] : {std::pair("x", &files::Point::x), std::pair("y", &files::Point::y),
                                        std::pair("z", &files::Point::z)}) {
    if (find(places.columns, name) != nullptr) continue;
    places.columns.push_back({name, "Cartesian coordinate of the place as it was given"});
    for (const files::Point& p : places.points) places.columns.back().numbers.push_back(p.*component);
  }
  return places;
}

void interpolate(Options& options) {
  if (options.points.empty() + options.grid.empty() + (options.step == 0) != 2)
    throw CLI::ValidationError("--to-points", "give one of --to-points, --to-grid, --grid-step");
  if (!options.region.empty() && !options.points.empty())
    throw CLI::ValidationError("--region", "is of a grid, not of --to-points");
  const bool netcdf = is_netcdf(options);
  files::Grid grid;
  if (options.points.empty()) grid = grid_of(options);
  files::OutputFile file(options.output);

  Progress progress;
  files::Nodes nodes = progress.step("reading", [&] { return read_values(options); });
  files::Nodes places = progress.step("reading the places", [&] {
    if (!options.points.empty()) return read_points(options);
    files::Nodes all;
    all.given = grid.places();
    all.points =
        files::points_of({all.given.lon.data(), all.given.lat.data(), 1, true, true}, all.given.lon.size());
    return all;
  });
  const Interpolation interpolation = progress.step("triangulating", [&] {
    try {
      return methods::interpolation_between(nodes.points);
    } catch (const files::NoMesh& e) {
      throw no_mesh_of(nodes, e);
    }
  });
  Interpolation::Result result = progress.step("interpolating", [&] {
    return interpolation.values_at(places.points, nodes.value.numbers, options.method,
                                   options.outside == Outside::nearest ? Interpolation::Outside::nearest
                                                                       : Interpolation::Outside::missing);
  });
  if (options.outside == Outside::error && result.outside > 0) {
    std::size_t first = 0;
    while (!std::isnan(result.values[first])) ++first;
    const files::LonLat where({places.points[first]}, true);
    throw std::runtime_error(
        fmt::format("{} of {} places lie outside the nodes of {}, the first is place {}, lon {:.6g} lat "
                    "{:.6g}: --outside missing "
                    "or nearest",
                    result.outside, places.points.size(), nodes.file, first + 1, where.lon[0], where.lat[0]));
  }
  progress.step("writing", [&] {
    files::Field field{std::move(nodes.value), std::move(places.columns), std::move(nodes.notes)};
    if (field.value.name.empty()) field.value.name = "value";
    field.value.numbers = std::move(result.values);
    field.value.whole = false;
    make_names_differ(field.columns, {"lon", "lat", field.value.name});
    add_history(field.notes);
    if (netcdf && options.points.empty())
      write_netcdf_grid(file, grid, field);
    else
      (netcdf ? files::write_netcdf_field : files::write_field)(
          file, angles_of(places.points, places.given, true), field);
    file.commit();
  });
  progress.finish(fmt::format("{} ({}), {}, {} outside the nodes", counted(nodes.points.size(), "node"),
                              nodes.kind, counted(places.points.size(), "place"), result.outside));
}

}  // namespace

void add_interpolate(CLI::App& app, Command& chosen) {
  CLI::App* const sub = app.add_subcommand(
      "interpolate", "interpolates values at scattered nodes to points or to a longitude-latitude grid");
  const auto options = std::make_shared<Options>();
  sub->add_option("VALUES", options->input.file, "file of nodes and values; - is stdin")
      ->required()
      ->type_name("");
  sub->add_option("--variable", options->input.read.variable,
                  "of the value: name, or in text column from 1 [the column after the coordinates]")
      ->type_name("NAME");
  sub->add_option("--to-points", options->points, "file of points")->type_name("FILE");
  sub->add_option("--to-grid", options->grid, "cell centres of a grid, for example 180x360")
      ->type_name("NLATxNLON");
  sub->add_option("--grid-step", options->step, "the same grid, by the width of a cell")
      ->type_name("DEGREES")
      ->check(CLI::PositiveNumber.description(""));
  sub->add_option("--region", options->region, "edges of the grid: WEST,EAST,SOUTH,NORTH [-180,180,-90,90]")
      ->type_name("DEGREES");
  add_choice(*sub, "--method", options->method,
             {{"linear", Interpolation::Method::linear},
              {"natural", Interpolation::Method::natural},
              {"cubic", Interpolation::Method::cubic}},
             "linear (on triangles), natural (neighbours) or cubic (these and gradients) [linear]");
  add_choice(*sub, "--outside", options->outside,
             {{"missing", Outside::missing}, {"nearest", Outside::nearest}, {"error", Outside::error}},
             "beyond regional nodes: missing (values), nearest (node's value) or error [missing]");
  sub->add_flag("--skip-missing", options->skip_missing, "leave out nodes without a value [an error]");
  add_reading(*sub, options->input.read);
  add_duplicates(*sub, options->input);
  sub->add_option("-o,--output", options->output, "file to write; - is stdout")
      ->required()
      ->type_name("FILE");
  sub->add_option("--to", options->to, "text (lines of lon lat value) or netcdf [by the suffix: .txt, .nc]")
      ->type_name("WORD")
      ->check(CLI::IsMember({"text", "netcdf"}).description(""));
  sub->footer(
      R"(VALUES is text with `lon lat value` or `x y z value` on each line, a table with a header line, or NetCDF. `nan` and
_FillValue are missing values, in input and output. --from, --columns and --coordinates apply to VALUES, --units to
VALUES and the points. The columns of the points follow the value.)");
  sub->callback([=, &chosen] { chosen = [=] { interpolate(*options); }; });
}

}  // namespace program
