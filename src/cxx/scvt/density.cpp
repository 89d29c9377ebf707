#include "scvt/density.h"

#include <algorithm>
#include <cmath>

namespace pstripack::scvt {

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
