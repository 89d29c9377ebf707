#pragma once
// Minimizes the energy of a centroidal Voronoi tessellation.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "geometry/point.h"
#include "scvt/evaluator.h"

namespace pstripack::scvt {

enum class Method { newton, lloyd };

struct Progress {
  std::int64_t generators = 0;   ///< of all ranks
  std::int64_t evaluations = 0;  ///< triangulations with integrals
  double gradient = 0;           ///< see Options::tolerance
  double energy = 0;
};

struct Options {
  Method method = Method::newton;
  /// Of the gradient: root mean square over generators of the distance to the centroid of the cell, in units
  /// of sqrt(4 pi / N).
  double tolerance = 1e-5;
  std::int64_t most_evaluations = 100000;
  int first_lloyd_steps = 3;  ///< before the quasi-Newton method begins
  /// After each step; false stops the run. The state may be copied: a run that begins with the copy goes on
  /// with the same bits.
  std::function<bool(const Progress&)> progress;
};

/// All that a run needs to go on, also with another number of ranks: its arrays are those of this rank's
/// generators, in the order of the generators.
struct State {
  explicit State(std::vector<Point> g = {}) : generators(std::move(g)) {}

  /// A step and the change of the gradient in it, in space.
  struct Pair {
    std::vector<Point> step, change;
  };

  std::vector<Point> generators;
  std::vector<Pair> pairs;  ///< the oldest first
  std::int64_t evaluations = 0, steps = 0;
  /// How often the quasi-Newton method fell back to a step of Lloyd's method, and why.
  std::int64_t no_descent = 0;   ///< its direction did not descend
  std::int64_t no_decrease = 0;  ///< the energy did not fall along it
};

enum class End {
  converged,
  evaluations,  ///< as many as allowed
  stopped,      ///< by the callback
  stalled  ///< the energy does not fall any more, not even by Lloyd's method: rounding, or a rough density
};

struct Result {
  End end = End::converged;
  Progress progress;  ///< of the generators in the state
  Cells cells;        ///< of the generators in the state
};

/// Moves the generators in the state until the gradient is at most the tolerance. The energy never rises.
///
/// Newton: L-BFGS (Nocedal 1980; Liu et al. 2009 for this energy) with 8 pairs. The initial metric is
/// that of metric.h. In space the energy is a function of
/// the directions of the generators, its gradient is at right angles to them, and a step ends at unit length
/// again. Same bits for any number of threads and ranks. Collective. Throws as Evaluator::evaluate.
Result minimize(Evaluator& evaluator, State& state, const Options& options);

}  // namespace pstripack::scvt
