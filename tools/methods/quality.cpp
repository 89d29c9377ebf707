#include "methods/quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "methods/sphere.h"
#include "stripack/list_queries.h"

namespace methods {
namespace {

using Reader = pstripack::ListReader<std::int32_t>;

/// The area of the part of each cell that lies in one triangle is two right-angled triangles at each corner;
/// negative where the circumcentre is beyond a side.
std::vector<double> areas_of_cells(const files::Mesh& mesh, const std::vector<std::int32_t>& triangles) {
  const auto at = [&](std::int32_t node) { return mesh.points[static_cast<std::size_t>(node) - 1]; };
  std::vector<double> areas(mesh.points.size());
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const std::int32_t* const corner = &triangles[t];
    const Point centre = circumcentre(at(corner[0]), at(corner[1]), at(corner[2]));
    for (const auto& [from, to] :
         {std::pair(corner[0], corner[1]), {corner[1], corner[2]}, {corner[2], corner[0]}}) {
      const double half =
          triangle_area(at(from), at(to), centre) / 2;  // both are equally far from the centre
      areas[static_cast<std::size_t>(from) - 1] += half;
      areas[static_cast<std::size_t>(to) - 1] += half;
    }
  }
  return areas;
}

}  // namespace

Quality quality_of(const files::Mesh& mesh) {
  const Reader reader(mesh.lists());
  if (reader.first_boundary_node() != 0) throw files::NoMesh("the nodes lie in one hemisphere");
  const std::vector<std::int32_t> triangles = files::triangles_of(mesh);
  const std::vector<double> areas = areas_of_cells(mesh, triangles);
  Quality quality;
  for (std::int32_t node = 1; node <= reader.size(); ++node) {
    int sides = 0;
    std::int32_t slot = reader.last_slot(node);
    do {
      slot = reader.next(slot);
      ++sides;
      const double ratio = areas[static_cast<std::size_t>(node) - 1] /
                           areas[static_cast<std::size_t>(reader.neighbour(slot)) - 1];
      quality.largest_ratio = std::max(quality.largest_ratio, ratio);
    } while (slot != reader.last_slot(node));
    ++quality.cells[static_cast<std::size_t>(std::min(sides, Quality::kMostSides))];
  }
  const auto at = [&](std::int32_t node) { return mesh.points[static_cast<std::size_t>(node) - 1]; };
  quality.smallest_angle = 180;
  std::size_t well_centred = 0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const Point a = at(triangles[t]), b = at(triangles[t + 1]), c = at(triangles[t + 2]);
    const double angles[] = {files::corner_angle(a, b, c), files::corner_angle(b, c, a),
                             files::corner_angle(c, a, b)};
    quality.smallest_angle = std::min({quality.smallest_angle, angles[0], angles[1], angles[2]});
    if (std::max({angles[0], angles[1], angles[2]}) < 90) ++well_centred;
  }
  quality.well_centred = 3 * static_cast<double>(well_centred) / static_cast<double>(triangles.size());
  return quality;
}

std::string Quality::text() const {
  std::string text = "cells by sides:";
  for (std::size_t sides = 3; sides < cells.size(); ++sides)
    if (cells[sides] > 0)
      text += fmt::format(" {}{}: {},", sides, sides == kMostSides ? " or more" : "", cells[sides]);
  text.back() = ';';
  return text + fmt::format(
                    " smallest angle {:.1f} degrees; neighbouring areas up to {:.2f} : 1; {:.2f} % of the "
                    "triangles hold their circumcentre",
                    smallest_angle, largest_ratio, 100 * well_centred);
}

}  // namespace methods
