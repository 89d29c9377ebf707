#include "methods/quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "files/limited_area.h"
#include "geometry/measures.h"
#include "scvt/cells.h"
#include "stripack/voronoi.h"

namespace methods {

Quality quality_of(const files::Mesh& mesh) {
  if (mesh.has_boundary()) throw files::NoMesh("the nodes lie in one hemisphere");
  const pstripack::scvt::NeighbourLists stars{mesh.points.size(), mesh.lend.data(), mesh.list.data()};
  const pstripack::Directions directions(mesh.points.data(), mesh.points.size());
  std::vector<double> areas(stars.count);
  if (!cell_areas(mesh.lists(), directions, areas.data())) throw files::NoMesh("the lists are broken");
  const auto index = [&](std::size_t k) { return static_cast<std::size_t>(stars.neighbour[k]) - 1; };
  const auto at = [&](std::size_t i) { return direction_of(directions, static_cast<pstripack::index_t>(i)); };
  const auto is_kept = [&](std::size_t i) {
    return mesh.layers.empty() || mesh.layers[i] != files::kLeftOut;
  };
  Quality quality;
  for (std::size_t i = 0; i < stars.count; ++i) {
    if (!is_kept(i)) continue;
    const auto sides = static_cast<int>(stars.end_of(i) - stars.begin_of(i));
    ++quality.cells[static_cast<std::size_t>(std::min(sides, Quality::kMostSides))];
    std::size_t last = index(stars.end_of(i) - 1);
    for (std::size_t k = stars.begin_of(i); k < stars.end_of(i); ++k) {
      const std::size_t to = index(k), from = std::exchange(last, to);
      if (is_kept(to)) quality.largest_ratio = std::max(quality.largest_ratio, areas[i] / areas[to]);
      if (!is_kept(from) || !is_kept(to) || from < i || to < i) continue;
      const pstripack::Angles angles = angles_of(at(i), at(from), at(to));
      for (const double angle : angles.at) {
        quality.smallest_angle = std::min(quality.smallest_angle, angle * files::kRadian);
        quality.largest_angle = std::max(quality.largest_angle, angle * files::kRadian);
      }
      if (!angles.are_acute && quality.obtuse++ == 0) quality.place = mesh.points[i];
    }
  }
  return quality;
}

std::string Quality::text() const {
  std::string text = "cells by sides:";
  for (std::size_t sides = 3; sides < cells.size(); ++sides)
    if (cells[sides] > 0)
      text += fmt::format(" {}{}: {},", sides, sides == kMostSides ? " or more" : "", cells[sides]);
  text.back() = ';';
  return text + fmt::format(" angles {:.1f} to {:.1f} degrees; neighbouring areas up to {:.2f} : 1; {}",
                            smallest_angle, largest_angle, largest_ratio,
                            obtuse == 0 ? "all triangles hold their circumcentre"
                            : obtuse == 1
                                ? "1 triangle does not hold its circumcentre"
                                : fmt::format("{} triangles do not hold their circumcentre", obtuse));
}

}  // namespace methods
