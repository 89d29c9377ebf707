#include "methods/quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <vector>

#include "base/parallel_for.h"
#include "files/limited_area.h"
#include "geometry/measures.h"
#include "parallel/agreement.h"
#include "parallel/halo.h"

namespace methods {
namespace {

using pstripack::Direction;
using pstripack::Directions;
using pstripack::scvt::Neighbourhood;

/// Calls visit(from, to) for each triangle at node i, with the indices of its two other corners.
template <class Visit>
void around(const Neighbourhood& nodes, std::size_t i, const Visit& visit) {
  const std::size_t begin = nodes.stars.begin_of(i), end = nodes.stars.end_of(i);
  auto from = static_cast<std::size_t>(nodes.stars.neighbour[end - 1]) - 1;
  for (std::size_t k = begin; k < end; ++k) {
    const auto to = static_cast<std::size_t>(nodes.stars.neighbour[k]) - 1;
    visit(from, to);
    from = to;
  }
}

Direction at(const Directions& directions, std::size_t i) {
  return direction_of(directions, static_cast<pstripack::index_t>(i));
}

double area_of_cell(const Neighbourhood& nodes, const Directions& directions, std::size_t i,
                    std::vector<Direction>& ring) {
  ring.clear();
  around(nodes, i, [&](std::size_t, std::size_t to) { ring.push_back(at(directions, to)); });
  return cell_area(at(directions, i), ring.data(), ring.size());
}

/// Areas of the cells of this rank's nodes, then of the halo. Sets the directions of both. Collective.
std::vector<double> areas_of_cells(pstripack::Communicator& ranks, const Neighbourhood& nodes,
                                   std::optional<Directions>& directions) {
  const std::size_t own = nodes.stars.count;
  std::vector<double> areas;
  pstripack::in_agreement(ranks, [&] {
    directions.emplace(nodes.points, nodes.known);
    areas.resize(nodes.known);
    const int threads = pstripack::threads_for(10 * own);
    pstripack::ErrorsOfThreads errors(static_cast<std::size_t>(threads));
    pstripack::parallel_pieces(own, threads, [&](std::size_t first, std::size_t last, int piece) {
      errors.keep(static_cast<std::size_t>(piece), [&] {
        std::vector<Direction> ring;
        for (std::size_t i = first; i < last; ++i) areas[i] = area_of_cell(nodes, *directions, i, ring);
      });
    });
    errors.rethrow();
  });
  nodes.halo->fetch<double>(
      ranks, [&](pstripack::LocalNode k) { return areas[k]; },
      [&](pstripack::OutsideNode j, double area) { areas[own + index_of(j)] = area; });
  return areas;
}

/// Counts only cells and triangles of which is_kept(index of the node) is true.
template <class Kept>
Quality quality_of_kept(pstripack::Communicator& ranks, const Neighbourhood& nodes, const Kept& is_kept) {
  std::optional<Directions> directions;
  const std::vector<double> areas = areas_of_cells(ranks, nodes, directions);
  Quality quality;
  pstripack::SmallestReal smallest_angle;
  pstripack::LargestReal largest_angle, largest_ratio;
  std::int64_t counts[Quality::kMostSides + 2] = {};  // number of cells by sides, and of obtuse triangles
  std::int64_t& obtuse = counts[Quality::kMostSides + 1];
  for (std::size_t i = 0; i < nodes.stars.count; ++i) {
    if (!is_kept(i)) continue;
    const auto sides = static_cast<int>(nodes.stars.end_of(i) - nodes.stars.begin_of(i));
    ++counts[std::min(sides, Quality::kMostSides)];
    around(nodes, i, [&](std::size_t from, std::size_t to) {
      if (is_kept(to)) largest_ratio.value = std::max(largest_ratio.value, areas[i] / areas[to]);
      if (!is_kept(from) || !is_kept(to)) return;
      if (nodes.numbers[from] < nodes.numbers[i] || nodes.numbers[to] < nodes.numbers[i]) return;
      const pstripack::Angles angles =
          angles_of(at(*directions, i), at(*directions, from), at(*directions, to));
      for (const double angle : angles.at) {
        smallest_angle.value = std::min(smallest_angle.value, angle * files::kRadian);
        largest_angle.value = std::max(largest_angle.value, angle * files::kRadian);
      }
      if (!angles.are_acute && obtuse++ == 0) quality.place = nodes.points[i];
    });
  }
  agree(ranks, smallest_angle, largest_angle, largest_ratio);
  ranks.all_sum(counts, std::size(counts));
  std::copy_n(counts, quality.cells.size(), quality.cells.begin());
  quality.smallest_angle = smallest_angle.value;
  quality.largest_angle = largest_angle.value;
  quality.largest_ratio = largest_ratio.value;
  quality.obtuse = obtuse;
  return quality;
}

}  // namespace

Quality quality_of(pstripack::Communicator& ranks, const Neighbourhood& nodes) {
  return quality_of_kept(ranks, nodes, [](std::size_t) { return true; });
}

Quality quality_of(const files::Mesh& mesh) {
  const std::size_t n = mesh.points.size();
  if (mesh.has_boundary()) throw files::NoMesh("the nodes lie in one hemisphere");
  std::vector<std::int64_t> numbers(n);
  std::iota(numbers.begin(), numbers.end(), std::int64_t{1});
  pstripack::SingleProcess alone;
  const pstripack::Halo no_halo{};
  return quality_of_kept(
      alone, {mesh.points.data(), numbers.data(), {n, mesh.lend.data(), mesh.list.data()}, n, &no_halo},
      [&](std::size_t i) { return mesh.layers.empty() || mesh.layers[i] != files::kLeftOut; });
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
