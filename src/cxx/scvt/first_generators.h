#pragma once
// Where a run begins.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/point.h"
#include "scvt/density.h"
#include "scvt/evaluator.h"
#include "scvt/spread.h"

namespace pstripack::scvt {

/// n random directions that no hemisphere holds, with the density of the generators of a centroidal
/// tessellation: proportional to the square root of the evaluator's density. Neighbours on the sphere have
/// close numbers. The same for the same seed. Collective. Throws BadDensity, BadGenerators, AgreedFailure.
Spread random_generators(Evaluator& evaluator, std::size_t n, std::uint64_t seed);
/// Of this process alone.
std::vector<Point> random_generators(std::size_t n, const Density& density, std::uint64_t seed);

/// The numbers of generators from a coarse level to n, each about a quarter of the next: refined() leads from
/// each to the next, and leaves out three midpoints at most. The coarsest level has 12 to 42 generators, or
/// n: so few find an arrangement with twelve pentagons and no other defects, which the finer levels keep.
std::vector<std::size_t> level_sizes(std::size_t n);

/// The generators and midpoints of the arcs between neighbours, n in all, at most 4 N - 6 for N generators.
/// Of more midpoints than wanted those of the shortest arcs, measured in local cells, are left out.
/// Neighbours on the sphere have close numbers. Collective. Throws BadDensity, AgreedFailure.
Spread refined(Communicator& ranks, const Neighbourhood& generators, const Density& density, std::size_t n);

/// The density at the points. Throws BadDensity.
std::vector<double> values_at(const std::vector<Point>& points, const Density& density);

}  // namespace pstripack::scvt
