#include "scvt/minimize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "base/parallel_for.h"
#include "scvt/errors.h"
#include "scvt/metric.h"

namespace pstripack::scvt {
namespace {

using Vectors = std::vector<Point>;

constexpr std::size_t kPairs = 8;
constexpr int kTrials = 6;            ///< steps along one direction
constexpr double kSufficient = 1e-4;  ///< required part of the decrease predicted by the slope (Armijo)
constexpr double kLongest = 1;        ///< longest step, in root mean square radii of the cell

/// The cells of generators, and what is summed up over them.
struct Place {
  Cells cells;
  double energy = 0;
  double gradient = 0;  ///< Options::tolerance
};

class Minimizer {
 public:
  Minimizer(Evaluator& evaluator, State& state, const Options& options)
      : evaluator_(evaluator),
        state_(state),
        options_(options),
        n_(state.generators.size()),
        metric_(evaluator.ranks()) {
    // Allocate here what every step needs: the ranks must agree that all have the memory.
    evaluator_.allocate([this] {
      parts_.resize(static_cast<std::size_t>(most_threads_for(n_)));
      trial_.resize(n_);
      direction_.resize(n_);
      state_.pairs.reserve(kPairs + 1);
      products_.reserve(kPairs + 1);
    });
    total_ = sum_of([](std::size_t) { return 1.0; });
    evaluator_.scale_anew();
  }

  Result run() {
    evaluate(state_.generators, here_);
    scale_pairs();
    for (const State::Pair& pair : state_.pairs) products_.push_back(product_of(pair));
    // Changes that were rounded to 0, because they are those of another density.
    if (std::any_of(products_.begin(), products_.end(), [](double p) { return !std::isfinite(1 / p); }))
      forget_pairs();
    if (state_.steps == 0) state_.evaluations = 1;  // of a continued run this evaluation was counted before
    End end = End::converged;
    while (!(here_.gradient <= options_.tolerance)) {
      if (state_.evaluations >= options_.most_evaluations) {
        end = End::evaluations;
        break;
      }
      if (!step()) {
        end = End::stalled;
        break;
      }
      ++state_.steps;
      if (options_.progress && !options_.progress(progress())) {
        end = End::stopped;
        break;
      }
    }
    check_sum();
    return {end, progress(), std::move(here_.cells)};
  }

 private:
  Progress progress() const {
    const ScaledDensity& density = evaluator_.scaled();
    const double energy = std::ldexp(here_.energy, density.exponent());
    if (!std::isfinite(energy)) throw DensityOutOfRange("the energy", density.largest());
    return {static_cast<std::int64_t>(total_), state_.evaluations, here_.gradient, energy};
  }

  /// Gives the changes of the pairs the exponent of the evaluator.
  void scale_pairs() {
    const int by = state_.exponent - evaluator_.scaled().exponent();
    if (by != 0)
      for (State::Pair& pair : state_.pairs)
        for (SinglePoint& p : pair.change)
          p = {std::ldexp(p.x, by), std::ldexp(p.y, by), std::ldexp(p.z, by)};
    state_.exponent = evaluator_.scaled().exponent();
  }

  /// The cells of a constant density must add up to the sphere.
  void check_sum() {
    if (!evaluator_.density().is_constant()) return;
    const Point anywhere{1, 0, 0};
    double value = 0;
    evaluator_.scaled().at(1, &anywhere, &value);
    const double area = sum_of([&](std::size_t i) { return here_.cells.mass[i]; }) / value;
    if (!is_sphere(area))
      throw NoTessellation("the areas of the cells add up to " + std::to_string(area) +
                           " instead of 4 pi: some generators are too near each other");
  }

  /// Sums of terms(i), which is an array of doubles, over the generators i of all ranks. terms(i) may write
  /// data that belong to generator i.
  template <class Terms>
  auto sum(const Terms& terms) {
    constexpr std::size_t kSums = std::tuple_size_v<decltype(terms(0))>;
    static_assert(kSums <= kMostSums);
    for (auto& part : parts_) part = {};
    const int threads = std::min(threads_for(n_), static_cast<int>(parts_.size()));
    parallel_pieces(n_, threads, [&](std::size_t first, std::size_t last, int piece) {
      auto& part = parts_[static_cast<std::size_t>(piece)];
      for (std::size_t i = first; i < last; ++i) {
        const std::array<double, kSums> t = terms(i);
        for (std::size_t k = 0; k < kSums; ++k) part[k].add(t[k]);
      }
    });
    for (std::size_t piece = 1; piece < parts_.size(); ++piece)
      for (std::size_t k = 0; k < kSums; ++k) parts_[0][k] += parts_[piece][k];
    evaluator_.add_up(parts_[0].data(), kSums);
    std::array<double, kSums> values;
    for (std::size_t k = 0; k < kSums; ++k) values[k] = parts_[0][k].value();
    return values;
  }
  template <class Term>
  double sum_of(const Term& term) {
    return sum([&](std::size_t i) { return std::array<double, 1>{term(i)}; })[0];
  }

  void evaluate(const Vectors& generators, Place& place) {
    constexpr double kNotFinite = std::numeric_limits<double>::quiet_NaN();
    last_ = evaluator_.evaluate(generators, place.cells);
    const auto sums = sum([&](std::size_t i) {
      const Point& g = generators[i];
      const Point move = minus(centroid(place.cells, i, g), g);
      return std::array<double, 2>{is_good(place.cells, i) ? place.cells.energy[i] : kNotFinite,
                                   dot(move, move)};
    });
    if (!std::isfinite(sums[0]) || !std::isfinite(sums[1])) evaluator_.refuse(last_, place.cells);
    place.energy = sums[0];
    constexpr double kSphere = 12.566370614359172;
    place.gradient = std::sqrt(sums[1] / total_ / (kSphere / total_));
  }
  /// Evaluates the trial. Generators without a tessellation have an infinite energy.
  void evaluate_trial() {
    ++state_.evaluations;
    try {
      evaluate(trial_, there_);
    } catch (const BadGenerators&) {
      there_.energy = std::numeric_limits<double>::infinity();
    }
  }
  void accept_trial() {
    std::swap(state_.generators, trial_);
    std::swap(here_, there_);
  }

  bool step() {
    if (options_.method == Method::newton && state_.steps >= options_.first_lloyd_steps) {
      if (newton_step()) return true;
      forget_pairs();
    }
    return lloyd_step();
  }

  /// A step to the centroids, shortened if the energy does not fall. False if it does not fall at all.
  bool lloyd_step() {
    double part = 1;
    for (int trial = 0; trial < kTrials; ++trial, part /= 2) {
      parallel_for(n_, n_, [&](std::size_t i) {
        const Point &g = state_.generators[i], c = centroid(here_.cells, i, g);
        trial_[i] = part == 1 ? c : normalized(plus(g, scaled(part, minus(c, g))));
      });
      evaluate_trial();
      if (there_.energy < here_.energy) {
        accept_trial();
        return true;
      }
    }
    return false;
  }

  bool newton_step() {
    set_direction();
    const double slope = sum_of([&](std::size_t i) { return -2 * dot(here_.cells.pull[i], direction_[i]); });
    if (!(slope < 0)) {
      ++state_.no_descent;
      return false;
    }
    double most = 0;
    for (std::size_t i = 0; i < n_; ++i)
      most = std::max(most, dot(direction_[i], direction_[i]) * here_.cells.mass[i] / here_.cells.energy[i]);
    most = std::sqrt(evaluator_.largest(most));
    double length = most > kLongest ? kLongest / most : 1;
    for (int trial = 0; trial < kTrials; ++trial) {
      parallel_for(n_, n_, [&](std::size_t i) {
        trial_[i] = normalized(plus(state_.generators[i], scaled(length, direction_[i])));
      });
      evaluate_trial();
      if (there_.energy <= here_.energy + kSufficient * length * slope && there_.energy < here_.energy) {
        keep_pair();
        accept_trial();
        return true;
      }
      // The minimum of the parabola through both energies with this slope, within bounds.
      const double rise = there_.energy - here_.energy - length * slope;
      const double next = std::isfinite(rise) ? -slope * length * length / (2 * rise) : 0;
      length = std::clamp(next, 0.1 * length, 0.5 * length);
    }
    ++state_.no_decrease;
    return false;
  }

  /// Keeps the step and the change of the gradient, if the energy is convex along the step.
  void keep_pair() {
    evaluator_.allocate([this] {
      spare_.step.resize(n_);
      spare_.change.resize(n_);
    });
    parallel_for(n_, n_, [&](std::size_t i) {
      spare_.step[i] = single(minus(trial_[i], state_.generators[i]));
      spare_.change[i] = single(scaled(-2, minus(there_.cells.pull[i], here_.cells.pull[i])));
    });
    const double product = product_of(spare_);
    if (!(product > 0)) return;
    state_.pairs.push_back(std::move(spare_));
    products_.push_back(product);
    if (state_.pairs.size() <= kPairs) return;
    spare_ = std::move(state_.pairs.front());
    state_.pairs.erase(state_.pairs.begin());
    products_.erase(products_.begin());
  }
  double product_of(const State::Pair& pair) {
    return sum_of([&](std::size_t i) { return dot(point(pair.step[i]), point(pair.change[i])); });
  }
  void forget_pairs() {
    state_.pairs.clear();
    products_.clear();
  }

  /// Sets direction_ to -H gradient, perpendicular to the generators (the two-loop recursion of Nocedal
  /// 1980). Each pass over the generators finishes the update of one pair and begins that of the next.
  /// last_ belongs to here_, because a failed newton_step() is followed by a step of Lloyd's method.
  void set_direction() {
    const std::size_t count = state_.pairs.size();
    std::array<double, kPairs> share;
    parallel_for(n_, n_, [&](std::size_t i) { direction_[i] = scaled(2, here_.cells.pull[i]); });
    for (std::size_t k = count; k-- > 0;) {
      const SinglePoint* const step = state_.pairs[k].step.data();
      const SinglePoint* const later = k + 1 < count ? state_.pairs[k + 1].change.data() : nullptr;
      share[k] = sum_of([&](std::size_t i) {
                   if (later != nullptr)
                     direction_[i] = minus(direction_[i], scaled(share[k + 1], point(later[i])));
                   return dot(point(step[i]), direction_[i]);
                 }) /
                 products_[k];
    }
    if (count > 0) {
      const SinglePoint* const first = state_.pairs[0].change.data();
      parallel_for(n_, n_, [&](std::size_t i) {
        direction_[i] = minus(direction_[i], scaled(share[0], point(first[i])));
      });
    }
    metric_.set(last_, here_.cells);
    metric_.solve(direction_);
    double add = 0;  // coefficient of the step of the pair before
    for (std::size_t k = 0; k < count; ++k) {
      const SinglePoint* const change = state_.pairs[k].change.data();
      const SinglePoint* const before = k > 0 ? state_.pairs[k - 1].step.data() : nullptr;
      const double other = sum_of([&](std::size_t i) {
                             if (before != nullptr)
                               direction_[i] = plus(direction_[i], scaled(add, point(before[i])));
                             return dot(point(change[i]), direction_[i]);
                           }) /
                           products_[k];
      add = share[k] - other;
    }
    const SinglePoint* const last = count > 0 ? state_.pairs[count - 1].step.data() : nullptr;
    parallel_for(n_, n_, [&](std::size_t i) {
      const Point& g = state_.generators[i];
      if (last != nullptr) direction_[i] = plus(direction_[i], scaled(add, point(last[i])));
      direction_[i] = minus(direction_[i], scaled(dot(direction_[i], g), g));
    });
  }

  Evaluator& evaluator_;
  State& state_;
  const Options& options_;
  const std::size_t n_;  ///< generators of this rank
  double total_ = 0;     ///< generators of all ranks
  static constexpr std::size_t kMostSums = 2;
  std::vector<std::array<ExactSum, kMostSums>> parts_;  ///< by thread
  Vectors trial_;                                       ///< generators after a step that is being tried
  Place here_, there_;                                  ///< of the generators in the state; of the trial
  Neighbourhood last_;                                  ///< of the last evaluation
  Metric metric_;
  Vectors direction_;
  State::Pair spare_;             ///< room for the next pair
  std::vector<double> products_;  ///< by pair: step times change
};

}  // namespace

Result minimize(Evaluator& evaluator, State& state, const Options& options) {
  return Minimizer(evaluator, state, options).run();
}

}  // namespace pstripack::scvt
