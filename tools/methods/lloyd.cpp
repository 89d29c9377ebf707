#include "methods/lloyd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/parallel_for.h"
#include "files/writers.h"
#include "methods/sphere.h"
#include "numbers.h"
#include "point_sets.h"
#include "stripack/list_queries.h"

namespace methods {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

class ConstantDensity : public Density {
 public:
  double at(const Point&, std::int32_t&) const override { return 1; }
  double largest() const override { return 1; }
};

class Bump : public Density {
 public:
  Bump(const Point& centre, double radius, double width, double ratio)
      : centre_(centre), radius_(radius), width_(width), ratio_(ratio) {}

  double at(const Point& p, std::int32_t&) const override {
    const Point d = minus(p, centre_);
    const double distance = 2 * std::asin(std::min(1.0, std::sqrt(dot(d, d)) / 2));
    const double finer = 1 + (ratio_ - 1) * (1 + std::tanh((radius_ - distance) / width_)) / 2;
    return finer * finer * (finer * finer);
  }
  double largest() const override { return std::max(1.0, ratio_ * ratio_ * (ratio_ * ratio_)); }

 private:
  Point centre_;
  double radius_, width_, ratio_;
};

class SampledDensity : public Density {
 public:
  SampledDensity(const std::vector<Point>& nodes, std::vector<double> values)
      : interpolation_(nodes), values_(std::move(values)) {}

  double at(const Point& p, std::int32_t& near) const override {
    thread_local std::vector<Share> shares;
    if (!interpolation_.linear(p, near, shares)) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0;
    for (const Share& s : shares) sum += s.part * values_[static_cast<std::size_t>(s.node) - 1];
    return sum;
  }
  double largest() const override { return *std::max_element(values_.begin(), values_.end()); }

 private:
  Interpolation interpolation_;
  std::vector<double> values_;
};

/// Integrals over a cell: of density times place, of density times squared distance, and its area.
struct Cell {
  Point moment{0, 0, 0};
  double energy = 0, area = 0;

  /// The triangle of generator g and two consecutive corners.
  template <class DensityAt>
  void add(const Point& g, const Point& a, const Point& b, const DensityAt& density_at) {
    const double third = volume(g, a, b) / 6;  // det/2, a third for each midpoint
    for (const auto& [s, t] : {std::pair(&g, &a), std::pair(&a, &b), std::pair(&b, &g)}) {
      const Point q{(s->x + t->x) / 2, (s->y + t->y) / 2, (s->z + t->z) / 2};
      const double square = dot(q, q), length = std::sqrt(square);
      const Point p{q.x / length, q.y / length, q.z / length}, d = minus(p, g);
      const double part = third / (square * length), mass = part * density_at(p);
      moment = {moment.x + mass * p.x, moment.y + mass * p.y, moment.z + mass * p.z};
      energy += mass * dot(d, d);
      area += part;
    }
  }
};

template <class DensityAt>
Cell cell_of(const std::vector<Point>& generators, const pstripack::ListReader<std::int32_t>& reader,
             std::int32_t node, const DensityAt& density_at) {
  const auto at = [&](std::int32_t i) -> const Point& { return generators[static_cast<std::size_t>(i) - 1]; };
  const Point& g = at(node);
  const std::int32_t last = reader.last_slot(node);
  std::int32_t slot = last;
  const auto corner = [&] {  // between the neighbour in the slot and the next one
    const Point& from = at(reader.neighbour(slot));
    slot = reader.next(slot);
    return circumcentre(g, from, at(reader.neighbour(slot)));
  };
  Cell cell;
  Point before = corner();
  const std::int32_t end = slot;
  do {
    const Point next = corner();
    cell.add(g, before, next, density_at);
    before = next;
  } while (slot != end);
  return cell;
}

}  // namespace

std::unique_ptr<Density> density_of(const std::string& formula) {
  if (formula == "constant") return std::make_unique<ConstantDensity>();
  std::vector<double> v{0, 30, 30, 10, 3};
  const auto fail = [&](const char* what) {
    throw std::invalid_argument("density '" + formula + "': " + what);
  };
  if (formula.rfind("bump", 0) != 0 || (formula.size() > 4 && formula[4] != ':'))
    fail("expected constant, bump or bump:LON,LAT,RADIUS,WIDTH,RATIO");
  if (formula.size() > 4) {
    v.clear();
    for (std::size_t begin = 5; begin <= formula.size();) {
      const std::size_t end = std::min(formula.find(',', begin), formula.size());
      double value = 0;
      if (!point_sets::parse(formula.substr(begin, end - begin), value)) fail("expected numbers");
      v.push_back(value);
      begin = end + 1;
    }
    if (v.size() != 5) fail("expected five numbers: LON,LAT,RADIUS,WIDTH,RATIO");
    if (!(std::fabs(v[1]) <= 90)) fail("LAT is beyond the pole");
    if (!(v[3] > 0)) fail("WIDTH must be positive");
    if (!(v[4] > 0 && v[4] <= 1000)) fail("RATIO must be above 0, and at most 1000");
  }
  return std::make_unique<Bump>(point_sets::from_degrees(v[0], v[1]), v[2] * kDegree, v[3] * kDegree, v[4]);
}

std::unique_ptr<Density> density_between(const std::vector<Point>& nodes, std::vector<double> values) {
  return std::make_unique<SampledDensity>(nodes, std::move(values));
}

std::vector<Point> random_generators(std::size_t n, const Density& density, std::uint64_t seed) {
  point_sets::Random random(seed);
  const double largest = density.largest();
  std::vector<Point> points;
  std::int32_t near = 1;
  while (points.size() < n) {
    const Point p = random.direction();
    const double u = random.uniform();
    if (const double value = density.at(p, near); u * u * largest <= value)
      points.push_back(p);
    else if (std::isnan(value))
      throw files::NoMesh("the density is not known on the whole sphere");
  }
  return points;
}

Lloyd::Lloyd(std::vector<Point> generators, const Density& density)
    : generators_(std::move(generators)), density_(density), near_(generators_.size(), 1) {}

Lloyd::Step Lloyd::step() {
  const std::size_t n = generators_.size();
  const files::Mesh mesh = files::triangulate(generators_);
  const pstripack::ListReader<std::int32_t> reader(mesh.lists());
  if (reader.first_boundary_node() != 0)
    throw files::NoMesh("the generators lie in one hemisphere: these tessellations need the whole sphere");
  std::vector<Point> moved(n);
  std::vector<double> energy(n), move(n);
  pstripack::parallel_pieces(
      n, pstripack::threads_for(100 * n), [&](std::size_t first, std::size_t last, int) {
        for (std::size_t i = first; i < last; ++i) {
          const auto density_at = [&](const Point& p) { return density_.at(p, near_[i]); };
          const Cell cell = cell_of(generators_, reader, static_cast<std::int32_t>(i) + 1, density_at);
          moved[i] = files::unit(cell.moment);
          energy[i] = cell.energy;
          const Point d = minus(moved[i], generators_[i]);
          move[i] = std::sqrt(dot(d, d) / cell.area);
        }
      });
  Step step;
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(move[i])) {
      const files::LonLat where({generators_[i]}, true);
      throw files::NoMesh(fmt::format("the density is not known everywhere around lon {:.6g} lat {:.6g}",
                                      where.lon[0], where.lat[0]));
    }
    step.energy += energy[i];
    step.move = std::max(step.move, move[i]);
  }
  generators_ = std::move(moved);
  return step;
}

std::vector<double> Lloyd::densities() const {
  std::vector<double> values(generators_.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::int32_t near = near_[i];
    values[i] = density_.at(generators_[i], near);
  }
  return values;
}

}  // namespace methods
