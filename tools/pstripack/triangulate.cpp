// `pstripack triangulate` and `pstripack voronoi`.

#include <fmt/format.h>

#include <algorithm>

#include "files/clipping.h"
#include "files/map_rings.h"
#include "files/measures.h"
#include "files/width_regions.h"
#include "pstripack/options.h"
#include "pstripack/progress.h"

namespace program {
namespace {

struct TriangulateOptions {
  Input input;
  Output output;
  std::string clip_to;  ///< of `voronoi`: a box, or a file of polygons
  bool clip_to_hull = false;
  Distance longest;  ///< of `triangulate`
};

/// `write(file, mesh)` writes the result and returns its description for the last line.
template <class Write>
void run(TriangulateOptions& options, const Write& write) {
  options.output.choose();
  if (is_box(options.clip_to)) region_of(options.clip_to, "--clip-to");  // check the option before reading
  files::OutputFile file(options.output.file);
  Progress progress;
  options.input.read.with_columns = true;
  files::Nodes nodes = progress.step("reading", [&] { return read_nodes(options.input); });
  add_history(nodes.notes);
  files::Mesh mesh = progress.step("triangulating", [&] { return triangulate(nodes); });
  const std::string what = progress.step("writing", [&] {
    const std::string written = with_nodes(nodes, [&] { return write(file, mesh); });
    file.commit();
    return written;
  });
  progress.finish(fmt::format("{} ({}), {}", counted(nodes.points.size(), "node"), nodes.kind, what));
}

void triangulate(TriangulateOptions& options) {
  if (options.longest.radians == 0 && !options.longest.text.empty())
    throw CLI::ValidationError("--longest", "'" + options.longest.text + "' leaves out everything");
  run(options, [&](files::OutputFile& file, files::Mesh& mesh) {
    mesh.longest = options.longest.radians;
    const std::size_t written = files::triangles_to_write(mesh).size() / 3;
    if (written == 0) throw files::NoMesh("each triangle has a side longer than " + options.longest.text);
    if (written < mesh.triangles())
      say(fmt::format("{}: {} with a side longer than {} left out", options.input.file,
                      counted(mesh.triangles() - written, "triangle"), options.longest.text));
    write_mesh(file, options.output, mesh);
    return counted(written, "triangle");
  });
}

/// Says which cell is a hundred times the median: that of a station at the edge of a region, most likely,
/// which gets a part of the rest of the sphere. No cell is larger than a hemisphere.
void tell_huge_cell(const TriangulateOptions& options, const files::Faces& faces, const files::Mesh& mesh) {
  std::vector<double> sorted = faces.area;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const auto largest = std::max_element(faces.area.begin(), faces.area.end());
  if (*largest < 100 * *middle) return;
  say(fmt::format(
      "{}: the cell of node {} has {:.0f} km2, {:.0f} times the median: it reaches far beyond the nodes; cut "
      "the cells by --clip-to{}",
      options.input.file, largest - faces.area.begin() + 1,
      *largest * files::kEarthRadius * files::kEarthRadius, *largest / *middle,
      mesh.has_boundary() ? " or --clip-to-hull" : ""));
}

void clip(files::Faces& faces, const std::string& to) {
  const auto polygons =
      is_box(to) ? std::vector{region_of_box(region_of(to, "--clip-to"))} : files::read_polygons(to);
  faces = in_file(to, [&] { return clipped_to_polygons(faces, polygons); });
  if (faces.size() == 0) throw files::NoMesh(to + " holds no part of the cells that is wider than rounding");
}

void voronoi(TriangulateOptions& options) {
  run(options, [&](files::OutputFile& file, const files::Mesh& mesh) {
    const bool are_whole = options.clip_to.empty() && !options.clip_to_hull;
    files::Faces faces = files::voronoi_faces(mesh);
    if (are_whole) tell_huge_cell(options, faces, mesh);
    if (options.clip_to_hull && !mesh.has_boundary())
      say(options.input.file + ": the nodes surround the sphere: --clip-to-hull cuts nothing");
    if (options.clip_to_hull) faces = clipped_to_hull(faces, mesh);
    if (!options.clip_to.empty()) clip(faces, options.clip_to);
    files::add_columns(faces, mesh);
    faces.variant = options.output.variant;
    write_faces(file, options.output.format, faces, mesh.notes);
    return counted(faces.size(), "cell") + ", " + counted(faces.points.size(), "corner");
  });
}

std::shared_ptr<TriangulateOptions> add(CLI::App& app, const char* name, const char* text,
                                        void (*command)(TriangulateOptions&), Command& chosen) {
  CLI::App* const sub = app.add_subcommand(name, text);
  const auto options = std::make_shared<TriangulateOptions>();
  add_input(*sub, options->input);
  add_duplicates(*sub, options->input);
  add_output(*sub, options->output, true);
  add_variant(*sub, options->output);
  sub->callback([=, &chosen] { chosen = [=] { command(*options); }; });
  return options;
}

}  // namespace

void add_triangulate(CLI::App& app, Command& chosen) {
  const auto options =
      add(app, "triangulate", "exact Delaunay triangulation of the nodes: a mesh of triangles", triangulate,
          chosen);
  CLI::App* const sub = app.get_subcommand("triangulate");
  add_radius(*sub, options->output.radius, kRadiusOfMpas);
  add_distance(*sub, "--longest", options->longest,
               "leave out triangles with a side longer than this: 500km, 20m, 5deg, 0.1rad");
}

void add_voronoi(CLI::App& app, Command& chosen) {
  const auto options =
      add(app, "voronoi",
          "Voronoi diagram of the nodes: a mesh with one polygon per node, in the order of the nodes",
          voronoi, chosen);
  CLI::App* const sub = app.get_subcommand("voronoi");
  option(*sub, "--clip-to BOX", options->clip_to,
         "cut the cells at WEST,EAST,SOUTH,NORTH, where 170,-170 crosses the dateline, or at the "
         "polygons of a GeoJSON file or of NAME.pts");
  sub->add_flag("--clip-to-hull", options->clip_to_hull, "cut the cells at the convex hull of the nodes");
}

}  // namespace program
