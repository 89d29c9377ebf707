#pragma once
// The first generators of a run: random ones, and refinement from level to level.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/point.h"
#include "scvt/density.h"
#include "scvt/evaluator.h"
#include "scvt/spread.h"

namespace pstripack::scvt {

/// n random unit vectors that do not lie in one hemisphere. They are distributed as the generators of a
/// centroidal tessellation: proportional to the square root of the evaluator's density. Neighbours on the
/// sphere have close numbers. The result depends on n, the density and the seed alone, not on the number of
/// ranks. Collective. Throws BadDensity, BadGenerators, AgreedFailure.
Spread random_generators(Evaluator& evaluator, std::size_t n, std::uint64_t seed);
/// The same on this process alone; not collective.
std::vector<Point> random_generators(std::size_t n, const Density& density, std::uint64_t seed);

/// The numbers of generators of all levels, from the coarsest to n. Each is about a quarter of the next, so
/// that refined() leads from a level to the next and leaves out three midpoints at most. The coarsest level
/// has 12 to 42 generators, or n. So few generators find an arrangement with twelve pentagons and no other
/// defects, which the finer levels keep.
std::vector<std::size_t> level_sizes(std::size_t n);

/// The N generators and midpoints of arcs between neighbours, n points in all, n <= 4 N - 6. If there are
/// more midpoints than needed, those of the shortest arcs, in units of the local width of a cell, are left
/// out. Neighbours on the sphere have close numbers. Collective. Throws BadDensity, AgreedFailure.
Spread refined(Communicator& ranks, const Neighbourhood& generators, const Density& density, std::size_t n);

}  // namespace pstripack::scvt
