#include "scvt/first_generators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "base/workspace.h"
#include "geometry/insertion_order.h"
#include "scvt/errors.h"
#include "scvt/evaluator.h"
#include "scvt/vectors.h"

namespace pstripack::scvt {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// In [0,1).
  double uniform() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

/// A triangle of the sphere, small enough that its area is about that of the plane triangle.
struct OctahedronPart {
  std::array<Point, 3> corner;

  double area() const {
    const Point n = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
    return std::sqrt(dot(n, n)) / 2;
  }
};

std::vector<OctahedronPart> octahedron(int cuts) {
  std::vector<OctahedronPart> patches;
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      for (const double z : {1.0, -1.0})
        patches.push_back({{Point{x, 0, 0}, Point{0, y, 0}, Point{0, 0, z}}});
  for (; cuts > 0; --cuts) {
    std::vector<OctahedronPart> parts;
    for (const auto& [c] : patches) {
      const Point p = normalized(plus(c[0], c[1])), q = normalized(plus(c[1], c[2])),
                  r = normalized(plus(c[2], c[0]));
      for (const OctahedronPart& part : {OctahedronPart{{c[0], p, r}}, OctahedronPart{{p, c[1], q}},
                                         OctahedronPart{{r, q, c[2]}}, OctahedronPart{{p, q, r}}})
        parts.push_back(part);
    }
    patches = std::move(parts);
  }
  return patches;
}

/// Draws points with the square root of a density. A patch is chosen by its area and the largest density seen
/// in it; a point in it is then taken with the chance that its density has. Where the density hides a higher
/// peak there are too few points: good enough to begin.
class Sampler {
 public:
  explicit Sampler(const Density& density)
      : density_(density), patches_(octahedron(density.is_constant() ? 3 : 6)) {
    std::vector<Point> places;
    for (const auto& [corner] : patches_)
      for (std::size_t k = 0; k < 3; ++k) {
        places.push_back(corner[k]);
        places.push_back(normalized(plus(corner[k], corner[(k + 1) % 3])));
      }
    const std::vector<double> values = values_at(places, density);
    double all = 0;
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      const double* const value = values.data() + 6 * i;
      most_.push_back(std::sqrt(*std::max_element(value, value + 6)));
      until_.push_back(all += patches_[i].area() * most_[i]);
    }
  }

  std::vector<Point> draw(std::size_t n, Random& random) const {
    std::vector<Point> points;
    points.reserve(n);
    while (points.size() < n) {
      const auto place = std::upper_bound(until_.begin(), until_.end(), random.uniform() * until_.back());
      const auto i = std::min(static_cast<std::size_t>(place - until_.begin()), patches_.size() - 1);
      double u = random.uniform(), v = random.uniform();
      const double chance = random.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const auto& c = patches_[i].corner;
      const Point p = normalized(plus(scaled(1 - u - v, c[0]), plus(scaled(u, c[1]), scaled(v, c[2]))));
      const double value = density_.at(p);
      if (!(value > 0 && std::isfinite(value))) throw BadDensity(p, value);
      if (chance * most_[i] <= std::sqrt(value)) points.push_back(p);
    }
    return along_a_curve(points);
  }

 private:
  const Density& density_;
  const std::vector<OctahedronPart> patches_;
  std::vector<double> most_, until_;
};

bool surround_the_sphere(const std::vector<Point>& points) {
  try {
    std::vector<std::int32_t> list, lptr, lend;
    triangulate(points, list, lptr, lend);
    return true;
  } catch (const GeneratorsInHemisphere&) {
    return false;
  } catch (const CoincidentGenerators&) {
    return false;
  }
}

}  // namespace

std::vector<double> values_at(const std::vector<Point>& points, const Density& density) {
  std::vector<double> values(points.size());
  density.at(points.size(), points.data(), values.data());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0 && std::isfinite(values[i]))) throw BadDensity(points[i], values[i]);
  return values;
}

std::vector<Point> along_a_curve(const std::vector<Point>& points) {
  Workspace workspace(16 * points.size() + (std::size_t{1} << 20));
  std::vector<std::uint32_t> order(points.size());
  insertion_order(points.data(), points.size(), order.data(), workspace);
  std::vector<Point> sorted;
  sorted.reserve(points.size());
  for (const std::uint32_t i : order) sorted.push_back(points[i]);
  return sorted;
}

std::vector<Point> random_generators(std::size_t n, const Density& density, std::uint64_t seed) {
  if (n < 4) throw BadGenerators("a tessellation needs at least 4 generators, here are " + std::to_string(n));
  // Seven in eight sets of four points lie in a hemisphere, and nearly all sets of few points where most of
  // the density does: then the points are uniform.
  constexpr int kTrials = 20;
  const ConstantDensity uniform;
  Random random(seed);
  for (const Density* of : {&density, static_cast<const Density*>(&uniform)}) {
    const Sampler sampler(*of);
    for (int trial = 0; trial < kTrials || of == &uniform; ++trial) {
      std::vector<Point> points = sampler.draw(n, random);
      if (surround_the_sphere(points)) return points;
    }
  }
  return {};  // never reached
}

std::vector<std::size_t> level_sizes(std::size_t n) {
  constexpr std::size_t kCoarsest = 12;
  std::vector<std::size_t> sizes{n};
  for (;;) {
    const std::size_t coarser = (sizes.back() - 2 + 3) / 4 + 2;  // 4 (N-2) + 2 are N and their midpoints
    if (coarser < kCoarsest) break;
    sizes.push_back(coarser);
  }
  std::reverse(sizes.begin(), sizes.end());
  return sizes;
}

std::vector<Point> refined(const std::vector<Point>& generators, const NeighbourLists& stars,
                           const Density& density, std::size_t n) {
  std::vector<Point> points = generators, middles;
  std::vector<double> length;
  for (std::size_t i = 0; i < stars.count; ++i)
    for (std::size_t j = stars.begin_of(i); j < stars.end_of(i); ++j) {
      const auto other = static_cast<std::size_t>(stars.neighbour[j]) - 1;
      if (other < i) continue;
      middles.push_back(normalized(plus(generators[i], generators[other])));
      const Point d = minus(generators[i], generators[other]);
      length.push_back(dot(d, d));
    }
  const std::vector<double> values = values_at(middles, density);
  for (std::size_t k = 0; k < length.size(); ++k) length[k] *= std::sqrt(values[k]);
  std::vector<std::size_t> order(middles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return length[a] > length[b]; });
  for (std::size_t k = 0; points.size() < n && k < order.size(); ++k) points.push_back(middles[order[k]]);
  return along_a_curve(points);
}

}  // namespace pstripack::scvt
