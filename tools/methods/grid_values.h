#pragma once
// Values on a grid of longitudes and latitudes, bilinear in between.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "files/nodes.h"

namespace methods {

/// Values on rows from pole to pole, in degrees. The first column is repeated at the end, 360 degrees on.
struct Table {
  std::vector<double> lon, lat, values;
};

/// The table of values on a grid, row after row of latitude. Longitudes must go once around the globe. At a
/// pole without a row it gets one with the mean of the last row. Throws std::runtime_error, saying why, if
/// the axes are no such grid.
Table table_of(const files::Grid& grid, const std::vector<double>& values);

/// Increasing numbers; finds the interval that contains a number.
class Axis {
 public:
  explicit Axis(std::vector<double> ticks);

  struct Place {
    std::size_t before;
    double part;  ///< fraction of the way to the next tick
  };
  /// The interval of x; x lies between the first and the last tick.
  Place place(double x) const {
    const double guess = (x - ticks_.front()) * ticks_per_unit_;  // correct if the ticks are equidistant
    std::size_t i = std::min(static_cast<std::size_t>(std::max(guess, 0.0)), ticks_.size() - 2);
    if (__builtin_expect(!(ticks_[i] <= x && x <= ticks_[i + 1]), false)) i = found(x);
    return {i, (x - ticks_[i]) / (ticks_[i + 1] - ticks_[i])};
  }
  double first() const { return ticks_.front(); }

 private:
  std::size_t found(double x) const;

  std::vector<double> ticks_;
  double ticks_per_unit_;
};

class GridValues {
 public:
  explicit GridValues(Table table);
  /// The values at unit vectors, positive and finite if those of the table are.
  void at(std::size_t n, const files::Point* p, double* value) const;

 private:
  std::size_t columns_;
  Axis lon_, lat_;
  std::vector<double> values_;
};

/// A mean of positive finite values, which its rounding may have made 0 or infinite.
double in_range(double mean);

}  // namespace methods
