#include "scvt/metric.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel_for.h"
#include "parallel/agreement.h"
#include "scvt/vectors.h"

namespace pstripack::scvt {
namespace {

constexpr double kApart = 1e-12;  ///< square of a distance: floats do not tell nearer points apart
constexpr int kPasses = 8;
constexpr double kMost = 2, kLeast = kMost / (kPasses * kPasses);  ///< eigenvalues of A/D

Point at_right_angles(const Point& v, const Point& g) { return minus(v, scaled(dot(v, g), g)); }

using Four = float __attribute__((vector_size(16)));
Four four(const Point& p) {
  return Four{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0};
}
Point point(const Four& v) { return {v[0], v[1], v[2]}; }
Four times(float f, const Four& v) { return Four{f, f, f, f} * v; }
float dot(const Four& a, const Four& b) {
  const Four product = a * b;
  return product[0] + product[1] + product[2];
}

}  // namespace

void Metric::set(const Neighbourhood& here, const Cells& cells) {
  halo_ = here.halo;
  stars_ = here.stars;
  const std::size_t n = stars_.count, all = here.known;
  in_agreement(ranks_, [&] {
    of_doubles_ = halo_->transfer(sizeof(double), ranks_);
    of_vectors_ = halo_->transfer(sizeof(Vector), ranks_);
    spring_.resize(n == 0 ? 0 : stars_.end_of(n - 1));
    for (auto* const array : {&share_, &diagonal_}) array->resize(all);
    for (auto* const array : {&points_, &rest_, &step_, &next_}) array->resize(all);
  });
  parallel_for(n, 10 * n, [&](std::size_t i) {
    share_[i] = cells.mass[i] / static_cast<double>(stars_.end_of(i) - stars_.begin_of(i));
  });
  fill(share_, of_doubles_);
  parallel_for(all, 10 * all, [&](std::size_t i) { points_[i].f = four(here.points[i]); });
  parallel_for(n, 10 * n, [&](std::size_t i) {
    const Point& g = here.points[i];
    Point squares{0, 0, 0}, products{0, 0, 0};  // of i's springs: xx, yy, zz and xy, yz, zx
    for (std::size_t s = stars_.begin_of(i); s < stars_.end_of(i); ++s) {
      const auto j = static_cast<std::size_t>(stars_.neighbour[s]) - 1;
      const Point e = minus(here.points[j], g), t = at_right_angles(e, g);
      const double k = (share_[i] + share_[j]) / (share_[i] * pstripack::dot(e, e));
      squares = plus(squares, scaled(k, Point{t.x * t.x, t.y * t.y, t.z * t.z}));
      products = plus(products, scaled(k, Point{t.x * t.y, t.y * t.z, t.z * t.x}));
      // Without it solve() leaves out an arc; the metric stays symmetric and positive.
      spring_[s] = pstripack::dot(e, e) < kApart ? 0 : static_cast<float>(k);
    }
    // The larger of the two non-zero eigenvalues: their sum is the trace, and the sum of their squares is
    // that of the squares of all entries.
    const double half = (squares.x + squares.y + squares.z) / 2;
    const double entries = pstripack::dot(squares, squares) + 2 * pstripack::dot(products, products);
    const double largest = half + std::sqrt(std::max(0.0, entries / 2 - half * half));
    diagonal_[i] = share_[i] * largest;
    const auto inverse = static_cast<float>(1 / largest);
    for (std::size_t s = stars_.begin_of(i); s < stars_.end_of(i); ++s) spring_[s] *= inverse;
  });
}

void Metric::solve(std::vector<Point>& v) {
  constexpr double kMiddle = (kMost + kLeast) / 2, kRadius = (kMost - kLeast) / 2;
  parallel_for(v.size(), 10 * v.size(), [&](std::size_t i) {
    const Four r = four(scaled(1 / diagonal_[i], v[i])), g = points_[i].f;
    rest_[i].f = r - times(dot(r, g), g);
    step_[i].f = times(static_cast<float>(1 / kMiddle), rest_[i].f);
    v[i] = point(step_[i].f);  // from here on the sum of the steps
  });
  double ratio = kRadius / kMiddle;  // of two consecutive Chebyshev polynomials
  for (int pass = 1; pass < kPasses; ++pass) {
    const double before = ratio;
    ratio = 1 / (2 * kMiddle / kRadius - before);
    const auto of_step = static_cast<float>(ratio * before),
               of_rest = static_cast<float>(2 * ratio / kRadius);
    fill(step_, of_vectors_);
    parallel_for(v.size(), 10 * v.size(), [&](std::size_t i) {
      const Four g = points_[i].f, u = step_[i].f;
      Four force{0, 0, 0, 0};
      for (std::size_t s = stars_.begin_of(i); s < stars_.end_of(i); ++s) {
        const auto j = static_cast<std::size_t>(stars_.neighbour[s]) - 1;
        const Four e = points_[j].f - g;
        force += times(spring_[s] * dot(e, u - step_[j].f), e);
      }
      rest_[i].f -= force - times(dot(force, g), g);
      next_[i].f = times(of_step, u) + times(of_rest, rest_[i].f);
      v[i] = plus(v[i], point(next_[i].f));
    });
    std::swap(step_, next_);
  }
}

}  // namespace pstripack::scvt
