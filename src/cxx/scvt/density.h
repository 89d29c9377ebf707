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

/// A density times 2^-exponent, so that products of integrals neither overflow nor underflow. Where they
/// would not anyway, all results but for that factor have the same bits.
class ScaledDensity {
 public:
  /// The density as it is.
  ScaledDensity(const Density& density) : density_(&density) {}  // NOLINT(google-explicit-constructor)
  /// For a density whose largest value is about `largest`. The exponent is 0 if that is within 2^+-20.
  ScaledDensity(const Density& density, double largest);

  /// The scaled values. Throws BadDensity if one is not positive and finite, or not within 2^+-700.
  void at(std::size_t n, const Point* p, double* value) const;
  bool is_constant() const { return density_->is_constant(); }
  bool is_serial() const { return density_->is_serial(); }
  int exponent() const { return exponent_; }
  double largest() const { return largest_; }
  const Density& density() const { return *density_; }

 private:
  const Density* density_;
  double largest_ = 1, factor_ = 1;
  int exponent_ = 0;
};

/// The density at the points, and the largest of these values. Throw BadDensity.
std::vector<double> values_at(const std::vector<Point>& points, const Density& density);
double largest_value(const Density& density, const std::vector<Point>& points);

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
