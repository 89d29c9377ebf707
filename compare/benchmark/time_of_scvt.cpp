#include "time_of_scvt.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "measuring.h"
#include "parallel/cost.h"
#include "scvt/first_generators.h"
#include "scvt/front.h"
#include "scvt/tessellation.h"

namespace benchmark {
namespace {

using namespace pstripack::scvt;
using pstripack::Point;

enum class First { front, levels, random };
const char* name_of(First first) {
  return first == First::front ? "front" : first == First::levels ? "levels" : "random";
}

std::unique_ptr<Density> density_called(const std::string& name) {
  if (name == "constant") return std::make_unique<ConstantDensity>();
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const Point centre{std::cos(30 * kDegree), 0, std::sin(30 * kDegree)};
  return std::make_unique<BumpDensity>(centre, 30 * kDegree, 10 * kDegree, 3);  // bump of `pstripack scvt`
}

double cpu_seconds() { return pstripack::clock_seconds(CLOCK_PROCESS_CPUTIME_ID); }

Tessellation descend(std::size_t n, const Density& density, First first, RunOptions options) {
  options.levels = first == First::levels;
  return first == First::front ? run(front_generators(n, density), density, options)
                               : run(n, density, options);
}

/// Runs work() in a process of its own, where triangulations may reuse the last mesh.
void in_its_own_process(const std::function<void()>& work) {
  measured([&] {
    setenv("PSTRIPACK_WARM_START", "1", 1);
    work();
    return 0.0;
  });
}

// ---- whole runs -------------------------------------------------------------------------------------

struct Found {
  double evaluations, gradient, energy, seconds;
  bool has_converged;
};

Found found_by(const std::string& density_name, std::size_t n, First first, double tolerance) {
  const legacy_stripack::Shared<Found> found;
  in_its_own_process([&] {
    const auto density = density_called(density_name);
    RunOptions options;
    options.tolerance = tolerance;
    const double start = cpu_seconds();
    const Tessellation t = descend(n, *density, first, options);
    found[0] = {t.evaluations, t.result.progress.gradient, t.result.progress.energy, cpu_seconds() - start,
                t.result.end == End::converged};
  });
  return found[0];
}

}  // namespace

void run_time_of_scvt() {
  fmt::print(
      "\nCentroidal tessellations on one thread, to a gradient. evaluations: of all N cells; those of levels "
      "by "
      "their share\nof N. energy N: a lattice of regular hexagons would have 25.3255, density 1\n\n"
      "{:<10} {:>8} {:<7} {:>9} {:>11} {:>9} {:>10} {:>12}\n",
      "density", "N", "first", "gradient", "evaluations", "reached", "energy N", "cpu seconds");
  for (const auto& [density, tolerance] : {std::pair("constant", 1e-5), {"bump", 1e-4}})
    for (const std::size_t n : {10242, 163842})
      for (const First first : {First::front, First::levels, First::random}) {
        const Found f = found_by(density, n, first, tolerance);
        fmt::print("{:<10} {:>8} {:<7} {:>9.0e} {:>11.1f} {:>9.2e} {:>10.4f} {:>12.1f}{}\n", density, n,
                   name_of(first), tolerance, f.evaluations, f.gradient, f.energy * static_cast<double>(n),
                   f.seconds, f.has_converged ? "" : " NOT converged");
        std::fflush(stdout);
      }
}

void run_descents(const DescentSettings& settings) {
  struct Descent {
    Method method;
    First first;
  };
  constexpr Descent kDescents[] = {{Method::lloyd, First::random},
                                   {Method::newton, First::random},
                                   {Method::newton, First::levels},
                                   {Method::newton, First::front}};
  const auto n = static_cast<std::size_t>(settings.n);
  fmt::print(
      "\n{} generators, density 1, one thread, to a gradient of {:.0e} in at most {} evaluations\n\n"
      "{:<8} {:<7} {:>12} {:>12} {:>9} {:>10}\n",
      n, settings.tolerance, settings.evaluations, "method", "first", "evaluations", "cpu seconds",
      "gradient", "energy N");
  std::fflush(stdout);
  std::FILE* const table = fdopen(dup(STDOUT_FILENO), "w");  // stdout of the process below is stderr
  for (const Descent& d : kDescents)
    in_its_own_process([&] {
      const ConstantDensity density;
      RunOptions options;
      options.method = d.method;
      options.tolerance = settings.tolerance;
      options.most_evaluations = settings.evaluations;
      std::int64_t before = 0;  // number of generators of the level
      double of_levels = 0, of_this = 0;
      const double start = cpu_seconds();
      options.progress = [&](const Progress& p) {
        if (p.generators != before) of_levels += of_this;
        before = p.generators;
        of_this = static_cast<double>(p.evaluations * p.generators) / settings.n;
        if (p.generators == settings.n)
          fmt::print(table, "{:<8} {:<7} {:>12.1f} {:>12.3f} {:>9.2e} {:>10.5f}\n",
                     d.method == Method::lloyd ? "lloyd" : "newton", name_of(d.first), of_levels + of_this,
                     cpu_seconds() - start, p.gradient, p.energy * static_cast<double>(p.generators));
        return true;
      };
      descend(n, density, d.first, options);
      std::fflush(table);
    });
  std::fclose(table);
}

}  // namespace benchmark
