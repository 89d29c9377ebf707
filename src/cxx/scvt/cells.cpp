// Quadrature.
//
// A cell is integrated in the plane that touches the sphere at its generator g, with coordinates x, y along
// two axes e1, e2 at right angles to g and to each other. The place x, y is seen from the centre in the
// direction p = (g + x e1 + y e2)/sqrt(1+s), s = x^2 + y^2, and dxdy in the plane is dxdy/(1+s)^(3/2) on the
// sphere. Great circles are straight lines there: a cell is a convex polygon around 0. With u = neighbour - g
// the points as far from the neighbour as from g are x u.e1 + y u.e2 = u.u/2, so a corner, the circumcentre
// of g and two neighbours, solves two linear equations: no square root, no cancellation.
//
// A triangle of 0 and two consecutive corners P, Q has the points r (P + t (Q-P)), 0 < r < 1, 0 < t < 1, and
// dxdy = det(P,Q) r dr dt. On a ray (t fixed) with z = r^2 s(t) the three integrands are
//     mass      density (1+z)^(-3/2)                       = density (1 - 3/2 z + 15/8 z^2 - ...)
//     energy    density 2 ((1+z)^(-3/2) - (1+z)^(-2))      = density (z - 9/4 z^2 + 29/8 z^3 - ...)
//     pull      density (x,y) (1+z)^(-2)                   = density (x,y) (1 - 2 z + 3 z^2 - ...)
// Power series in z times a polynomial in r: integrated over r term by term. Over t: three points of Gauss,
// exact up to degree 5. In a cell with s <= kSmall at all corners the first neglected terms are below 2e-12
// of the leading ones.
//
// The density is taken as a polynomial of degree 2 in each triangle, from its values at 0, P, Q and the
// midpoints of the three sides: on a ray density = a + b(t) r + c(t) r^2. Its products with the weights above
// are integrated as well as those of a constant density.
//
// Larger cells, and those where the density differs by more than kRough, are cut into small spherical
// triangles, each with a rule of seven points (Radon 1948): positive weights, so that mass and energy are
// positive whatever the density is.

#include "scvt/cells.h"

#include <algorithm>
#include <cmath>

#include "base/parallel_for.h"
#include "scvt/errors.h"

namespace pstripack::scvt {
namespace {

constexpr double kSmall = 0.004;
constexpr double kRough = 4;  ///< largest density in a cell over the smallest

Point scaled(double f, const Point& p) { return {f * p.x, f * p.y, f * p.z}; }
Point plus(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point normalized(const Point& p) { return scaled(1 / std::sqrt(dot(p, p)), p); }

bool is_good(double density) { return density > 0 && std::isfinite(density); }

/// Two axes at right angles to the unit vector g and to each other (Duff et al. 2017).
struct Axes {
  explicit Axes(const Point& g) {
    const double sign = std::copysign(1.0, g.z), a = -1 / (sign + g.z), b = g.x * g.y * a;
    e1 = {1 + sign * g.x * g.x * a, sign * b, -sign * g.x};
    e2 = {b, sign + g.y * g.y * a, -g.y};
  }
  Point e1, e2;
};

struct Sums {
  double mass = 0, energy = 0;
  Point pull{0, 0, 0};  ///< integral of density times p-g, not yet at right angles to g
};

// ---- cells that are large, or rough
// ------------------------------------------------------------------------

class LargeCell {
 public:
  explicit LargeCell(const Density& density) : density_(density) {}

  /// The cell of g between the neighbours of points[] in ring[0..count-1].
  Sums integrate(const Point* points, const Point& g, const std::int32_t* ring, std::size_t count) {
    const auto spoke = [&](std::size_t k) { return minus(points[static_cast<std::size_t>(ring[k]) - 1], g); };
    points_.clear();
    weights_.clear();
    Point before = spoke(count - 1), first{0, 0, 0}, last{0, 0, 0};
    for (std::size_t k = 0; k < count; ++k) {
      const Point next = spoke(k), corner = normalized(cross(before, next));
      if (k == 0)
        first = corner;
      else
        cut(g, last, corner, kMostCuts);
      last = corner;
      before = next;
    }
    cut(g, last, first, kMostCuts);

    values_.resize(points_.size());
    density_.at(points_.size(), points_.data(), values_.data());
    Sums sums;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!is_good(values_[i])) throw BadDensity(points_[i], values_[i]);
      const Point d = minus(points_[i], g);
      const double mass = weights_[i] * values_[i];
      sums.mass += mass;
      sums.energy += mass * dot(d, d);
      sums.pull = plus(sums.pull, scaled(mass, d));
    }
    return sums;
  }

 private:
  static constexpr int kMostCuts = 8;
  static constexpr double kLongest = 0.05;  ///< side of a triangle that is not cut

  void cut(const Point& a, const Point& b, const Point& c, int cuts) {
    const Point ab = minus(b, a), bc = minus(c, b), ca = minus(a, c);
    if (cuts == 0 || std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)}) <= kLongest * kLongest) {
      add(a, b, c);
      return;
    }
    const Point p = normalized(plus(a, b)), q = normalized(plus(b, c)), r = normalized(plus(c, a));
    cut(a, p, r, cuts - 1);
    cut(p, b, q, cuts - 1);
    cut(r, q, c, cuts - 1);
    cut(p, q, r, cuts - 1);
  }

  /// With the points q of the plane triangle the integral over the spherical one is det(a,b,c)/2 times the
  /// mean of the integrand at q/|q| over |q|^3.
  void add(const Point& a, const Point& b, const Point& c) {
    // (6 -+ sqrt(15))/21 and weights (155 -+ sqrt(15))/1200.
    constexpr double kNear = 0.10128650732345634, kFar = 0.47014206410511509;
    constexpr double kWeight[3] = {0.225, 0.12593918054482715, 0.13239415278850618};
    const double half = dot(a, cross(minus(b, a), minus(c, a))) / 2;
    const auto put = [&](double u, double v, double w, double weight) {
      const Point q = plus(plus(scaled(u, a), scaled(v, b)), scaled(w, c));
      const double square = dot(q, q), length = std::sqrt(square);
      points_.push_back(scaled(1 / length, q));
      weights_.push_back(half * weight / (square * length));
    };
    put(1.0 / 3, 1.0 / 3, 1.0 / 3, kWeight[0]);
    for (const auto& [s, weight] : {std::pair(kNear, kWeight[1]), std::pair(kFar, kWeight[2])}) {
      put(1 - 2 * s, s, s, weight);
      put(s, 1 - 2 * s, s, weight);
      put(s, s, 1 - 2 * s, weight);
    }
  }

  const Density& density_;
  std::vector<Point> points_;
  std::vector<double> weights_, values_;
};

// ---- small cells, many at a time
// ---------------------------------------------------------------------------

/// Some consecutive cells. Cell i has the entries begin(i)..begin(i)+d+1 of the arrays for its d neighbours,
/// of which the last two are its first once more: entry k+1 is then always the next corner, and loops over
/// entries need no branch.
class Block {
 public:
  Block(const Point* points, const Stars& stars, const Density& density, Cells& cells)
      : points_(points), stars_(stars), density_(density), cells_(cells), large_(density) {
    if (density.is_constant()) {
      constant_ = density.at({1, 0, 0});
      if (!is_good(constant_)) throw BadDensity({1, 0, 0}, constant_);
    }
  }

  void integrate(std::size_t first, std::size_t last) {
    find_corners(first, last);
    if (density_.is_constant())
      integrate_constant();
    else
      integrate_varying(first, last);
    std::size_t k = 0;
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t count = stars_.end_of(i) - stars_.begin_of(i);
      const Point& g = points_[i];
      double mass = 0, energy = 0, x = 0, y = 0;
      for (std::size_t j = k; j < k + count; ++j) {
        mass += mass_[j];
        energy += energy_[j];
        x += pull_x_[j];
        y += pull_y_[j];
      }
      if (is_small(k, count) && is_smooth_[i - first]) {
        const Axes axes(g);
        cells_.mass[i] = mass;
        cells_.energy[i] = energy;
        cells_.pull[i] = plus(scaled(x, axes.e1), scaled(y, axes.e2));
      } else {
        const Sums sums = large_.integrate(points_, g, stars_.neighbour + stars_.begin_of(i), count);
        cells_.mass[i] = sums.mass;
        cells_.energy[i] = sums.energy;
        cells_.pull[i] = minus(sums.pull, scaled(dot(sums.pull, g), g));
      }
      k += count + 2;
    }
  }

 private:
  void resize(std::size_t entries) {
    entries_ = entries;
    for (auto* v : {&u_, &v_, &half_, &x_, &y_, &s_, &mass_, &energy_, &pull_x_, &pull_y_})
      if (v->size() < entries) v->resize(entries);
  }

  /// Corner k lies between the neighbours k and k+1.
  void find_corners(std::size_t first, std::size_t last) {
    resize(stars_.end_of(last - 1) - stars_.begin_of(first) + 2 * (last - first));
    is_smooth_.assign(last - first, true);
    std::size_t k = 0;
    for (std::size_t i = first; i < last; ++i) {
      const Point& g = points_[i];
      const Axes axes(g);
      const std::size_t begin = k;
      for (std::size_t j = stars_.begin_of(i); j < stars_.end_of(i); ++j, ++k) {
        const Point d = minus(points_[static_cast<std::size_t>(stars_.neighbour[j]) - 1], g);
        u_[k] = dot(d, axes.e1);
        v_[k] = dot(d, axes.e2);
        half_[k] = dot(d, d) / 2;
      }
      for (std::size_t j = begin; j < begin + 2; ++j, ++k) u_[k] = u_[j], v_[k] = v_[j], half_[k] = half_[j];
    }
    for (std::size_t j = 0; j + 1 < entries_; ++j) {
      const double det = u_[j] * v_[j + 1] - v_[j] * u_[j + 1], inverse = 1 / det;
      x_[j] = (half_[j] * v_[j + 1] - v_[j] * half_[j + 1]) * inverse;
      y_[j] = (u_[j] * half_[j + 1] - half_[j] * u_[j + 1]) * inverse;
      // Where det is not positive the corner is not in front of the plane's centre: a large cell.
      s_[j] = det > 0 ? x_[j] * x_[j] + y_[j] * y_[j] : 1;
    }
  }

  bool is_small(std::size_t k, std::size_t count) const {
    double most = 0;
    for (std::size_t j = k; j < k + count; ++j) most = s_[j] > most ? s_[j] : most;
    return most <= kSmall;
  }

  /// Weights of Gauss's points t = 1/2 - sqrt(15)/10, 1/2, 1/2 + sqrt(15)/10.
  static constexpr double kGauss[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
  static constexpr double kWeight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

  /// Triangle k has the corners k and k+1.
  void integrate_constant() {
    for (std::size_t k = 0; k + 2 < entries_; ++k) {
      const double dx = x_[k + 1] - x_[k], dy = y_[k + 1] - y_[k];
      const double det = constant_ * (x_[k] * dy - y_[k] * dx);
      double mass = 0, energy = 0, pull_x = 0, pull_y = 0;
      for (int i = 0; i < 3; ++i) {
        const double x = x_[k] + kGauss[i] * dx, y = y_[k] + kGauss[i] * dy, s = x * x + y * y;
        const double w = kWeight[i] * det;
        mass += w * (1.0 / 2 + s * (-3.0 / 8 + s * (5.0 / 16 + s * (-35.0 / 128 + s * (63.0 / 256)))));
        energy +=
            w * (s * (1.0 / 4 + s * (-3.0 / 8 + s * (29.0 / 64 + s * (-65.0 / 128 + s * (281.0 / 512))))));
        const double p = w * (1.0 / 3 + s * (-2.0 / 5 + s * (3.0 / 7 + s * (-4.0 / 9 + s * (5.0 / 11)))));
        pull_x += p * x;
        pull_y += p * y;
      }
      mass_[k] = mass;
      energy_[k] = energy;
      pull_x_[k] = pull_x;
      pull_y_[k] = pull_y;
    }
  }

  /// Samples: for each cell its generator, and for each entry k its corner, the middle between the generator
  /// and the corner, and the middle between this corner and the next.
  void integrate_varying(std::size_t first, std::size_t last) {
    samples_.resize(last - first + 3 * entries_);
    values_.resize(samples_.size());
    std::size_t k = 0, count = 0;
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t degree = stars_.end_of(i) - stars_.begin_of(i);
      if (is_small(k, degree)) {
        const Point& g = points_[i];
        const Axes axes(g);
        const auto sample = [&](double x, double y) {
          const Point q = plus(g, plus(scaled(x, axes.e1), scaled(y, axes.e2)));
          samples_[count++] = scaled(1 / std::sqrt(1 + x * x + y * y), q);
        };
        samples_[count++] = g;
        for (std::size_t j = k; j < k + degree; ++j) {
          sample(x_[j], y_[j]);
          sample(x_[j] / 2, y_[j] / 2);
          sample((x_[j] + x_[j + 1]) / 2, (y_[j] + y_[j + 1]) / 2);
        }
      }
      k += degree + 2;
    }
    density_.at(count, samples_.data(), values_.data());
    for (std::size_t i = 0; i < count; ++i)
      if (!is_good(values_[i])) throw BadDensity(samples_[i], values_[i]);

    const double* value = values_.data();
    k = 0;
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t degree = stars_.end_of(i) - stars_.begin_of(i);
      if (is_small(k, degree)) {
        const double* const end = value + 1 + 3 * degree;
        const auto [least, most] = std::minmax_element(value, end);
        is_smooth_[i - first] = *most <= kRough * *least;
        const double centre = *value++;
        for (std::size_t j = 0; j < degree; ++j) {
          const double* const here = value + 3 * j;
          const double* const next = value + 3 * (j + 1 < degree ? j + 1 : 0);
          integrate_triangle(k + j, centre, here, next);
        }
        value = end;
      }
      k += degree + 2;
    }
  }

  /// here, next: the density at a corner and midway to it; here[2]: midway between the corners.
  void integrate_triangle(std::size_t k, double centre, const double* here, const double* next) {
    const double dx = x_[k + 1] - x_[k], dy = y_[k + 1] - y_[k];
    const double det = x_[k] * dy - y_[k] * dx;
    double mass = 0, energy = 0, pull_x = 0, pull_y = 0;
    for (int i = 0; i < 3; ++i) {
      const double t = kGauss[i], x = x_[k] + t * dx, y = y_[k] + t * dy, s = x * x + y * y,
                   w = kWeight[i] * det;
      // The polynomial of degree 2 with these values, on the ray: a + b r + c r^2.
      const double a = centre;
      const double b =
          (1 - t) * (4 * here[1] - here[0] - 3 * centre) + t * (4 * next[1] - next[0] - 3 * centre);
      const double c = 2 * centre + 2 * (1 - t) * (1 - t) * here[0] + 2 * t * t * next[0] -
                       4 * (1 - t) * here[1] - 4 * t * next[1] + 4 * t * (1 - t) * here[2];
      const auto mean = [&](int power) { return a / power + b / (power + 1) + c / (power + 2); };
      mass +=
          w * (mean(2) +
               s * (-3.0 / 2 * mean(4) +
                    s * (15.0 / 8 * mean(6) + s * (-35.0 / 16 * mean(8) + s * (315.0 / 128 * mean(10))))));
      energy +=
          w * s *
          (mean(4) +
           s * (-9.0 / 4 * mean(6) +
                s * (29.0 / 8 * mean(8) + s * (-325.0 / 64 * mean(10) + s * (843.0 / 128 * mean(12))))));
      const double p =
          w * (mean(3) + s * (-2 * mean(5) + s * (3 * mean(7) + s * (-4 * mean(9) + s * (5 * mean(11))))));
      pull_x += p * x;
      pull_y += p * y;
    }
    mass_[k] = mass;
    energy_[k] = energy;
    pull_x_[k] = pull_x;
    pull_y_[k] = pull_y;
  }

  const Point* const points_;
  const Stars& stars_;
  const Density& density_;
  Cells& cells_;
  LargeCell large_;
  double constant_ = 0;
  std::size_t entries_ = 0;
  std::vector<double> u_, v_,
      half_;  ///< neighbours: their components along the axes, half their distance squared
  std::vector<double> x_, y_, s_;                        ///< corners
  std::vector<double> mass_, energy_, pull_x_, pull_y_;  ///< triangles
  std::vector<Point> samples_;
  std::vector<double> values_;
  std::vector<char> is_smooth_;  ///< of each cell
};

}  // namespace

Point centroid(const Cells& cells, std::size_t i, const Point& g) {
  return normalized(plus(cells.pull[i], scaled(cells.mass[i] - cells.energy[i] / 2, g)));
}

void integrate(const Point* points, const Stars& stars, const Density& density, Cells& cells) {
  constexpr std::size_t kCells = 64;  // their arrays fit the first cache
  cells.resize(stars.count);
  const int threads = density.is_serial() ? 1 : threads_for(10 * stars.count);
  ErrorsOfThreads errors(static_cast<std::size_t>(threads));
  parallel_pieces(stars.count, threads, [&](std::size_t first, std::size_t last, int piece) {
    errors.keep(static_cast<std::size_t>(piece), [&] {
      Block block(points, stars, density, cells);
      for (std::size_t i = first; i < last; i += kCells) block.integrate(i, std::min(i + kCells, last));
    });
  });
  errors.rethrow();
}

}  // namespace pstripack::scvt
