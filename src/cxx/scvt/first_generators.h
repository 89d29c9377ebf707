#pragma once
// Where a run begins.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/point.h"
#include "scvt/cells.h"
#include "scvt/density.h"

namespace pstripack::scvt {

/// n random directions, with the density of the generators of a centroidal tessellation: proportional to the
/// square root of `density`. Neighbours on the sphere have close numbers. The same for the same seed. Throws
/// BadDensity.
std::vector<Point> random_generators(std::size_t n, const Density& density, std::uint64_t seed);

/// The numbers of generators from a coarse level to n, each a quarter of the next: refined() leads from each
/// to the next. Has one entry if n is below 4 `coarsest`.
std::vector<std::size_t> level_sizes(std::size_t n, std::size_t coarsest = 160);

/// The generators and midpoints of the arcs between neighbours, n in all, at most 4 N - 6 for N generators.
/// Of more midpoints than wanted those of the shortest arcs, measured in local cells, are left out.
/// Neighbours on the sphere have close numbers. Throws BadDensity.
std::vector<Point> refined(const std::vector<Point>& generators, const Stars& stars, const Density& density,
                           std::size_t n);

}  // namespace pstripack::scvt
