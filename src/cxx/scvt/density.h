#pragma once

#include <cstddef>
#include <vector>

#include "geometry/point.h"

namespace pstripack::scvt {

/// A positive function on the sphere. The cells of a centroidal tessellation are about density^(-1/4) wide.
class Density {
 public:
  virtual ~Density() = default;
  /// Sets value[i] to the density at the unit vector p[i], i = 0..n-1. Any number of threads call it at
  /// once, unless is_serial(). The value must depend on p[i] alone, never on earlier calls: so results have
  /// the same bits for any number of threads and ranks.
  virtual void at(std::size_t n, const Point* p, double* value) const = 0;
  /// True if the value is the same everywhere. Then it is evaluated once, and cells are integrated faster.
  virtual bool is_constant() const { return false; }
  /// True if only the thread that called the library may call at().
  virtual bool is_serial() const { return false; }

  double at(const Point& p) const {
    double value = 0;
    at(1, &p, &value);
    return value;
  }
};

class ConstantDensity final : public Density {
 public:
  explicit ConstantDensity(double value = 1) : value_(value) {}
  using Density::at;
  void at(std::size_t n, const Point* p, double* value) const override;
  bool is_constant() const override { return true; }

 private:
  double value_;
};

/// (1 + (ratio-1) (1 + tanh((radius-d)/width))/2)^4 at the distance d from the centre: cells near the
/// centre are `ratio` times narrower than far away. Lengths in radians.
class BumpDensity final : public Density {
 public:
  BumpDensity(const Point& centre, double radius, double width, double ratio)
      : centre_(centre), radius_(radius), width_(width), ratio_(ratio) {}
  using Density::at;
  void at(std::size_t n, const Point* p, double* value) const override;

 private:
  Point centre_;
  double radius_, width_, ratio_;
};

}  // namespace pstripack::scvt
