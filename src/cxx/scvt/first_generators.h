#pragma once
// Where a run begins.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/point.h"
#include "scvt/cells.h"
#include "scvt/density.h"

namespace pstripack::scvt {

/// n random directions that no hemisphere holds, with the density of the generators of a centroidal
/// tessellation: proportional to the square root of `density`. Neighbours on the sphere have close numbers.
/// The same for the same seed. Throws BadDensity, BadGenerators.
std::vector<Point> random_generators(std::size_t n, const Density& density, std::uint64_t seed);

/// The numbers of generators from a coarse level to n, each about a quarter of the next: refined() leads from
/// each to the next, and leaves out three midpoints at most. The coarsest level has 12 to 42 generators, or
/// n: so few find an arrangement with twelve pentagons and no other defects, which the finer levels keep.
std::vector<std::size_t> level_sizes(std::size_t n);

/// The generators and midpoints of the arcs between neighbours, n in all, at most 4 N - 6 for N generators.
/// Of more midpoints than wanted those of the shortest arcs, measured in local cells, are left out.
/// Neighbours on the sphere have close numbers. Throws BadDensity.
std::vector<Point> refined(const std::vector<Point>& generators, const NeighbourLists& stars,
                           const Density& density, std::size_t n);

/// The density at the points. Throws BadDensity.
std::vector<double> values_at(const std::vector<Point>& points, const Density& density);

/// The points in the order of a space-filling curve.
std::vector<Point> along_a_curve(const std::vector<Point>& points);

}  // namespace pstripack::scvt
