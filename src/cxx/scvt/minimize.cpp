#include "scvt/minimize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/parallel_for.h"
#include "scvt/errors.h"

namespace pstripack::scvt {
namespace {

using Vectors = std::vector<Point>;

constexpr std::size_t kPairs = 8;
constexpr int kTrials = 6;            ///< steps along one direction
constexpr double kSufficient = 1e-4;  ///< of the decrease that the slope promises (Armijo)
constexpr double kLongest = 1;        ///< step, in root mean square radii of the cell

Point scaled(double f, const Point& p) { return {f * p.x, f * p.y, f * p.z}; }
Point plus(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point normalized(const Point& p) { return scaled(1 / std::sqrt(dot(p, p)), p); }

template <class Body>
void for_each(std::size_t n, const Body& body) {
  parallel_pieces(n, threads_for(n), [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i) body(i);
  });
}

/// Sums of terms(i), an array of doubles, over the generators of all ranks; terms(i) may also write what is
/// i's.
template <std::size_t kSums, class Terms>
std::array<ExactSum, kSums> sum(Evaluator& evaluator, std::size_t n, const Terms& terms) {
  const int threads = threads_for(n);
  std::vector<std::array<ExactSum, kSums>> parts(static_cast<std::size_t>(threads));
  parallel_pieces(n, threads, [&](std::size_t first, std::size_t last, int piece) {
    auto& part = parts[static_cast<std::size_t>(piece)];
    for (std::size_t i = first; i < last; ++i) {
      const std::array<double, kSums> t = terms(i);
      for (std::size_t k = 0; k < kSums; ++k) part[k].add(t[k]);
    }
  });
  for (std::size_t piece = 1; piece < parts.size(); ++piece)
    for (std::size_t k = 0; k < kSums; ++k) parts[0][k] += parts[piece][k];
  evaluator.add_up(parts[0].data(), kSums);
  return parts[0];
}
template <class Term>
double sum_of(Evaluator& evaluator, std::size_t n, const Term& term) {
  return sum<1>(evaluator, n, [&](std::size_t i) { return std::array<double, 1>{term(i)}; })[0].value();
}

/// Generators, and what an evaluation says of them.
struct Place {
  Vectors generators;
  Cells cells;
  double energy = 0;
  double gradient = 0;  ///< Options::tolerance
};

class Minimizer {
 public:
  Minimizer(Evaluator& evaluator, State& state, const Options& options)
      : evaluator_(evaluator), state_(state), options_(options), n_(state.generators.size()) {
    total_ = sum_of(evaluator_, n_, [](std::size_t) { return 1.0; });
  }

  Result run() {
    here_.generators = state_.generators;
    evaluate(here_);
    if (state_.steps == 0) state_.evaluations = 1;  // else they were evaluated before
    End end = End::converged;
    while (here_.gradient > options_.tolerance) {
      if (state_.evaluations >= options_.most_evaluations) {
        end = End::evaluations;
        break;
      }
      if (!step()) {
        end = End::stalled;
        break;
      }
      ++state_.steps;
      state_.generators = here_.generators;
      if (options_.progress && !options_.progress(progress())) {
        end = End::stopped;
        break;
      }
    }
    return {end, progress(), std::move(here_.cells)};
  }

 private:
  Progress progress() const {
    return {static_cast<std::int64_t>(total_), state_.evaluations, here_.gradient, here_.energy};
  }

  void evaluate(Place& place) {
    evaluator_.evaluate(place.generators, place.cells);
    const auto sums = sum<2>(evaluator_, n_, [&](std::size_t i) {
      const Point& g = place.generators[i];
      const Point move = minus(centroid(place.cells, i, g), g);
      return std::array<double, 2>{place.cells.energy[i], dot(move, move)};
    });
    place.energy = sums[0].value();
    constexpr double kSphere = 12.566370614359172;
    place.gradient = std::sqrt(sums[1].value() / total_ / (kSphere / total_));
  }
  /// As a trial: generators without a tessellation have an infinite energy.
  void try_place(Place& place) {
    ++state_.evaluations;
    try {
      evaluate(place);
    } catch (const BadGenerators&) {
      place.energy = std::numeric_limits<double>::infinity();
    }
  }

  bool step() {
    if (options_.method == Method::newton && state_.steps >= options_.first_lloyd_steps) {
      if (newton_step()) return true;
      state_.pairs.clear();
    }
    return lloyd_step();
  }

  /// False if the energy does not fall.
  bool lloyd_step() {
    there_.generators.resize(n_);
    for_each(n_,
             [&](std::size_t i) { there_.generators[i] = centroid(here_.cells, i, here_.generators[i]); });
    try_place(there_);
    if (!(there_.energy < here_.energy)) return false;
    std::swap(here_, there_);
    return true;
  }

  bool newton_step() {
    set_direction();
    const auto sums = sum<1>(evaluator_, n_, [&](std::size_t i) {
      return std::array<double, 1>{-2 * dot(here_.cells.pull[i], direction_[i])};
    });
    const double slope = sums[0].value();
    if (!(slope < 0)) {
      ++state_.no_descent;
      return false;
    }
    double most = 0;
    for (std::size_t i = 0; i < n_; ++i)
      most = std::max(most, dot(direction_[i], direction_[i]) * here_.cells.mass[i] / here_.cells.energy[i]);
    most = std::sqrt(evaluator_.largest(most));
    double length = most > kLongest ? kLongest / most : 1;
    there_.generators.resize(n_);
    for (int trial = 0; trial < kTrials; ++trial) {
      for_each(n_, [&](std::size_t i) {
        there_.generators[i] = normalized(plus(here_.generators[i], scaled(length, direction_[i])));
      });
      try_place(there_);
      if (there_.energy <= here_.energy + kSufficient * length * slope && there_.energy < here_.energy) {
        keep_pair();
        std::swap(here_, there_);
        return true;
      }
      // The least of the parabola through both energies with this slope, within bounds.
      const double rise = there_.energy - here_.energy - length * slope;
      const double next = std::isfinite(rise) ? -slope * length * length / (2 * rise) : 0;
      length = std::clamp(next, 0.1 * length, 0.5 * length);
    }
    ++state_.no_decrease;
    return false;
  }

  /// The step and the change of the gradient, if the energy is convex along it.
  void keep_pair() {
    State::Pair pair;
    if (state_.pairs.size() == kPairs) {
      pair = std::move(state_.pairs.front());
      state_.pairs.erase(state_.pairs.begin());
    }
    pair.step.resize(n_);
    pair.change.resize(n_);
    const double product = sum_of(evaluator_, n_, [&](std::size_t i) {
      pair.step[i] = minus(there_.generators[i], here_.generators[i]);
      pair.change[i] = scaled(-2, minus(there_.cells.pull[i], here_.cells.pull[i]));
      return dot(pair.step[i], pair.change[i]);
    });
    if (product > 0) state_.pairs.push_back(std::move(pair));
  }

  /// -H gradient, at right angles to the generators (Nocedal 1980).
  void set_direction() {
    direction_.resize(n_);
    for_each(n_, [&](std::size_t i) { direction_[i] = scaled(2, here_.cells.pull[i]); });
    const std::size_t count = state_.pairs.size();
    std::vector<double> product(count), share(count);
    for (std::size_t k = count; k-- > 0;) {
      const auto& [step, change] = state_.pairs[k];
      const auto sums = sum<2>(evaluator_, n_, [&, s = step.data(), c = change.data()](std::size_t i) {
        return std::array<double, 2>{dot(s[i], c[i]), dot(s[i], direction_[i])};
      });
      product[k] = sums[0].value();
      share[k] = sums[1].value() / product[k];
      for_each(n_, [&, c = change.data()](std::size_t i) {
        direction_[i] = minus(direction_[i], scaled(share[k], c[i]));
      });
    }
    for_each(n_,
             [&](std::size_t i) { direction_[i] = scaled(1 / (2 * here_.cells.mass[i]), direction_[i]); });
    for (std::size_t k = 0; k < count; ++k) {
      const auto& [step, change] = state_.pairs[k];
      const double other =
          sum_of(evaluator_, n_, [&, c = change.data()](std::size_t i) { return dot(c[i], direction_[i]); }) /
          product[k];
      for_each(n_, [&, s = step.data()](std::size_t i) {
        direction_[i] = plus(direction_[i], scaled(share[k] - other, s[i]));
      });
    }
    for_each(n_, [&](std::size_t i) {
      const Point& g = here_.generators[i];
      direction_[i] = minus(direction_[i], scaled(dot(direction_[i], g), g));
    });
  }

  Evaluator& evaluator_;
  State& state_;
  const Options& options_;
  const std::size_t n_;  ///< generators of this rank
  double total_ = 0;     ///< generators of all ranks
  Place here_, there_;
  Vectors direction_;
};

}  // namespace

Result minimize(Evaluator& evaluator, State& state, const Options& options) {
  return Minimizer(evaluator, state, options).run();
}

}  // namespace pstripack::scvt
