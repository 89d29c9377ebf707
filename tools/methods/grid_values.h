#pragma once
// Values on a grid of longitudes and latitudes, bilinear in between.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "files/nodes.h"

namespace methods {

/// Values on rows from pole to pole, in degrees. The first column is repeated at the end, 360 degrees on.
template <class Value>
struct TableOf {
  std::vector<double> lon, lat;
  std::vector<Value> values;
};
/// Of widths: maps are large, and seven digits are enough. Densities may have any size.
using Table = TableOf<float>;

/// The table of values on a grid, row after row of latitude. Longitudes must go once around the globe. At a
/// pole without a row it gets one with the mean of the last row. Throws std::runtime_error, saying why, if
/// the axes are no such grid. Value: float, double.
template <class Value>
TableOf<Value> table_of(const files::Grid& grid, const std::vector<double>& values);

/// Increasing numbers; finds the interval that contains a number.
class Axis {
 public:
  explicit Axis(std::vector<double> ticks);

  struct Place {
    std::int64_t before;
    double part;  ///< fraction of the way to the next tick
  };
  /// The interval of x; x lies between the first and the last tick, up to rounding.
  Place place(double x) const {
    const double position = (x - ticks_.front()) * ticks_per_unit_;
    std::int64_t i = std::clamp<std::int64_t>(static_cast<std::int64_t>(position), 0, last_);
    if (is_equidistant_) return {i, position - static_cast<double>(i)};
    if (!(ticks_[index(i)] <= x && x <= ticks_[index(i) + 1])) i = found(x);
    return {i, (x - ticks_[index(i)]) / (ticks_[index(i) + 1] - ticks_[index(i)])};
  }
  double first() const { return ticks_.front(); }

 private:
  static std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }
  std::int64_t found(double x) const;

  std::vector<double> ticks_;
  double ticks_per_unit_;
  std::int64_t last_;    ///< interval
  bool is_equidistant_;  ///< to a thousand-millionth of an interval
};

template <class Value>
class GridValues {
 public:
  explicit GridValues(TableOf<Value> table);
  /// The values at unit vectors, positive and finite if those of the table are.
  void at(std::size_t n, const files::Point* p, double* value) const;

 private:
  std::size_t columns_;
  Axis lon_, lat_;
  std::vector<Value> values_;
};

/// A mean of positive finite values, which its rounding may have made 0 or infinite.
double in_range(double mean);

}  // namespace methods
