// `pstripack convert`.

#include <fmt/format.h>

#include "pstripack/options.h"
#include "pstripack/progress.h"

namespace program {
namespace {

struct Options {
  Input input;
  Output output;
};

void convert(Options& options) {
  options.output.choose();
  options.input.read.with_triangles = options.input.read.with_columns = true;
  files::OutputFile file(options.output.file);
  Progress progress;
  const Input& input = options.input;
  files::Nodes nodes = progress.step("reading", [&] {
    if (!input.drops() && input.within.radians == 0) return files::read(input.file, input.read);
    files::Nodes places = read_places(input.file, input.read);
    drop_duplicates(places, input);
    return places;
  });
  files::Format format = options.output.format;
  const bool has_mesh = !nodes.triangles.empty();
  // .nc is the suffix of meshes and of nodes: choose by what the input has.
  if (format == files::Format::ugrid && !has_mesh && options.output.to.empty())
    format = files::Format::netcdf;
  if (!files::holds_nodes(format) && !has_mesh)
    throw std::runtime_error(nodes.file + ": holds nodes without triangles: use `pstripack triangulate`");
  add_history(nodes.notes);
  progress.step("writing", [&] {
    if (files::holds_a_mesh(format) && has_mesh) {
      try {
        files::Mesh mesh = files::mesh_of(nodes.points, nodes.triangles);
        mesh.given = nodes.given;
        mesh.density = nodes.density;
        mesh.columns = nodes.columns;
        mesh.notes = nodes.notes;
        write_mesh(file, format, mesh);
      } catch (const files::NoMesh& e) {
        throw std::runtime_error(nodes.file + ": " + e.what());
      }
    } else {
      write_nodes(file, format, nodes.points, {nodes.given, nodes.density, nodes.columns, nodes.notes});
    }
    file.commit();
  });
  progress.finish(fmt::format("{} ({}), {}", counted(nodes.points.size(), "node"), nodes.kind,
                              counted(nodes.triangles.size(), "triangle")));
}

}  // namespace

void add_convert(CLI::App& app, Command& chosen) {
  CLI::App* const sub =
      app.add_subcommand("convert", "the same nodes or triangles (of UGRID, MPAS, OFF) in another format");
  const auto options = std::make_shared<Options>();
  add_input(*sub, options->input);
  add_duplicates(*sub, options->input);
  add_output(*sub, options->output, true);
  sub->callback([=, &chosen] { chosen = [=] { convert(*options); }; });
}

}  // namespace program
