// `pstripack convert`.

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "files/mpas_mesh.h"
#include "files/nearest.h"
#include "pstripack/options.h"
#include "pstripack/progress.h"

namespace program {
namespace {

struct ConvertOptions {
  Input input;
  Output output;
  std::string region, sides;
};

/// bdyMaskCell in the input, if it has it.
std::vector<std::int32_t> layers_in(const files::Nodes& nodes) {
  const files::Column* const column = find(nodes.columns, files::kBdyMaskCell);
  if (column == nullptr || !column->whole) return {};
  return {column->numbers.begin(), column->numbers.end()};
}

files::Mesh mesh_in(const files::Nodes& nodes) {
  files::Mesh mesh = nodes.vertices.empty() ? files::mesh_of(nodes.points, nodes.triangles)
                                            : files::mesh_with_boundary(nodes.points, nodes.triangles);
  static_cast<files::NodeValues&>(mesh) = nodes;
  return mesh;
}

void write_whole(files::OutputFile& file, const ConvertOptions& options, const files::Nodes& nodes) {
  files::Mesh mesh = mesh_in(nodes);
  const Output& output = options.output;
  if (!options.region.empty()) {
    const double radius = output.radius > 0 ? output.radius : nodes.radius == 1 ? 6371220 : nodes.radius;
    keep_area(mesh, limited_area_of(options.region, options.sides, options.input.read, radius / 1000));
    const bool keeps_radius = output.radius == 0 || output.radius == nodes.radius;
    if (output.format == files::Format::mpas && keeps_radius && is_mpas_mesh(nodes)) {
      write_mpas_area(file, nodes.file, mesh.layers, nodes.notes);
      return;
    }
  }
  if (files::holds_a_mesh(output.format)) {
    write_mesh(file, output, mesh);
    return;
  }
  mesh = files::cut(mesh);
  write_nodes(file, output.format, mesh.points, mesh);
}

/// Writes an MPAS mesh with a boundary, which keeps its vertices; in other formats the triangles that have
/// all corners.
void write_cut(files::OutputFile& file, const Output& output, const files::Nodes& nodes) {
  if (output.format != files::Format::mpas) {
    files::Nodes whole = nodes;
    const auto lacks_corners = [](const pstripack::Triangle& t) { return std::min({t[0], t[1], t[2]}) < 0; };
    whole.triangles.erase(std::remove_if(whole.triangles.begin(), whole.triangles.end(), lacks_corners),
                          whole.triangles.end());
    files::Mesh mesh = mesh_in(whole);
    write_mesh(file, output, mesh);
    return;
  }
  std::vector<files::MpasMesh::Three> cells_on_vertex(nodes.triangles.begin(), nodes.triangles.end());
  write_mpas(
      file,
      files::mpas_mesh(files::unit(nodes.points), files::unit(nodes.vertices), std::move(cells_on_vertex)),
      {nodes.given,
       nodes.density,
       {},
       nodes.notes,
       layers_in(nodes),
       output.radius > 0 ? output.radius : nodes.radius,
       nodes.nominal});
}

/// Says which variables of a NetCDF file, those of init_atmosphere for example, the mesh made of it lacks.
void tell_lost_variables(const files::Nodes& nodes, const std::string& mesh) {
  if (nodes.variables.empty()) return;
  const std::vector<std::string> kept = files::netcdf_variables(mesh);
  std::vector<std::string> lost;
  for (const std::string& name : nodes.variables)
    if (std::find(kept.begin(), kept.end(), name) == kept.end()) lost.push_back(name);
  if (!lost.empty())
    say(fmt::format("{}: an MPAS mesh has no place for {}, which {} lacks", nodes.file, files::listed(lost),
                    mesh));
}

void convert(ConvertOptions& options) {
  options.output.choose();
  options.input.read.with_columns = options.input.read.with_boundary = true;
  options.input.read.with_triangles = !options.input.read.keep_missing;
  files::OutputFile file(options.output.file);
  Progress progress;
  const Input& input = options.input;
  files::Nodes nodes = progress.step("reading", [&] {
    if (!input.drops() && input.within.radians == 0 && !input.read.keep_missing)
      return files::read(input.file, input.read);
    files::Nodes places = read_places(input.file, input.read);
    drop_duplicates(places, input);
    return places;
  });
  files::Format format = options.output.format;
  const bool has_mesh = !nodes.triangles.empty();
  // .nc is the suffix of meshes and of nodes: choose by what the input has.
  if (format == files::Format::ugrid && !has_mesh && options.output.to.empty())
    format = files::Format::netcdf;
  if (nodes.polygons > 0 && !files::holds_nodes(options.output.format))
    throw std::runtime_error(
        fmt::format("{}: {} of its faces have more than three corners, which convert does not divide: "
                    "`pstripack triangulate` makes triangles of the nodes, and --to nodes writes the nodes",
                    nodes.file, nodes.polygons));
  if ((!files::holds_nodes(format) || !options.region.empty()) && !has_mesh)
    throw std::runtime_error(nodes.file + ": holds nodes without triangles: use `pstripack triangulate`");
  add_history(nodes.notes);
  progress.step("writing", [&] {
    if ((files::holds_a_mesh(format) || !options.region.empty()) && has_mesh) {
      if (!nodes.vertices.empty() && !options.region.empty())
        throw std::runtime_error(nodes.file +
                                 ": cellsOnVertex has a boundary already: cut the mesh of the sphere");
      with_nodes(nodes, [&] {
        if (nodes.vertices.empty())
          write_whole(file, options, nodes);
        else
          write_cut(file, options.output, nodes);
      });
    } else {
      write_nodes(file, format, nodes.points, nodes);
    }
    file.commit();
  });
  if (format == files::Format::mpas && options.output.file != "-")
    tell_lost_variables(nodes, options.output.file);
  progress.finish(fmt::format("{} ({}), {}", counted(nodes.points.size(), "node"), nodes.kind,
                              counted(nodes.triangles.size(), "triangle")));
}

}  // namespace

void add_convert(CLI::App& app, Command& chosen) {
  CLI::App* const sub =
      app.add_subcommand("convert", "the same nodes or triangles (of UGRID, MPAS, OFF) in another format");
  const auto options = std::make_shared<ConvertOptions>();
  add_input(*sub, options->input);
  add_duplicates(*sub, options->input);
  add_output(*sub, options->output, true);
  add_radius(*sub, options->output.radius, kRadiusOfMpas);
  add_variant(*sub, options->output);
  add_limited_area(*sub, options->region, options->sides);
  sub->callback([=, &chosen] { chosen = [=] { convert(*options); }; });
}

}  // namespace program
