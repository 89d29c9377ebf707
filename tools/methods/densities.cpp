#include "methods/densities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "methods/triangulated_nodes.h"
#include "numbers.h"
#include "point_sets.h"
#include "text_file.h"

namespace methods {
namespace {

using files::Point;

constexpr double kPi = 3.14159265358979323846, kDegree = kPi / 180;

/// A mean of positive finite values, which its rounding may have made 0 or infinite.
double in_range(double mean) {
  using Limits = std::numeric_limits<double>;
  return std::clamp(mean, Limits::denorm_min(), Limits::max());
}

class SampledDensity : public Density {
 public:
  SampledDensity(const std::vector<Point>& nodes, std::vector<double> values)
      : interpolation_(interpolation_between(nodes)), values_(std::move(values)) {}

  void at(std::size_t n, const Point* p, double* value) const override {
    thread_local std::vector<Share> shares;
    thread_local std::int32_t near = 1;  // start near the last place; the result does not depend on it
    if (static_cast<std::size_t>(near) > values_.size()) near = 1;  // that density had more nodes
    for (std::size_t i = 0; i < n; ++i) {
      value[i] = std::numeric_limits<double>::quiet_NaN();
      if (!interpolation_.linear(p[i], near, shares)) continue;
      double mean = 0;
      for (const Share& s : shares) mean += s.part * values_[static_cast<std::size_t>(s.node) - 1];
      value[i] = in_range(mean);
    }
  }

 private:
  Interpolation interpolation_;
  std::vector<double> values_;
};

/// Increasing numbers; finds the interval that contains a number.
class Axis {
 public:
  explicit Axis(std::vector<double> ticks) : ticks_(std::move(ticks)) {
    ticks_per_unit_ = static_cast<double>(ticks_.size() - 1) / (ticks_.back() - ticks_.front());
  }

  struct Place {
    std::size_t before;
    double part;  ///< fraction of the way to the next tick
  };
  /// The interval of x; x lies between the first and the last tick.
  Place place(double x) const {
    const double guess = (x - ticks_.front()) * ticks_per_unit_;  // correct if the ticks are equidistant
    std::size_t i = std::min(static_cast<std::size_t>(std::max(guess, 0.0)), ticks_.size() - 2);
    if (!(ticks_[i] <= x && x <= ticks_[i + 1])) {
      const auto after = std::upper_bound(ticks_.begin() + 1, ticks_.end() - 1, x);
      i = static_cast<std::size_t>(after - ticks_.begin()) - 1;
    }
    return {i, (x - ticks_[i]) / (ticks_[i + 1] - ticks_[i])};
  }
  double first() const { return ticks_.front(); }

 private:
  std::vector<double> ticks_;
  double ticks_per_unit_;
};

/// Values on rows from pole to pole. The first column is repeated at the end, 360 degrees on.
struct Table {
  std::vector<double> lon, lat, values;
};

class GridDensity : public Density {
 public:
  explicit GridDensity(Table table)
      : columns_(table.lon.size()),
        lon_(std::move(table.lon)),
        lat_(std::move(table.lat)),
        values_(std::move(table.values)) {}

  void at(std::size_t n, const Point* p, double* value) const override {
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = std::atan2(p[i].y, p[i].x) / kDegree;
      const double turns = std::floor((angle - lon_.first()) / 360);
      const double lon = std::clamp(angle - 360 * turns, lon_.first(), lon_.first() + 360);
      const double lat = std::atan2(p[i].z, std::hypot(p[i].x, p[i].y)) / kDegree;
      const auto [column, east] = lon_.place(lon);
      const auto [row, north] = lat_.place(std::clamp(lat, -90.0, 90.0));
      const auto in_row = [&, column = column, east = east](std::size_t r) {
        const double* const v = &values_[r * columns_ + column];
        return (1 - east) * v[0] + east * v[1];
      };
      value[i] = in_range((1 - north) * in_row(row) + north * in_row(row + 1));
    }
  }

 private:
  std::size_t columns_;
  Axis lon_, lat_;
  std::vector<double> values_;
};

/// The order in which the numbers increase.
template <class Key>
std::vector<std::size_t> sorted(std::size_t n, const Key& key) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

void require_distinct(const std::vector<double>& ticks, const char* name) {
  if (ticks.size() < 2) throw std::runtime_error(fmt::format("the axis {} has a single value", name));
  for (std::size_t i = 1; i < ticks.size(); ++i)
    if (!(ticks[i - 1] < ticks[i]))
      throw std::runtime_error(fmt::format("the axis {} holds {} twice", name, ticks[i]));
}

}  // namespace

std::unique_ptr<Density> density_of(const std::string& formula) {
  if (formula == "constant") return std::make_unique<pstripack::scvt::ConstantDensity>();
  std::vector<double> v{0, 30, 30, 10, 3};
  const auto fail = [&](const char* what) {
    throw std::invalid_argument("density '" + point_sets::excerpt(formula) + "': " + what);
  };
  if (formula.rfind("bump", 0) != 0 || (formula.size() > 4 && formula[4] != ':'))
    fail("expected constant, bump or bump:LON,LAT,RADIUS,WIDTH,RATIO");
  if (formula.size() > 4) {
    v.clear();
    for (std::size_t begin = 5; begin <= formula.size();) {
      const std::size_t end = std::min(formula.find(',', begin), formula.size());
      double value = 0;
      if (!point_sets::parse(formula.substr(begin, end - begin), value)) fail("expected numbers");
      v.push_back(value);
      begin = end + 1;
    }
    if (v.size() != 5) fail("expected five numbers: LON,LAT,RADIUS,WIDTH,RATIO");
    if (!(std::fabs(v[1]) <= 90)) fail("LAT is beyond the pole");
    if (!(v[3] > 0)) fail("WIDTH must be positive");
    if (!(v[4] > 0 && v[4] <= 1000)) fail("RATIO must be above 0, and at most 1000");
  }
  return std::make_unique<pstripack::scvt::BumpDensity>(point_sets::from_degrees(v[0], v[1]), v[2] * kDegree,
                                                        v[3] * kDegree, v[4]);
}

std::unique_ptr<Density> density_between(const std::vector<Point>& nodes, std::vector<double> values) {
  return std::make_unique<SampledDensity>(nodes, std::move(values));
}

namespace {

Table table_of(const files::Grid& grid, const std::vector<double>& values) {
  // Columns from the first one eastwards, without a last column that repeats the first one 360 degrees on.
  const double west = grid.lon.front();
  const auto east_of_first = [&](std::size_t i) {
    return grid.lon[i] - west - 360 * std::floor((grid.lon[i] - west) / 360);
  };
  std::vector<std::size_t> columns = sorted(grid.lon.size(), east_of_first);
  std::vector<double> lon, lat;
  if (columns.size() > 1 && east_of_first(columns[1]) == 0) columns.erase(columns.begin() + 1);
  for (const std::size_t i : columns) lon.push_back(east_of_first(i) + west);
  require_distinct(lon, "of longitudes");
  double widest = 0;
  lon.push_back(west + 360);
  for (std::size_t i = 1; i < lon.size(); ++i) widest = std::max(widest, lon[i] - lon[i - 1]);
  if (widest > 2.5 * 360 / static_cast<double>(columns.size()))
    throw std::runtime_error(
        fmt::format("the grid leaves out {} degrees of longitude: a density must cover the sphere", widest));
  const std::vector<std::size_t> rows = sorted(grid.lat.size(), [&](std::size_t i) { return grid.lat[i]; });
  for (const std::size_t i : rows) lat.push_back(grid.lat[i]);
  require_distinct(lat, "of latitudes");
  const double spacing = (lat.back() - lat.front()) / static_cast<double>(lat.size() - 1);
  if (std::max(90 - lat.back(), lat.front() + 90) > 2.5 * spacing)
    throw std::runtime_error(fmt::format(
        "the grid ends at latitudes {} and {}: a density must cover the sphere", lat.front(), lat.back()));

  std::vector<double> table;
  const auto add_row = [&](std::size_t row) {
    const double* const v = &values[row * grid.lon.size()];
    for (const std::size_t c : columns) table.push_back(v[c]);
    table.push_back(v[columns[0]]);
  };
  const auto add_pole = [&](std::size_t row) {
    const auto count = static_cast<double>(columns.size());
    double sum = 0, mean = 0;
    for (const std::size_t c : columns) {
      sum += values[row * grid.lon.size() + c];
      mean += values[row * grid.lon.size() + c] / count;  // cannot overflow
    }
    table.insert(table.end(), columns.size() + 1, std::isfinite(sum) ? sum / count : in_range(mean));
  };
  if (lat.front() > -90) add_pole(rows.front());
  for (const std::size_t row : rows) add_row(row);
  if (lat.back() < 90) add_pole(rows.back());
  if (lat.front() > -90) lat.insert(lat.begin(), -90);
  if (lat.back() < 90) lat.push_back(90);
  return {std::move(lon), std::move(lat), std::move(table)};
}

class WidthDensity : public Density {
 public:
  WidthDensity(Table widths, double least) : widths_(std::move(widths)), least_(least) {}
  using Density::at;
  void at(std::size_t n, const Point* p, double* value) const override {
    widths_.at(n, p, value);
    for (std::size_t i = 0; i < n; ++i) {
      const double square = least_ / value[i] * (least_ / value[i]);
      value[i] = std::min(1.0, square * square);  // bilinear widths round below the least
    }
  }

 private:
  GridDensity widths_;
  double least_;
};

/// The integral of 1/(sqrt(3)/2 w^2): Gauss' rule with three points along each side of a cell of the grid.
double cells_of(const Table& t, double radius) {
  constexpr double kPlaces[] = {-0.7745966692414834, 0, 0.7745966692414834}, kWeights[] = {5, 8, 5};  // / 18
  double cells = 0;
  for (std::size_t row = 0; row + 1 < t.lat.size(); ++row) {
    const double south = std::sin(t.lat[row] * kDegree), north = std::sin(t.lat[row + 1] * kDegree);
    const double height = t.lat[row + 1] - t.lat[row];
    for (int j = 0; j < 3; ++j) {
      const double z = (south + north + kPlaces[j] * (north - south)) / 2;
      const double up = (std::asin(z) / kDegree - t.lat[row]) / height;
      double sum = 0;
      for (std::size_t column = 0; column + 1 < t.lon.size(); ++column) {
        const double* const low = &t.values[row * t.lon.size() + column];
        const double* const high = low + t.lon.size();
        const double west = low[0] + up * (high[0] - low[0]), east = low[1] + up * (high[1] - low[1]);
        for (int i = 0; i < 3; ++i) {
          const double ratio = radius / (west + (1 + kPlaces[i]) / 2 * (east - west));
          sum += kWeights[i] / 18 * ratio * ratio * (t.lon[column + 1] - t.lon[column]) * kDegree;
        }
      }
      cells += kWeights[j] / 18 * (north - south) * sum / (std::sqrt(3) / 2);
    }
  }
  return cells;
}

}  // namespace

std::unique_ptr<Density> density_on_grid(const files::Grid& grid, const std::vector<double>& values) {
  return std::make_unique<GridDensity>(table_of(grid, values));
}

Widths widths_on_grid(const files::Grid& grid, const std::vector<double>& km, double radius) {
  Table table = table_of(grid, km);
  const double least = *std::min_element(table.values.begin(), table.values.end());
  const double cells = cells_of(table, radius);
  return {std::make_unique<WidthDensity>(std::move(table), least), least, cells};
}

double width_of(const std::string& text) {
  double value = 0;
  const std::size_t end = text.find_last_of("0123456789.") + 1;
  const std::string unit = text.substr(end);
  if (!point_sets::parse(text.substr(0, end), value) || !(value > 0) ||
      !(unit.empty() || unit == "km" || unit == "m"))
    throw std::invalid_argument("'" + point_sets::excerpt(text) + "' is no width: expected, say, 60km");
  return unit == "m" ? value / 1000 : value;
}

double cells_of_width(double width, double radius) {
  const double ratio = radius / width;
  return 4 * kPi / (std::sqrt(3) / 2) * ratio * ratio;
}

}  // namespace methods
