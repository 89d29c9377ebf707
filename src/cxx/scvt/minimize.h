#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "capi/pstripack.h"
#include "geometry/point.h"
#include "scvt/evaluator.h"
#include "scvt/vectors.h"

namespace pstripack::scvt {

enum class Method { newton = PSTRIPACK_SCVT_NEWTON, lloyd = PSTRIPACK_SCVT_LLOYD };

using Progress = pstripack_scvt_progress;

struct Options {
  Method method = Method::newton;
  /// Bound of the gradient: the root mean square over generators of the distance to the centroid of the
  /// cell, in units of sqrt(4 pi / N).
  double tolerance = 1e-5;
  std::int64_t most_evaluations = 100000;
  bool well_centred = false;  ///< of iterate(): in the end all triangles hold their circumcentre strictly
  int first_lloyd_steps = 3;  ///< number of steps of Lloyd's method before the quasi-Newton method
  /// Called after each step; false stops the run. It may copy the state: a run that starts from the copy
  /// continues with the same bits.
  std::function<bool(const Progress&)> progress;
};

/// All that a run needs to continue, also with another number of ranks. The arrays have one element per
/// generator of this rank.
struct State {
  explicit State(std::vector<Point> g = {}) : generators(std::move(g)) {}

  /// A step and the change of the gradient along it, as vectors in space.
  struct Pair {
    std::vector<SinglePoint> step, change;
  };

  std::vector<Point> generators;
  std::vector<Pair> pairs;  ///< the oldest first
  int exponent = 0;         ///< the changes are those of the gradient times 2^-exponent
  std::int64_t evaluations = 0, steps = 0;
  /// Number of times the quasi-Newton method fell back to a step of Lloyd's method, by cause.
  std::int64_t no_descent = 0;   ///< the direction was not a direction of descent
  std::int64_t no_decrease = 0;  ///< the energy did not fall along the direction
};

enum class End {
  converged = PSTRIPACK_SCVT_CONVERGED,
  evaluations = PSTRIPACK_SCVT_EVALUATIONS,  ///< the bound most_evaluations is reached
  stopped = PSTRIPACK_SCVT_STOPPED,          ///< the callback returned false
  /// the energy does not fall any more, not even by Lloyd's method: rounding, or a rough density
  stalled = PSTRIPACK_SCVT_STALLED
};

struct Result {
  End end = End::converged;
  Progress progress{};  ///< of the generators in the state
  Cells cells;          ///< of the generators in the state, of the density times 2^-exponent
};

/// Moves the generators in the state until the gradient is at most the tolerance. The energy never rises.
///
/// Newton: L-BFGS (Nocedal 1980; Liu et al. 2009 for this energy) with 8 pairs and the initial metric of
/// metric.h. The energy is a function of the directions of the generators, so its gradient is perpendicular
/// to them; after each step the generators are scaled to unit length. The result has the same bits for any
/// number of threads and ranks. A density is scaled by a power of two where it is very large or small. All
/// numbers of the result are finite, and the cells of a constant density add up to the sphere. Collective.
/// Throws what Evaluator::evaluate throws, GeneratorsTooNear, DensityOutOfRange, NoTessellation.
Result minimize(Evaluator& evaluator, State& state, const Options& options);

}  // namespace pstripack::scvt
