// Quadrature.
//
// A cell is integrated in the tangent plane at its generator g, with coordinates x, y along two axes e1, e2
// perpendicular to g and to each other. The point x, y of the plane is projected from the centre to
// p = (g + x e1 + y e2)/sqrt(1+s), s = x^2 + y^2, and dxdy in the plane is dxdy/(1+s)^(3/2) on the sphere.
// Great circles are straight lines in the plane: a cell is a convex polygon around 0. With u = neighbour - g
// the points equidistant from the neighbour and g are x u.e1 + y u.e2 = u.u/2 = 1 - neighbour.g. So a corner,
// the circumcentre of g and two neighbours, solves two linear equations: no square root, no cancellation.
//
// Cells are those of the directions of the generators. Unit vectors are rounded, also in length, by some
// r = 2^-53. That changes u.e1 and u.e2 by r |u|, however small |u| is, but u.u by r^2. So below |u| = 1e-8
// u.u is taken from u.e1 and u.e2, for which 1 - neighbour.g = u.u/2 is then exact to 1e-16. Two neighbours
// that are nearly in line with g make a large angle where they are: there their corner is found, if they are
// near each other. So corners are right to some r of their distance from g, over the sine of the larger of
// the two angles, at every scale; and integrals to the errors below and some r times the cell's length over
// its width.
//
// A triangle of 0 and two consecutive corners P, Q has the points r (P + t (Q-P)), 0 < r < 1, 0 < t < 1,
// and dxdy = det(P,Q) r dr dt. On a ray (t fixed) with z = r^2 s(t) the three integrands are
//     mass      density (1+z)^(-3/2)                       = density (1 - 3/2 z + 15/8 z^2 - ...)
//     energy    density 2 ((1+z)^(-3/2) - (1+z)^(-2))      = density (z - 9/4 z^2 + 29/8 z^3 - ...)
//     pull      density (x,y) (1+z)^(-2)                   = density (x,y) (1 - 2 z + 3 z^2 - ...)
// These are power series in z times a polynomial in r, integrated over r term by term. Over t the rule is
// Gauss's with three points, exact for z^2. In a cell with s <= kSmall at all corners the error is below
// 5e-8, that of the energy below 5e-7 in a round cell and 1.5e-5 in a long one (found by trial), and falls
// with s^2. If the density is constant and s <= kTiny, three terms are enough: the next are below 2e-7, and
// fall with s^3; the integrals over t then have closed forms.
//
// The density is interpolated by a polynomial of degree 2 in each triangle, from its values at 0, P, Q and
// the midpoints of the three sides: on a ray density = a + b(t) r + c(t) r^2. Its products with the weights
// above are integrated as accurately as those of a constant density.
//
// Where s <= kFine and the density varies by less than a factor of kSmooth, as in most cells of a fine mesh,
// its values at 0 and at the corners are enough, a third of the values. A polynomial of degree 2 is fitted to
// them; what is left at the corners is interpolated along the sides and grows with r^2. Then two terms of the
// series are enough.
//
// Larger cells, and cells in which the density varies by more than a factor of kRough, are cut into small
// spherical triangles, each with a rule of seven points (Radon 1948). Its weights are positive, so mass and
// energy are positive for any density. Points are kept as their difference to g, in the axes e1, e2, g: so
// nothing is lost in a rough cell that is small.

#include "scvt/cells.h"

#include <algorithm>
#include <array>

#include "base/parallel_for.h"
#include "scvt/vectors.h"

namespace pstripack::scvt {
namespace {

constexpr double kFine = 3e-4, kTiny = 4e-3, kSmall = 0.02;  ///< s of the farthest corner
constexpr double kRough = 4;                                 ///< largest density in a cell over the smallest
constexpr double kSmooth = 1.25;                             ///< the same
constexpr double kClose = 1e-16;  ///< u.u of neighbours where the rounding of lengths matters
constexpr double kFlat = 1e-16;   ///< squared sine of an angle too small to find its corner from

/// Two axes perpendicular to the unit vector g and to each other (Duff et al. 2017).
struct Axes {
  Axes() = default;
  explicit Axes(const Point& g) {
    const double sign = std::copysign(1.0, g.z), a = -1 / (sign + g.z), b = g.x * g.y * a;
    e1 = {1 + sign * g.x * g.x * a, sign * b, -sign * g.x};
    e2 = {b, sign + g.y * g.y * a, -g.y};
  }
  Point e1, e2;
};

/// A neighbour as seen from g: the components of its difference to g along the axes, and minus that along g.
struct Spoke {
  Spoke(const Point& neighbour, const Point& g, const Axes& axes) {
    const Point d = minus(neighbour, g);
    u = dot(d, axes.e1);
    v = dot(d, axes.e2);
    const double square = dot(d, d);
    half = square / 2;
    if (__builtin_expect(square < kClose, false)) half = (u * u + v * v) / 2;
  }
  double u, v, half;
};

struct Sums {
  double mass = 0, energy = 0, pull_x = 0, pull_y = 0;
};

// ---- large or rough cells -----------------------------------------------------------------------------

class LargeCell {
 public:
  explicit LargeCell(const ScaledDensity& density) : density_(density) {}

  /// Integrates the cell of g. ring[0..count-1] are its neighbours, as indices from 1 into points[].
  Sums integrate(const Point* points, const Point& g, const Axes& axes, const std::int32_t* ring,
                 std::size_t count) {
    const auto neighbour = [&](std::size_t k) { return points[static_cast<std::size_t>(ring[k]) - 1]; };
    offsets_.clear();
    weights_.clear();
    Point before = neighbour(count - 1), first{0, 0, 0}, last{0, 0, 0};
    for (std::size_t k = 0; k < count; ++k) {
      const Point next = neighbour(k), corner = corner_of(g, axes, before, next);
      if (k == 0)
        first = corner;
      else
        add_side(last, corner, Spoke(before, g, axes));
      last = corner;
      before = next;
    }
    add_side(last, first, Spoke(before, g, axes));

    places_.clear();
    for (const Point& d : offsets_) places_.push_back(plus(g, in_space(d, g, axes)));
    values_.resize(places_.size());
    density_.at(places_.size(), places_.data(), values_.data());
    Sums sums;
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      const Point& d = offsets_[i];
      const double mass = weights_[i] * values_[i];
      sums.mass += mass;
      sums.energy += mass * dot(d, d);
      sums.pull_x += mass * d.x;
      sums.pull_y += mass * d.y;
    }
    return sums;
  }

 private:
  static constexpr int kMostCuts = 8;
  static constexpr double kLongest = 0.1;  ///< triangles with a longer side are cut

  // Points of the sphere are their differences to g, in the axes e1, e2, g.

  static Point in_space(const Point& d, const Point& g, const Axes& axes) {
    return plus(plus(scaled(d.x, axes.e1), scaled(d.y, axes.e2)), scaled(d.z, g));
  }

  /// The corner of g's cell between two consecutive neighbours, which is equally far from all three.
  static Point corner_of(const Point& g, const Axes& axes, const Point& before, const Point& next) {
    constexpr double kNeedle = 1e-6;  // square of the ratio of two sides
    const Spoke to_before(before, g, axes), to_next(next, g, axes);
    const Point side = minus(next, before);
    if (!(dot(side, side) < kNeedle * std::min(to_before.half, to_next.half)))
      return between(to_before, to_next);
    const Axes there(before);
    const Point d = in_space(between(Spoke(next, before, there), Spoke(g, before, there)), before, there);
    return {to_before.u + dot(d, axes.e1), to_before.v + dot(d, axes.e2), dot(d, g) - to_before.half};
  }

  /// The same in homogeneous coordinates, which has a sign beyond the hemisphere, too.
  static Point between(Spoke a, Spoke b) {
    for (Spoke* const s : {&a, &b}) {  // so that no product underflows
      const double size = std::max({std::fabs(s->u), std::fabs(s->v), s->half});
      s->u /= size, s->v /= size, s->half /= size;
    }
    const double x = a.half * b.v - a.v * b.half, y = a.u * b.half - a.half * b.u, w = a.u * b.v - a.v * b.u;
    const double square = x * x + y * y, r = std::sqrt(square + w * w);
    return {x / r, y / r, w > 0 ? -square / (r * (r + w)) : w / r - 1};
  }

  /// The triangle of g and the side from a to b, which the cell shares with the cell of `neighbour`.
  void add_side(const Point& a, const Point& b, const Spoke& neighbour) {
    const Point g{0, 0, 0};
    if (a.x * b.x + a.y * b.y + (1 + a.z) * (1 + b.z) > -0.9) {
      cut(g, a, b, kMostCuts);
      return;
    }
    // Nearly a half turn: a and b do not tell where the side is.
    const Point m = middle(g, {neighbour.u, neighbour.v, -neighbour.half});
    cut(g, a, m, kMostCuts);
    cut(g, m, b, kMostCuts);
  }

  static Point middle(const Point& a, const Point& b) {
    const Point m = scaled(0.5, plus(a, b)), d = minus(a, b);
    const double length = std::sqrt(m.x * m.x + m.y * m.y + (1 + m.z) * (1 + m.z));
    return {m.x / length, m.y / length, (m.z + dot(d, d) / (4 * (1 + length))) / length};
  }

  void cut(const Point& a, const Point& b, const Point& c, int cuts) {
    const Point ab = minus(b, a), bc = minus(c, b), ca = minus(a, c);
    if (cuts == 0 || std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)}) <= kLongest * kLongest) {
      add(a, b, c);
      return;
    }
    const Point p = middle(a, b), q = middle(b, c), r = middle(c, a);
    cut(a, p, r, cuts - 1);
    cut(p, b, q, cuts - 1);
    cut(r, q, c, cuts - 1);
    cut(p, q, r, cuts - 1);
  }

  /// The integral over the spherical triangle is det(a,b,c)/2 times the mean, over the points q of the plane
  /// triangle, of the integrand at q/|q| divided by |q|^3.
  void add(const Point& a, const Point& b, const Point& c) {
    // (6 -+ sqrt(15))/21 and weights (155 -+ sqrt(15))/1200.
    constexpr double kNear = 0.10128650732345634, kFar = 0.47014206410511509;
    constexpr double kWeight[3] = {0.225, 0.12593918054482715, 0.13239415278850618};
    const double half = dot({a.x, a.y, 1 + a.z}, cross(minus(b, a), minus(c, a))) / 2;
    const auto put = [&](double u, double v, double w, double weight) {
      const Point q = plus(plus(scaled(u, a), scaled(v, b)), scaled(w, c));
      const double more = 2 * q.z + dot(q, q), length = std::sqrt(1 + more);
      offsets_.push_back({q.x / length, q.y / length, (q.z - more / (1 + length)) / length});
      weights_.push_back(half * weight / ((1 + more) * length));
    };
    put(1.0 / 3, 1.0 / 3, 1.0 / 3, kWeight[0]);
    for (const auto& [s, weight] : {std::pair(kNear, kWeight[1]), std::pair(kFar, kWeight[2])}) {
      put(1 - 2 * s, s, s, weight);
      put(s, 1 - 2 * s, s, weight);
      put(s, s, 1 - 2 * s, weight);
    }
  }

  const ScaledDensity& density_;
  std::vector<Point> offsets_, places_;
  std::vector<double> weights_, values_;
};

// ---- small cells, many at a time ----------------------------------------------------------------------

/// Arrays over the entries of several cells. A cell has an entry for each neighbour, and its first entry
/// once more at the end: so entry k+1 always follows entry k, and loops over entries have no branches.
struct Entries {
  std::size_t count = 0;
  std::vector<double> u, v, half;  ///< neighbour: its components along the axes, half its distance squared
  std::vector<double> x, y, s;     ///< corner between neighbours k and k+1
  std::vector<double> mass, energy, pull_x, pull_y;  ///< triangle between corners k and k+1
  std::vector<double> density;                       ///< at the corner, if it is not constant
  /// Of a smooth cell: density = centre + linear r + (rest + xx x^2 + xy x y + yy y^2) r^2 on the ray to the
  /// corner.
  std::vector<double> centre, linear, rest, xx, xy, yy;

  void resize(std::size_t n) {
    count = n;
    if (u.size() >= n) return;
    for (auto* array : {&u, &v, &half, &x, &y, &s, &mass, &energy, &pull_x, &pull_y, &density, &centre,
                        &linear, &rest, &xx, &xy, &yy})
      array->resize(n);
  }
};

/// Gauss's points 1/2 -+ sqrt(15)/10, 1/2.
constexpr double kGaussPoint[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
constexpr double kGaussWeight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

/// Computes all corners; the one after the last corner of each cell is meaningless.
void find_corners(Entries& e) {
  const double *const u = e.u.data(), *const v = e.v.data(), *const half = e.half.data();
  double *const x = e.x.data(), *const y = e.y.data(), *const s = e.s.data();
#ifndef __clang__
#pragma GCC ivdep  // the arrays do not overlap; Clang tests that itself
#endif
  for (std::size_t k = 0; k + 1 < e.count; ++k) {
    const double det = u[k] * v[k + 1] - v[k] * u[k + 1], inverse = 1 / det;
    const bool is_flat = det * det < 4 * kFlat * (half[k] * half[k + 1]);
    x[k] = (half[k] * v[k + 1] - v[k] * half[k + 1]) * inverse;
    y[k] = (u[k] * half[k + 1] - half[k] * u[k + 1]) * inverse;
    // < 0 or NaN: the corner has no image in the plane, or it is uncertain
    s[k] = std::copysign(x[k] * x[k] + y[k] * y[k], is_flat ? -1.0 : det);
  }
}

/// Integrates with density 1 and three terms of the series. With A = P.P, B = P.Q, C = Q.Q, T = A+C, G = AC
/// the means over t of s, s^2, s^3 are
///     (T+B)/3,  (3 T (T+B) + 2 B^2 - 5 G)/15,  (5 T^2 (T+B) + (2T+B) (2 B^2 - 7 G))/35,
/// and (x,y) = (1-t) P + t Q needs those of (1-t) s and (1-t) s^2 for P,
///     (3A+2B+C)/12,  (M + 2A (2A+B))/30  with  M = T (T+2B) + 2 B^2 - G,
/// and the same for Q with A and C exchanged.
void integrate_tiny(Entries& e) {
  const double *const x = e.x.data(), *const y = e.y.data(), *const s = e.s.data();
  double *const mass = e.mass.data(), *const energy = e.energy.data();
  double *const pull_x = e.pull_x.data(), *const pull_y = e.pull_y.data();
#ifndef __clang__
#pragma GCC ivdep  // the arrays do not overlap; Clang tests that itself
#endif
  for (std::size_t k = 0; k + 1 < e.count; ++k) {
    const double det = x[k] * y[k + 1] - y[k] * x[k + 1];
    const double a = s[k], b = x[k] * x[k + 1] + y[k] * y[k + 1], c = s[k + 1], t = a + c, g = a * c;
    const double b2 = 2 * b * b, one = t + b, two = 3 * t * one + (b2 - 5 * g);
    const double three = 5 * t * t * one + (2 * t + b) * (b2 - 7 * g), m = t * (t + 2 * b) + (b2 - g);
    const double p = 1.0 / 6 - (one + b + 2 * a) * (1.0 / 30) + (m + 2 * a * (2 * a + b)) * (1.0 / 70);
    const double q = 1.0 / 6 - (one + b + 2 * c) * (1.0 / 30) + (m + 2 * c * (2 * c + b)) * (1.0 / 70);
    mass[k] = det * (0.5 - one * (1.0 / 8) + two * (1.0 / 48) - three * (1.0 / 128));
    energy[k] = det * (one * (1.0 / 12) - two * (1.0 / 40) + three * (29.0 / 2240));
    pull_x[k] = det * (p * x[k] + q * x[k + 1]);
    pull_y[k] = det * (p * y[k] + q * y[k + 1]);
  }
}

/// Integrates the smooth cells, with two terms of the series. On the ray t, with the means over r of 1, r,
/// r^2 times the three powers of z.
void integrate_smooth(Entries& e) {
  const double *const x = e.x.data(), *const y = e.y.data();
  const double *const centre = e.centre.data(), *const linear = e.linear.data();
  const double* const rest = e.rest.data();
  const double *const xx = e.xx.data(), *const xy = e.xy.data(), *const yy = e.yy.data();
  double *const mass = e.mass.data(), *const energy = e.energy.data();
  double *const pull_x = e.pull_x.data(), *const pull_y = e.pull_y.data();
#ifndef __clang__
#pragma GCC ivdep  // the arrays do not overlap; Clang tests that itself
#endif
  for (std::size_t k = 0; k + 1 < e.count; ++k) {
    const double dx = x[k + 1] - x[k], dy = y[k + 1] - y[k], det = x[k] * dy - y[k] * dx, a = centre[k];
    double m = 0, f = 0, px = 0, py = 0;
    const auto add = [&](double t, double weight) {
      const double u = x[k] + t * dx, v = y[k] + t * dy, s = u * u + v * v;
      const double b = linear[k] + t * (linear[k + 1] - linear[k]);
      const double c = rest[k] + t * (rest[k + 1] - rest[k]) + u * (xx[k] * u + xy[k] * v) + yy[k] * v * v;
      const auto mean = [&](int power) {  // of the density times r^(power-1)
        return a * (1.0 / power) + b * (1.0 / (power + 1)) + c * (1.0 / (power + 2));
      };
      const double w = weight * det;
      m += w * (mean(2) - s * (1.5 * mean(4)));
      f += w * s * (mean(4) - s * (2.25 * mean(6)));
      const double p = w * (mean(3) - s * (2 * mean(5)));
      px += p * u;
      py += p * v;
    };
    add(kGaussPoint[0], kGaussWeight[0]);
    add(kGaussPoint[1], kGaussWeight[1]);
    add(kGaussPoint[2], kGaussWeight[2]);
    mass[k] = m;
    energy[k] = f;
    pull_x[k] = px;
    pull_y[k] = py;
  }
}

/// Integrates consecutive cells, up to kCells at a time.
class SmallCells {
 public:
  static constexpr std::size_t kCells = 64;  ///< so few that their arrays fit the first-level cache
  SmallCells(const Point* points, const NeighbourLists& stars, const ScaledDensity& density, Cells& cells)
      : points_(points),
        stars_(stars),
        slots_(stars.end_of(stars.count - 1)),
        density_(density),
        cells_(cells),
        large_(density) {
    const Point anywhere{1, 0, 0};
    if (density.is_constant()) density.at(1, &anywhere, &constant_);
  }

  void integrate(std::size_t first, std::size_t last) {
    first_ = first;
    last_ = last;
    order_cells();
    read_neighbours();
    find_corners(e_);
    close_cells();
    if (density_.is_constant()) {
      if (std::find(size_.begin(), size_.end(), Size::tiny) != size_.end()) integrate_tiny(e_);
      for_each_cell([&](std::size_t i, std::size_t k, std::size_t count) {
        if (size_[i - first_] == Size::tiny) write(i, k, count, constant_);
        if (size_[i - first_] != Size::small) return;
        const double c = constant_;
        for (std::size_t j = k; j < k + count; ++j) integrate_triangle(j, c, {c, c, c}, {c, c});
        write(i, k, count, 1);
      });
    } else {
      sample_corners();
      fit_smooth_cells();
      if (std::find(size_.begin(), size_.end(), Size::smooth) != size_.end()) integrate_smooth(e_);
      for_each_cell([&](std::size_t i, std::size_t k, std::size_t count) {
        if (size_[i - first_] == Size::smooth) write(i, k, count, 1);
      });
      sample_sides();
      integrate_small();
    }
    for_each_cell([&](std::size_t i, std::size_t, std::size_t) {
      if (size_[i - first_] == Size::large) integrate_large(i);
    });
  }

 private:
  static constexpr std::size_t kAhead = 6 * kCells;  ///< distance of prefetching, in neighbours

  /// Tiny: of constant density; smooth: fine, and the density varies little; large also: rough.
  enum class Size : char { tiny, smooth, small, large };

  /// body(i, k, count): cell i has the neighbours, corners and triangles k..k+count-1.
  template <class Body>
  void for_each_cell(const Body& body) const {
    std::size_t k = 0;
    for (const std::uint32_t cell : order_) {
      const std::size_t i = first_ + cell, count = stars_.end_of(i) - stars_.begin_of(i);
      body(i, k, count);
      k += count + 1;
    }
  }

  /// Orders the cells by their number of neighbours, so that the ends of loops over a cell are predictable.
  void order_cells() {
    constexpr std::size_t kMost = 15;
    const auto key = [&](std::size_t i) { return std::min(stars_.end_of(i) - stars_.begin_of(i), kMost); };
    std::uint32_t begin[kMost + 2] = {};
    for (std::size_t i = first_; i < last_; ++i) ++begin[key(i) + 1];
    for (std::size_t k = 0; k < kMost; ++k) begin[k + 1] += begin[k];
    order_.resize(last_ - first_);
    for (std::size_t i = first_; i < last_; ++i)
      order_[begin[key(i)]++] = static_cast<std::uint32_t>(i - first_);
  }

  void read_neighbours() {
    e_.resize(stars_.end_of(last_ - 1) - stars_.begin_of(first_) + (last_ - first_));
    axes_.resize(last_ - first_);
    double *const u = e_.u.data(), *const v = e_.v.data(), *const half = e_.half.data();
    for_each_cell([&](std::size_t i, std::size_t k, std::size_t count) {
      const Point g = points_[i];
      const Axes axes(g);
      const std::size_t begin = stars_.begin_of(i), ahead = begin + count + kAhead <= slots_ ? kAhead : 0;
      const std::int32_t* const ring = stars_.neighbour + begin;
      for (std::size_t j = 0; j < count; ++j) {
        __builtin_prefetch(points_ + (ring[j + ahead] - 1));
        const Spoke spoke(points_[static_cast<std::size_t>(ring[j]) - 1], g, axes);
        u[k + j] = spoke.u;
        v[k + j] = spoke.v;
        half[k + j] = spoke.half;
      }
      u[k + count] = u[k], v[k + count] = v[k], half[k + count] = half[k];
      axes_[i - first_] = axes;
    });
  }

  void close_cells() {
    double *const x = e_.x.data(), *const y = e_.y.data(), *const s = e_.s.data();
    const bool is_constant = density_.is_constant();
    const Size tiny = is_constant ? Size::tiny : Size::smooth;
    const double most = is_constant ? kTiny : kFine;
    size_.resize(last_ - first_);
    for_each_cell([&](std::size_t i, std::size_t k, std::size_t count) {
      bool is_tiny = true, is_small = true;
      for (std::size_t j = k; j < k + count; ++j) {
        is_tiny &= s[j] <= most;
        is_small &= s[j] >= 0 && s[j] <= kSmall;
      }
      size_[i - first_] = !is_small ? Size::large : is_tiny ? tiny : Size::small;
      x[k + count] = x[k], y[k + count] = y[k], s[k + count] = s[k];
    });
  }

  void write(std::size_t i, std::size_t k, std::size_t count, double factor) {
    double mass = 0, energy = 0, x = 0, y = 0;
    for (std::size_t j = k; j < k + count; ++j) {
      mass += e_.mass[j];
      energy += e_.energy[j];
      x += e_.pull_x[j];
      y += e_.pull_y[j];
    }
    const Axes& axes = axes_[i - first_];
    cells_.mass[i] = factor * mass;
    cells_.energy[i] = factor * energy;
    cells_.pull[i] = plus(scaled(factor * x, axes.e1), scaled(factor * y, axes.e2));
  }

  void integrate_large(std::size_t i) {
    const std::size_t begin = stars_.begin_of(i);
    const Axes& axes = axes_[i - first_];
    const Sums sums =
        large_.integrate(points_, points_[i], axes, stars_.neighbour + begin, stars_.end_of(i) - begin);
    cells_.mass[i] = sums.mass;
    cells_.energy[i] = sums.energy;
    cells_.pull[i] = plus(scaled(sums.pull_x, axes.e1), scaled(sums.pull_y, axes.e2));
  }

  void sample(std::size_t i, double x, double y) {
    const Axes& axes = axes_[i - first_];
    const Point q = plus(points_[i], plus(scaled(x, axes.e1), scaled(y, axes.e2)));
    samples_.push_back(scaled(1 / std::sqrt(1 + (x * x + y * y)), q));
  }
  void evaluate_samples() {
    if (samples_.empty()) return;
    values_.resize(samples_.size());
    density_.at(samples_.size(), samples_.data(), values_.data());
  }

  /// The density at the generators and corners.
  void sample_corners() {
    samples_.clear();
    for_each_cell([&](std::size_t i, std::size_t k, std::size_t count) {
      if (size_[i - first_] == Size::large) return;
      samples_.push_back(points_[i]);
      for (std::size_t j = k; j < k + count; ++j) sample(i, e_.x[j], e_.y[j]);
    });
    evaluate_samples();
    const double* value = values_.data();
    for_each_cell([&](std::size_t i, std::size_t k, std::size_t count) {
      if (size_[i - first_] == Size::large) return;
      Size& size = size_[i - first_];
      const auto [least, most] = std::minmax_element(value, value + 1 + count);
      if (*most > kRough * *least)
        size = Size::large;
      else if (*most > kSmooth * *least)
        size = Size::small;
      e_.centre[k] = *value++;
      std::copy_n(value, count, e_.density.begin() + static_cast<std::ptrdiff_t>(k));
      e_.density[k + count] = e_.density[k];
      value += count;
    });
  }

  /// Least squares at the corners, with lengths in units of their root mean square distance and the basis x,
  /// y, x^2-y^2, 2xy, x^2+y^2, whose normal equations (solved by Cholesky's method) are diagonal in a regular
  /// cell. A cell of 3 or 4 sides, or nearly, does not determine the polynomial: it is no smooth one.
  void fit_smooth_cells() {
    constexpr std::size_t kTerms = 5;
    constexpr double kLeastPivot = 0.1;  // 2.5 in a regular pentagon
    for_each_cell([&](std::size_t i, std::size_t k, std::size_t count) {
      if (size_[i - first_] != Size::smooth) return;
      double square = 0;
      for (std::size_t j = k; j < k + count; ++j) square += e_.s[j];
      square /= static_cast<double>(count);
      const double per_length = 1 / std::sqrt(square), centre = e_.centre[k];
      double lower[kTerms][kTerms] = {}, right[kTerms] = {};
      for (std::size_t j = k; j < k + count; ++j) {
        const double x = e_.x[j] * per_length, y = e_.y[j] * per_length, more = e_.density[j] - centre;
        const double term[kTerms] = {x, y, x * x - y * y, 2 * x * y, x * x + y * y};
        for (std::size_t r = 0; r < kTerms; ++r) {
          for (std::size_t c = 0; c <= r; ++c) lower[r][c] += term[r] * term[c];
          right[r] += term[r] * more;
        }
      }
      for (std::size_t c = 0; c < kTerms; ++c) {
        for (std::size_t d = 0; d < c; ++d)
          for (std::size_t r = c; r < kTerms; ++r) lower[r][c] -= lower[r][d] * lower[c][d];
        if (!(lower[c][c] > kLeastPivot)) {
          size_[i - first_] = Size::small;
          return;
        }
        const double inverse = 1 / std::sqrt(lower[c][c]);
        for (std::size_t r = c; r < kTerms; ++r) lower[r][c] *= inverse;
        right[c] *= inverse;
        for (std::size_t r = c + 1; r < kTerms; ++r) right[r] -= lower[r][c] * right[c];
        lower[c][c] = inverse;
      }
      for (std::size_t c = kTerms; c-- > 0;) {
        for (std::size_t r = c + 1; r < kTerms; ++r) right[c] -= lower[r][c] * right[r];
        right[c] *= lower[c][c];
      }
      const double b_x = right[0] * per_length, b_y = right[1] * per_length;
      const double xx = (right[4] + right[2]) / square, xy = 2 * right[3] / square;
      const double yy = (right[4] - right[2]) / square;
      for (std::size_t j = k; j <= k + count; ++j) {
        const double x = e_.x[j], y = e_.y[j], linear = b_x * x + b_y * y;
        e_.centre[j] = centre;
        e_.linear[j] = linear;
        e_.xx[j] = xx, e_.xy[j] = xy, e_.yy[j] = yy;
        e_.rest[j] = e_.density[j] - centre - linear - (x * (xx * x + xy * y) + yy * y * y);
      }
    });
  }

  /// For each entry of the other small cells the density midway between generator and corner, and between
  /// this corner and the next.
  void sample_sides() {
    samples_.clear();
    for_each_cell([&](std::size_t i, std::size_t k, std::size_t count) {
      if (size_[i - first_] != Size::small) return;
      for (std::size_t j = k; j < k + count; ++j) {
        sample(i, e_.x[j] / 2, e_.y[j] / 2);
        sample(i, (e_.x[j] + e_.x[j + 1]) / 2, (e_.y[j] + e_.y[j + 1]) / 2);
      }
    });
    evaluate_samples();
  }

  void integrate_small() {
    const double* value = values_.data();
    for_each_cell([&](std::size_t i, std::size_t k, std::size_t count) {
      if (size_[i - first_] != Size::small) return;
      const double* const end = value + 2 * count;
      const auto [least, most] = std::minmax_element(value, end);
      const auto [low, high] = std::minmax_element(&e_.density[k], &e_.density[k] + count);
      if (std::max({*most, *high, e_.centre[k]}) > kRough * std::min({*least, *low, e_.centre[k]}))
        size_[i - first_] = Size::large;
      for (std::size_t j = 0; j < count; ++j) {
        const double *const here = value + 2 * j, *const next = value + 2 * (j + 1 < count ? j + 1 : 0);
        integrate_triangle(k + j, e_.centre[k], {e_.density[k + j], here[0], here[1]},
                           {e_.density[k + j + 1], next[0]});
      }
      write(i, k, count, 1);
      value = end;
    });
  }

  /// here[0], next[0]: the density at the two corners; here[1], next[1]: midway between generator and corner;
  /// here[2]: midway between the corners.
  void integrate_triangle(std::size_t k, double centre, const std::array<double, 3>& here,
                          const std::array<double, 2>& next) {
    const double dx = e_.x[k + 1] - e_.x[k], dy = e_.y[k + 1] - e_.y[k];
    const double det = e_.x[k] * dy - e_.y[k] * dx;
    double mass = 0, energy = 0, pull_x = 0, pull_y = 0;
    for (int i = 0; i < 3; ++i) {
      const double t = kGaussPoint[i], x = e_.x[k] + t * dx, y = e_.y[k] + t * dy, s = x * x + y * y;
      // The polynomial of degree 2 with these values, on the ray: a + b r + c r^2.
      const double a = centre;
      const double b = (1 - t) * (4 * here[1] - here[0] - 3 * a) + t * (4 * next[1] - next[0] - 3 * a);
      const double c = 2 * a + 2 * (1 - t) * (1 - t) * here[0] + 2 * t * t * next[0] - 4 * (1 - t) * here[1] -
                       4 * t * next[1] + 4 * t * (1 - t) * here[2];
      // Its integral times r^(power-1).
      const auto mean = [&](int power) {
        return a * (1.0 / power) + b * (1.0 / (power + 1)) + c * (1.0 / (power + 2));
      };
      const double w = kGaussWeight[i] * det;
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
    e_.mass[k] = mass;
    e_.energy[k] = energy;
    e_.pull_x[k] = pull_x;
    e_.pull_y[k] = pull_y;
  }

  const Point* const points_;
  const NeighbourLists& stars_;
  const std::size_t slots_;  ///< number of neighbours of all cells
  const ScaledDensity& density_;
  Cells& cells_;
  LargeCell large_;
  double constant_ = 0;
  std::size_t first_ = 0, last_ = 0;  ///< cells
  Entries e_;
  std::vector<std::uint32_t> order_;  ///< of the cells
  std::vector<Axes> axes_;            ///< of each cell
  std::vector<Size> size_;            ///< of each cell
  std::vector<Point> samples_;
  std::vector<double> values_;
};

}  // namespace

Point centroid(const Cells& cells, std::size_t i, const Point& g) {
  const double mass = cells.mass[i];
  const Point moment = plus(cells.pull[i], scaled(mass - cells.energy[i] / 2, g));
  if (mass > 0x1p-300 && mass < 0x1p300) return normalized(moment);
  return normalized(scaled(std::ldexp(1, -std::clamp(std::ilogb(mass), -1000, 1000)), moment));
}

std::size_t nearest_neighbour(const Point* points, const NeighbourLists& stars, std::size_t i) {
  std::size_t nearest = i;
  double least = 5;
  for (std::size_t s = stars.begin_of(i); s < stars.end_of(i); ++s) {
    const auto j = static_cast<std::size_t>(stars.neighbour[s]) - 1;
    const Point d = minus(points[j], points[i]);
    if (const double square = dot(d, d); square < least) {
      least = square;
      nearest = j;
    }
  }
  return nearest;
}

void integrate(const Point* points, const NeighbourLists& stars, const ScaledDensity& density, Cells& cells) {
  cells.resize(stars.count);
  if (stars.count == 0) return;  // a rank without generators
  const int threads = density.is_serial() ? 1 : threads_for(10 * stars.count);
  ErrorsOfThreads errors(static_cast<std::size_t>(threads));
  parallel_pieces(stars.count, threads, [&](std::size_t first, std::size_t last, int piece) {
    errors.keep(static_cast<std::size_t>(piece), [&] {
      SmallCells block(points, stars, density, cells);
      for (std::size_t i = first; i < last; i += SmallCells::kCells)
        block.integrate(i, std::min(i + SmallCells::kCells, last));
    });
  });
  errors.rethrow();
}

}  // namespace pstripack::scvt
