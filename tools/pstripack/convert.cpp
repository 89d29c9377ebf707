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
  options.input.read.with_triangles = true;
  files::OutputFile file(options.output.file);
  Progress progress;
  files::Nodes nodes =
      progress.step("reading", [&] { return files::read(options.input.file, options.input.read); });
  files::Format format = options.output.format;
  const bool has_mesh = !nodes.triangles.empty();
  // The suffix .nc stands for meshes and for nodes.
  if (format == files::Format::ugrid && !has_mesh && options.output.to.empty())
    format = files::Format::netcdf;
  if (files::holds_a_mesh(format) && !has_mesh)
    throw std::runtime_error(nodes.file +
                             ": holds nodes, no triangles: `pstripack triangulate` makes a mesh of them");
  progress.step("writing", [&] {
    if (files::holds_a_mesh(format)) {
      try {
        files::Mesh mesh = files::mesh_of(nodes.points, nodes.triangles);
        mesh.density = nodes.density;
        mesh.notes = nodes.notes;
        write_mesh(file, format, mesh);
      } catch (const files::NoMesh& e) {
        throw std::runtime_error(nodes.file + ": " + e.what());
      }
    } else {
      write_nodes(file, format, nodes.points, nodes.density, nodes.notes);
    }
    file.commit();
  });
  progress.finish(
      fmt::format("{} nodes ({}), {} triangles", nodes.points.size(), nodes.kind, nodes.triangles.size()));
}

}  // namespace

void add_convert(CLI::App& app, Command& chosen) {
  CLI::App* const sub =
      app.add_subcommand("convert", "the same nodes or triangles (of UGRID, MPAS, OFF) in another format");
  const auto options = std::make_shared<Options>();
  add_input(*sub, options->input);
  add_output(*sub, options->output, true);
  sub->callback([=, &chosen] { chosen = [=] { convert(*options); }; });
}

}  // namespace program
