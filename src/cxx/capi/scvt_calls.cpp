// Centroidal Voronoi tessellations as C functions: default floating-point environment in, no exception out.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "base/floating_point.h"
#include "base/parallel_for.h"
#include "capi/pstripack.h"
#include "lists/limits.h"
#include "lists/rings.h"
#include "scvt/errors.h"
#include "scvt/exact_sum.h"
#include "scvt/run.h"

namespace {

using namespace pstripack;

static_assert(sizeof(Point) == 3 * sizeof(double), "points are passed on as coordinates");

/// What a function returns, and says.
struct Refusal {
  std::int32_t code;
  std::string why;
};

class DensityOfCaller final : public scvt::Density {
 public:
  explicit DensityOfCaller(const pstripack_density* density)
      : density_(density != nullptr ? *density : pstripack_density{}) {}

  void at(std::size_t n, const Point* p, double* value) const override {
    constexpr std::size_t kMost = 65536;
    std::fill_n(value, n, is_constant() ? 1 : std::numeric_limits<double>::quiet_NaN());
    if (is_constant()) return;
    for (std::size_t i = 0; i < n; i += kMost)
      density_.at(static_cast<std::int32_t>(std::min(kMost, n - i)), &p[i].x, value + i, density_.user);
  }
  bool is_constant() const override { return density_.at == nullptr; }
  bool is_serial() const override { return density_.any_thread == 0; }

 private:
  pstripack_density density_;
};

/// Runs body() and returns 0, or the code of what it throws. Besides the allocator, and what follows here,
/// only a density in C++ throws.
template <class Body>
std::int32_t guarded(char* message, std::int32_t length, const Body& body) noexcept {
  const auto say = [&](std::int32_t code, const char* text) {
    if (message != nullptr && length > 0)
      std::snprintf(message, static_cast<std::size_t>(length), "%s", text);
    return code;
  };
  try {
    in_default_floating_point(body);
    return PSTRIPACK_OK;
  } catch (const Refusal& refusal) {
    return say(refusal.code, refusal.why.c_str());
  } catch (const scvt::BadDensity& error) {
    return say(PSTRIPACK_BAD_DENSITY, error.what());
  } catch (const scvt::CoincidentGenerators& error) {
    return say(PSTRIPACK_COINCIDENT, error.what());
  } catch (const scvt::GeneratorsInHemisphere& error) {
    return say(PSTRIPACK_HEMISPHERE, error.what());
  } catch (const scvt::BadGenerators& error) {
    return say(PSTRIPACK_BAD_COORDINATE, error.what());
  } catch (const std::bad_alloc&) {
    return say(PSTRIPACK_OUT_OF_MEMORY, pstripack_strerror(PSTRIPACK_OUT_OF_MEMORY));
  } catch (const std::exception& error) {
    return say(PSTRIPACK_BAD_DENSITY, error.what());
  } catch (...) {
    return say(PSTRIPACK_BAD_DENSITY, "the density threw an exception");
  }
}

void check_count(std::int32_t n) {
  if (n < 4)
    throw Refusal{PSTRIPACK_TOO_FEW_NODES,
                  "a tessellation needs at least 4 generators, here are " + std::to_string(n)};
  if (n > most_nodes<std::int32_t>())
    throw Refusal{PSTRIPACK_TOO_MANY_NODES, "at most " + std::to_string(most_nodes<std::int32_t>()) +
                                                " generators, here are " + std::to_string(n)};
}

std::vector<Point> points_of(std::int32_t n, const double* x, const double* y, const double* z) {
  std::vector<Point> points(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {x[i], y[i], z[i]};
  return points;
}

// ---- the whole run

void require(bool is_good, const char* option) {
  if (!is_good) throw Refusal{PSTRIPACK_BAD_OPTION, std::string("pstripack_scvt_options: ") + option};
}

/// With the default in the place of each 0, but for the procedure.
pstripack_scvt_options checked(const pstripack_scvt_options* given) {
  pstripack_scvt_options options{};
  if (given != nullptr) {
    require(given->bytes >= static_cast<std::int64_t>(sizeof given->bytes), "bytes: the size of the options");
    require(given->bytes <= static_cast<std::int64_t>(sizeof options),
            "bytes: the options of a newer library than the one that is loaded");
    std::memcpy(&options, given, static_cast<std::size_t>(given->bytes));
  }
  require(options.start >= PSTRIPACK_SCVT_LEVELS && options.start <= PSTRIPACK_SCVT_GIVEN,
          "start: 0, 1 or 2");
  require(options.method == PSTRIPACK_SCVT_NEWTON || options.method == PSTRIPACK_SCVT_LLOYD,
          "method: 0 or 1");
  require(options.tolerance >= 0 && std::isfinite(options.tolerance), "tolerance: positive");
  require(options.most_evaluations >= 0, "most_evaluations: positive");
  return options;
}

scvt::RunOptions run_options(const pstripack_scvt_options& options) {
  scvt::RunOptions run;
  run.levels = options.start == PSTRIPACK_SCVT_LEVELS;
  run.method = options.method == PSTRIPACK_SCVT_LLOYD ? scvt::Method::lloyd : scvt::Method::newton;
  if (options.tolerance != 0) run.tolerance = options.tolerance;
  if (options.most_evaluations != 0) run.most_evaluations = options.most_evaluations;
  if (options.seed != 0) run.seed = static_cast<std::uint64_t>(options.seed);
  if (options.progress != nullptr)
    run.progress = [progress = options.progress, user = options.user](const scvt::Progress& p) {
      const pstripack_scvt_progress told{p.generators, p.evaluations, p.gradient, p.energy};
      return progress(&told, user) == 0;
    };
  return run;
}

std::int32_t reason_of(scvt::End end) {
  switch (end) {
    case scvt::End::converged:
      return PSTRIPACK_SCVT_CONVERGED;
    case scvt::End::evaluations:
      return PSTRIPACK_SCVT_EVALUATIONS;
    case scvt::End::stopped:
      return PSTRIPACK_SCVT_STOPPED;
    case scvt::End::stalled:
      break;
  }
  return PSTRIPACK_SCVT_STALLED;
}

// ---- one step

/// The neighbours of each node as Stars: those of canonical lists are where they are, of others there is a
/// copy.
class StarsOfLists {
 public:
  explicit StarsOfLists(const ListsView<std::int32_t>& lists) {
    const auto n = static_cast<std::int32_t>(lists.n);
    Rings<std::int32_t> rings;
    if (!rings.read(lists, threads_for(lists.n)))
      throw Refusal{PSTRIPACK_BAD_LISTS, pstripack_strerror(PSTRIPACK_BAD_LISTS)};
    end_.reserve(lists.n);
    neighbour_.reserve(static_cast<std::size_t>(rings.arcs()));
    for (std::int32_t node = 1; node <= n; ++node) {
      for (std::int32_t arc = rings.begin(node); arc < rings.end(node); ++arc) {
        if (rings.entry(arc) < 0) throw scvt::GeneratorsInHemisphere();
        neighbour_.push_back(rings.entry(arc));
      }
      const auto first = neighbour_.end() - rings.degree(node);
      std::rotate(first, std::min_element(first, neighbour_.end()), neighbour_.end());
      end_.push_back(rings.end(node));
    }
    if (rings.arcs() != 6 * n - 12)
      throw Refusal{PSTRIPACK_BAD_LISTS, "the lists have " + std::to_string(rings.arcs()) +
                                             " neighbours, a triangulation of the sphere has " +
                                             std::to_string(6 * n - 12)};
  }
  scvt::Stars stars() const { return {end_.size(), end_.data(), neighbour_.data()}; }

 private:
  std::vector<std::int32_t> end_, neighbour_;
};

/// A triangle that turns the wrong way, by more than rounding, tells lists of other generators.
void check_triangles(const std::vector<Point>& generators, const scvt::Stars& stars) {
  constexpr double kRounding = 1e-12;
  const auto point = [&](std::int32_t node) { return generators[static_cast<std::size_t>(node) - 1]; };
  for (std::size_t i = 0; i < stars.count; ++i) {
    std::int32_t before = stars.neighbour[stars.end_of(i) - 1];
    for (std::size_t j = stars.begin_of(i); j < stars.end_of(i); ++j) {
      const std::int32_t next = stars.neighbour[j];
      const Point to_before = minus(point(before), generators[i]),
                  to_next = minus(point(next), generators[i]);
      if (dot(generators[i], cross(to_before, to_next)) < -kRounding)
        throw Refusal{PSTRIPACK_BAD_LISTS, "the lists are not those of the generators: triangle " +
                                               std::to_string(i + 1) + ", " + std::to_string(before) + ", " +
                                               std::to_string(next) + " is clockwise"};
      before = next;
    }
  }
}

}  // namespace

extern "C" {

int32_t pstripack_scvt(int32_t n, double* x, double* y, double* z, const pstripack_density* density,
                       const pstripack_scvt_options* options, pstripack_scvt_result* result, char* message,
                       int32_t length) {
  return guarded(message, length, [&] {
    check_count(n);
    const pstripack_scvt_options chosen = checked(options);
    const scvt::RunOptions how = run_options(chosen);
    const DensityOfCaller values(density);
    const scvt::Tessellation found = chosen.start == PSTRIPACK_SCVT_GIVEN
                                         ? scvt::run(points_of(n, x, y, z), values, how)
                                         : scvt::run(static_cast<std::size_t>(n), values, how);
    const std::vector<Point>& generators = found.state.generators;
    for (std::size_t i = 0; i < generators.size(); ++i) {
      x[i] = generators[i].x;
      y[i] = generators[i].y;
      z[i] = generators[i].z;
    }
    if (result != nullptr)
      *result = {found.result.progress.energy, found.result.progress.gradient, found.evaluations,
                 static_cast<std::int32_t>(generators.size()), reason_of(found.result.end)};
  });
}

int32_t pstripack_scvt_step(int32_t n, const double* x, const double* y, const double* z, const int32_t* list,
                            const int32_t* lptr, const int32_t* lend, const pstripack_density* density,
                            double* xc, double* yc, double* zc, double* mass, double* energy, char* message,
                            int32_t length) {
  return guarded(message, length, [&] {
    check_count(n);
    const std::vector<Point> generators = scvt::unit_vectors(points_of(n, x, y, z));
    const StarsOfLists lists({generators.size(), list, lptr, lend, 0});
    check_triangles(generators, lists.stars());
    scvt::Cells cells;
    scvt::integrate(generators.data(), lists.stars(), DensityOfCaller(density), cells);
    scvt::ExactSum sum;
    for (std::size_t i = 0; i < generators.size(); ++i) {
      if (!(cells.mass[i] > 0) || !std::isfinite(cells.mass[i]))
        throw Refusal{PSTRIPACK_BAD_LISTS,
                      "the lists are not those of the generators: the cell of generator " +
                          std::to_string(i + 1) + " has no mass"};
      sum.add(cells.energy[i]);
    }
    for (std::size_t i = 0; i < generators.size(); ++i) {
      const Point c = scvt::centroid(cells, i, generators[i]);
      xc[i] = c.x;
      yc[i] = c.y;
      zc[i] = c.z;
    }
    if (mass != nullptr) std::copy(cells.mass.begin(), cells.mass.end(), mass);
    if (energy != nullptr) *energy = sum.value();
  });
}

}  // extern "C"
