#include "scvt/first_generators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "base/splitmix64.h"
#include "parallel/local_nodes.h"
#include "scvt/caller_agreement.h"
#include "scvt/errors.h"
#include "scvt/vectors.h"

namespace pstripack::scvt {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014), which can start at any place of its sequence.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t numbers_before) : state_(seed + numbers_before * kStep) {}
  /// In [0,1).
  double uniform() { return static_cast<double>(splitmix64(state_ += kStep) >> 11) * 0x1p-53; }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;
  std::uint64_t state_;
};

/// A spherical triangle, so small that its area is about that of the plane triangle.
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

/// A random point that was accepted, and its number among the candidates.
struct Drawn {
  std::size_t candidate;
  Point point;
};

/// Draws points distributed as the square root of a density, by rejection sampling. A patch is chosen with
/// a probability proportional to its area times the root of the largest density sampled in it; a random
/// point of the patch is then accepted in proportion to the root of its density. At peaks that the samples
/// miss there are too few points, which is good enough for first generators.
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

  /// Those of the candidates first..last-1 that are accepted.
  std::vector<Drawn> draw(std::size_t first, std::size_t last, std::uint64_t seed) const {
    constexpr std::uint64_t kNumbers = 4;  // random numbers per candidate
    std::vector<Point> points;
    std::vector<double> chances;
    Random random(seed, kNumbers * first);
    for (std::size_t k = first; k < last; ++k) {
      const auto place = std::upper_bound(until_.begin(), until_.end(), random.uniform() * until_.back());
      const auto i = std::min(static_cast<std::size_t>(place - until_.begin()), patches_.size() - 1);
      double u = random.uniform(), v = random.uniform();
      chances.push_back(random.uniform() * most_[i]);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const auto& c = patches_[i].corner;
      points.push_back(normalized(plus(scaled(1 - u - v, c[0]), plus(scaled(u, c[1]), scaled(v, c[2])))));
    }
    const std::vector<double> values = values_at(points, density_);
    std::vector<Drawn> taken;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (chances[k] <= std::sqrt(values[k])) taken.push_back({first + k, points[k]});
    return taken;
  }

 private:
  const Density& density_;
  const std::vector<OctahedronPart> patches_;
  std::vector<double> most_, until_;
};

/// The first n accepted candidates of all ranks, from `candidate` on; `candidate` becomes the next unused
/// one. Collective.
Spread draw(Communicator& ranks, const Sampler& sampler, std::size_t n, std::uint64_t seed,
            std::size_t& candidate) {
  const auto size = static_cast<std::size_t>(ranks.size()), me = static_cast<std::size_t>(ranks.rank());
  const auto wanted = static_cast<std::int64_t>(n);
  std::vector<Point> points;
  std::int64_t found = 0;
  while (found < wanted) {
    std::vector<Drawn> taken;
    in_agreement_with_caller(ranks, [&] {
      taken =
          sampler.draw(candidate + slice_begin(n, me, size), candidate + slice_begin(n, me + 1, size), seed);
    });
    const std::int64_t before = found + sum_before(ranks, taken.size());
    found += sum_of_all(ranks, taken.size());
    Smallest next;
    in_agreement(
        ranks,
        [&] {
          const std::int64_t left = std::max(wanted - before, std::int64_t{0});
          const std::size_t count = std::min(taken.size(), static_cast<std::size_t>(left));
          for (std::size_t k = 0; k < count; ++k) points.push_back(taken[k].point);
          if (count > 0 && before + static_cast<std::int64_t>(count) == wanted)
            next.value = static_cast<std::int64_t>(taken[count - 1].candidate) + 1;
        },
        next);
    candidate = next.exists() ? static_cast<std::size_t>(next.value) : candidate + n;
  }
  return along_a_curve(ranks, points);
}

bool surround_the_sphere(Evaluator& evaluator, const Spread& generators) {
  evaluator.begin_with(generators.numbers);
  try {
    evaluator.triangulate(generators.points);
    return true;
  } catch (const GeneratorsInHemisphere&) {
    return false;
  } catch (const CoincidentGenerators&) {
    return false;
  }
}

struct Middle {
  std::uint64_t key;      ///< the smaller, the longer the arc in units of the local width of a cell
  std::int64_t from, to;  ///< numbers
  Point point;
};

/// A number below 2^63 that decreases with `length`.
std::uint64_t key_of(double length) {
  std::uint64_t bits = 0;  // for positive numbers, in the same order as the numbers
  std::memcpy(&bits, &length, sizeof bits);
  return (std::uint64_t{1} << 63) - 1 - bits;
}

/// The midpoints of the arcs to neighbours with larger numbers, that of the longest arc first.
std::vector<Middle> middles_of(const Neighbourhood& generators, const Density& density) {
  const NeighbourLists& stars = generators.stars;
  std::vector<Middle> middles;
  std::vector<Point> places;
  std::vector<double> squares;
  for (std::size_t i = 0; i < stars.count; ++i)
    for (std::size_t s = stars.begin_of(i); s < stars.end_of(i); ++s) {
      const auto j = static_cast<std::size_t>(stars.neighbour[s]) - 1;
      if (generators.numbers[j] < generators.numbers[i]) continue;
      places.push_back(normalized(plus(generators.points[i], generators.points[j])));
      const Point d = minus(generators.points[i], generators.points[j]);
      squares.push_back(dot(d, d));
      middles.push_back({0, generators.numbers[i], generators.numbers[j], places.back()});
    }
  const std::vector<double> values = values_at(places, density);
  for (std::size_t k = 0; k < middles.size(); ++k) middles[k].key = key_of(squares[k] * std::sqrt(values[k]));
  std::sort(middles.begin(), middles.end(), [](const Middle& a, const Middle& b) {
    return std::tie(a.key, a.from, a.to) < std::tie(b.key, b.from, b.to);
  });
  return middles;
}

}  // namespace

Spread random_generators(Evaluator& evaluator, std::size_t n, std::uint64_t seed) {
  if (n < 4) throw BadGenerators("a tessellation needs at least 4 generators, here are " + std::to_string(n));
  // Seven in eight sets of four random points lie in a hemisphere. So do nearly all sets of few points if
  // most of the density lies in one. After kTrials such sets the points are drawn uniformly.
  constexpr int kTrials = 20;
  const ConstantDensity uniform;
  std::size_t candidate = 0;
  for (const Density* of : {&evaluator.density(), static_cast<const Density*>(&uniform)}) {
    std::optional<Sampler> sampler;
    in_agreement_with_caller(evaluator.ranks(), [&] { sampler.emplace(*of); });
    for (int trial = 0; trial < kTrials || of == &uniform; ++trial) {
      Spread points = draw(evaluator.ranks(), *sampler, n, seed, candidate);
      if (surround_the_sphere(evaluator, points)) return points;
    }
  }
  return {};  // never reached
}

std::vector<Point> random_generators(std::size_t n, const Density& density, std::uint64_t seed) {
  LocalEvaluator evaluator(density);
  return random_generators(evaluator, n, seed).points;
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

Spread refined(Communicator& ranks, const Neighbourhood& generators, const Density& density, std::size_t n) {
  constexpr std::uint64_t kNobody = std::uint64_t{1} << 62;  // above all numbers
  std::vector<Middle> middles;
  in_agreement_with_caller(ranks, [&] { middles = middles_of(generators, density); });
  // Take the first `wanted` midpoints of all ranks in the order of (key, from): all with a smaller key than
  // the bound; of those with the bound's key, all with a smaller `from`; the rest has one `from`, so is on
  // one rank.
  const std::int64_t wanted = static_cast<std::int64_t>(n) - sum_of_all(ranks, generators.stars.count);
  const auto before = [&](std::uint64_t key, std::int64_t from) {
    return static_cast<std::size_t>(std::lower_bound(middles.begin(), middles.end(), std::pair(key, from),
                                                     [](const Middle& m, const auto& bound) {
                                                       return std::tie(m.key, m.from) <
                                                              std::tie(bound.first, bound.second);
                                                     }) -
                                    middles.begin());
  };
  const std::uint64_t key = bounds(ranks, {wanted}, [&](std::uint64_t k) { return before(k, 0); })[0];
  const auto from = static_cast<std::int64_t>(std::min(kNobody, bounds(ranks, {wanted}, [&](std::uint64_t f) {
                                                         return before(key, static_cast<std::int64_t>(f));
                                                       })[0]));
  const std::size_t whole = before(key, from);
  const std::int64_t left = wanted - sum_of_all(ranks, whole);
  const std::size_t taken = std::min(whole + static_cast<std::size_t>(left), before(key, from + 1));
  std::vector<Point> points;
  in_agreement(ranks, [&] {
    points.assign(generators.points, generators.points + generators.stars.count);
    for (std::size_t k = 0; k < taken; ++k) points.push_back(middles[k].point);
  });
  return along_a_curve(ranks, points);
}

}  // namespace pstripack::scvt
