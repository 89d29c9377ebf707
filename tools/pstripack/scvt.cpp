// `pstripack scvt`.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <initializer_list>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/system.h"
#include "files/geojson.h"
#include "files/text_file.h"
#include "methods/densities.h"
#include "methods/quality.h"
#include "methods/regional_widths.h"
#include "methods/widths.h"
#include "numbers.h"
#include "pstripack/options.h"
#include "pstripack/progress.h"
#include "pstripack/ranks.h"
#include "scvt/caller_agreement.h"
#include "scvt/errors.h"
#include "scvt/first_generators.h"
#include "scvt/front.h"
#include "scvt/tessellation.h"

namespace program {
namespace {

namespace engine = pstripack::scvt;
using engine::in_agreement_with_caller;
using engine::Method;
using engine::State;
using engine::Tessellation;
using files::Point;
using pstripack::Communicator;

enum class First { by_number, front, levels, random };

struct ScvtOptions {
  std::size_t n = 0;
  std::uint64_t seed = 1;
  First first = First::by_number;
  Input start;
  std::string density, density_file, width_file, variable;
  std::string width_text, width_region, width_distance;
  std::string region, sides;     ///< that is kept; empty: the sphere
  files::LimitedArea area;       ///< the region
  files::Point centre{0, 0, 0};  ///< of its cells
  double radius = 0;             ///< of the sphere, metres; 0: not given
  double nominal = 0;  ///< width of cells of density 1 times the root of their number, radians; 0: unknown
  double grade = 0;    ///< most that widths may change, km per km; 0: not given
  Method method = Method::newton;
  double tolerance = -1;  ///< below 0: not given
  double settled = 0;     ///< the run ends when ten evaluations lower the energy by less than this part of it
  std::int64_t mark = 0;  ///< evaluations when the energy was looked at for this, ten or more ago
  double energy = INFINITY;   ///< then
  bool well_centred = false;  ///< move generators until all triangles hold their circumcentre
  bool strict = false;
  std::int64_t evaluations = 10000, every = 100;
  double time_limit = 0;  ///< seconds; 0: none
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  std::string history;  ///< of --start
  bool has_widths() const { return !(width_text + width_file + width_distance).empty(); }
  Output output, checkpoint{"", "", files::Format::netcdf};
};

// Attributes of the output that let another run continue this one.
constexpr auto kEvaluations = "scvt_iterations", kSteps = "scvt_steps", kPairs = "scvt_pairs",
               kExponent = "scvt_exponent", kMark = "scvt_mark", kEnergy = "scvt_energy_at_mark";

// The options that are stored in others: those that say the density.
constexpr std::pair<const char*, std::string ScvtOptions::*> kStored[] = {
    {"scvt_density", &ScvtOptions::density},
    {"scvt_density_file", &ScvtOptions::density_file},
    {"scvt_width_file", &ScvtOptions::width_file},
    {"scvt_width", &ScvtOptions::width_text},
    {"scvt_width_region", &ScvtOptions::width_region},
    {"scvt_width_distance", &ScvtOptions::width_distance},
    {"scvt_density_variable", &ScvtOptions::variable},
    {"scvt_region", &ScvtOptions::region},
    {"scvt_sides", &ScvtOptions::sides}};
constexpr std::pair<const char*, double ScvtOptions::*> kStoredNumbers[] = {
    {"scvt_radius", &ScvtOptions::radius}, {"scvt_grade", &ScvtOptions::grade}};

std::string note(const files::Notes& notes, const std::string& name) {
  const auto found = notes.find(name);
  return found == notes.end() ? "" : found->second;
}

std::int64_t count_in(const files::Nodes& start, const char* name, std::int64_t otherwise, double least = 0) {
  double count = 0;
  const std::string text = note(start.notes, name);
  if (text.empty()) return otherwise;
  if (!point_sets::parse(text, count) || !(count >= least && count < 1e15))
    throw std::runtime_error(fmt::format("{}: attribute {}: '{}' is not a number of {}", start.file, name,
                                         files::excerpt(text),
                                         name == kEvaluations ? "iterations" : name + sizeof "scvt"));
  return static_cast<std::int64_t>(count);
}

// Variables that hold widths of cells, never densities.
constexpr const char* kNamesOfWidths[] = {"cellWidth", "width", "resolution"};

std::unique_ptr<engine::Density> density_in_file(const ScvtOptions& options) {
  files::ReadOptions read = options.start.read;
  read.with_values = true;
  read.variable = options.variable;
  files::Nodes nodes = read_places(options.density_file, read);
  for (const char* const name : kNamesOfWidths)
    if (nodes.value.name == name)
      throw std::runtime_error(fmt::format(
          "{}: {} is a width, not a density (width^-4): say --width-file in place of --density-file",
          nodes.file, name));
  const std::vector<double>& values = nodes.value.numbers;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0 && std::isfinite(values[i])))
      throw std::runtime_error(fmt::format("{}: {}: density {}: must be positive and finite", nodes.file,
                                           nodes.place(i), values[i]));
  if (!nodes.grid.lon.empty())
    return in_file(nodes.file, [&] { return methods::density_on_grid(nodes.grid, values); });
  drop_duplicates(nodes, options.start);
  return with_nodes(nodes, [&] { return methods::density_between(nodes.points, values); });
}

/// Sets N to the number of cells that have these widths, unless N is given, and says so.
void choose_n(ScvtOptions& options, double cells) {
  constexpr double kMost = 357913943;
  if (options.n > 0 || !options.start.file.empty()) {
    if (options.n > 0)
      say(fmt::format("the widths give {:.0f} cells; {} are asked for: widths times {:.4g}", cells, options.n,
                      std::sqrt(cells / static_cast<double>(options.n))));
    return;
  }
  if (!(cells >= 4 && cells <= kMost))
    throw std::runtime_error(fmt::format(
        "the widths give {:.3g} cells, not 4 to {:.0f}: widths are in km, --radius in metres", cells, kMost));
  options.n = static_cast<std::size_t>(std::llround(cells));
  say(fmt::format("the widths give {} cells", options.n));
}

/// Throws, before the work, if N generators on this machine need more memory than it has.
void check_memory(double generators) {
  constexpr double kBytes = 750;  // of a generator; 600 with levels
  const double bytes = kBytes * generators;
  const double most = static_cast<double>(pstripack::memory_limit());
  if (bytes > most)
    throw std::runtime_error(
        fmt::format("{:.0f} generators need about {:.3g} GB, this machine has {:.3g} GB: take fewer, with "
                    "widths {:.2g} times as wide, or pstripack-mpi on several machines",
                    generators, bytes / 1e9, most / 1e9, std::sqrt(bytes / most)));
}

/// The widths, limited in their gradient.
methods::Widths widths_of(methods::Table table, const ScvtOptions& options) {
  const double radius = options.radius / 1000, before = methods::cells_of(table, radius);
  const methods::Lowered lowered = methods::limit_gradient(table, options.grade, radius);
  methods::Widths widths = methods::widths_of(std::move(table), radius);
  if (lowered.places > 0)
    say(fmt::format(
        "widths limited to a change of {:g} km per km: {} of {} values lowered, by up to {:.4g} km "
        "(lon {:g} lat {:g}): {:.2g} % more cells{}",
        options.grade, lowered.places, lowered.of, lowered.most, lowered.lon, lowered.lat,
        100 * (widths.cells / before - 1),
        widths.cells > 1.1 * before ? "; if the map is noisy, smooth it first, say by cdo smooth,radius=1deg"
                                    : ""));
  return widths;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

methods::Widths widths_in_file(const ScvtOptions& options) {
  files::ReadOptions read = options.start.read;
  read.with_values = true;
  read.variable = options.variable;
  read.usual_variables.assign(std::begin(kNamesOfWidths), std::end(kNamesOfWidths));
  read.only_axes = true;
  files::Nodes nodes = files::read(options.width_file, read);
  const auto fail = [&](const std::string& what) { throw std::runtime_error(nodes.file + ": " + what); };
  if (nodes.grid.lon.empty()) fail("expected widths on a grid, say cellWidth(lat, lon) in NetCDF");
  std::vector<double> km = std::move(nodes.value.numbers);
  const std::string& units = nodes.value.units;
  const bool are_metres = units == "m" || units == "meters" || units == "metres";
  if (!are_metres && !units.empty() && units != "km" && units != "kilometers" && units != "kilometres")
    fail(fmt::format("variable {}: units '{}'; expected km or m", nodes.value.name, files::excerpt(units)));
  const auto is_bad = [](double width) { return !(width > 0 && std::isfinite(width)); };
  if (const auto bad = std::find_if(km.begin(), km.end(), is_bad); bad != km.end()) {
    const auto i = static_cast<std::size_t>(bad - km.begin());
    const std::string place =
        fmt::format("{}, lon {:g} lat {:g}", nodes.place(i), nodes.grid.lon[i % nodes.grid.lon.size()],
                    nodes.grid.lat[i / nodes.grid.lon.size()]);
    const auto count = std::count_if(km.begin(), km.end(), is_bad);
    if (std::isnan(*bad))
      fail(
          fmt::format("{}: there is no width, at {} of {} places: fill the holes of the map, say with cdo "
                      "setmisstonn",
                      place, count, km.size()));
    fail(fmt::format("{}: width {:g}, one of {} of {} that are not positive and finite: set them", place,
                     *bad, count, km.size()));
  }
  if (are_metres)
    for (double& width : km) width /= 1000;
  const double middle = median_of(km);
  if (middle > 20000 || middle < 0.01)
    fail(fmt::format("the median width is {:g} km: if these are not km, say so: ncatted -a units,{},c,c,m {}",
                     middle, nodes.value.name, nodes.file));
  methods::Table table = in_file(nodes.file, [&] { return methods::table_of<float>(nodes.grid, km); });
  km = {};
  return widths_of(std::move(table), options);
}

/// Quasi-uniform meshes of MPAS: refined icosahedra.
constexpr std::pair<const char*, double> kQuasiUniform[] = {
    {"qu240", 10242}, {"qu120", 40962}, {"qu60", 163842}, {"qu30", 655362}, {"qu15", 2621442}};
double cells_of_quasi_uniform(const std::string& name) {
  for (const auto& [known, cells] : kQuasiUniform)
    if (name == known) return cells;
  return 0;
}

/// True if --width is a name, not a width or a formula.
bool is_name(const std::string& width) {
  return cells_of_quasi_uniform(width) > 0 || !methods::widths_of_name(width).values.empty();
}

/// Those of --width.
methods::Widths widths_of_formula(const ScvtOptions& options) {
  if (is_name(options.width_text)) return widths_of(methods::widths_of_name(options.width_text), options);
  methods::WidthFormula formula(options.width_text);
  if (formula.limit(options.grade))
    say(fmt::format("transition made {:.0f} km long, so that widths change by at most {:g} km per km",
                    formula.transition(), options.grade));
  return formula.widths(options.radius / 1000);
}

/// Those of the regions, and of the formula elsewhere.
methods::Widths widths_of_regions(const ScvtOptions& options) {
  const methods::WidthFormula elsewhere(options.width_text);
  const auto regions = files::read_width_regions(options.width_region);
  methods::Table table = in_file(options.width_region, [&] {
    return methods::widths_of_regions(regions, elsewhere, options.radius / 1000);
  });
  return widths_of(std::move(table), options);
}

methods::Widths widths_of_distance(const ScvtOptions& options) {
  const methods::WidthDistance given(options.width_distance);
  std::vector<files::Line> lines;
  for (const files::Shape& shape :
       files::read_shapes(given.file, "lines", {"LineString", "Polygon", "MultiLineString", "MultiPolygon"}))
    for (const auto& part : shape.parts) lines.insert(lines.end(), part.begin(), part.end());
  return widths_of(methods::widths_of_distance(lines, given, options.radius / 1000), options);
}

/// How many cells have --width, if it is one width on the whole sphere; 0: it is not.
double cells_of_one_width(const ScvtOptions& options) {
  const std::string& text = options.width_text;
  if (text.empty() || !(options.width_region + options.region).empty()) return 0;
  if (is_name(text)) return cells_of_quasi_uniform(text);
  const methods::WidthFormula formula(text);
  return formula.is_one_width() ? methods::cells_of_width(formula.least(), options.radius / 1000) : 0;
}

/// The density of the widths; chooses N.
std::unique_ptr<engine::Density> density_of_widths(ScvtOptions& options) {
  methods::Widths widths = !options.width_region.empty() ? widths_of_regions(options)
                           : !options.width_text.empty() ? widths_of_formula(options)
                           : !options.width_file.empty() ? widths_in_file(options)
                                                         : widths_of_distance(options);
  if (!options.region.empty()) {
    methods::RegionalWidths regional =
        methods::widths_in(options.area, widths, options.grade, options.radius / 1000);
    say(fmt::format(
        "the widths give about {:.0f} cells in the region; the others are in layers around it, or "
        "coarse and left out",
        regional.inside));
    widths = std::move(regional.widths);
    options.centre = regional.centre;
  }
  choose_n(options, widths.cells);
  options.nominal = widths.least * std::sqrt(widths.cells) / (options.radius / 1000);
  return std::move(widths.density);
}

std::unique_ptr<engine::Density> make_density(ScvtOptions& options) {
  if (options.has_widths()) return density_of_widths(options);
  if (!options.density_file.empty()) return density_in_file(options);
  if (options.density == "constant") options.nominal = std::sqrt(methods::cells_of_width(1, 1));
  return methods::density_of(options.density);
}

/// Sets the density: that of the command line, else that of the start, else constant.
void choose_density(ScvtOptions& options, const files::Notes& notes) {
  for (const auto& [name, option] : kStoredNumbers)
    if (options.*option == 0) point_sets::parse(note(notes, name), options.*option);
  if (!(options.radius > 0)) options.radius = 6371220;  // that of MPAS' and E3SM's tools
  if (!(options.grade > 0)) options.grade = 0.2;
  if (const double cells = cells_of_one_width(options); cells > 0) {
    const bool is_new = options.first == First::by_number && options.start.file.empty();
    if (is_name(options.width_text) && is_new) options.first = First::levels;
    options.density = "constant";
    options.width_text.clear();
    choose_n(options, cells);
  }
  const auto is_chosen = [&] {
    return options.has_widths() || !(options.density + options.density_file).empty();
  };
  if (!is_chosen())
    for (const auto& [name, option] : kStored)
      if ((options.*option).empty()) options.*option = note(notes, name);
  if (!is_chosen()) {
    options.density = "constant";
    if (!options.start.file.empty())
      say(options.start.file + ": holds no density: constant; say --density or widths for another one");
  }
  if (!options.region.empty())
    options.area = limited_area_of(options.region, options.sides, options.start.read, options.radius / 1000);
  const bool widths_differ = options.has_widths();
  // With a region most of the gradient is that of the coarse cells outside.
  if (options.tolerance < 0 && widths_differ) options.settled = 3e-5;
  if (options.tolerance < 0) options.tolerance = !options.region.empty() ? 1e-3 : widths_differ ? 3e-4 : 1e-4;
}

/// Empty: not used.
files::Notes notes_of_density(const ScvtOptions& options) {
  files::Notes notes;
  for (const auto& [name, option] : kStored) notes[name] = options.*option;
  for (const auto& [name, option] : kStoredNumbers)
    notes[name] = options.has_widths() ? fmt::format("{}", options.*option) : "";
  return notes;
}

files::Notes notes_of(const ScvtOptions& options, const State& state, const engine::Progress& reached) {
  files::Notes notes;
  for (const auto& [name, text] : notes_of_density(options))
    if (!text.empty()) notes[name] = text;
  notes[kEvaluations] = std::to_string(state.evaluations);
  notes[kSteps] = std::to_string(state.steps);
  notes[kExponent] = std::to_string(state.exponent);
  notes[kMark] = std::to_string(options.mark);
  notes[kEnergy] = fmt::format("{}", options.energy);
  notes["scvt_gradient"] = fmt::format("{}", reached.gradient);
  notes["scvt_energy"] = fmt::format("{}", reached.energy);
  notes["history"] = options.history;
  add_history(notes);
  return notes;
}

/// True if the file has the density of this run.
bool has_density_of(const files::Notes& notes, const ScvtOptions& options) {
  const files::Notes chosen = notes_of_density(options);
  return std::all_of(chosen.begin(), chosen.end(),
                     [&](const auto& entry) { return note(notes, entry.first) == entry.second; });
}

// Steps and changes of the gradient are stored as columns scvt_step_1_x ... scvt_change_8_z, the oldest
// first.
using engine::SinglePoint;
constexpr std::pair<const char*, std::vector<SinglePoint> State::Pair::*> kHalves[] = {
    {"step", &State::Pair::step}, {"change", &State::Pair::change}};
constexpr std::pair<const char*, float SinglePoint::*> kComponents[] = {
    {"x", &SinglePoint::x}, {"y", &SinglePoint::y}, {"z", &SinglePoint::z}};

/// The columns of each pair in the notation of kHalves and kComponents: visit(name, vectors, component).
template <class Pairs, class Visit>
void for_each_column(Pairs& pairs, const Visit& visit) {
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (const auto& [half, vectors] : kHalves)
      for (const auto& [letter, component] : kComponents)
        visit(fmt::format("scvt_{}_{}_{}", half, k + 1, letter), pairs[k].*vectors, component);
}

files::Columns columns_of(const State& state) {
  files::Columns columns;
  for_each_column(state.pairs, [&](const std::string& name, const auto& vectors, auto component) {
    columns.push_back({name});
    for (const SinglePoint& v : vectors) columns.back().numbers.push_back(v.*component);
  });
  return columns;
}

std::size_t count_of_pairs(const files::Nodes& start) {
  constexpr std::int64_t kMost = 100;  // more than any run has
  return static_cast<std::size_t>(std::min(count_in(start, kPairs, 0), kMost));
}

/// The pairs in the file; empty if it does not have all of them.
std::vector<State::Pair> pairs_in(const files::Nodes& start) {
  std::vector<State::Pair> pairs(count_of_pairs(start));
  bool has_all = true;
  for_each_column(pairs, [&](const std::string& name, auto& vectors, auto component) {
    const files::Column* const column = find(start.columns, name);
    vectors.resize(start.points.size());
    has_all = has_all && column != nullptr && !column->is_text();
    for (std::size_t i = 0; has_all && i < vectors.size(); ++i) {
      vectors[i].*component = static_cast<float>(column->numbers[i]);
      has_all = std::isfinite(vectors[i].*component);
    }
  });
  return has_all ? pairs : std::vector<State::Pair>();
}

void number(Tessellation& t) {
  t.numbers.resize(t.state.generators.size());
  std::iota(t.numbers.begin(), t.numbers.end(), std::int64_t{1});
}

/// The state of a run from its file; the generators and pairs of rank 0. Pairs are used only if the density
/// is the same and the method is not Lloyd's, which needs none. Collective.
Tessellation tessellation_of(Communicator& ranks, files::Nodes& start, ScvtOptions& options) {
  Tessellation t;
  pstripack::OnAll have_pairs;
  in_agreement_with_caller(
      ranks,
      [&] {
        t.state.evaluations = count_in(start, kEvaluations, 0);
        t.state.steps = count_in(start, kSteps, t.state.evaluations);
        options.mark = count_in(start, kMark, 0);
        point_sets::parse(note(start.notes, kEnergy), options.energy);
        t.state.exponent = static_cast<int>(count_in(start, kExponent, 0, -5000));
        const bool use_pairs = options.method == Method::newton && has_density_of(start.notes, options);
        if (ranks.rank() > 0) {  // as many pairs, of no generators
          t.state.pairs.resize(use_pairs ? count_of_pairs(start) : 0);
          return;
        }
        if (use_pairs) t.state.pairs = pairs_in(start);
        have_pairs.value = !t.state.pairs.empty();
        triangulate(start);  // reports wrong nodes with their lines
        t.state.generators = engine::unit_vectors(std::move(start.points));
        number(t);
      },
      have_pairs);
  if (!have_pairs.value) t.state.pairs.clear();
  start.columns.clear();
  return t;
}

/// The density of an MPAS mesh is at most 1.
void scale_density(files::Mesh& mesh) {
  const double largest = *std::max_element(mesh.density.begin(), mesh.density.end());
  for (double& density : mesh.density) density /= largest;
  mesh.nominal /= std::sqrt(std::sqrt(largest));
}

void write(const Output& output, files::Mesh& mesh) {
  files::OutputFile file(output.file);
  if (output.format == files::Format::mpas) scale_density(mesh);
  if (!mesh.layers.empty() && output.format != files::Format::mpas) mesh = files::cut(mesh);
  if (!files::holds_nodes(output.format))
    write_mesh(file, output, mesh);
  else
    write_nodes(file, output.format, mesh.points, {{}, mesh.density, mesh.columns, mesh.notes});
  file.commit();
}

/// Writes the generators of all ranks on rank 0, or those in the region. A checkpoint gets all, and the
/// pairs; for other files rank 0 returns the quality of the mesh. Collective.
methods::Quality write(Communicator& ranks, const ScvtOptions& options, bool is_checkpoint,
                       const Tessellation& t, const engine::Density& density, files::Notes&& notes) {
  const Output& output = is_checkpoint ? options.checkpoint : options.output;
  Tessellation all = on_rank_0(ranks, t);
  methods::Quality quality;
  in_agreement_with_caller(ranks, [&] {
    if (ranks.rank() > 0) return;
    files::Mesh mesh;
    if (is_checkpoint && files::holds_nodes(output.format))
      mesh.points = std::move(all.state.generators);
    else
      mesh = files::triangulate(std::move(all.state.generators));
    mesh.density = engine::values_at(mesh.points, density);
    mesh.notes = std::move(notes);
    mesh.nominal = options.nominal / std::sqrt(static_cast<double>(mesh.points.size()));
    if (is_checkpoint) {
      mesh.notes[kPairs] = std::to_string(all.state.pairs.size());
      if (output.format == files::Format::ugrid || output.format == files::Format::netcdf)
        mesh.columns = columns_of(all.state);
    } else {
      if (!options.region.empty()) keep_area(mesh, options.area);
      quality = methods::quality_of(mesh);
    }
    write(output, mesh);
  });
  return quality;
}

/// The generators of a new run, those of the last level if there are levels. Collective.
Tessellation first_tessellation(const ScvtOptions& options, engine::Evaluator& evaluator,
                                Progress& progress) {
  const bool is_alone = evaluator.ranks().size() == 1, is_regional = !options.region.empty();
  const First first = options.first != First::by_number                                   ? options.first
                      : is_regional || (options.n >= engine::kFewestOfAFront && is_alone) ? First::front
                                                                                          : First::levels;
  if (first == First::front) {
    Tessellation t;
    in_agreement_with_caller(evaluator.ranks(), [&] {
      if (evaluator.ranks().rank() > 0) return;
      t.state.generators = is_regional ? methods::front_around(options.centre, options.n, evaluator.density())
                                       : engine::front_generators(options.n, evaluator.density());
      number(t);
    });
    return t;
  }
  engine::RunOptions on_levels;
  on_levels.levels = first == First::levels;
  on_levels.seed = options.seed;
  on_levels.method = options.method;
  on_levels.tolerance = options.tolerance;
  on_levels.most_evaluations =
      ScvtOptions().evaluations;  // the default, so that a run that is cut short has the same levels
  on_levels.progress = [&](const engine::Progress& p) {
    progress.now(fmt::format("level of {} generators, {} evaluations, gradient {:.3g}", p.generators,
                             p.evaluations, p.gradient));
    return true;
  };
  return engine::first_generators(evaluator, options.n, on_levels);
}

/// The signal that is to end the iterations; 0: none.
volatile sig_atomic_t signal_received = 0;

void on_signal(int signal) {
  if (signal_received != 0) {
    files::remove_unfinished_output();
    std::signal(signal, SIG_DFL);
    raise(signal);
  }
  signal_received = signal;
}

/// From now on the first of these signals ends the iterations, and a second one the program. One that was
/// ignored, as INT in the background, stays so.
void end_iterations_at(std::initializer_list<int> signals) {
  for (const int signal : signals)
    if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
}

constexpr int kSettled = -1;

/// Returns the signal that ended the iterations, on any rank, SIGALRM for the time limit, or kSettled; 0:
/// nothing did. Collective.
int iterate(ScvtOptions& options, engine::Evaluator& evaluator, Tessellation& t, Progress& progress) {
  engine::Options of_run;
  of_run.method = options.method;
  of_run.tolerance = options.tolerance;
  of_run.most_evaluations = options.evaluations;
  of_run.well_centred = options.well_centred;
  pstripack::Largest signal;
  bool has_settled = false;
  of_run.progress = [&](const engine::Progress& p) {
    progress.now(fmt::format("{} evaluations, gradient {:.3g}, to fall to {:g}, energy {:.9g}", p.evaluations,
                             p.gradient, options.tolerance, p.energy));
    constexpr double kTogether = 10;
    if (const auto evaluations = static_cast<double>(p.evaluations - options.mark);
        evaluations >= kTogether) {
      const double fall = options.energy - p.energy;
      has_settled = fall >= 0 && fall < options.settled * p.energy * evaluations / kTogether;
      options.mark = p.evaluations;
      options.energy = p.energy;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - options.begin;
    const bool is_late = options.time_limit > 0 && elapsed.count() > options.time_limit;
    signal.value = signal_received == 0 && is_late ? SIGALRM : signal_received;
    agree(evaluator.ranks(), signal);
    if (!options.checkpoint.file.empty() && (signal.value != 0 || t.state.steps % options.every == 0))
      write(evaluator.ranks(), options, true, t, evaluator.density(), notes_of(options, t.state, p));
    return signal.value == 0 && !has_settled;
  };
  end_iterations_at({SIGTERM, SIGINT});
  engine::iterate(evaluator, t, of_run);
  return has_settled ? kSettled : static_cast<int>(signal.value);
}

std::string end_of(const ScvtOptions& options, const Tessellation& t, bool has_moved, int signal) {
  const auto end = [&] {
    switch (t.result.end) {
      case engine::End::converged:
        return fmt::format("converged to {:g}", options.tolerance);
      case engine::End::stalled:
        return fmt::format(
            "stalled, NOT converged to {:g}: the energy falls no more (rounding, or a rough density)",
            options.tolerance);
      case engine::End::stopped:
        if (signal == kSettled)
          return fmt::format("settled: ten evaluations lower the energy by less than {:g} of it",
                             options.settled);
        return fmt::format("ended by {}, NOT converged to {:g}",
                           signal == SIGTERM  ? "TERM"
                           : signal == SIGINT ? "INT"
                                              : "--time-limit",
                           options.tolerance);
      default:
        return has_moved ? fmt::format("NOT converged to {:g}", options.tolerance) : "none was left to do";
    }
  };
  return t.repair.moved == 0 ? end()
                             : fmt::format("{}, then {} generators moved for their triangles' circumcentres",
                                           end(), t.repair.moved);
}

/// One line if triangles are left that were to be repaired, or, with --strict, if the run has not converged.
std::string what_is_missing(const ScvtOptions& options, const Tessellation& t,
                            const methods::Quality& quality, int signal) {
  const std::int64_t obtuse = options.region.empty() ? t.repair.obtuse
                              : options.well_centred ? quality.obtuse
                                                     : 0;
  if (obtuse > 0) {
    const files::LonLat where({options.region.empty() ? t.repair.place : quality.place}, true);
    return fmt::format(
        "{} triangles do not hold their circumcentre, the first at lon {:.6g} lat {:.6g}, also after {} "
        "generators were moved: try a smaller --tolerance or --grade, or another --first or --seed",
        obtuse, where.lon[0], where.lat[0], t.repair.moved);
  }
  if (t.repair.bad > 0 && options.region.empty()) {
    const files::LonLat where({t.repair.place}, true);
    say(fmt::format("{} with an angle beyond {:g} to {:g} degrees, the first at lon {:.6g} lat {:.6g}",
                    counted(static_cast<std::size_t>(t.repair.bad), "triangle"), engine::kLeastAngle,
                    engine::kMostAngle, where.lon[0], where.lat[0]));
  }
  if (options.strict && t.result.end != engine::End::converged && signal != kSettled)
    return fmt::format("not converged to {:g}", options.tolerance);
  return "";
}

/// Reads the nodes to start from on rank 0; the other ranks get only their notes. Collective.
files::Nodes read_start(Communicator& ranks, const ScvtOptions& options) {
  files::Nodes start;
  std::string notes;
  in_agreement_with_caller(ranks, [&] {
    if (ranks.rank() > 0) return;
    Input input = options.start;
    input.read.with_columns = true;
    start = read_nodes(input);
    notes = nlohmann::json(start.notes).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  });
  const pstripack::Parcels all = ranks.all_gather(notes.data(), notes.size());
  in_agreement_with_caller(ranks, [&] {
    if (ranks.rank() > 0)
      start.notes = nlohmann::json::parse(all.bytes.data(), all.bytes.data() + all.begin.back());
  });
  return start;
}

/// The command, on all ranks.
void scvt(ScvtOptions& options, Ranks& ranks) {
  Communicator& communicator = ranks.communicator;
  in_agreement_with_caller(communicator, [&] {
    for (const std::string& file :
         {options.density_file, options.width_file, options.width_region, options.region,
          options.width_distance.substr(0, options.width_distance.find(':'))})
      if (file == "-" && communicator.size() > 1)
        throw std::runtime_error(
            "-: each rank reads this file, and rank 0 alone has the standard input: name a file");
    if (communicator.rank() > 0) return;
    for (const Output* const output : {&options.output, &options.checkpoint})
      if (!output->file.empty())
        files::OutputFile can_be_written(output->file);  // report it now, not after hours
  });
  Progress progress;
  files::Nodes start;
  if (!options.start.file.empty())
    start = progress.step("reading", [&] { return read_start(communicator, options); });
  options.history = note(start.notes, "history");
  in_agreement_with_caller(communicator, [&] { choose_density(options, start.notes); });
  std::unique_ptr<engine::Density> density;
  progress.step("reading the density",
                [&] { in_agreement_with_caller(communicator, [&] { density = make_density(options); }); });
  if (communicator.size() == 1) check_memory(static_cast<double>(options.n));
  try {
    std::shared_ptr<engine::Evaluator> evaluator = ranks.evaluator(*density);
    Tessellation t = progress.step("placing generators", [&] {
      if (options.start.file.empty()) return first_tessellation(options, *evaluator, progress);
      return tessellation_of(communicator, start, options);
    });
    const std::int64_t steps_before = t.state.steps;
    const int signal = progress.step("iterating", [&] { return iterate(options, *evaluator, t, progress); });
    const engine::Progress reached = t.result.progress;
    evaluator.reset();  // writing needs memory of its own
    t.state.pairs.clear();
    t.result.cells = {};
    const methods::Quality quality = progress.step("writing", [&] {
      return write(communicator, options, false, t, *density, notes_of(options, t.state, reached));
    });
    progress.finish(fmt::format("{} generators, {} evaluations, {}: gradient {:.3g}, energy {:.9g}",
                                reached.generators, t.state.evaluations,
                                end_of(options, t, t.state.steps > steps_before, signal), reached.gradient,
                                reached.energy));
    say(quality.text());
    const std::string missed = what_is_missing(options, t, quality, signal);
    if (!missed.empty() && options.strict) throw engine::NoTessellation(missed);
    if (!missed.empty()) say(missed);
    constexpr int kBySignal = 128;  // as a shell has it
    if (signal == SIGTERM || signal == SIGINT) global().exit_code = kBySignal + signal;
  } catch (const engine::BadDensity& e) {
    if (options.density_file.empty() || !std::isnan(e.value)) throw;
    const files::LonLat where({e.place}, true);
    throw engine::NoTessellation(fmt::format(
        "{}: the density is not known on the whole sphere: the nodes leave out lon {:.6g} lat {:.6g}",
        options.density_file, where.lon[0], where.lat[0]));
  } catch (const engine::BadGenerators& e) {
    throw engine::NoTessellation((start.file.empty() ? "" : start.file + ": ") + e.what());
  }
}

void scvt(ScvtOptions& options) {
  if (options.start.file.empty() ? options.n == 0 && !options.has_widths() : options.n > 0)
    throw CLI::ValidationError("N", "give either N or widths, for new generators, or --start FILE");
  if (!options.region.empty() && options.start.file.empty() && !options.has_widths())
    throw CLI::ValidationError("--region",
                               "say also the widths there: --width, --width-file or --width-distance");
  const std::string& width = options.width_text;
  const char* const of_part = !options.width_region.empty() && is_name(width) ? "--width-region"
                              : !options.region.empty() && cells_of_quasi_uniform(width) > 0 ? "--region"
                                                                                             : nullptr;
  if (of_part != nullptr)
    throw CLI::ValidationError(of_part, "not with " + width + ": say a width, as in 60km");
  options.output.choose();
  options.well_centred = options.well_centred || options.output.format == files::Format::mpas;
  options.output.radius = options.radius;
  if (!options.checkpoint.file.empty()) options.checkpoint.choose(files::Format::netcdf);
  try {
    on_all_ranks([&](Ranks& ranks) { scvt(options, ranks); });
  } catch (const pstripack::AgreedFailure&) {
    throw std::bad_alloc();  // some rank is out of memory
  }
}

/// A check of an option: the text must be one from which parse(text) makes something.
template <class Parse>
std::function<std::string(const std::string&)> parsed_by(const Parse& parse) {
  return [parse](const std::string& text) -> std::string {
    try {
      parse(text);
      return "";
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
  };
}

}  // namespace

void add_scvt(CLI::App& app, Command& chosen) {
  CLI::App* const sub = app.add_subcommand(
      "scvt", "spherical centroidal Voronoi tessellation: moves generators to the centroids of their cells");
  const auto options = std::make_shared<ScvtOptions>();
  option(*sub, "N", options->n, "number of generators, unless widths or --start are given")
      ->transform(whole_number())
      ->check(CLI::Range(std::size_t{4}, std::size_t{357913943}).description(""));
  option(*sub, "--seed NUMBER", options->seed, "seed of random generators")->capture_default_str();
  add_choice(*sub, "--first", options->first,
             {{"front", First::front}, {"levels", First::levels}, {"random", First::random}},
             "where N generators begin, see below [front from 3000 on, else levels; on ranks levels]");
  option(*sub, "--start FILE", options->start.file,
         "initial generators, or the output or checkpoint of a run to continue");
  option(*sub, "--density FORMULA", options->density, "density, see below [that of --start, or constant]")
      ->check(parsed_by([](const std::string& text) { methods::density_of(text); }));
  option(*sub, "--density-file FILE", options->density_file,
         "density at nodes, linear in between: lines of lon lat value or x y z value, or NetCDF");
  option(*sub, "--width WIDTH", options->width_text,
         "width of all cells, as in 60km, or a formula, see below. It is the distance of neighbours in "
         "a mesh of regular hexagons; N follows from it")
      ->check(parsed_by([](const std::string& text) {
        if (!is_name(text)) methods::WidthFormula{text};
      }));
  option(*sub, "--width-file FILE", options->width_file,
         "widths in km, bilinear on a longitude-latitude grid (NetCDF): cellWidth(lat, lon)");
  option(*sub, "--width-region FILE", options->width_region,
         "GeoJSON polygons with properties width and transition, km; elsewhere --width holds")
      ->needs("--width");
  option(*sub, "--width-distance FILE:NEAR:FAR:KM", options->width_distance,
         "widths of NEAR km at the lines or polygons of a GeoJSON file, growing to FAR at KM km from them")
      ->check(parsed_by([](const std::string& text) { methods::WidthDistance{text}; }));
  const char* const one_of_these[] = {"--density", "--density-file", "--width", "--width-file",
                                      "--width-distance"};
  for (const char* const a : one_of_these)
    for (const char* const b : one_of_these)
      if (a != b) sub->get_option(a)->excludes(sub->get_option(b));
  add_limited_area(*sub, options->region, options->sides)->excludes("--density")->excludes("--density-file");
  option(*sub, "--grade NUMBER", options->grade,
         "largest change of widths, km per km: widths above it are lowered [0.2]")
      ->check(number_from(kAbove0, kLargest, "a finite number above 0"));
  add_radius(*sub, options->radius, "radius of the sphere: for widths [6371220], in an MPAS mesh [1]");
  option(*sub, "--variable NAME", options->variable,
         "variable of the file of densities or widths: its name (NetCDF) or column (text, from 1)");
  add_choice(*sub, "--method", options->method, {{"newton", Method::newton}, {"lloyd", Method::lloyd}},
             "newton (L-BFGS) or lloyd [newton]");
  option(*sub, "--tolerance NUMBER", options->tolerance,
         "stop at this gradient: root mean square distance to the centroid over sqrt(4 pi/N) [1e-4; "
         "where widths differ 3e-4, with --region 1e-3, or when the energy has settled]")
      ->check(number_from(0, kLargest, "a number of at least 0"));
  sub->add_flag(
      "--well-centred", options->well_centred,
      "move a few generators in the end, so that all triangles hold their circumcentre; always for mpas");
  sub->add_flag(
      "--strict", options->strict,
      "status 1 if the run has not converged, or if a well-centred mesh was asked for and is not reached");
  option(*sub, "--evaluations NUMBER", options->evaluations,
         "largest number of evaluations of all N cells, including those of a run that --start continues")
      ->transform(whole_number())
      ->capture_default_str();
  option(*sub, "--time-limit SECONDS", options->time_limit,
         "end the iterations after this time from the start, and write the mesh; a signal TERM or "
         "INT does the same")
      ->check(number_from(kAbove0, kLargest, "a finite number above 0"));
  option(*sub, "--checkpoint FILE", options->checkpoint.file,
         "file that is written after every --every steps");
  option(*sub, "--every NUMBER", options->every, "steps between checkpoints")
      ->capture_default_str()
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000000}).description(""));
  add_reading(*sub, options->start.read);
  add_duplicates(*sub, options->start);
  add_output(*sub, options->output, true);
  sub->footer(R"(First generators:
  front                               an advancing front, nearly centroidal; independent of --seed
  levels                              few random generators, alternately made centroidal and refined
  random                              random generators, distributed by the density

Densities:
  constant                            1
  bump                                bump:0,30,30,10,3
  bump:LON,LAT,RADIUS,WIDTH,RATIO     (1 + (RATIO-1) (1 + tanh((RADIUS-d)/WIDTH))/2)^4, d the distance from LON,LAT,
                                      all in degrees: cells within RADIUS are RATIO times narrower than far away
A NetCDF density on the two axes of a global longitude-latitude grid is bilinear between its values.

Widths, in km, angles in degrees:
  60km                                the width of all cells
  disc:INNER,OUTER,RADIUS,TRANSITION,LON,LAT
  band:INNER,OUTER,RADIUS,TRANSITION,LAT
                                      INNER up to RADIUS km from LON,LAT, or from the parallel LAT; then over TRANSITION
                                      km, which --grade may lengthen, smoothly to OUTER
  ec60to30, rrs18to6                  E3SM's ocean meshes, by latitude
  qu240, qu120, qu60, qu30, qu15      10,242 to 2,621,442 cells of one width, with 12 pentagons

To continue a run, repeat its command with --start CHECKPOINT instead of N: the result has the same bits as without
interruption, except the history of the file. NetCDF files hold evaluations and density. NetCDF checkpoints also hold the
state of --method newton; mpas files and other formats do not, and the method restarts. A step takes one or more
evaluations; the last step is finished.
--from, --coordinates and --units apply to both input files.

)" + sub->get_footer());
  sub->callback([=, &chosen] { chosen = [=] { scvt(*options); }; });
}

}  // namespace program
