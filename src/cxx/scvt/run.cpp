#include "scvt/run.h"

#include <cmath>
#include <string>
#include <utility>

#include "scvt/errors.h"
#include "scvt/evaluator.h"
#include "scvt/first_generators.h"

namespace pstripack::scvt {
namespace {

void check_count(std::size_t n) {
  if (n < 4) throw BadGenerators("a tessellation needs at least 4 generators, here are " + std::to_string(n));
}

}  // namespace

Tessellation run(std::size_t n, const Density& density, const RunOptions& options) {
  check_count(n);
  const std::vector<std::size_t> sizes = options.levels ? level_sizes(n) : std::vector<std::size_t>{n};
  LocalEvaluator evaluator(density);
  Tessellation done;
  done.state = State(random_generators(sizes[0], density, options.seed));
  for (std::size_t level = 0;; ++level) {
    done.result = minimize(evaluator, done.state, options);
    done.evaluations +=
        static_cast<double>(done.state.evaluations * static_cast<std::int64_t>(sizes[level])) /
        static_cast<double>(n);
    if (level + 1 == sizes.size() || done.result.end == End::stopped) return done;
    std::vector<std::int32_t> list, lptr, lend;
    const NeighbourLists stars = triangulate(done.state.generators, list, lptr, lend);
    done.state = State(refined(done.state.generators, stars, density, sizes[level + 1]));
  }
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
      throw BadGenerators("generator " + std::to_string(i + 1) + " has no direction");
    generators[i] = unit_vector(generators[i]);
  }
  return generators;
}

Tessellation run(std::vector<Point> generators, const Density& density, const RunOptions& options) {
  check_count(generators.size());
  generators = unit_vectors(std::move(generators));
  LocalEvaluator evaluator(density);
  Tessellation done;
  done.state = State(std::move(generators));
  done.result = minimize(evaluator, done.state, options);
  done.evaluations = static_cast<double>(done.state.evaluations);
  return done;
}

}  // namespace pstripack::scvt
