#include "scvt/density.h"

#include <algorithm>
#include <cmath>

#include "scvt/errors.h"

namespace pstripack::scvt {

ScaledDensity::ScaledDensity(const Density& density, double largest) : density_(&density), largest_(largest) {
  constexpr int kOrdinary = 20, kMost = 1000;  // 2^kMost and 2^-kMost are doubles; floats hold 2^-149
  const int exponent = std::ilogb(largest);
  if (exponent < -kOrdinary || exponent > kOrdinary) exponent_ = std::clamp(exponent, -kMost, kMost);
  factor_ = std::ldexp(1, -exponent_);
}

void ScaledDensity::at(std::size_t n, const Point* p, double* value) const {
  constexpr double kMost = 0x1p700;  // then products of integrals stay in range
  density_->at(n, p, value);
  for (std::size_t i = 0; i < n; ++i) {
    const double v = value[i] * factor_;
    if (!(v >= 1 / kMost && v <= kMost)) throw BadDensity(p[i], value[i], largest_);
  }
  if (exponent_ != 0)
    for (std::size_t i = 0; i < n; ++i) value[i] *= factor_;
}

std::vector<double> values_at(const std::vector<Point>& points, const Density& density) {
  std::vector<double> values(points.size());
  density.at(points.size(), points.data(), values.data());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0 && std::isfinite(values[i]))) throw BadDensity(points[i], values[i]);
  return values;
}

double largest_value(const Density& density, const std::vector<Point>& points) {
  double largest = 0;
  const std::vector<double> values = values_at(points, density);
  for (const double v : values) largest = std::max(largest, v);
  return largest;
}

void ConstantDensity::at(std::size_t n, const Point*, double* value) const { std::fill_n(value, n, value_); }

void BumpDensity::at(std::size_t n, const Point* p, double* value) const {
  for (std::size_t i = 0; i < n; ++i) {
    const Point d = minus(p[i], centre_);
    const double distance = 2 * std::asin(std::min(1.0, std::sqrt(dot(d, d)) / 2));
    const double finer = 1 + (ratio_ - 1) * (1 + std::tanh((radius_ - distance) / width_)) / 2;
    value[i] = finer * finer * (finer * finer);
  }
}

}  // namespace pstripack::scvt
