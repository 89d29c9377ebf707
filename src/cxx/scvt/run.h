#pragma once
// A whole run: from a number of generators, or from generators, to a centroidal tessellation.

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

/// Of this rank's generators, all that a run needs to go on, also on another number of ranks.
struct Tessellation {
  std::vector<std::int64_t> numbers;  ///< of the generators: 1, 2, ... over all ranks
  State state;                        ///< of the last level
  Result result;                      ///< of the last level
  /// Over all levels, each counted by its share of the last level's generators.
  double evaluations = 0;
};

/// A vector of any length as a unit vector; one that is, within rounding, stays.
Point unit_vector(const Point& generator);
/// All of them. Throws BadGenerators.
std::vector<Point> unit_vectors(std::vector<Point> generators);

/// n generators, at least 4, for the last level to begin with. With levels, those before are done; the result
/// is that of the last of these, and there are fewer generators if End::stopped. Collective. Throws as
/// minimize.
Tessellation first_generators(Evaluator& evaluator, std::size_t n, const RunOptions& options);

/// A level: each generator goes to the rank where its neighbours are, then minimize(). Collective. Throws as
/// minimize.
void iterate(Evaluator& evaluator, Tessellation& tessellation, const Options& options);

/// The numbers and the state of a part of the generators: rank r gets the r-th of equal slices of 1, 2, ...
/// Collective. Throws AgreedFailure.
Tessellation slice_of(Communicator& ranks, const Tessellation& tessellation);

/// n generators, at least 4, for the density. Throws as minimize.
Tessellation run(std::size_t n, const Density& density, const RunOptions& options);

/// The same from generators, which may have any length.
Tessellation run(std::vector<Point> generators, const Density& density, const RunOptions& options);

}  // namespace pstripack::scvt
