#include "methods/grid_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace methods {
namespace {

using files::Point;

constexpr double kDegree = 3.14159265358979323846 / 180;

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

double in_range(double mean) {
  using Limits = std::numeric_limits<double>;
  return std::clamp(mean, Limits::denorm_min(), Limits::max());
}

Axis::Axis(std::vector<double> ticks) : ticks_(std::move(ticks)) {
  ticks_per_unit_ = static_cast<double>(ticks_.size() - 1) / (ticks_.back() - ticks_.front());
}

Axis::Place Axis::place(double x) const {
  const double guess = (x - ticks_.front()) * ticks_per_unit_;  // correct if the ticks are equidistant
  std::size_t i = std::min(static_cast<std::size_t>(std::max(guess, 0.0)), ticks_.size() - 2);
  if (!(ticks_[i] <= x && x <= ticks_[i + 1])) {
    const auto after = std::upper_bound(ticks_.begin() + 1, ticks_.end() - 1, x);
    i = static_cast<std::size_t>(after - ticks_.begin()) - 1;
  }
  return {i, (x - ticks_[i]) / (ticks_[i + 1] - ticks_[i])};
}

GridValues::GridValues(Table table)
    : columns_(table.lon.size()),
      lon_(std::move(table.lon)),
      lat_(std::move(table.lat)),
      values_(std::move(table.values)) {}

void GridValues::at(std::size_t n, const Point* p, double* value) const {
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

}  // namespace methods
