#include "mesh_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "files/nodes.h"
#include "only_in.h"

namespace comparison {
namespace {

pstripack::Triangles read_triangles(const std::string& file, std::size_t nodes) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file);
  pstripack::Triangles triangles;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    std::istringstream fields(line);
    pstripack::Triangle triangle;
    std::string rest;
    if (!(fields >> triangle[0] >> triangle[1] >> triangle[2]) || fields >> rest)
      throw std::runtime_error(fmt::format("{}, line {}: expected three node numbers", file, number));
    for (pstripack::index_t& node : triangle) {
      if (node < 1 || static_cast<std::size_t>(node) > nodes)
        throw std::runtime_error(fmt::format("{}, line {}: there is no node {}", file, number, node));
      --node;
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace

MeshFiles read_mesh(const std::string& prefix) {
  MeshFiles mesh;
  files::ReadOptions options;
  options.coordinates = files::Coordinates::xyz;
  mesh.points = files::read(prefix + "_points.txt", options).points;
  mesh.triangles = read_triangles(prefix + "_triangles.txt", mesh.points.size());
  pstripack::make_canonical(mesh.triangles);
  return mesh;
}

MeshComparison compare_meshes(const MeshFiles& a, const MeshFiles& b) {
  MeshComparison result;
  if (a.points.size() != b.points.size()) {
    result.largest_distance = std::numeric_limits<double>::infinity();
  } else {
    for (std::size_t i = 0; i < a.points.size(); ++i) {
      const pstripack::Point &p = a.points[i], &q = b.points[i];
      result.largest_distance =
          std::max(result.largest_distance, std::hypot(p.x - q.x, p.y - q.y, p.z - q.z));
    }
  }
  result.only_in_a = only_in(a.triangles, b.triangles).size();
  result.only_in_b = only_in(b.triangles, a.triangles).size();
  return result;
}

}  // namespace comparison
