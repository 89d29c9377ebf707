#pragma once
// A whole run in this process: from a number of generators, or from generators, to a centroidal tessellation.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scvt/density.h"
#include "scvt/minimize.h"

namespace pstripack::scvt {

struct RunOptions : Options {
  bool levels = true;  ///< coarse generators first, refined level by level; false: n random generators
  std::uint64_t seed = 1;
};

struct Tessellation {
  State state;    ///< of the last level
  Result result;  ///< of the last level
  /// Over all levels, each counted by its share of the last level's generators.
  double evaluations = 0;
};

/// A vector of any length as a unit vector; one that is, within rounding, stays.
Point unit_vector(const Point& generator);
/// All of them. Throws BadGenerators.
std::vector<Point> unit_vectors(std::vector<Point> generators);

/// n generators, at least 4, for the density. Throws as minimize.
Tessellation run(std::size_t n, const Density& density, const RunOptions& options);

/// The same from generators, which may have any length.
Tessellation run(std::vector<Point> generators, const Density& density, const RunOptions& options);

}  // namespace pstripack::scvt
