#include "pstripack/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "files/nearest.h"
#include "numbers.h"
#include "pstripack/progress.h"

namespace program {
namespace {

using files::Column;
using files::Nodes;

constexpr double kRightAngle = 1.5707963267948966;
constexpr auto kNode = "node", kLine = "line", kFeature = "feature";  // columns

void check_directions(const Nodes& nodes) {
  for (std::size_t i = 0; i < nodes.points.size(); ++i)
    if (!pstripack::has_direction(nodes.points[i]))
      throw std::runtime_error(
          fmt::format("{}: {} is zero or not finite: remove it", nodes.file, nodes.place(i)));
}

/// Marks of missing values, as -999, are no longitudes.
void check_longitudes(const Nodes& nodes) {
  for (std::size_t i = 0; i < nodes.given.lon.size(); ++i)
    if (std::fabs(nodes.given.lon[i]) > (nodes.given.degrees ? 720 : 8 * kRightAngle))
      throw std::runtime_error(fmt::format(
          "{}: {}: longitude {} is more than two turns: if it means a missing place, remove the row",
          nodes.file, nodes.place(i), nodes.given.lon[i]));
}

/// If three columns are vectors whose lengths differ by more than 1 %, most likely they are not x y z; nor if
/// all lie at the equator but are not on one sphere: they are metres of a map projection.
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
  if (high > (1 + files::kSameLength) * low &&
      std::all_of(nodes.points.begin(), nodes.points.end(),
                  [&](const files::Point& p) { return std::fabs(p.z) < 0.02 * low; }))
    throw std::runtime_error(
        nodes.file +
        ": x y z of nodes at the equator, but not on one sphere: if they are metres of a map "
        "projection, convert them to longitudes and latitudes, say by gdaltransform or "
        "to_crs(4326); say --coordinates xyz if the vectors are directions");
}

constexpr double kDegree = kRightAngle / 90;

Distance distance_of(const char* option, const std::string& text) {
  const std::size_t unit = text.find_last_not_of("abcdefghijklmnopqrstuvwxyz") + 1;
  constexpr std::pair<const char*, double> kUnits[] = {{"mm", files::kMillimetre},
                                                       {"cm", 10 * files::kMillimetre},
                                                       {"m", 1e3 * files::kMillimetre},
                                                       {"km", 1e6 * files::kMillimetre},
                                                       {"deg", kDegree},
                                                       {"rad", 1}};
  const auto known = std::find_if(std::begin(kUnits), std::end(kUnits),
                                  [&](const auto& u) { return text.compare(unit, text.npos, u.first) == 0; });
  double value = 0;
  if (known == std::end(kUnits) || !point_sets::parse(text.substr(0, unit), value))
    throw CLI::ValidationError(
        option,
        "'" + text + "': expected a number and its unit: 1mm, 0.5m, 2km (on the Earth), 1e-6deg or 1e-8rad");
  const Distance distance{value * known->second, text};
  if (!(value >= 0 && distance.radians < 90 * kDegree))
    throw CLI::ValidationError(option, "'" + text + "': expected a distance from 0 to less than 90deg");
  return distance;
}

std::string suffixes() {
  std::string text;
  for (const files::FormatEntry& f : files::formats())
    text += fmt::format("\n  {:<7} {:<16} {}", f.name, f.suffixes, f.what);
  return text;
}

}  // namespace

void add_distance(CLI::App& app, const char* name, Distance& distance, const char* text) {
  app.add_option_function<std::string>(
         name, [=, &distance](const std::string& word) { distance = distance_of(name, word); }, text)
      ->type_name("DISTANCE");
}

Global& global() {
  static Global options;
  return options;
}

std::string counted(std::size_t n, const std::string& thing) {
  return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

CLI::Validator whole_number() {
  const auto check = [](std::string& text) -> std::string {
    double value = 0;
    constexpr double kMost = 9007199254740992;  // 2^53: all smaller integers are doubles
    if (!point_sets::parse(text, value) || value != std::floor(value) || !(value >= 0 && value <= kMost))
      return "'" + text + "' is not a whole number";
    text = fmt::format("{:.0f}", value);
    return "";
  };
  return CLI::Validator(check, "");
}

std::vector<double> numbers_in(const std::string& option, const std::string& text, char separator,
                               std::size_t count) {
  std::vector<double> numbers = files::numbers_between(text, separator);
  if (numbers.size() != count)
    throw CLI::ValidationError(option, fmt::format("'{}' is not {} numbers", text, count));
  return numbers;
}

files::Region region_of(const std::string& text, const std::string& option) {
  const std::vector<double> r = numbers_in(option, text, ',', 4);
  files::Region region{r[0], r[1] < r[0] ? r[1] + 360 : r[1], r[2], r[3]};
  const double width = region.east - region.west;
  if (!(std::fabs(r[0]) <= 360 && std::fabs(r[1]) <= 360 && width > 0 && width <= 360 && r[2] >= -90 &&
        r[2] < r[3] && r[3] <= 90))
    throw CLI::ValidationError(
        option, "'" + text +
                    "': expected WEST,EAST,SOUTH,NORTH in degrees, longitudes from -360 to 360, "
                    "latitudes from -90 to 90, the south first; 170,-170 crosses the dateline");
  return region;
}

bool is_box(const std::string& text) {
  return text.find(',') != text.npos && text.find_first_not_of("+-.,eE0123456789") == text.npos;
}

files::LimitedArea limited_area_of(const std::string& text, const std::string& sides,
                                   const files::ReadOptions& read, double radius) {
  constexpr std::string_view kCircle = "circle:";
  const bool great_circles = sides == "great-circle";
  const bool is_circle = text.rfind(kCircle, 0) == 0;
  const bool is_file = !is_circle && !is_box(text);
  if (is_file && text != "-" && !std::filesystem::exists(text))
    throw CLI::ValidationError("--region", "there is no file '" + text +
                                               "': expected WEST,EAST,SOUTH,NORTH, circle:KM,LON,LAT, or a "
                                               "file of GeoJSON polygons or NAME.pts");
  if (is_file)
    return files::file_area(text, 1000 * radius, read.units == files::Units::degrees, great_circles);
  const std::string name = "--region " + text;
  if (!is_circle) {
    const files::Region box = region_of(text);
    if (read.units != files::Units::degrees &&
        std::max(std::fabs(box.west), std::fabs(box.east)) <= 4 * kDegree * 90 &&
        std::max(std::fabs(box.south), std::fabs(box.north)) <= kDegree * 90)
      throw CLI::ValidationError(
          "--region",
          "'" + text + "': these may be radians: give degrees; if these are degrees, say --units degrees");
    return files::box_area(name, box, great_circles);
  }
  const std::vector<double> r = numbers_in("--region", text.substr(kCircle.size()), ',', 3);
  if (!(r[0] > 0 && r[0] / radius < 2 * kDegree * 90 && std::fabs(r[1]) <= 360 && std::fabs(r[2]) <= 90))
    throw CLI::ValidationError(
        "--region",
        "'" + text +
            fmt::format("': expected circle:KM,LON,LAT: a radius from 0 to {:.0f} km, and degrees",
                        2 * kDegree * 90 * radius));
  return files::circle_area(name, r[1], r[2], r[0] / radius, great_circles);
}

CLI::Option* add_limited_area(CLI::App& app, std::string& text, std::string& sides) {
  CLI::Option* const region =
      option(app, "--region REGION", text,
             "keep the cells of a limited area: WEST,EAST,SOUTH,NORTH, circle:KM,LON,LAT, or a file "
             "of GeoJSON polygons or of MPAS-Limited-Area, NAME.pts, and 7 layers of cells around "
             "it, with their bdyMaskCell");
  option(app, "--sides WORD", sides,
         "sides of the region: map (straight in longitude and latitude) or great-circle, as in "
         "MPAS-Limited-Area: always for NAME.pts [map]")
      ->check(one_of({"map", "great-circle"}))
      ->needs(region);
  return region;
}

void keep_area(files::Mesh& mesh, const files::LimitedArea& area) {
  files::set_layers(mesh, area);
  const auto left_out = std::count(mesh.layers.begin(), mesh.layers.end(), files::kLeftOut);
  const auto inside = std::count(mesh.layers.begin(), mesh.layers.end(), 0);
  const auto all = static_cast<std::ptrdiff_t>(mesh.layers.size());
  say(fmt::format("{} of {} cells kept: {} in the region, {} in {} layers around it", all - left_out, all,
                  inside, all - left_out - inside, files::kLayers));
}

void add_input(CLI::App& app, Input& input) {
  option(app, "IN", input.file, "file of nodes; - is stdin")->required();
  add_reading(app, input.read);
  add_skip_missing(app, input.read, "a place");
}

void add_skip_missing(CLI::App& app, files::ReadOptions& read, const char* what) {
  app.add_flag("--skip-missing", read.keep_missing,
               fmt::format("leave out nodes without {} [an error]", what));
}

void add_duplicates(CLI::App& app, Input& input) {
  add_choice(app, "--duplicates", input.duplicates,
             {{"error", Duplicates::error}, {"first", Duplicates::first}, {"mean", Duplicates::mean}},
             "nodes in the same place: error, first (keep it) or mean (of their values) [error]");
  add_distance(app, "--duplicates-within", input.within,
               "nodes this near are in the same place: 1mm, 0.5m, 2km, 1e-6deg, 1e-8rad [0]");
}

void add_output(CLI::App& app, Output& output, bool required) {
  CLI::Option* const file = option(app, "-o,--output FILE", output.file, "file to write; - is stdout");
  file->required(required);
  if (!required) file->capture_default_str();
  std::vector<std::string> names;
  for (const files::FormatEntry& f : files::formats()) names.emplace_back(f.name);
  option(app, "--to FORMAT", output.to, "format, see below [by the suffix of the file]")
      ->check(one_of(names));
  app.footer("Formats and their suffixes:" + suffixes());
}

std::function<std::string(const std::string&)> number_from(double low, double high, std::string what) {
  return [=](const std::string& word) {
    double value = 0;
    return point_sets::parse(word, value) && low <= value && value <= high
               ? ""
               : fmt::format("'{}' is not {}", word, what);
  };
}

CLI::Option* add_radius(CLI::App& app, double& radius, const char* text) {
  return option(app, "--radius METRES", radius, text)
      ->check(number_from(kAbove0, kLargest, "a number of metres above 0"));
}

void add_variant(CLI::App& app, Output& output) {
  app.add_flag("--edges", output.variant.edges, "UGRID: also the edges, with their nodes and faces");
  add_choice(app, "--rings", output.variant.clockwise, {{"counterclockwise", false}, {"clockwise", true}},
             "GeoJSON: turn of the rings; clockwise for D3 and globe.gl [counterclockwise, as RFC 7946]");
}

void Output::choose(std::optional<files::Format> otherwise) {
  std::optional<files::Format> found = files::format_of(to, file);
  if (!found) found = otherwise;
  if (!found) {
    const std::string_view name(file);
    const std::size_t dot = std::min(name.rfind('.'), name.size());
    const std::string_view suffix = name.substr(dot);
    if (suffix == ".gpkg" || suffix == ".shp" || suffix == ".kml")
      throw CLI::ValidationError(
          "--output", fmt::format("{0}: write GeoJSON and convert it: ogr2ogr {0} {1}.geojson", file,
                                  name.substr(0, dot)));
    throw CLI::ValidationError("--output", file + ": no format has this suffix: give --to");
  }
  format = *found;
  if (radius > 0 && format != files::Format::mpas)
    throw CLI::ValidationError("--radius", "only MPAS meshes have a radius: --to mpas");
  if (variant.clockwise && format != files::Format::geojson)
    throw CLI::ValidationError("--rings", "only GeoJSON has rings: --to geojson");
  if (variant.edges && format != files::Format::ugrid)
    throw CLI::ValidationError("--edges", "it is for UGRID (MPAS meshes always have edges): --to ugrid");
}

Nodes read_places(const std::string& file, const files::ReadOptions& options) {
  Nodes nodes = files::read(file, options);
  if (options.keep_missing)
    leave_out(
        nodes,
        [&](std::size_t i) {
          const files::Point& p = nodes.points[i];
          return std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z);
        },
        "place");
  check_directions(nodes);
  check_longitudes(nodes);
  if (options.coordinates != files::Coordinates::xyz) check_lengths(nodes);
  return nodes;
}

void leave_out(Nodes& nodes, const std::function<bool(std::size_t)>& is_missing, const char* what) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < nodes.points.size(); ++i)
    if (!is_missing(i)) kept.push_back(i);
  if (kept.size() == nodes.points.size()) return;
  say(fmt::format("{}: {} without {} left out", nodes.file,
                  counted(nodes.points.size() - kept.size(), "node"), what));
  nodes.keep(kept);
}

Nodes read_nodes(const Input& input) {
  Nodes nodes = read_places(input.file, input.read);
  if (nodes.points.size() < 3)
    throw std::runtime_error(fmt::format("{}: a triangulation needs at least 3 nodes, here are {}",
                                         nodes.file, nodes.points.size()));
  if (input.read.with_columns) number_nodes(nodes);
  drop_duplicates(nodes, input);
  return nodes;
}

std::vector<std::size_t> without(const std::vector<files::Duplicate>& duplicates, std::size_t nodes) {
  std::vector<std::size_t> kept;
  auto next = duplicates.begin();
  for (std::size_t i = 0; i < nodes; ++i)
    if (next != duplicates.end() && next->node == i)
      ++next;
    else
      kept.push_back(i);
  return kept;
}

namespace {

/// Sets the numbers of each first node to the mean over its duplicates; missing numbers are ignored.
void take_means(Column& column, const std::vector<files::Duplicate>& duplicates) {
  if (column.numbers.empty()) return;
  std::map<std::size_t, std::pair<double, double>> sums;  // and how many numbers
  const auto add = [&](std::size_t first, double number) {
    if (std::isnan(number)) return;
    sums[first].first += number;
    ++sums[first].second;
  };
  for (const files::Duplicate& d : duplicates) {
    if (sums.count(d.first) == 0) add(d.first, column.numbers[d.first]);
    add(d.first, column.numbers[d.node]);
  }
  for (const auto& [first, sum] : sums) {
    const double mean = sum.first / sum.second;
    column.numbers[first] = mean;
    column.texts.clear();
    if (mean != std::floor(mean)) column.whole = false;
  }
}

/// The nodes in the same place as an earlier one, or within this distance of one that is kept.
std::vector<files::Duplicate> duplicates_within(const std::vector<files::Point>& points, double within) {
  const std::vector<files::Duplicate> same = files::duplicates(points);
  if (within == 0) return same;
  const std::vector<std::size_t> kept = without(same, points.size());
  std::vector<std::size_t> first(points.size());  // the kept node in whose place each node is
  std::iota(first.begin(), first.end(), std::size_t{0});
  for (const files::Duplicate& d : same) first[d.node] = d.first;
  const files::Mesh mesh = files::triangulate(files::values_at(points, kept));
  for (const files::Duplicate& d : files::near_duplicates(mesh, within)) first[kept[d.node]] = kept[d.first];
  std::vector<files::Duplicate> all;
  for (std::size_t i = 0; i < first.size(); ++i)
    if (first[i] != i) all.push_back({i, first[first[i]]});
  return all;
}

}  // namespace

void drop_duplicates(Nodes& nodes, const Input& input) {
  const Distance& within = input.within;
  if (!input.drops() && within.radians == 0) return;
  const std::vector<files::Duplicate> duplicates =
      with_nodes(nodes, [&] { return duplicates_within(nodes.points, within.radians); });
  if (duplicates.empty()) return;
  const bool means = input.duplicates == Duplicates::mean;
  if (!input.drops())
    throw std::runtime_error(fmt::format(
        "{}: {} and {} are within {} of each other: remove one, or say --duplicates=first", nodes.file,
        nodes.place(duplicates[0].first), nodes.place(duplicates[0].node), within.text));
  if (means) {
    take_means(nodes.value, duplicates);
    for (Column& column : nodes.columns)
      if (column.name != kNode && column.name != kLine && column.name != kFeature)
        take_means(column, duplicates);
  }
  nodes.keep(without(duplicates, nodes.points.size()));
  const bool is_one = duplicates.size() == 1;
  say(fmt::format("{}: {} dropped that {} earlier ones{}", nodes.file, counted(duplicates.size(), "node"),
                  within.radians == 0 ? fmt::format("coincide{} with", is_one ? "s" : "")
                                      : fmt::format("{} within {} of", is_one ? "is" : "are", within.text),
                  means ? "; the mean of their values is kept" : ""));
}

void tell_near_nodes(const Nodes& nodes, const pstripack::ListsView<std::int32_t>& lists) {
  const files::NearNeighbours near = files::near_neighbours(lists, nodes.points, files::kMillimetre);
  if (near.pairs == 0) return;
  say(fmt::format(
      "{}: {} less than 1 mm apart on the Earth, but not in the same place: {} and {}{}; "
      "--duplicates first --duplicates-within 1mm keeps one of each pair",
      nodes.file, near.pairs == 1 ? "2 nodes are" : fmt::format("{} pairs of nodes are", near.pairs),
      nodes.place(near.first), nodes.place(near.second), near.pairs == 1 ? "" : ", ..."));
}

void number_nodes(Nodes& nodes) {
  const auto add = [&](const char* name, const std::string& long_name, const auto& number) {
    if (find(nodes.columns, name) != nullptr) return;
    std::vector<double> numbers(nodes.points.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(number(i));
    nodes.columns.insert(nodes.columns.begin(), files::whole_numbers(name, long_name, std::move(numbers)));
  };
  if (!nodes.lines.empty())
    add(nodes.lines_are, fmt::format("{} of the node in the input", nodes.lines_are),
        [&](std::size_t i) { return nodes.lines[i]; });
  add(kNode, "number of the node in the input, from 1", [&](std::size_t i) { return nodes.number(i); });
}

void add_history(files::Notes& notes) {
  std::string& history = notes["history"];
  history = global().command + (history.empty() ? "" : "\n") + history;
}

std::runtime_error no_mesh_of(const Nodes& nodes, const files::NoMesh& why) {
  if (const auto* const coincident = dynamic_cast<const files::CoincidentNodes*>(&why))
    return std::runtime_error(
        fmt::format("{}: {} and {} are in the same place: remove one, or say --duplicates=first", nodes.file,
                    nodes.place(coincident->first), nodes.place(coincident->second)));
  return std::runtime_error(nodes.file + ": " + why.what());
}

void write_mesh(files::OutputFile& file, const Output& output, files::Mesh& mesh) {
  if (!mesh.layers.empty() && output.format != files::Format::mpas) mesh = files::cut(mesh);
  if (output.radius > 0) mesh.radius = output.radius;
  mesh.variant = output.variant;
  write_mesh(file, output.format, mesh);
  if (output.format != files::Format::mpas || !mesh.has_boundary()) return;
  const auto left_out = std::count_if(mesh.lend.begin(), mesh.lend.end(), [&](std::int32_t end) {
    return mesh.list[static_cast<std::size_t>(end) - 1] < 0;
  });
  say(fmt::format("{} have no whole cell, at the boundary of the mesh: {} without them",
                  counted(static_cast<std::size_t>(left_out), "node"), file.name()));
}

files::Mesh triangulate(Nodes& nodes) {
  files::Mesh mesh = with_nodes(nodes, [&] { return files::triangulate(nodes.points); });
  tell_near_nodes(nodes, mesh.lists());
  static_cast<files::NodeValues&>(mesh) = std::move(nodes);
  mesh.nominal = 0;  // of other cells
  return mesh;
}

}  // namespace program
