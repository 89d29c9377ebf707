#pragma once
// A whole run: from a number of generators, or from given generators, to a centroidal tessellation.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scvt/density.h"
#include "scvt/minimize.h"
#include "scvt/well_centred.h"

namespace pstripack::scvt {

struct RunOptions : Options {
  bool levels = true;  ///< coarse generators first, refined level by level; false: n random generators
  std::uint64_t seed = 1;
};

/// This rank's generators, and all that a run needs to continue, also on another number of ranks.
struct Tessellation {
  std::vector<std::int64_t> numbers;  ///< global numbers of the generators: 1, 2, ... over all ranks
  State state;                        ///< of the last level
  Result result;                      ///< of the last level
  /// Evaluations of all levels, each weighted by its number of generators over that of the last level.
  double evaluations = 0;
  Repair repair;  ///< of the last level, if Options::well_centred
};

/// The vector scaled to length 1; unchanged if its length is 1 up to rounding.
Point unit_vector(const Point& generator);
/// unit_vector() of all generators. Throws BadGenerators if one is zero or not finite.
std::vector<Point> unit_vectors(std::vector<Point> generators);

/// The n >= 4 generators from which the last level starts. With options.levels, it carries out the levels
/// before; `result` is then that of the level before the last, and there are fewer generators if it is
/// End::stopped. Collective. Throws what minimize throws.
Tessellation first_generators(Evaluator& evaluator, std::size_t n, const RunOptions& options);

/// minimize(), then, with options.well_centred, make_well_centred(), which sets `repair`; the result is that
/// of the generators in the end. Collective. Throws what minimize throws.
Result solve(Evaluator& evaluator, State& state, const Options& options, Repair& repair);

/// One level: moves each generator to the rank where its neighbours are, then calls solve(). Collective.
/// Throws what minimize throws.
void iterate(Evaluator& evaluator, Tessellation& tessellation, const Options& options);

/// The generators of all ranks and the pairs of their state, in order and on rank 0. Collective. Throws
/// AgreedFailure.
Tessellation on_rank_0(Communicator& ranks, const Tessellation& tessellation);

/// A tessellation of n >= 4 generators for the density, on this process alone. Throws what minimize throws.
Tessellation run(std::size_t n, const Density& density, const RunOptions& options);

/// The same, starting from given generators, which may have any length.
Tessellation run(std::vector<Point> generators, const Density& density, const RunOptions& options);

}  // namespace pstripack::scvt
