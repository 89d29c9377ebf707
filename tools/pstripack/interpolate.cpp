// `pstripack interpolate`.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "methods/triangulated_nodes.h"
#include "numbers.h"
#include "pstripack/options.h"
#include "pstripack/progress.h"

namespace program {
namespace {

using methods::Interpolation;

/// Places of a grid: centres of cells, or, including the edges of the box, corners of cells.
enum class Registration { cell, node };
enum class To { text, csv, netcdf };

struct InterpolateOptions {
  Input input;
  std::string points, grid, box;
  double step = 0;
  Registration registration = Registration::cell;
  Interpolation::Method method = Interpolation::Method::linear;
  Interpolation::Outside outside = Interpolation::Outside::missing;
  std::string output, to, weights;
};

/// `count` longitudes or latitudes from low to high: centres of equal cells, or, if at_nodes, their corners.
std::vector<double> axis(double low, double high, std::size_t count, bool at_nodes) {
  std::vector<double> values(count);
  const auto parts = static_cast<double>(2 * (at_nodes && count > 1 ? count - 1 : count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto k = static_cast<double>(2 * i + (at_nodes ? 0 : 1));
    values[i] = low + (high - low) * k / parts;
  }
  return values;
}

/// The number of --grid-step in `extent`.
double parts(double extent, double step) {
  const double count = std::round(extent / step);
  if (count < 1 || std::fabs(count * step - extent) > 1e-6 * extent)
    throw CLI::ValidationError("--grid-step",
                               fmt::format("{} degrees are not a multiple of {}", extent, step));
  return count;
}

constexpr double kMostPlaces = 1 << 28;  // of insertion_order

files::Grid grid_of(const InterpolateOptions& options) {
  const files::Region r = options.box.empty() ? files::Region{} : region_of(options.box, "--box");
  const double width = r.east - r.west, height = r.north - r.south;
  const bool at_nodes = options.registration == Registration::node, all_around = width == 360;
  std::vector<double> counts;  // of latitudes and longitudes
  if (!options.grid.empty()) {
    counts = numbers_in("--to-grid", options.grid, 'x', 2);
  } else {
    counts = {parts(height, options.step), parts(width, options.step)};
    if (at_nodes) counts = {counts[0] + 1, counts[1] + (all_around ? 0 : 1)};
  }
  for (const double count : counts)
    if (!(count >= (at_nodes ? 2 : 1) && count == std::floor(count)) || counts[0] * counts[1] > kMostPlaces)
      throw CLI::ValidationError("--to-grid", "expected NLATxNLON, for example 180x360");
  // In a grid around the globe the last meridian equals the first one: leave it out.
  const auto n_lat = static_cast<std::size_t>(counts[0]), n_lon = static_cast<std::size_t>(counts[1]);
  files::Grid grid{axis(r.west, r.east, n_lon + (at_nodes && all_around ? 1 : 0), at_nodes),
                   axis(r.south, r.north, n_lat, at_nodes)};
  grid.lon.resize(n_lon);
  return grid;
}

/// The edges between the points of an axis. The first and the last are those of the box, or, if the points
/// go around the globe from one on, half a step further.
std::vector<double> edges_between(const std::vector<double>& points, double low, double high,
                                  bool goes_around) {
  std::vector<double> edges{goes_around ? low - (points[1] - points[0]) / 2 : low};
  for (std::size_t i = 1; i < points.size(); ++i) edges.push_back((points[i - 1] + points[i]) / 2);
  edges.push_back(goes_around ? edges[0] + 360 : high);
  return edges;
}

files::Grid edges_of(const files::Grid& grid, const InterpolateOptions& options) {
  const files::Region r = options.box.empty() ? files::Region{} : region_of(options.box, "--box");
  const bool goes_around = options.registration == Registration::node && r.east - r.west == 360;
  return {edges_between(grid.lon, r.west, r.east, goes_around),
          edges_between(grid.lat, r.south, r.north, false)};
}

To format_of(const InterpolateOptions& options) {
  const std::map<std::string, To> names{{"text", To::text}, {".txt", To::text},     {"csv", To::csv},
                                        {".csv", To::csv},  {"netcdf", To::netcdf}, {".nc", To::netcdf}};
  const auto found = names.find(
      options.to.empty() ? std::filesystem::path(options.output).extension().string() : options.to);
  if (found != names.end()) return found->second;
  if (options.output != "-")
    throw CLI::ValidationError(
        "--output", options.output + ": neither .nc nor .txt nor .csv: give --to netcdf, text or csv");
  return To::text;
}

files::Nodes read_values(InterpolateOptions& options) {
  files::Nodes nodes = read_places(options.input.file, options.input.read);
  if (options.input.read.with_values)
    leave_out(
        nodes,
        [&](std::size_t i) {
          const bool is_missing = std::isnan(nodes.value.numbers[i]);
          if (is_missing && !options.input.read.keep_missing)
            throw std::runtime_error(fmt::format("{}: {} has no value: remove it, or say --skip-missing",
                                                 nodes.file, nodes.place(i)));
          return is_missing;
        },
        "value");
  drop_duplicates(nodes, options.input);
  return nodes;
}

/// Reads the places with the columns of their file, and x y z if these were given.
files::Nodes read_points(const InterpolateOptions& options) {
  files::ReadOptions read;
  read.units = options.input.read.units;
  read.keep_missing = options.input.read.keep_missing;
  read.with_columns = read.lengths_decide = true;
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

void interpolate(InterpolateOptions& options) {
  if (options.points.empty() && options.grid.empty() && options.step == 0)
    throw CLI::ValidationError("--to-points", "give one of --to-points, --to-grid, --grid-step");
  const bool has_values = !options.output.empty(), has_weights = !options.weights.empty();
  if (!has_values && !has_weights) throw CLI::RequiredError("--output or --weights");
  if (has_weights && options.input.duplicates == Duplicates::mean)
    throw CLI::ValidationError("--weights", "need one node for each place: say --duplicates=first");
  const To to = has_values ? format_of(options) : To::netcdf;
  options.input.read.may_have_value = true;
  options.input.read.with_values = has_values || !options.input.read.variable.empty();
  files::Grid grid;
  if (options.points.empty()) grid = grid_of(options);
  std::optional<files::OutputFile> file, weights_file;
  if (has_values) file.emplace(options.output);
  if (has_weights) weights_file.emplace(options.weights);

  Progress progress;
  files::Nodes nodes = progress.step("reading", [&] { return read_values(options); });
  files::Nodes places = progress.step("reading the places", [&] {
    if (!options.points.empty()) return read_points(options);
    files::Nodes all;
    all.given = grid.places();
    all.points = files::points_of(all.given);
    return all;
  });
  if (static_cast<double>(places.points.size()) > kMostPlaces)
    throw std::runtime_error(
        fmt::format("{}: more than {} places: divide the file", options.points, kMostPlaces));
  const Interpolation interpolation = progress.step("triangulating", [&] {
    Interpolation made = with_nodes(nodes, [&] { return methods::interpolation_between(nodes.points); });
    tell_near_nodes(nodes, made.mesh().lists);
    return made;
  });
  Interpolation::Result result;
  files::Weights weights;
  progress.step("interpolating", [&] {
    if (has_weights) weights = interpolation.weights_at(places.points, options.method, options.outside);
    if (has_values)
      result = interpolation.values_at(places.points, nodes.value.numbers, options.method, options.outside);
  });
  const files::LonLat at = angles_of(places.points, places.given, true);
  add_history(nodes.notes);
  if (has_weights)
    progress.step("writing the weights", [&] {
      const std::vector<std::size_t> shape =
          options.points.empty() ? std::vector<std::size_t>{grid.lat.size(), grid.lon.size()} : places.shape;
      write_weights(
          *weights_file, weights,
          {angles_of(nodes.points, nodes.given, true), nodes.numbers, nodes.shape, {}},
          {at, places.numbers, shape, options.points.empty() ? edges_of(grid, options) : files::Grid{}},
          nodes.notes["history"]);
      weights_file->commit();
    });
  if (has_values)
    progress.step("writing", [&] {
      files::Field field{std::move(nodes.value), std::move(places.columns), std::move(nodes.notes)};
      if (field.value.name.empty()) field.value.name = "value";
      field.value.numbers = std::move(result.values);
      field.value.whole = false;
      make_names_differ(field.columns, {"lon", "lat", field.value.name});
      if (to == To::netcdf)
        write_netcdf_field(*file, at, grid, field);
      else
        (to == To::csv ? files::write_csv_field : files::write_field)(*file, at, field);
      file->commit();
    });
  progress.finish(fmt::format("{} ({}), {}, {} outside the nodes{}", counted(nodes.points.size(), "node"),
                              nodes.kind, counted(places.points.size(), "place"),
                              has_values ? result.outside : weights.outside,
                              has_weights ? ", " + counted(weights.node.size(), "weight") : ""));
}

}  // namespace

void add_interpolate(CLI::App& app, Command& chosen) {
  CLI::App* const sub = app.add_subcommand(
      "interpolate", "interpolates values at scattered nodes to points or to a longitude-latitude grid");
  const auto options = std::make_shared<InterpolateOptions>();
  option(*sub, "VALUES", options->input.file, "file of nodes and values; - is stdin")->required();
  option(*sub, "--variable NAME", options->input.read.variable,
         "the value: its name, or in text its column, from 1 [the only one; in text without a header "
         "the one after the coordinates]");
  option(*sub, "--to-points FILE", options->points, "file of points");
  option(*sub, "--to-grid NLATxNLON", options->grid, "points of a grid, for example 180x360");
  option(*sub, "--grid-step DEGREES", options->step, "the same grid, by the distance of its points")
      ->check(number_from(kAbove0, kLargest, "a number of degrees above 0"));
  option(*sub, "--box DEGREES", options->box,
         "edges: WEST,EAST,SOUTH,NORTH; 170,-170 crosses the dateline [-180,180,-90,90]");
  add_choice(*sub, "--registration", options->registration,
             {{"cell", Registration::cell}, {"node", Registration::node}},
             "cell: centres of equal cells; node: on the edges of the box and between [cell]");
  add_choice(
      *sub, "--method", options->method,
      {{"linear", Interpolation::Method::linear},
       {"natural", Interpolation::Method::natural},
       {"cubic", Interpolation::Method::cubic},
       {"nearest", Interpolation::Method::nearest}},
      "linear (on triangles), natural (neighbours), cubic (these and gradients) or nearest (node) [linear]");
  add_choice(*sub, "--outside", options->outside,
             {{"missing", Interpolation::Outside::missing}, {"nearest", Interpolation::Outside::nearest}},
             "places outside the nodes: missing (no value) or nearest (nearest node's value) [missing]");
  add_reading(*sub, options->input.read);
  add_skip_missing(*sub, options->input.read, "a place or a value, points without a place");
  add_duplicates(*sub, options->input);
  option(*sub, "--weights FILE", options->weights,
         "NetCDF file of the weights as of ESMF_RegridWeightGen: row, col, S; with or without --output");
  option(*sub, "-o,--output FILE", options->output, "file to write; - is stdout");
  for (const char* const of_grid : {"--box", "--registration", "--to-grid", "--grid-step"})
    sub->get_option("--to-points")->excludes(sub->get_option(of_grid));
  sub->get_option("--to-grid")->excludes("--grid-step");
  option(*sub, "--to WORD", options->to,
         "text (lines of lon lat value), csv or netcdf [by the suffix: .txt, .csv, .nc]")
      ->check(one_of({"text", "csv", "netcdf"}));
  sub->footer(
      R"(VALUES is text with `lon lat value` or `x y z value` on each line, a table with a header line, or NetCDF. `nan` and
_FillValue are missing values, in input and output. --from, --columns and --coordinates apply to VALUES, --units to
VALUES and the points. The columns of the points follow the value.)");
  sub->callback([=, &chosen] { chosen = [=] { interpolate(*options); }; });
}

}  // namespace program
