// `pstripack plot`.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "files/nearest.h"
#include "numbers.h"
#include "pictures/mesh_picture.h"
#include "pictures/scale.h"
#include "pstripack/options.h"
#include "pstripack/progress.h"

namespace program {
namespace {

using pictures::MeshOptions;

struct PlotOptions {
  Input input;
  MeshOptions mesh;
  std::string file, to, view, colour = "none", box, range;
  std::optional<std::string> title;
};

/// Parses orthographic[:LON,LAT] or lonlat[:LON,LAT].
void set_view(const std::string& text, MeshOptions& mesh) {
  const auto refuse = [&] {
    throw CLI::ValidationError("--view", text +
                                             ": expected orthographic, lonlat, or one of them with the "
                                             "centre in degrees: orthographic:LON,LAT");
  };
  const std::vector<std::string> parts = files::parts_of(text, ':');
  mesh.lonlat = parts[0] == "lonlat";
  if ((!mesh.lonlat && parts[0] != "orthographic") || parts.size() > 2) refuse();
  if (parts.size() == 1) return;
  const std::vector<double> numbers = files::numbers_between(parts[1], ',');
  if (numbers.size() != 2 || std::fabs(numbers[0]) > 360 || std::fabs(numbers[1]) > 90) refuse();
  mesh.centre = {numbers[0], numbers[1]};
}

/// Parses none, area, degree, owner:P[:stripes], or the name of a column.
void set_colour(const std::string& text, MeshOptions& mesh) {
  using Colour = MeshOptions::Colour;
  const std::vector<std::string> parts = files::parts_of(text, ':');
  const std::map<std::string, Colour> words{
      {"none", Colour::none}, {"area", Colour::size}, {"degree", Colour::degree}};
  if (const auto word = words.find(text); word != words.end()) {
    mesh.colour = word->second;
    return;
  }
  if (parts[0] != "owner") {
    mesh.colour = Colour::value;
    mesh.value = text;
    return;
  }
  double ranks = 0;
  if (parts.size() > 1) point_sets::parse(parts[1], ranks);
  const bool are_stripes = parts.size() == 3 && parts[2] == "stripes";
  constexpr double kMost = 4096;
  if (parts.size() != (are_stripes ? 3 : 2) || !(ranks >= 1 && ranks <= kMost) || ranks != std::floor(ranks))
    throw CLI::ValidationError("--colour",
                               text + ": expected owner:P or owner:P:stripes for 1 to 4096 ranks");
  mesh.colour = Colour::owner;
  mesh.ranks = static_cast<int>(ranks);
  if (are_stripes) mesh.partition = pstripack::PartitionKind::stripes;
}

void set_box(const PlotOptions& options, MeshOptions& mesh) {
  mesh.region = region_of(options.box, "--box");
  mesh.lonlat = true;
  if (mesh.radius || (!options.view.empty() && options.view != "lonlat"))
    throw CLI::ValidationError(
        "--box", "it is a map of longitude and latitude: leave out --zoom, and other views than lonlat");
}

void set_range(const std::string& text, MeshOptions& mesh) {
  if (mesh.colour != MeshOptions::Colour::size && mesh.colour != MeshOptions::Colour::value)
    throw CLI::ValidationError("--range", "a colour bar is needed: --colour area or a column of numbers");
  const std::vector<double> ends = numbers_in("--range", text, ',', 2);
  if (!(ends[0] < ends[1] && ends[1] - ends[0] > 1e-9 * std::fabs(ends[1])))
    throw CLI::ValidationError("--range", "'" + text + "': expected LOW,HIGH, the lower first");
  mesh.range = {ends[0], ends[1]};
}

std::string what_is_drawn(const files::Mesh& mesh, MeshOptions::What what) {
  const std::string nodes = pictures::grouped(mesh.points.size());
  if (what == MeshOptions::What::cells) return nodes + " cells";
  return fmt::format("{} nodes, {} triangle{}", nodes, pictures::grouped(mesh.triangles()),
                     mesh.triangles() == 1 ? "" : "s");
}

void expect_column(const files::Nodes& nodes, const std::string& name) {
  if (files::find(nodes.columns, name) != nullptr) return;
  std::vector<std::string> names{"none", "area", "degree", "owner:P"};
  for (const files::Column& column : nodes.columns) names.push_back(column.name);
  throw std::runtime_error(fmt::format("{}: --colour {}: no column has this name{} (expected {})", nodes.file,
                                       name, files::did_you_mean(name, names), files::listed(names)));
}

void plot(PlotOptions& options) {
  const std::string suffix =
      options.to.empty() ? std::filesystem::path(options.file).extension().string() : "." + options.to;
  const bool globe = suffix == ".html";
  if (!globe && suffix != ".svg")
    throw CLI::ValidationError(
        "--output",
        options.file + ": expected FILE.svg or FILE.html, or --to svg or html; rsvg-convert makes PNG");
  MeshOptions& wanted = options.mesh;
  if (!options.view.empty()) set_view(options.view, wanted);
  set_colour(options.colour, wanted);
  if (!options.box.empty()) set_box(options, wanted);
  if (!options.range.empty()) set_range(options.range, wanted);
  if (wanted.colour == MeshOptions::Colour::degree && wanted.what != MeshOptions::What::cells)
    throw CLI::ValidationError("--colour", "degree is a property of nodes: say --what cells");
  if (globe && (wanted.lonlat || wanted.width != MeshOptions().width || wanted.dots))
    throw CLI::ValidationError("--to", "a globe has no --view lonlat, --box, --dots or --width");

  options.input.read.with_columns = wanted.colour == MeshOptions::Colour::value;
  // Without triangles where nodes are left out, which renumbers corners.
  options.input.read.with_triangles = !options.input.drops() && !options.input.read.keep_missing;
  options.input.read.with_cells = true;
  files::OutputFile file(options.file);
  Progress progress;
  files::Nodes nodes = progress.step("reading", [&] { return read_nodes(options.input); });
  if (nodes.kind.find("cells") != nodes.kind.npos)
    say(nodes.file + ": whole cells of its nodes are drawn, also where it has parts of them");
  if (wanted.colour == MeshOptions::Colour::value) expect_column(nodes, wanted.value);
  const files::Mesh mesh = progress.step("triangulating", [&] {
    if (nodes.triangles.empty()) return triangulate(nodes);
    files::Mesh drawn = with_nodes(nodes, [&] { return files::mesh_of(nodes.points, nodes.triangles); });
    drawn.columns = std::move(nodes.columns);
    return drawn;
  });
  progress.step("drawing", [&] {
    wanted.title = options.title
                       ? *options.title
                       : fmt::format("{}: {}", std::filesystem::path(nodes.file).filename().string(),
                                     what_is_drawn(mesh, wanted.what));
    const std::string picture = in_file(nodes.file, [&] {
      return globe ? globe_page(mesh_globe(mesh, wanted)) : mesh_picture(mesh, wanted);
    });
    file.write(picture.data(), picture.size());
    file.commit();
  });
  progress.finish(fmt::format("{} ({}), {}", counted(nodes.points.size(), "node"), nodes.kind,
                              counted(mesh.triangles(), "triangle")));
}

}  // namespace

void add_plot(CLI::App& app, Command& chosen) {
  CLI::App* const sub = app.add_subcommand("plot",
                                           "picture of the triangulation or its Voronoi cells: SVG; "
                                           "a globe to turn: HTML");
  const auto options = std::make_shared<PlotOptions>();
  add_input(*sub, options->input);
  add_duplicates(*sub, options->input);
  option(*sub, "-o,--output FILE", options->file,
         "picture to write: FILE.svg, or FILE.html, a globe; - is stdout")
      ->required();
  option(*sub, "--to FORMAT", options->to, "svg or html [by the suffix of the file]")
      ->check(one_of({"svg", "html"}));
  add_choice(*sub, "--what", options->mesh.what,
             {{"triangles", MeshOptions::What::triangles}, {"cells", MeshOptions::What::cells}},
             "triangles, or cells of the Voronoi diagram [triangles]");
  option(*sub, "--view VIEW", options->view,
         "orthographic or lonlat, or with a centre orthographic:LON,LAT [the middle of the nodes]");
  option(*sub, "--zoom DEGREES", options->mesh.radius, "show this many degrees around the centre [all nodes]")
      ->check(number_from(1e-6, 180, "a number from 1e-06 to 180"));
  option(*sub, "--box DEGREES", options->box,
         "show the map of WEST,EAST,SOUTH,NORTH; 170,-170 crosses the dateline");
  option(*sub, "--colour,--color BY", options->colour,
         "none, area, degree, owner:P, owner:P:stripes or a column of IN, see below")
      ->capture_default_str();
  option(*sub, "--range LOW,HIGH", options->range, "ends of the colour bar [those of the values]");
  sub->add_flag("--dots", options->mesh.dots, "also draw the nodes, as dots");
  sub->add_flag("--coasts", options->mesh.coasts,
                "coast lines of Natural Earth, from Debian's libmagics++-data");
  option(*sub, "--coast-file FILE", options->mesh.coast_file, "coast lines of this shapefile instead");
  option(*sub, "--title TEXT", options->title, "title of the picture [file and counts]");
  option(*sub, "--width PIXELS", options->mesh.width, "width of the picture")
      ->capture_default_str()
      ->check(number_from(100, 20000, "a number from 100 to 20000"));
  sub->footer(R"(  pstripack plot mesh.nc -o mesh.svg
  pstripack plot nodes.txt --view orthographic:10,45 --zoom 5 -o zoom.svg --width 1600
  pstripack plot nodes.txt --what cells --colour area -o cells.svg
  pstripack plot quakes.csv --what cells --colour mag --coasts --view lonlat -o quakes.svg
  pstripack plot quakes.csv --what cells --colour mag --range 2,7 --dots --box 170,-170,-30,-10 -o fiji.svg
  pstripack plot quakes.csv --what cells --colour mag --coasts -o globe.html

Colours:
  area             of the triangle or cell, on a sphere of radius 6371 km
  degree           number of neighbours of the node; with --what cells only
  owner:P          rank that owns the node if P ranks divide the sphere by recursive bisection
  owner:P:stripes  the same, by stripes of longitude
  NAME             the column of this name; a triangle has the mean of its corners. node and line: numbers in IN.

Triangles of UGRID, MPAS and OFF files are drawn as they are; other nodes are triangulated first. Nodes that do not
cover the sphere fill the picture; their boundary is orange. At most 200,000 nodes may be in view: choose a part by
--view and --zoom. To make PNG: rsvg-convert mesh.svg -o mesh.png (Debian: librsvg2-bin). A globe is one file for
any browser, without network, that holds the mesh, of any size.)");

  sub->callback([=, &chosen] { chosen = [=] { plot(*options); }; });
}

}  // namespace program
