// Centroidal Voronoi tessellations as C functions: sets the default floating-point environment and turns
// exceptions into codes.

#include "capi/scvt_calls.h"

#include <vector>

#include "base/parallel_for.h"
#include "lists/limits.h"
#include "lists/rings.h"
#include "scvt/exact_sum.h"
#include "scvt/front.h"

namespace {

using namespace pstripack;

static_assert(sizeof(Point) == 3 * sizeof(double), "points are passed on as coordinates");

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

// ---- a run

scvt::Tessellation run(std::int32_t n, const double* x, const double* y, const double* z,
                       const scvt::Density& density, const pstripack_scvt_options& options) {
  const scvt::RunOptions how = run_options(options);
  const auto count = static_cast<std::size_t>(n);
  if (options.start == PSTRIPACK_SCVT_GIVEN) return scvt::run(points_of(n, x, y, z), density, how);
  if (options.start == PSTRIPACK_SCVT_FRONT ||
      (options.start == PSTRIPACK_SCVT_BY_NUMBER && count >= scvt::kFewestOfAFront))
    return scvt::run(scvt::front_generators(count, density), density, how);
  return scvt::run(count, density, how);
}

// ---- one step

/// A copy of the neighbours of each node, in the form of NeighbourLists. Throws Refusal if the lists are
/// not those of a triangulation of the sphere.
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
  scvt::NeighbourLists stars() const { return {end_.size(), end_.data(), neighbour_.data()}; }

 private:
  std::vector<std::int32_t> end_, neighbour_;
};

/// Throws Refusal if a triangle is clockwise by more than rounding: then the lists are those of other
/// generators.
void check_triangles(const std::vector<Point>& generators, const scvt::NeighbourLists& stars) {
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

/// About a thousand of the generators: where the density is looked at before it is integrated.
std::vector<Point> some_of(const std::vector<Point>& generators) {
  std::vector<Point> some;
  for (std::size_t i = 0; i < generators.size(); i += 1 + generators.size() / 1000)
    some.push_back(generators[i]);
  return some;
}

/// Throws the reason why the cell of generator i is not good.
[[noreturn]] void refuse_cell(const std::vector<Point>& generators, const scvt::NeighbourLists& stars,
                              std::size_t i) {
  constexpr double kTooNear = 1e-60;  // then the integrals may be below all doubles
  const std::size_t j = scvt::nearest_neighbour(generators.data(), stars, i);
  const auto [first, second] =
      std::minmax({static_cast<std::int64_t>(i) + 1, static_cast<std::int64_t>(j) + 1});
  const Point d = minus(generators[j], generators[i]);
  if (d == Point{0, 0, 0}) throw scvt::CoincidentGenerators(first, second);
  if (dot(d, d) < kTooNear * kTooNear) throw scvt::GeneratorsTooNear(first, second);
  throw Refusal{PSTRIPACK_BAD_LISTS, "the lists are not those of the generators: the cell of generator " +
                                         std::to_string(i + 1) + " has no mass"};
}

}  // namespace

extern "C" {

int32_t pstripack_scvt(int32_t n, double* x, double* y, double* z, const pstripack_density* density,
                       const pstripack_scvt_options* options, pstripack_scvt_result* result, char* message,
                       int32_t length) {
  return guarded_scvt(message, length, [&] {
    check_count(n);
    const pstripack_scvt_options chosen = checked(options);
    const scvt::Tessellation found = run(n, x, y, z, DensityOfCaller(density, chosen.widths != 0), chosen);
    const std::vector<Point>& generators = found.state.generators;
    for (std::size_t i = 0; i < generators.size(); ++i) {
      x[i] = generators[i].x;
      y[i] = generators[i].y;
      z[i] = generators[i].z;
    }
    if (result != nullptr)
      *result = {found.result.progress.energy, found.result.progress.gradient, found.evaluations,
                 static_cast<std::int32_t>(generators.size()), reason_of(found.result.end, found.repair)};
  });
}

int32_t pstripack_scvt_cells(const pstripack_density* width, double radius, double* cells, char* message,
                             int32_t length) {
  return guarded_scvt(message, length, [&] {
    if (!(radius > 0 && std::isfinite(radius)))
      throw Refusal{PSTRIPACK_BAD_OPTION, "the radius must be positive and finite"};
    *cells = scvt::cells_of_widths(DensityOfCaller(width), radius);
  });
}

int32_t pstripack_scvt_step(int32_t n, const double* x, const double* y, const double* z, const int32_t* list,
                            const int32_t* lptr, const int32_t* lend, const pstripack_density* density,
                            double* xc, double* yc, double* zc, double* mass, double* energy, char* message,
                            int32_t length) {
  return guarded_scvt(message, length, [&] {
    check_count(n);
    const std::vector<Point> generators = scvt::unit_vectors(points_of(n, x, y, z));
    const StarsOfLists lists({generators.size(), list, lptr, lend, 0});
    check_triangles(generators, lists.stars());
    const scvt::NeighbourLists stars = lists.stars();
    const DensityOfCaller values(density);
    const scvt::ScaledDensity scaled(values, scvt::largest_value(values, some_of(generators)));
    scvt::Cells cells;
    scvt::integrate(generators.data(), stars, scaled, cells);
    scvt::ExactSum sum, area;
    for (std::size_t i = 0; i < generators.size(); ++i) {
      if (!is_good(cells, i)) refuse_cell(generators, stars, i);
      sum.add(cells.energy[i]);
      area.add(cells.mass[i]);
    }
    if (values.is_constant() && !scvt::is_sphere(area.value()))
      throw Refusal{PSTRIPACK_BAD_LISTS,
                    "the lists are not those of the generators: the areas of their cells add up to " +
                        std::to_string(area.value())};
    // Beyond the largest double only if the density is.
    const auto unscaled = [&](double value, const char* what) {
      const double v = std::ldexp(value, scaled.exponent());
      if (!std::isfinite(v)) throw scvt::DensityOutOfRange(what, scaled.largest());
      return v;
    };
    const double all = unscaled(sum.value(), "the energy");
    for (double& m : cells.mass) unscaled(m, "the mass of a cell");
    for (std::size_t i = 0; i < generators.size(); ++i) {
      const Point c = scvt::centroid(cells, i, generators[i]);
      xc[i] = c.x;
      yc[i] = c.y;
      zc[i] = c.z;
      if (mass != nullptr) mass[i] = std::ldexp(cells.mass[i], scaled.exponent());
    }
    if (energy != nullptr) *energy = all;
  });
}

}  // extern "C"
