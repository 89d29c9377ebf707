// Files written in parts have the bytes of a file written at once; parts that are read are the whole.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "files/mesh.h"
#include "files/writers.h"
#include "point_sets.h"
#include "support/this_program.h"

namespace files {
namespace {

Mesh mesh_with_columns(std::size_t n) {
  Mesh mesh = triangulate(point_sets::make("random", n));
  Column column{"scvt_step", "a step", "1"};
  for (std::size_t i = 0; i < n; ++i) {
    column.numbers.push_back(i % 7 == 3 ? std::nan("") : -0.5 * static_cast<double>(i));
    mesh.density.push_back(1.0 + static_cast<double>(i));
  }
  mesh.columns = {column, whole_numbers("degree", "another degree", std::vector<double>(n, 3))};
  mesh.notes = {{"scvt_steps", "12"}, {"history", "a test"}};
  return mesh;
}

/// The part with the nodes begin, ..., end - 1, which knows all other nodes.
MeshPart part_of(const Mesh& mesh, std::size_t begin, std::size_t end) {
  const std::size_t n = mesh.points.size();
  MeshPart part;
  part.nodes = end - begin;
  part.numbers.resize(n);
  std::iota(part.numbers.begin(), part.numbers.end(), 1);
  const auto here = [&](auto& all) { return all.begin() + static_cast<std::ptrdiff_t>(begin); };
  std::rotate(part.numbers.begin(), here(part.numbers),
              part.numbers.begin() + static_cast<std::ptrdiff_t>(end));
  std::vector<std::int32_t> place(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto node = static_cast<std::size_t>(part.numbers[i]) - 1;
    place[node] = static_cast<std::int32_t>(i) + 1;
    part.points.push_back(mesh.points[node]);
  }
  const std::vector<std::int32_t> triangles = triangles_of(mesh);
  part.share_of_nodes = {begin, n};
  part.share_of_triangles.all = triangles.size() / 3;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const auto smallest = static_cast<std::size_t>(triangles[t]) - 1;
    if (smallest < begin) ++part.share_of_triangles.before;
    for (std::size_t k = t; smallest >= begin && smallest < end && k < t + 3; ++k)
      part.corner.push_back(place[static_cast<std::size_t>(triangles[k]) - 1]);
  }
  for (std::size_t node = begin; node < end; ++node)
    part.degrees.push_back(mesh.lend[node] - (node == 0 ? 0 : mesh.lend[node - 1]));
  const auto slice = [&](const std::vector<double>& all) {
    return std::vector<double>(here(all), here(all) + static_cast<std::ptrdiff_t>(part.nodes));
  };
  part.density = slice(mesh.density);
  part.columns = mesh.columns;
  for (Column& column : part.columns) column.numbers = slice(column.numbers);
  part.notes = mesh.notes;
  return part;
}

/// Whether this build writes the format.
bool is_known(Format format) {
#ifdef HAVE_NETCDF
  static_cast<void>(format);
  return true;
#else
  return format != Format::ugrid && format != Format::mpas && format != Format::netcdf;
#endif
}

TEST(parts, one_after_the_other_are_the_bytes_of_the_whole) {
  const Folder folder;
  for (const std::size_t n : {4u, 5u, 300u}) {
    const Mesh mesh = mesh_with_columns(n);
    for (const FormatEntry& entry : formats()) {
      if (!holds_parts(entry.format) || !is_known(entry.format)) continue;
      SCOPED_TRACE(entry.name);
      OutputFile whole(folder.path() + "/whole");
      if (holds_a_mesh(entry.format))
        write_mesh(whole, entry.format, mesh);
      else
        write_nodes(whole, entry.format, mesh.points, {{}, mesh.density, mesh.columns, mesh.notes});
      for (const std::vector<std::size_t>& ends : {std::vector<std::size_t>{1, n}, {n / 3 + 1, n - 1, n}}) {
        const std::string path = folder.path() + "/parts";
        for (int section = 0; section < sections_of(entry.format); ++section) {
          std::size_t begin = 0;
          for (const std::size_t end : ends) {
            write_part(OutputFile("parts", path, section > 0 || begin > 0), entry.format,
                       part_of(mesh, begin, end), section);
            begin = end;
          }
        }
        EXPECT_EQ(contents(path), contents(whole.path())) << n << " nodes, " << ends.size() << " parts";
      }
    }
  }
}

TEST(parts, of_other_formats_are_refused) {
  const Folder folder;
  const MeshPart part = part_of(mesh_with_columns(10), 0, 10);
  for (const Format format : {Format::scrip, Format::vtu, Format::gmsh, Format::lists}) {
    EXPECT_FALSE(holds_parts(format));
    EXPECT_THROW(write_part(OutputFile("part", folder.path() + "/part", false), format, part, 0),
                 std::runtime_error);
  }
}

#ifdef HAVE_NETCDF
TEST(parts, that_are_read_are_the_whole) {
  const Folder folder;
  const Mesh mesh = mesh_with_columns(20);
  for (const Format format : {Format::netcdf, Format::ugrid}) {
    const std::string name = folder.path() + "/nodes.nc";
    OutputFile file(name);
    if (format == Format::ugrid)
      write_mesh(file, format, mesh);
    else
      write_nodes(file, format, mesh.points, {{}, mesh.density, mesh.columns, mesh.notes});
    file.commit();
    ReadOptions options;
    options.with_columns = true;
    const Nodes whole = read(name, options);
    for (const std::size_t parts : {2u, 3u, 21u}) {
      options.parts = parts;
      std::vector<Point> points;
      std::vector<double> density, steps;
      for (options.part = 0; options.part < parts; ++options.part) {
        const Nodes part = read(name, options);
        EXPECT_EQ(part.before, points.size());
        EXPECT_EQ(part.place(0), "node " + std::to_string(points.size() + 1));
        EXPECT_EQ(part.notes, whole.notes);
        const Column* const step = find(part.columns, "scvt_step");
        ASSERT_NE(step, nullptr);
        const auto append = [](auto& all, const auto& some) {
          all.insert(all.end(), some.begin(), some.end());
        };
        append(points, part.points);
        append(density, part.density);
        append(steps, step->numbers);
      }
      EXPECT_EQ(points, whole.points);
      EXPECT_EQ(density, whole.density);
      const std::vector<double>& expected = find(whole.columns, "scvt_step")->numbers;
      ASSERT_EQ(steps.size(), expected.size());
      for (std::size_t i = 0; i < steps.size(); ++i)
        EXPECT_TRUE(steps[i] == expected[i] || (std::isnan(steps[i]) && std::isnan(expected[i])));
    }
    options.part = 0;
    options.parts = 1;
  }
}

TEST(parts, of_a_grid_are_refused) {
  const Folder folder;
  const std::string name = folder.path() + "/grid.nc";
  OutputFile file(name);
  const Grid grid{{0, 90, 180, 270}, {-45, 0, 45}};
  write_netcdf_field(file, {}, grid, {{"value", "", "", std::vector<double>(12, 1)}, {}, {}});
  file.commit();
  ReadOptions options;
  EXPECT_EQ(read(name, options).points.size(), 12u);
  options.parts = 2;
  try {
    read(name, options);
    FAIL() << "a part of a grid";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("a grid: several ranks read a list of nodes"), std::string::npos)
        << e.what();
  }
}
#endif

}  // namespace
}  // namespace files
