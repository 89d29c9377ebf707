#include "scvt/tessellation.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "parallel/agreement.h"
#include "scvt/errors.h"
#include "scvt/evaluator.h"
#include "scvt/first_generators.h"

namespace pstripack::scvt {
namespace {

/// A row per generator: its position, then step and change of each pair.
Rows rows_of(const Tessellation& t) {
  Rows rows{3 + 6 * t.state.pairs.size(), {}, t.numbers};
  rows.values.reserve(rows.width * t.numbers.size());
  const auto add = [&](const Point& p) { rows.values.insert(rows.values.end(), {p.x, p.y, p.z}); };
  for (std::size_t i = 0; i < t.numbers.size(); ++i) {
    add(t.state.generators[i]);
    for (const State::Pair& pair : t.state.pairs) add(point(pair.step[i])), add(point(pair.change[i]));
  }
  return rows;
}

void take_rows(Tessellation& t, Rows&& rows) {
  const std::size_t n = rows.numbers.size();
  t.numbers = std::move(rows.numbers);
  t.state.generators.resize(n);
  t.state.pairs.resize((rows.width - 3) / 6);
  for (State::Pair& pair : t.state.pairs) pair.step.resize(n), pair.change.resize(n);
  const double* value = rows.values.data();
  const auto next = [&] {
    value += 3;
    return Point{value[-3], value[-2], value[-1]};
  };
  for (std::size_t i = 0; i < n; ++i) {
    t.state.generators[i] = next();
    for (State::Pair& pair : t.state.pairs) {
      pair.step[i] = single(next());
      pair.change[i] = single(next());
    }
  }
}

/// Moves generator i of `from`, with all its data, to `to` on rank ranks_of[i].
void move(Communicator& ranks, const Tessellation& from, const std::vector<std::int32_t>& ranks_of,
          Tessellation& to) {
  Rows rows;
  in_agreement(ranks, [&] { rows = rows_of(from); });
  rows = moved(ranks, std::move(rows), ranks_of);
  in_agreement(ranks, [&] { take_rows(to, std::move(rows)); });
}

Tessellation begun_with(Spread&& generators) {
  Tessellation t;
  t.numbers = std::move(generators.numbers);
  t.state.generators = std::move(generators.points);
  return t;
}

}  // namespace

Tessellation first_generators(Evaluator& evaluator, std::size_t n, const RunOptions& options) {
  Options of_levels = options;
  of_levels.well_centred = false;
  const std::vector<std::size_t> sizes = options.levels ? level_sizes(n) : std::vector<std::size_t>{n};
  Tessellation t = begun_with(random_generators(evaluator, sizes[0], options.seed));
  for (std::size_t level = 0; level + 1 < sizes.size(); ++level) {
    iterate(evaluator, t, of_levels);
    const double evaluations =
        t.evaluations + static_cast<double>(t.state.evaluations * static_cast<std::int64_t>(sizes[level])) /
                            static_cast<double>(n);
    if (t.result.end != End::stopped) {
      const Neighbourhood coarse = evaluator.triangulate(t.state.generators);
      t = begun_with(refined(evaluator.ranks(), coarse, evaluator.density(), sizes[level + 1]));
    }
    t.evaluations = evaluations;
    if (t.result.end == End::stopped) break;
  }
  return t;
}

Result solve(Evaluator& evaluator, State& state, const Options& options, Repair& repair) {
  Result result = minimize(evaluator, state, options);
  if (!options.well_centred) return result;
  repair = make_well_centred(evaluator, state.generators);
  if (repair.moved == 0) return result;
  state.pairs.clear();  // of other generators
  Options only_evaluate = options;
  only_evaluate.tolerance = std::numeric_limits<double>::infinity();
  const End end = result.end;
  result = minimize(evaluator, state, only_evaluate);
  result.end = end;
  return result;
}

void iterate(Evaluator& evaluator, Tessellation& t, const Options& options) {
  evaluator.begin_with(t.numbers);
  if (evaluator.ranks().size() > 1) {
    move(evaluator.ranks(), t, evaluator.homes(t.state.generators), t);
    evaluator.begin_with(t.numbers);
  }
  t.result = solve(evaluator, t.state, options, t.repair);
}

Tessellation on_rank_0(Communicator& ranks, const Tessellation& t) {
  Tessellation all;
  std::vector<std::int32_t> zeros;
  in_agreement(ranks, [&] { zeros.resize(t.numbers.size()); });
  move(ranks, t, zeros, all);
  return all;
}

Point unit_vector(const Point& g) {
  constexpr double kRounding = 1e-15;  ///< of the square of a length that was divided by itself
  if (std::fabs(dot(g, g) - 1) <= kRounding) return g;
  const double length = std::hypot(g.x, g.y, g.z);
  return {g.x / length, g.y / length, g.z / length};
}

std::vector<Point> unit_vectors(std::vector<Point> generators) {
  for (std::size_t i = 0; i < generators.size(); ++i) {
    if (!has_direction(generators[i]))
      throw BadGenerators("generator " + std::to_string(i + 1) + " is zero or not finite");
    generators[i] = scvt::unit_vector(generators[i]);
  }
  return generators;
}

Tessellation run(std::size_t n, const Density& density, const RunOptions& options) {
  LocalEvaluator evaluator(density);
  Tessellation t = first_generators(evaluator, n, options);
  if (t.result.end == End::stopped) return t;
  iterate(evaluator, t, options);
  t.evaluations += static_cast<double>(t.state.evaluations);
  return t;
}

Tessellation run(std::vector<Point> generators, const Density& density, const RunOptions& options) {
  LocalEvaluator evaluator(density);
  Tessellation t;
  t.state.generators = unit_vectors(std::move(generators));
  t.numbers.resize(t.state.generators.size());
  std::iota(t.numbers.begin(), t.numbers.end(), std::int64_t{1});
  iterate(evaluator, t, options);
  t.evaluations = static_cast<double>(t.state.evaluations);
  return t;
}

}  // namespace pstripack::scvt
